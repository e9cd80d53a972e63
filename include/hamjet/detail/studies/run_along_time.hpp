#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hamjet {

/// An integrator of the scene watched along time, at some hundred points.
struct RunAlongTime {
  struct Point {
    double time = 0;  ///< canonical
    /// Residual of degree 0 of the kind that is watched, scaled; none where it does not exist.
    std::optional<double> exactness;
    double condition = 0;     ///< of the kind's linear part; infinite where it is singular
    double energy_error = 0;  ///< relative, signed
  };
  std::string label;
  std::string failure;  ///< not empty: stopped there, and why
  std::vector<Point> points;
  /// Canonical times, up to the last point, at which the kind that is watched does not exist: those
  /// of the flow itself, found by find_singular_times, whatever the integrator makes of it.
  std::vector<double> singular_times = {};
  std::string not_searched = {};  ///< not empty: singular times were not searched, and why
};

}  // namespace hamjet
