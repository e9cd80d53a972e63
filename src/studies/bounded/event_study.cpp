#include "event_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>

#include "../../algebra/other_units.hpp"
#include "../../algebra/scalar_search.hpp"
#include "../../algebra/state_sums.hpp"
#include "../../dynamics/autonomy.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../checks/flight_checks.hpp"
#include "../exact_flow.hpp"
#include "../formation/deputy_flows.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/studies/propagation.hpp"
#include "scene_gauss.hpp"

namespace hamjet {
namespace {

constexpr double most_event_tolerance = 1e-14;
/// Places within a step of the trajectory at which a change of sign is looked for.
constexpr int places_of_step = 8;
/// A start nearer to the surface than this part of the condition's size is on it.
constexpr double on_surface = 1e-12;
constexpr int flown_deputies = 8;

using State = std::vector<double>;

double value_at(const EventCondition<double>& condition, const State& state) {
  static const SpacePointer constants = SeriesSpace::create(1, 0);
  const auto z = [&](std::size_t i) { return Series<double>(constants, state[i]); };
  return condition({z(0), z(1), z(2), z(3), z(4), z(5)})[0];
}

/// Finds the chief's events one after the other, by their changes of sign along its trajectory.
class EventSearch {
 public:
  EventSearch(const Scene& scene, const EventCondition<double>& condition)
      : condition_(condition),
        direction_(scene.event->direction),
        trajectory_(
            trajectory_problem(make_system(scene), scene.nominal, scene.start_time, scene.duration),
            scene_gauss(scene, most_event_tolerance)) {}

  /// The time of the event of a number; none if there are fewer, whose count is then found().
  std::optional<double> find(int number) {
    const std::vector<double>& steps = trajectory_.step_times();
    double size = 0;
    for (const double time : steps) size = std::max(size, std::abs(at(time)));
    std::optional<Place> before;
    std::optional<Place> last;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      for (int i = k == 0 ? places_of_step : 1; i <= places_of_step; ++i) {
        const double from = k == 0 ? 0 : steps[k - 1];
        const double time = from + (steps[k] - from) * i / places_of_step;
        const Place now{time, at(time)};
        if (now.value == 0 || (k == 0 && std::abs(now.value) <= on_surface * size)) continue;
        if (last) {
          if (const auto event = between(before, *last, now, number)) return event;
        }
        before = last;
        last = now;
      }
    }
    return std::nullopt;
  }

  int found() const { return found_; }

 private:
  double at(double time) const {
    const double value = value_at(condition_, nominal_of(trajectory_.at(time)));
    // No change of sign would show an event beside what is no number.
    if (std::isnan(value)) {
      throw Error(ErrorKind::numerical,
                  fmt::format("event: its condition is no number at {:.10g} canonical", time));
    }
    return value;
  }

  struct Place {
    double time;
    double value;
  };

  /// The event of the number, if it is between the last two of these places, or in a dip of the
  /// three through zero and back.
  std::optional<double> between(const std::optional<Place>& before, const Place& last,
                                const Place& now, int number) {
    if (last.value * now.value < 0) return counted(last, now, number);
    const bool may_dip = before && before->value * last.value > 0 &&
                         std::abs(last.value) <= std::abs(before->value) &&
                         std::abs(last.value) <= std::abs(now.value);
    if (!may_dip) return std::nullopt;
    const Place dip = nearest(before->time, now.time, last.value < 0 ? -1 : 1);
    if (dip.value * last.value >= 0) return std::nullopt;
    const auto first = counted(*before, dip, number);
    return first ? first : counted(dip, now, number);
  }

  /// The least of the condition times `sign` between two times.
  Place nearest(double from, double to, int sign) const {
    // Half of the digits: a minimum is flat.
    constexpr int bits = std::numeric_limits<double>::digits / 2;
    const auto [time, least] = minimum_between(
        "event", [&](double t) { return sign * at(t); }, from, to, bits);
    return {time, sign * least};
  }

  /// Counts a change of sign if it has the direction; its time if it is the number's.
  std::optional<double> counted(const Place& from, const Place& to, int number) {
    if (!is_wanted((to.value - from.value) / (to.time - from.time))) return std::nullopt;
    if (++found_ != number) return std::nullopt;
    return crossing(from.time, from.value, to.time);
  }

