#pragma once

#include <Eigen/Core>
#include <span>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/maps/position_boundary_values.hpp"

namespace hamjet {

/// The derivative of the final position by the initial momentum that polynomials up to a degree
/// say, by central differences in one block of deputies. The step leaves some ten digits.
Eigen::Matrix3d commanded_positions(DeputyPredictor& predictor, const SixNumbers<double>& deviation,
                                    int degree);

/// Solves the two-point problem in positions by the polynomials of a flow in any coordinates:
/// Newton's method on the final position that they predict, halved where it does not come nearer.
/// What PositionBoundaryValues does for Cartesian jets, with no generating function in between.
///
/// `first` and `last` are deviations of the positions at both ends, `guess` one of the initial
/// momentum; all canonical. Throws Error(numerical) if no solution is found from there.
BoundaryMomenta solve_positions(const DeputyFlow& flow, std::span<const double> first,
                                std::span<const double> last, int degree,
                                std::span<const double> guess);

}  // namespace hamjet
