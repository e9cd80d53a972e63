#pragma once

#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// How a degree of a run's jet compares with the requested tolerance.
struct KeptTolerance {
  double asked = 0;     ///< the error that the tolerance allows, PromisedErrors::of_tolerance
  double error = 0;     ///< measured against a reference, or else estimated
  double rounding = 0;  ///< effect of rounding alone on the degree
  bool is_rounding =
      true;  ///< whether rounding explains the error; otherwise the steps are too long

  bool is_kept() const { return error <= asked; }
};

/// By degree; empty for fixed steps, which promise no error, and if no error is known.
std::vector<KeptTolerance> kept_tolerance(const Scene& scene, const RunResult& run);

/// The number of degrees, from 0 on, that all keep the tolerance.
std::size_t degrees_kept(const std::vector<KeptTolerance>& by_degree);

/// A warning that names the degrees that keep the tolerance and the reason why the others do not;
/// empty if all do. An error that is estimated, not measured against a reference, must exceed the
/// tolerance's error more than 10 times, because estimates may be too high by this factor, and only
/// a tolerance that is surely not kept is worth a warning.
std::string tolerance_warning(const Scene& scene, const RunResult& run);

}  // namespace hamjet
