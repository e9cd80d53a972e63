#include "relative_drift.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../../algebra/state_sums.hpp"
#include "../exact_flow.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Eigen::Vector3d;

Vector3d place_of(const std::vector<double>& z) { return {z[0], z[1], z[2]}; }
Vector3d velocity_of(const std::vector<double>& z) { return {z[3], z[4], z[5]}; }

/// 1/a of the osculating orbit; positive for an ellipse.
double inverse_axis(const std::vector<double>& z) {
  return 2 / place_of(z).norm() - velocity_of(z).squaredNorm() / canonical_mu;
}

/// A half-plane through the centre that orbits cross once per revolution.
class Meridian {
 public:
  Meridian(const SharedSystem& system, const std::vector<double>& chief,
           const ClockTime& start_time)
      : system_(system), start_time_(start_time) {
    radial_ = place_of(chief).normalized();
    normal_ = place_of(chief).cross(velocity_of(chief)).normalized();
    along_ = normal_.cross(radial_);
  }

  /// The time from the passage nearest to the start to the next one, for a state at the start; no
  /// value if it is not found.
  std::optional<double> revolution(std::vector<double> state) const {
    const double inverse = inverse_axis(state);
    if (!(inverse > 0)) return std::nullopt;
    const double period = 2 * std::numbers::pi * std::pow(inverse, -1.5) / std::sqrt(canonical_mu);
    const auto first = fly_to_passage(state, start_time_, period);
    if (!first) return std::nullopt;
    state = exact_flow(system_, state, start_time_ + *first, period);
    const auto rest = fly_to_passage(state, start_time_ + (*first + period), period);
    if (!rest) return std::nullopt;
    return period + *rest;
  }

 private:
  /// Newton's method on the angle; returns the time that passed.
  std::optional<double> fly_to_passage(std::vector<double>& state, const ClockTime& from,
                                       double period) const {
    constexpr int most_iterations = 40;
    constexpr double close = 1e-14;  // as a fraction of the period
    double taken = 0;
    for (int i = 0; i < most_iterations; ++i) {
      const Vector3d q = place_of(state), v = velocity_of(state);
      const double x = q.dot(radial_), y = q.dot(along_);
      const double rate = (x * v.dot(along_) - y * v.dot(radial_)) / (x * x + y * y);
      if (!(rate > 0)) return std::nullopt;
      double step = -std::atan2(y, x) / rate;
      if (std::abs(step) <= close * period) return taken + step;
      step = std::clamp(step, -period / 8, period / 8);
      state = exact_flow(system_, state, from + taken, step);
      taken += step;
      // The rounding of the flights allows no better result.
      if (i > 8 && std::abs(step) <= 100 * close * period) return taken;
    }
    return std::nullopt;
  }

  const SharedSystem& system_;
  ClockTime start_time_;
  Vector3d radial_;
  Vector3d along_;
  Vector3d normal_;
};

/// The change of the deputy's velocity along its motion that gives its revolution the duration of
/// the chief's.
std::optional<Vector3d> holding_change(const Meridian& meridian, const std::vector<double>& deputy,
                                       double chief_revolution) {
  constexpr int most_iterations = 12;
  constexpr double close = 1e-12;
  const Vector3d direction = velocity_of(deputy).normalized();
  std::vector<double> state = deputy;
  double change = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const auto revolution = meridian.revolution(state);
    if (!revolution) return std::nullopt;
    const double missing = *revolution - chief_revolution;
    if (std::abs(missing) <= close * chief_revolution) return change * direction;
    // dT/T = 3/2 da/a and da/a = 2 a v dv / mu.
    const double slope =
        3 * *revolution * velocity_of(state).norm() / inverse_axis(state) / canonical_mu;
    change -= missing / slope;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      state[3 + k] = deputy[3 + k] + change * direction[axis];
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<RelativeDrift> relative_drift(const Scene& scene, const std::vector<double>& chief,
                                            const std::vector<double>& deviation,
                                            const ClockTime& start_time, RelativeFrame frame,
                                            bool finds_holding) {
  // The rounding of a flight over a revolution, relative to these numbers.
  constexpr double rounding = 1e-11;
  const MetricUnits units = metric_units(scene);
  const SharedSystem system = make_system(scene);
  const std::vector<double> deputy = state_sum(chief, deviation);
  RelativeDrift drift;
  try {
    const Meridian meridian(system, chief, start_time);
    const auto of_chief = meridian.revolution(chief);
    const auto of_deputy = meridian.revolution(deputy);
    if (!of_chief || !of_deputy) return std::nullopt;
    const double length_m = 2 * std::numbers::pi / inverse_axis(chief) * units.length_m;
    const double difference = *of_deputy - *of_chief;
    drift.per_revolution_m = -length_m * difference / *of_chief;
    drift.floor_m = rounding * length_m;
    drift.period_difference_s = difference * units.time_s;
    // No velocity holds a deputy that air or light keeps moving away.
    if (finds_holding && is_like_chief(scene)) {
      if (const auto change = holding_change(meridian, deputy, *of_chief)) {
        drift.holding_change_m_s = ChiefFrame(chief, units, frame).velocity_change_m_s(*change);
      }
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return std::nullopt;
  }
  try {
    drift.elements_m = DeputyCoordinates(chief, units, canonical_mu, DeputyForm::relative_elements)
                           .coordinates(deviation);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
  }
  return drift;
}

std::optional<RelativeDrift> deputy_drift(const Scene& asked) {
  if (!asked.deputy) return std::nullopt;
  const Scene scene = with_deputy_parameters(asked);
  return relative_drift(scene, scene.nominal, deputy_deviation(scene), scene.start_time,
                        scene.deputy->frame);
}

}  // namespace hamjet
