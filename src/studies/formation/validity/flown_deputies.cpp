#include "flown_deputies.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "../../exact_flow.hpp"
#include "../../random_direction.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

Matrix6 ellipsoid_axes(std::span<const double> chief, RelativeFrame frame,
                       std::span<const double> semi_axes, double velocity, const VelocityLaw& law) {
  const ChiefFrame at_chief(chief, MetricUnits{1, 1, law}, frame);
  Matrix6 axes;
  for (std::size_t i = 0; i < 6; ++i) {
    RelativeState state;
    const auto axis = static_cast<Eigen::Index>(i % 3);
    (i < 3 ? state.position_m : state.velocity_m_s)[axis] =
        semi_axes[i % 3] * (i < 3 ? 1 : velocity);
    const std::vector<double> deviation = at_chief.deviation(state);
    axes.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Vector6>(deviation.data());
  }
  return axes;
}

Vector6 random_coordinates(std::mt19937_64& generator) {
  Vector6 coordinates;
  for (const Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
    const std::vector<double> direction = random_direction(generator, 3);
    coordinates.segment<3>(first) = Eigen::Vector3d(direction.data());
  }
  return coordinates;
}

Vector6 direction_of_energy(const DynamicalSystem& system, std::span<const double> chief,
                            const Matrix6& axes) {
  DifferentiableFunction<double> field(system.vector_field);
  field.evaluate(chief);
  const Vector<double> rates = field.values();
  Vector6 gradient;  // gradient of the Hamiltonian: (-dp/dt, dq/dt)
  gradient << -rates.tail<3>(), rates.head<3>();
  Vector6 coordinates = axes.transpose() * gradient;
  for (const Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
    coordinates.segment<3>(first).normalize();
  }
  return coordinates;
}

SixNumbers<double> FlownDeputies::deviation(const Vector6& coordinates) const {
  const Vector6 z = axes_ * coordinates;
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}

std::vector<double> FlownDeputies::state(const SixNumbers<double>& deviation) const {
  std::vector<double> deputy = problem_.nominal;
  for (std::size_t i = 0; i < deviation.size(); ++i) deputy[i] += deviation[i];
  return deputy;
}

Vector6 FlownDeputies::error_of(std::span<const double> flown,
                                const SixNumbers<double>& predicted) const {
  Vector6 error;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    error[static_cast<Eigen::Index>(i)] =
        predictor_.flow().chief_end()[i] + predicted[i] - flown[i];
  }
  return error;
}

Vector6 FlownDeputies::error(const Vector6& coordinates, int order) {
  if (before_flight_) before_flight_();
  const SixNumbers<double> start = deviation(coordinates);
  std::vector<double> flown;
  try {
    flown = exact_flow(problem_.system, state(start), problem_.start_time, time_);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return Vector6::Constant(std::numeric_limits<double>::infinity());
  }
  return error_of(flown, predictor_.predict(start, order).deviation);
}

double FlownDeputies::miss(const Vector6& coordinates, int order) {
  const double distance = error(coordinates, order).head<3>().norm();
  return std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
}

Vector6 FlownDeputies::gradient(const Vector6& coordinates, int order, double step) {
  if (before_flight_) before_flight_();
  constexpr double step_tolerance = 1e-13;  // the directions of an ascent need no more
  FlowJet<double> flown;
  try {
    flown = linear_jet(problem_.system, state(deviation(coordinates)), problem_.start_time, time_,
                       step_tolerance);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return Vector6::Constant(std::numeric_limits<double>::infinity());
  }
  // The error is far smaller than what the polynomials and the flight change by, so that the
  // differences are of fourth order: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / (12 h).
  constexpr double places[] = {1, -1, 2, -2};
  constexpr double weights[] = {8, -8, -1, 1};
  std::vector<SixNumbers<double>> starts = {deviation(coordinates)};
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (const double place : places) {
      starts.push_back(deviation(coordinates + place * step * Vector6::Unit(i)));
    }
  }
  std::vector<DeputyPrediction> predicted(starts.size());
  predictor_.predict(starts, order, predicted);
  const Eigen::Vector3d error = error_of(nominal_of(flown), predicted[0].deviation).head<3>();
  const double miss = error.norm();
  if (miss == 0) return Vector6::Zero();
  Vector6 result = -axes_.transpose() * linear_part(flown).topRows(3).transpose() * error / miss;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < std::size(places); ++k) {
      const SixNumbers<double>& end = predicted[1 + std::size(places) * i + k].deviation;
      result[static_cast<Eigen::Index>(i)] +=
          weights[k] / (12 * step) * Eigen::Map<const Eigen::Vector3d>(end.data()).dot(error) /
          miss;
    }
  }
  return result;
}

FlownDeputies::Worst FlownDeputies::worst_from(const Worst& start, int order, double separation) {
  constexpr int most_iterations = 12;
  constexpr double step = 1e-3;          // step of differences, as a fraction of the separation
  constexpr double least_growth = 2e-3;  // least relative growth of the miss in an iteration
  // Lengths of a step along the gradient, in semi-axes; the first one leads straight to the
  // ellipsoids' points in this direction.
  constexpr double lengths[] = {1e6, 1, 0.25, 0.06};
  Worst worst = start;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Vector6 uphill = gradient(separation * worst.direction, order, step * separation);
    if (!uphill.allFinite()) break;
    for (const Eigen::Index first : {0, 3}) {
      const double length = uphill.segment<3>(first).norm();
      if (length > 0) uphill.segment<3>(first) /= length;
    }
    const double before = worst.miss;
    for (const double length : lengths) {
      Vector6 next = worst.direction + length * uphill;
      for (const Eigen::Index first : {0, 3}) {
        next.segment<3>(first) /= std::max(1.0, next.segment<3>(first).norm());
      }
      const double found = miss(separation * next, order);
      if (!(found > before)) continue;
      worst = {next, found};
      break;
    }
    if (!(worst.miss > before * (1 + least_growth))) break;
  }
  return worst;
}

}  // namespace hamjet
