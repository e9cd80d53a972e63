#include "hamjet/maps/position_boundary_values.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {

PositionBoundaryValues::PositionBoundaryValues(const PartialInversion<double>& inversion)
    : inversion_(inversion),
      values_(inversion.remaining_final[0].space_pointer()),
      point_(2 * inversion.kind.degrees_of_freedom(), 0) {}

void PositionBoundaryValues::find_unknowns(int degree) {
  constexpr int most_iterations = 40;
  constexpr double rest = 4 * std::numeric_limits<double>::epsilon();
  constexpr double nearly_at_rest = 1e-9;  // stagnation below this is round-off
  // Where terms cancel, stagnation below the step that the rounding of the positions causes is
  // round-off as well.
  const auto step_of_rounding = [&](const auto& factorised) {
    Eigen::VectorXd rounding(static_cast<Eigen::Index>(unknowns_.size()));
    for (Eigen::Index i = 0; i < rounding.size(); ++i) {
      rounding(i) = values_.rounding(*unknowns_[static_cast<std::size_t>(i)].position, degree);
    }
    return (factorised.inverse().cwiseAbs() * rounding).eval().maxCoeff();
  };
  const auto count = static_cast<Eigen::Index>(unknowns_.size());
  Eigen::MatrixXd jacobian(count, count);
  Eigen::VectorXd residual(count);
  double last_step = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    values_.set_point(point_);
    double size = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Unknown& unknown = unknowns_[static_cast<std::size_t>(i)];
      residual(i) = values_.value(*unknown.position, degree) - unknown.wanted;
      for (Eigen::Index j = 0; j < count; ++j) {
        jacobian(i, j) = values_.derivative(
            *unknown.position, unknowns_[static_cast<std::size_t>(j)].variable, degree);
      }
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> factorised(jacobian);
    const Eigen::VectorXd step = factorised.solve(residual);
    if (!step.allFinite()) break;
    for (Eigen::Index j = 0; j < count; ++j) {
      double& momentum = point_[unknowns_[static_cast<std::size_t>(j)].variable];
      momentum -= step(j);
      size = std::max(size, std::abs(momentum));
    }
    const double norm = step.lpNorm<Eigen::Infinity>();
    if (norm <= rest * size) return;
    if (norm >= last_step &&
        (norm <= nearly_at_rest * size || norm <= step_of_rounding(factorised))) {
      return;
    }
    last_step = norm;
  }
  throw Error(ErrorKind::numerical,
              fmt::format("generating function {}: no momenta were found that join these positions "
                          "with polynomials of degree {}: they are farther apart than the "
                          "polynomials reach, or cannot be commanded at this time",
                          inversion_.kind.name(), degree));
}

BoundaryMomenta PositionBoundaryValues::solve(std::span<const double> initial_position,
                                              std::span<const double> final_position, int degree) {
  const GeneratingFunctionKind& kind = inversion_.kind;
  const std::size_t n = kind.degrees_of_freedom();
  if (initial_position.size() != n || final_position.size() != n || degree < 1 ||
      degree > inversion_.remaining_final[0].order()) {
    throw Error(ErrorKind::usage,
                "boundary values: positions of n numbers and a degree of the "
                "inversion are needed");
  }
  unknowns_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    point_[i] = kind.final_is_momentum[i] ? 0 : final_position[i];
    point_[n + i] = kind.initial_is_momentum[i] ? 0 : initial_position[i];
    if (kind.final_is_momentum[i]) {
      unknowns_.push_back({i, &inversion_.remaining_final[i], final_position[i]});
    }
    if (kind.initial_is_momentum[i]) {
      unknowns_.push_back({n + i, &inversion_.remaining_initial[i], initial_position[i]});
    }
  }
  // Newton's method starts each degree at the solution of the degree below.
  for (int d = 1; d <= degree && !unknowns_.empty(); ++d) find_unknowns(d);
  values_.set_point(point_);
  BoundaryMomenta momenta;
  for (std::size_t i = 0; i < n; ++i) {
    momenta.final.push_back(kind.final_is_momentum[i]
                                ? point_[i]
                                : values_.value(inversion_.remaining_final[i], degree));
    momenta.initial.push_back(kind.initial_is_momentum[i]
                                  ? point_[n + i]
                                  : values_.value(inversion_.remaining_initial[i], degree));
  }
  return momenta;
}

}  // namespace hamjet
