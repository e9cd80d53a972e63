#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hamjet {

/// Observations of an integrator of the scene along time, at some hundred points.
struct RunAlongTime {
  struct Point {
    double time = 0;  ///< in canonical units
    /// Scaled residual of degree 0 of the observed kind of generating function; no value where the
    /// kind does not exist.
    std::optional<double> exactness;
    double condition = 0;  ///< condition of the kind's linear part; infinite where it is singular
    double energy_error = 0;  ///< relative, signed
  };
  std::string label;
  std::string failure;  ///< if not empty, the reason why the integration stopped
  std::vector<Point> points;
  /// Canonical times, up to the last point, at which the observed kind does not exist. They belong
  /// to the flow itself, independent of the integrator, and are found by find_singular_times.
  std::vector<double> singular_times = {};
  std::string not_searched = {};  ///< if not empty, the reason why singular times were not searched
};

}  // namespace hamjet
