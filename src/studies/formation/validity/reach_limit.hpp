#pragma once

#include "../deputy_flows.hpp"
#include "flown_deputies.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet {

/// The coordinates in which a limit is told: of a deputy's deviation at the start, and of where the
/// polynomials miss it at the end.
struct LimitCoordinates {
  std::vector<std::string> start;  ///< of the polynomials' variables
  std::vector<std::string> end;    ///< of their values
  /// The rows are the frame's axes at the end; components of the position along them stand for the
  /// values of polynomials of positions and momenta.
  Eigen::Matrix3d end_axes = Eigen::Matrix3d::Identity();
};

/// The names of the polynomials' variables and values at the propagation's last time; at an end
/// where these are positions and momenta themselves, the components of the frame.
LimitCoordinates limit_coordinates(const DeputyFlowPropagation& propagation, const DeputyFlow& flow,
                                   RelativeFrame frame);

/// What limits an order at a deputy, told by its coordinates along the ellipsoids' axes.
ReachLimit reach_limit(FlownDeputies& deputies, int order, const Vector6& deputy,
                       const CoordinatesAtEnds& coordinates, const LimitCoordinates& names);

}  // namespace hamjet
