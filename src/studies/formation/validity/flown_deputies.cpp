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
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The step of differences by which ascents find their directions, as a fraction of the separation.
constexpr double gradient_step = 1e-3;

/// Ascent of a miss within the unit balls of position and of velocity, by steps along its gradient
/// that are brought back to the balls.
FlownDeputies::Worst ascent(FlownDeputies::Worst worst,
                            const std::function<Vector6(const Vector6&)>& gradient_at,
                            const std::function<double(const Vector6&)>& miss_at) {
  constexpr int most_iterations = 12;
  constexpr double least_growth = 2e-3;  // least relative growth of the miss in an iteration
  // Lengths of a step along the gradient, in semi-axes; the first one leads straight to the
  // ellipsoids' points in this direction.
  constexpr double lengths[] = {1e6, 1, 0.25, 0.06};
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Vector6 uphill = gradient_at(worst.direction);
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
      const double found = miss_at(next);
      if (!(found > before)) continue;
      worst = {next, found};
      break;
    }
    if (!(worst.miss > before * (1 + least_growth))) break;
  }
  return worst;
}

}  // namespace

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

Vector6 in_told_directions(Vector6 direction, std::size_t told) {
  if (told == 3) return direction;
  const auto count = static_cast<Eigen::Index>(told);
  for (const Eigen::Index first : {Eigen::Index{0}, Eigen::Index{3}}) {
    direction.segment(first + count, 3 - count).setZero();
    direction.segment<3>(first).normalize();
  }
  return direction;
}

std::vector<Vector6> far_apart(const std::vector<Vector6>& directions) {
  // After whole revolutions the polynomials' own parts say little of what they neglect, and few
  // starts leave a maximum out.
  constexpr std::size_t most_starts = 16;
  constexpr double apart = 0.3;
  std::vector<Vector6> starts;
  for (const Vector6& direction : directions) {
    const bool is_near = std::any_of(starts.begin(), starts.end(), [&](const Vector6& start) {
      return (start - direction).norm() < apart;
    });
    if (!is_near) starts.push_back(direction);
    if (starts.size() == most_starts) break;
  }
  return starts;
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

void FlownDeputies::sort_by_miss(std::vector<Worst>& deputies) {
  std::stable_sort(deputies.begin(), deputies.end(),
                   [](const Worst& a, const Worst& b) { return a.miss > b.miss; });
}

std::vector<double> FlownDeputies::state(const SixNumbers<double>& deviation) const {
  std::vector<double> deputy = problem_.nominal;
  for (std::size_t i = 0; i < deviation.size(); ++i) deputy[i] += deviation[i];
  return deputy;
}

Vector6 FlownDeputies::error_of(DeputyPredictor& predictor, std::span<const double> flown,
                                const SixNumbers<double>& start, int order) {
  const SixNumbers<double> predicted = predictor.predict(start, order).deviation;
  Vector6 error;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    error[static_cast<Eigen::Index>(i)] = predictor.flow().chief_end()[i] + predicted[i] - flown[i];
  }
  return error;
}

DeputyPredictor& FlownDeputies::worse_of(std::span<const double> flown,
                                         const SixNumbers<double>& start, int order) {
  if (!again_) return predictor_;
  const auto miss = [&](DeputyPredictor& one) {
    return error_of(one, flown, start, order).head<3>().norm();
  };
  // A deputy without a place in the coordinates has a miss that is no number.
  const double first = miss(predictor_);
  return !std::isfinite(first) || miss(*again_) <= first ? predictor_ : *again_;
}

Vector6 FlownDeputies::error(const Vector6& coordinates, int order) {
  if (before_flight_) before_flight_();
  const SixNumbers<double> start = deviation(coordinates);
  std::vector<double> flown;
  try {
    flown = exact_flow(problem_.system, state(start), problem_.start_time, time_);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return Vector6::Constant(infinity);
  }
  return error_of(worse_of(flown, start, order), flown, start, order);
}

