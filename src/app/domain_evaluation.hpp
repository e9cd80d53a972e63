#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "deputy_evaluation.hpp"

namespace hamjet::cli {

/// Deputies that have polynomials about a centre of their own. Numbers are of position and velocity
/// in RTN, as seen from the turning axes, in metres and m/s.
struct EvalDomain {
  std::array<double, 6> centre{};  ///< relative to the chief
  std::array<double, 6> half_widths{};
  std::size_t deputies = 0;
  double miss_m = 0;  ///< the largest estimate of a deputy; infinite where one has none
};

/// What deputies were split into.
struct EvalDomains {
  /// More domains than this are not listed, but counted only.
  static constexpr std::size_t most_listed = 100;
  static constexpr std::array<std::string_view, 6> coordinates = {"R", "T", "N", "vR", "vT", "vN"};

  double tolerance_m = 0;
  std::size_t most = 0;   ///< the limit on domains
  std::size_t count = 0;  ///< of domains
  std::size_t maps = 0;   ///< that were integrated, those of domains that were split too
  /// How many domains were halved across each coordinate.
  std::array<std::size_t, 6> splits{};
  std::size_t not_right = 0;  ///< deputies whose estimate is beyond the tolerance
  /// Whether the limit ended the splitting; otherwise what is not right no split makes better.
  bool is_limited = false;
  double largest_miss_m = 0;  ///< of all domains; infinite where a deputy has no estimate
  double seconds = 0;         ///< of the integration of the domains' polynomials
  std::vector<EvalDomain> domains;
};

/// What DeputyEvaluation does, for a scene whose table [eval] asks for domains: deputies are split
/// by split_points, across R, T, N and their rates, until the estimate of each is within the
/// tolerance. To the estimates of deputies with another centre than the chief what both orbits may
/// be wrong by is added. Deputies beyond the tolerance are marked outside.
class DomainEvaluation {
 public:
  /// Points that are split together.
  static constexpr std::size_t most_points = std::size_t{1} << 18;

  /// `pause` is called before each integration and may throw. Throws Error(usage) for a degree
  /// below 2, which has no estimates.
  DomainEvaluation(const EvaluatedScene& scene, int degree,
                   std::size_t threads = usable_processors(), std::function<void()> pause = {});

  void add(const std::vector<double>& deviation);
  /// As DeputyEvaluation::run.
  void run(const std::function<void(const std::vector<double>&, const MissEstimate&)>& take);

  std::size_t pending() const { return pending_.size(); }
  double chief_error() const { return about_chief_.chief_error(); }
  double seconds() const { return seconds_; }
  double chart_seconds() const { return chart_seconds_; }
  double multiply_adds() const { return multiply_adds_; }
  /// Of all points so far.
  const EvalDomains& domains() const { return domains_; }

 private:
  struct Result {
    std::vector<double> deviation;
    MissEstimate estimate;
  };
  class Split;

  const EvaluatedScene& scene_;
  int degree_;
  std::size_t threads_;
  std::function<void()> pause_;
  DeputyEvaluation about_chief_;
  std::vector<SixNumbers<double>> pending_;
  double seconds_ = 0;
  double chart_seconds_ = 0;
  double multiply_adds_ = 0;
  EvalDomains domains_;
};

}  // namespace hamjet::cli
