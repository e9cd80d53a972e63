#include "event_flights.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "../../algebra/state_sums.hpp"
#include "../exact_flow.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/charts/free_coordinates.hpp"
#include "../formation/single_transfer.hpp"
#include "../formation/validity/slice_maxima.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// Random deviations of which the first are flown, and from all of which ascents begin.
constexpr std::size_t random_directions = 32;
constexpr std::size_t flown_random_directions = 8;
/// The number of maxima of each degree that chooses deviations; both sides of each are flown.
constexpr std::size_t flown_maxima = 4;

/// The direction and its opposite, where neither is there yet: a degree contributes as much at
/// both.
void add_both(std::vector<Vector6>& directions, const Vector6& direction) {
  // Directions that are nearer to each other than two maxima are the same.
  constexpr double same = 0.1;
  for (const double side : {1.0, -1.0}) {
    const Vector6 one = side * direction;
    const bool is_there = std::any_of(directions.begin(), directions.end(), [&](const auto& other) {
      return (other - one).norm() < same;
    });
    if (!is_there) directions.push_back(one);
  }
}

/// What polynomials of a degree say of a deviation: all, or constant and linear terms.
double predicted(const Series<double>& series, std::span<const double> deviation, bool is_linear) {
  if (!is_linear) return evaluate<double>(series, deviation);
  double sum = series[0];
  for (std::size_t i = 0; i < deviation.size(); ++i) sum += series[1 + i] * deviation[i];
  return sum;
}

}  // namespace

double condition_at(const EventCondition<double>& condition, std::span<const double> state) {
  static const SpacePointer constants = SeriesSpace::create(1, 0);
  const auto z = [&](std::size_t i) { return Series<double>(constants, state[i]); };
  return condition({z(0), z(1), z(2), z(3), z(4), z(5)})[0];
}

EventFlights::EventFlights(const Scene& scene, const EventCondition<double>& condition,
                           const EventMap<double>& map, const EventMap<double>& steering)
    : scene_(scene), condition_(condition), map_(map), system_(make_system(scene)) {
  const Eigen::Vector3d chief(scene.nominal.data());
  mean_motion_ = is_orbit(scene.system.model)
                     ? std::sqrt(orbit_field(scene).mu / std::pow(chief.norm(), 3))
                     : 1 / std::abs(map.time[0]);
  std::mt19937_64 generator(1);
  std::vector<Vector6> samples;
  const std::size_t told = told_coordinates(scene.system);
  for (std::size_t k = 0; k < random_directions; ++k) {
    samples.push_back(in_told_directions(random_coordinates(generator), told));
  }
  directions_.assign(samples.begin(), samples.begin() + flown_random_directions);
  const MetricUnits units = metric_units(scene);
  const bool has_orbit = is_orbit(scene.system.model);
  to_canonical_ = deviations_of_relative_states(ChiefFrame(
      scene.nominal, units, has_orbit ? RelativeFrame::inertial : RelativeFrame::coordinates));
  to_canonical_.rightCols(3) *= mean_motion_ / units.time_s;
  Matrix<double> variables = to_canonical_ * units.length_m;
  // Along coordinates that move freely there are no deviations.
  for (Eigen::Index i = static_cast<Eigen::Index>(told); i < 3; ++i) {
    variables.col(i).setZero();
    variables.col(3 + i).setZero();
  }
  SliceMaxima slices({steering.state[0], steering.state[1], steering.state[2]}, variables);
  for (const int degree : {steering.time.space().order(), 2}) {
    const std::vector<Vector6> maxima = slices.maxima(samples, degree);
    for (std::size_t k = 0; k < std::min(flown_maxima, maxima.size()); ++k) {
      add_both(directions_, in_told_directions(maxima[k], told));
    }
  }
}

EventMisses EventFlights::fly(double amplitude_m) const {
  EventMisses misses;
  misses.amplitude_m = amplitude_m;
  for (const bool is_linear : {false, true}) {
    try {
      const Miss worst = largest_miss(amplitude_m, is_linear);
      if (!std::isfinite(worst.position_m) || !std::isfinite(worst.time_s)) continue;
      (is_linear ? misses.linear_position_m : misses.position_m) = worst.position_m;
      (is_linear ? misses.linear_time_s : misses.time_s) = worst.time_s;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::too_large) throw;
    }
  }
  return misses;
}

EventFlights::Miss EventFlights::largest_miss(double amplitude_m, bool is_linear) const {
  Miss worst;
  for (const Vector6& direction : directions_) {
    const Vector6 canonical = to_canonical_ * direction * amplitude_m;
    const Miss one = miss({canonical.begin(), canonical.end()}, is_linear);
    // A miss that is no number stays.
    if (!(one.position_m <= worst.position_m)) worst.position_m = one.position_m;
    if (!(one.time_s <= worst.time_s)) worst.time_s = one.time_s;
  }
  return worst;
}

EventFlights::Miss EventFlights::miss(const std::vector<double>& deviation, bool is_linear) const {
  const std::vector<double> start = state_sum(scene_.nominal, deviation);
  const double time = predicted(map_.time, deviation, is_linear);
  // Beyond their reach polynomials give any time, up to one that would take days to fly.
  const double chiefs = map_.time[0];
  if (!(std::abs(time - chiefs) <= std::max(std::abs(chiefs), 1 / mean_motion_))) {
    throw Error(ErrorKind::numerical, "event: the polynomials give no time near the chief's");
  }
  const std::vector<double> end = exact_flow(system_, start, scene_.start_time, time);
  Eigen::Vector3d apart;
  for (std::size_t i = 0; i < 3; ++i) {
    apart[static_cast<Eigen::Index>(i)] = end[i] - predicted(map_.state[i], deviation, is_linear);
  }
  // The slope need only be right to a few digits.
  const double later = std::ldexp(std::abs(map_.time[0]), -16);
  const double value = condition_at(condition_, end);
  const double slope =
      (condition_at(condition_, exact_flow(system_, end, scene_.start_time + time, later)) -
       value) /
      later;
  return {apart.norm() * metres(), std::abs(value / slope) * scene_.units.time_s};
}

}  // namespace hamjet