double FlownDeputies::miss(const Vector6& coordinates, int order) {
  const double distance = error(coordinates, order).head<3>().norm();
  return std::isfinite(distance) ? distance : infinity;
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
    return Vector6::Constant(infinity);
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
  const std::vector<double> end = nominal_of(flown);
  DeputyPredictor& predictor = worse_of(end, starts[0], order);
  std::vector<DeputyPrediction> predicted(starts.size());
  predictor.predict(starts, order, predicted);
  const Eigen::Vector3d error = error_of(predictor, end, starts[0], order).head<3>();
  const double miss = error.norm();
  if (miss == 0) return Vector6::Zero();
  Vector6 result = -axes_.transpose() * linear_part(flown).topRows(3).transpose() * error / miss;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < std::size(places); ++k) {
      const SixNumbers<double>& moved = predicted[1 + std::size(places) * i + k].deviation;
      result[static_cast<Eigen::Index>(i)] +=
          weights[k] / (12 * step) * Eigen::Map<const Eigen::Vector3d>(moved.data()).dot(error) /
          miss;
    }
  }
  return result;
}

std::vector<Eigen::Vector3d> FlownDeputies::foretold_errors(
    std::span<const SixNumbers<double>> starts, int order) {
  const int degrees[] = {order, predictor_.flow().order()};
  std::vector<DeputyPrediction> predicted(2 * starts.size());
  predictor_.predict(starts, degrees, predicted);
  std::vector<Eigen::Vector3d> errors;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Eigen::Map<const Eigen::Vector3d> by_order(predicted[k].deviation.data());
    const Eigen::Map<const Eigen::Vector3d> by_all(predicted[starts.size() + k].deviation.data());
    errors.push_back(by_all - by_order);
  }
  return errors;
}

FlownDeputies::Worst FlownDeputies::worst_from(const Worst& start, int order, double separation) {
  const double step = gradient_step * separation;
  return ascent(
      start, [&](const Vector6& at) { return gradient(separation * at, order, step); },
      [&](const Vector6& at) { return miss(separation * at, order); });
}

void FlownDeputies::sort_by_foretold_miss(std::vector<Vector6>& directions, int order,
                                          double separation) {
  std::vector<SixNumbers<double>> starts;
  for (const Vector6& direction : directions) starts.push_back(deviation(separation * direction));
  const std::vector<Eigen::Vector3d> errors = foretold_errors(starts, order);
  std::vector<Worst> foretold;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    // A deputy without a place in the coordinates comes first.
    const double miss = errors[k].norm();
    foretold.push_back({directions[k], miss < infinity ? miss : infinity});
  }
  sort_by_miss(foretold);
  std::transform(foretold.begin(), foretold.end(), directions.begin(),
                 [](const Worst& worst) { return worst.direction; });
}

Vector6 FlownDeputies::foretold_worst_from(const Vector6& start, int order, double separation) {
  const auto foretold = [&](const Vector6& at) {
    const SixNumbers<double> initial = deviation(separation * at);
    return foretold_errors({&initial, 1}, order)[0].norm();
  };
  // Differences to both sides of the error itself, which is all that the two orders differ by.
  const auto slope = [&](const Vector6& at) {
    std::vector<SixNumbers<double>> starts;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (const double side : {gradient_step, -gradient_step}) {
        starts.push_back(deviation(separation * (at + side * Vector6::Unit(i))));
      }
    }
    const std::vector<Eigen::Vector3d> errors = foretold_errors(starts, order);
    Vector6 result;
    for (std::size_t i = 0; i < 6; ++i) {
      result[static_cast<Eigen::Index>(i)] = errors[2 * i].norm() - errors[2 * i + 1].norm();
    }
    return result;
  };
  return ascent({start, foretold(start)}, slope, foretold).direction;
}

}  // namespace hamjet
