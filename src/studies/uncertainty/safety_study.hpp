#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/keep_out_margin.hpp"
#include "hamjet/uncertainty/least_separations.hpp"

namespace hamjet {

/// How near two spacecraft of a formation come to each other.
struct SafetyPair {
  std::string first;  ///< "chief", "deputy", "deputy 2", ...
  std::string second;
  /// The fraction of the burn that is completed; no value for a pair that the burn does not affect.
  std::optional<double> burn_share;
  double mean_separation_m = 0;  ///< least separation of the means
  /// In metres. The first separation belongs to the fraction of cases that come nearer than the
  /// rest; the others are quantiles of the whole distribution.
  LeastSeparations separations;
  std::optional<KeepOutMargin> margin;  ///< for a pair with the chief; time in seconds
  std::string refusal;                  ///< reason why the margin was not found
  std::optional<std::string> warning;   ///< reason why its numbers are not reliable
};

/// The passive safety of a formation.
struct SafetyResult {
  SafetyWatch watch;
  double from_s = 0;
  double to_s = 0;
  int order = 0;
  std::vector<SafetyPair> pairs;
  double seconds = 0;
};

/// The pair whose reported separation is least.
const SafetyPair& least_safe_pair(const SafetyResult& result);

/// The study of table `[uncertainty.safety]`. Throws as least_separations.
SafetyResult study_safety(const Scene& scene, std::size_t threads,
                          const ProgressCallback& progress = {});

}  // namespace hamjet
