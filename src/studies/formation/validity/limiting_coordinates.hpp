#pragma once

#include "../charts/deputy_flows.hpp"
#include "flown_deputies.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet {

/// The coordinates in which a limit is described: those of a deputy's deviation at the start, and
/// those of the miss of the polynomials at the end.
struct LimitCoordinates {
  std::vector<std::string> start;  ///< names of the polynomials' variables
  std::vector<std::string> end;    ///< names of the polynomials' values
  /// The rows are the frame's axes at the end. For polynomials of positions and momenta, the
  /// components of the position along these axes replace the values.
  Eigen::Matrix3d end_axes = Eigen::Matrix3d::Identity();
};

/// The names of the polynomials' variables and values at the propagation's last time. At an end
/// with positions and momenta, the names are those of the components of the frame.
LimitCoordinates limit_coordinates(const DeputyFlowPropagation& propagation, const DeputyFlow& flow,
                                   RelativeFrame frame, const SystemSettings& system);

/// The limit of an order at a deputy, which is given by its coordinates along the ellipsoids' axes.
ReachLimit reach_limit(FlownDeputies& deputies, int order, const Vector6& deputy,
                       const CoordinatesAtEnds& coordinates, const LimitCoordinates& names);

}  // namespace hamjet
