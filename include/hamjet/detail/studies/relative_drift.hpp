#pragma once

#include <array>
#include <optional>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// How a free deputy drifts away from its chief along the track, when both are flown over a
/// revolution with the full equations of motion. For both, a revolution lasts from one passage
/// through the half-plane of the chief's position and orbital normal to the next.
struct RelativeDrift {
  /// -a n (T_d - T_c), where T is the time of a revolution, n = 2 pi / T_c and a the chief's
  /// osculating semi-major axis; positive ahead of the chief. On a Kepler orbit it is, to first
  /// order, 3 pi times the difference of the semi-major axes, backwards.
  double per_revolution_m = 0;
  double floor_m = 0;              ///< a drift below this is rounding of the flights
  double period_difference_s = 0;  ///< T_d - T_c
  /// The least change of the deputy's present velocity, along its motion, that removes the drift;
  /// in m/s along the axes of the frame. Absent if none was found.
  std::optional<Eigen::Vector3d> holding_change_m_s;
  /// Osculating relative orbital elements in metres, see DeputyForm::relative_elements; absent
  /// where an orbit has none.
  std::optional<std::array<double, 6>> elements_m;

  bool is_none() const { return !(per_revolution_m > floor_m || per_revolution_m < -floor_m); }
};

}  // namespace hamjet
