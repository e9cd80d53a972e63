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
  /// Canonical times at which the determinant of the kind's linear part changes sign, interpolated
  /// between two steps: there the kind does not exist. Two such times within one step go unseen.
  std::vector<double> singular_times;
};

}  // namespace hamjet