  bool is_wanted(double slope) const {
    return direction_ == EventDirection::either ||
           (slope > 0) == (direction_ == EventDirection::rising);
  }

  double crossing(double from, double value, double to) const {
    // Newton's method on the jet does the rest.
    constexpr int halvings = 30;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (from + to) / 2;
      const double there = at(middle);
      (value * there <= 0 ? to : from) = middle;
    }
    return (from + to) / 2;
  }

  const EventCondition<double>& condition_;
  EventDirection direction_;
  JetTrajectory<double> trajectory_;
  int found_ = 0;
};

/// What polynomials of a degree say of a deviation: all, or constant and linear terms.
double predicted(const Series<double>& series, std::span<const double> deviation, bool is_linear) {
  if (!is_linear) return evaluate<double>(series, deviation);
  double sum = series[0];
  for (std::size_t i = 0; i < deviation.size(); ++i) sum += series[1 + i] * deviation[i];
  return sum;
}

/// Deputies flown to their predicted events.
class EventFlights {
 public:
  EventFlights(const Scene& scene, const EventCondition<double>& condition,
               const EventMap<double>& map)
      : scene_(scene), condition_(condition), map_(map), system_(make_system(scene)) {}

  EventMisses fly(double amplitude_m) const {
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

 private:
  double metres() const { return scene_.units.length_km * 1000; }
  /// Of a circle through the chief's start.
  double mean_motion() const {
    const Eigen::Vector3d chief(scene_.nominal.data());
    return std::sqrt(canonical_mu / std::pow(chief.norm(), 3));
  }

  /// The size in position, and that times the mean motion of the chief's distance in velocity, each
  /// in a random direction; the standard library's distributions differ between implementations.
  State random_deviation(std::mt19937_64& generator, double amplitude_m) const {
    State deviation;
    for (const double size : {amplitude_m / metres(), amplitude_m / metres() * mean_motion()}) {
      Eigen::Vector3d direction;
      do {
        for (double& x : direction) x = std::ldexp(static_cast<double>(generator() >> 11), -52) - 1;
      } while (direction.norm() > 1 || direction.norm() < 0.1);
      direction *= size / direction.norm();
      deviation.insert(deviation.end(), direction.begin(), direction.end());
    }
    return deviation;
  }

  struct Miss {
    double position_m = 0;
    double time_s = 0;
  };

  Miss largest_miss(double amplitude_m, bool is_linear) const {
    std::mt19937_64 generator(1);
    Miss worst;
    for (int k = 0; k < flown_deputies; ++k) {
      const Miss one = miss(random_deviation(generator, amplitude_m), is_linear);
      // A miss that is no number stays.
      if (!(one.position_m <= worst.position_m)) worst.position_m = one.position_m;
      if (!(one.time_s <= worst.time_s)) worst.time_s = one.time_s;
    }
    return worst;
  }

  Miss miss(const State& deviation, bool is_linear) const {
    const State start = state_sum(scene_.nominal, deviation);
    const double time = predicted(map_.time, deviation, is_linear);
    // Beyond their reach polynomials give any time, up to one that would take days to fly.
    const double chiefs = map_.time[0];
    if (!(std::abs(time - chiefs) <= std::max(std::abs(chiefs), 1 / mean_motion()))) {
      throw Error(ErrorKind::numerical, "event: the polynomials give no time near the chief's");
    }
    const State end = exact_flow(system_, start, scene_.start_time, time);
    Eigen::Vector3d apart;
    for (std::size_t i = 0; i < 3; ++i) {
      apart[static_cast<Eigen::Index>(i)] = end[i] - predicted(map_.state[i], deviation, is_linear);
    }
    // The slope need only be right to a few digits.
    const double later = std::ldexp(std::abs(map_.time[0]), -16);
    const double value = value_at(condition_, end);
    const State flown_on = exact_flow(system_, end, scene_.start_time + time, later);
    const double slope = (value_at(condition_, flown_on) - value) / later;
    return {apart.norm() * metres(), std::abs(value / slope) * scene_.units.time_s};
  }

  const Scene& scene_;
  const EventCondition<double>& condition_;
  const EventMap<double>& map_;
  SharedSystem system_;
};

/// Rounding of a flown position, canonical: that of the linear flow over the chief's time, which is
/// that of the map less what the time's change adds along the chief's motion.
double rounding_at(const EventStudy& study) {
  const State end = study.state();
  const double mu = canonical_mu;
  const double distance = std::hypot(end[0], end[1], end[2]);
  Matrix<double> linear(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    // Of the size, for which the field of the centre will do.
    const double motion = i < 3 ? end[3 + i] : -mu * end[i - 3] / std::pow(distance, 3);
    for (std::size_t j = 0; j < 6; ++j) {
      linear(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          study.map.state[i][1 + j] - motion * study.map.time[1 + j];
    }
  }
  return rounding_of_flights(linear, study.scene.nominal, end,
                             natural_momentum_exponent(true, study.scene.nominal));
}

}  // namespace

std::vector<double> EventStudy::state() const {
  std::vector<double> result;
  for (const Series<double>& component : map.state) result.push_back(component[0]);
  return result;
}

EventMap<double> EventStudy::told_map() const {
  const CanonicalFactors told = told_factors(scene);
  std::vector<double> of_state(6, told.length);
  std::fill(of_state.begin() + 3, of_state.end(), told.momentum);
  EventMap<double> result = map;
  result.time = in_other_units<double>(std::move(result.time), told.time, of_state);
  tell_in_other_units<double>(result.state, of_state, of_state);
  return result;
}

EventCondition<double> event_condition(const Scene& scene) {
  using Z = SixNumbers<Series<double>>;
  const EventSettings& event = *scene.event;
  const double kilometre = 1 / scene.units.length_km;
  switch (event.surface) {
    case EventSurface::equator:
      return [](const Z& z) { return z[2]; };
    case EventSurface::plane:
      return [normal = event.normal, offset = event.offset_km * kilometre](const Z& z) {
        Series<double> height = z[0] * normal[0] + z[1] * normal[1] + z[2] * normal[2];
        height[0] -= offset;
        return height;
      };
    case EventSurface::distance:
      return [distance = event.distance_km * kilometre](const Z& z) {
        Series<double> height = sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
        height[0] -= distance;
        return height;
      };
    case EventSurface::apsis:
      break;
  }
  return [](const Z& z) { return z[0] * z[3] + z[1] * z[4] + z[2] * z[5]; };
}

EventStudy study_event(const Scene& scene, const ProgressCallback& progress) {
  require_formation_problem(scene, scene.event.has_value(), "event");
  if (!is_autonomous(make_system(scene))) {
    throw Error(
        ErrorKind::scene,
        "event: the model's forces depend on the time, and the times of neighbours would be "
        "no argument of theirs; must be zonal-gravity or kepler");
  }
  const EventCondition<double> condition = event_condition(scene);
  if (progress) progress("event", 0);
  EventSearch search(scene, condition);
  const std::optional<double> near = search.find(scene.event->number);
  if (!near) {
    throw Error(
        ErrorKind::scene,
        fmt::format("event.number: no such event, got {}, where within jet.duration "
                    "({:.10g} s) the chief has {}; must be {}a longer jet.duration, another "
                    "surface or another direction would be right",
                    scene.event->number, scene.duration * scene.units.time_s,
                    search.found() == 0 ? "none" : std::to_string(search.found()),
                    search.found() == 0 ? "one that it meets: "
                                        : fmt::format("at most {}, or ", search.found())));
  }
  if (progress) progress("event", 0.2);
  SixNumbers<double> chief = six_numbers(scene.nominal);
  EventStudy study{
      scene,
      event_map<double>(make_system(scene), chief, scene.start_time, *near, scene.order,
                        scene_gauss(scene, most_event_tolerance), condition),
      0,
      flown_deputies,
      {}};
  const EventFlights flights(scene, condition, study.map);
  const std::vector<double>& amplitudes = scene.event->amplitudes_m;
  for (std::size_t k = 0; k < amplitudes.size(); ++k) {
    if (progress) {
      progress("flights", static_cast<double>(k) / static_cast<double>(amplitudes.size()));
    }
    study.misses.push_back(flights.fly(amplitudes[k]));
  }
  study.checks = flight_checks(scene, flights_of(scene, study.map.time[0], false));
  study.position_rounding_m = rounding_at(study) * scene.units.length_km * 1000;
  return study;
}

}  // namespace hamjet
