#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What a degree of a run's jet keeps of the tolerance that was asked for.
struct KeptTolerance {
  double asked = 0;         ///< the error that the tolerance allows, PromisedErrors::of_tolerance
  double error = 0;         ///< against a reference, or else estimated
  double rounding = 0;      ///< what rounding alone makes of the degree
  bool is_rounding = true;  ///< whether rounding explains the error; else the steps are too long

  bool is_kept() const { return error <= asked; }
};

/// By degree; empty for fixed steps, which promise nothing, and where no error is known.
std::vector<KeptTolerance> kept_tolerance(const Scene& scene, const RunResult& run);

/// The number of degrees, from 0 on, that all keep it.
std::size_t degrees_kept(const std::vector<KeptTolerance>& by_degree);

/// Which degrees keep the tolerance and what keeps the others from it, in words; empty where all
/// do. An error that is estimated, not measured against a reference, must be more than 10 times
/// what the tolerance allows: estimates may be so many times too high, and only what is surely not
/// kept is worth a warning.
std::string tolerance_warning(const Scene& scene, const RunResult& run);

}  // namespace hamjet
