#pragma once

#include <array>
#include <optional>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// How a deputy that is left to itself goes away from its chief along the track, as both are flown
/// over a revolution with the full equations of motion. A revolution is that from one passage
/// through the half-plane of the chief's place and orbital normal to the next, of both alike.
struct RelativeDrift {
  /// -a n (T_d - T_c), T being the time of a revolution, n = 2 pi / T_c and a the chief's
  /// osculating semi-major axis: positive ahead of the chief. On a Kepler orbit 3 pi times the
  /// difference of the semi-major axes, to first order.
  double per_revolution_m = 0;
  double floor_m = 0;              ///< a drift below this is rounding of the flights
  double period_difference_s = 0;  ///< T_d - T_c
  /// The least change of the deputy's velocity now, along its motion, that leaves no drift; m/s
  /// along the axes of the frame. Absent where none was found.
  std::optional<Eigen::Vector3d> holding_change_m_s;
  /// Osculating relative orbital elements in metres, see DeputyForm::relative_elements; absent
  /// where an orbit has none.
  std::optional<std::array<double, 6>> elements_m;

  bool is_none() const { return !(per_revolution_m > floor_m || per_revolution_m < -floor_m); }
};

}  // namespace hamjet
