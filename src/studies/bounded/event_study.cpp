#include "event_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "../../algebra/other_units.hpp"
#include "../../algebra/scalar_search.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../checks/flight_checks.hpp"
#include "../exact_flow.hpp"
#include "../flights/manoeuvred_flight.hpp"
#include "../formation/charts/deputy_flows.hpp"
#include "../formation/charts/free_coordinates.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "event_flights.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "hamjet/studies/propagation.hpp"
#include "scene_gauss.hpp"

namespace hamjet {
namespace {

constexpr double most_event_tolerance = 1e-14;
/// Places within a step of the trajectory at which a change of sign is looked for.
constexpr int places_of_step = 8;
/// A start counts as on the surface if it is nearer than this part of the condition's size.
constexpr double on_surface = 1e-12;

using State = std::vector<double>;

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
    const double value = condition_at(condition_, nominal_of(trajectory_.at(time)));
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
    // A minimum is flat, so that its place is known to half of the digits only.
    constexpr int bits = std::numeric_limits<double>::digits / 2;
    const auto [time, least] = minimum_between(
        "event", [&](double t) { return sign * at(t); }, from, to, bits);
    return {time, sign * least};
  }

  /// Counts a change of sign if it has the direction and is one through zero; its time if it is the
  /// number's.
  std::optional<double> counted(const Place& from, const Place& to, int number) {
    if (!is_wanted((to.value - from.value) / (to.time - from.time))) return std::nullopt;
    const std::optional<double> time = crossing(from, to);
    if (!time || ++found_ != number) return std::nullopt;
    return time;
  }

  bool is_wanted(double slope) const {
    return direction_ == EventDirection::either ||
           (slope > 0) == (direction_ == EventDirection::rising);
  }

  /// None at a pole or a jump of the condition, towards which its values do not vanish.
  std::optional<double> crossing(Place from, Place to) const {
    // Newton's method on the jet does the rest.
    constexpr int halvings = 30;
    constexpr double vanishing = 1e-3;
    const double size = std::max(std::abs(from.value), std::abs(to.value));
    for (int i = 0; i < halvings; ++i) {
      const double middle = (from.time + to.time) / 2;
      const Place there{middle, at(middle)};
      (from.value * there.value <= 0 ? to : from) = there;
    }
    if (!(std::max(std::abs(from.value), std::abs(to.value)) <= vanishing * size)) {
      return std::nullopt;
    }
    return (from.time + to.time) / 2;
  }

  const EventCondition<double>& condition_;
  EventDirection direction_;
  JetTrajectory<double> trajectory_;
  int found_ = 0;
};

/// Rounding of a flown position, canonical: that of the linear flow over the chief's time, which is
/// that of the map less what the time's change adds along the chief's motion.
double rounding_at(const EventStudy& study) {
  const State end = study.state();
  DifferentiableFunction<double> field(make_system(study.scene).vector_field);
  field.evaluate(end);
  Matrix<double> linear(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const double motion = field.values()[static_cast<Eigen::Index>(i)];
    for (std::size_t j = 0; j < 6; ++j) {
      linear(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          study.map.state[i][1 + j] - motion * study.map.time[1 + j];
    }
  }
  return rounding_of_flights(
      linear, study.scene.nominal, end,
      natural_momentum_exponent(is_orbit(study.scene.system.model), study.scene.nominal));
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

FunctionText event_function(const SystemSettings& system, const std::string& expression) {
  FunctionText function;
  for (const std::string_view name : variable_names(system)) function.variables.emplace_back(name);
  if (system.own_text) {
    function.parameters = system.own_text->parameters;
    function.definitions = system.own_text->definitions;
  }
  function.outputs = {{"expression", expression}};
  return function;
}

namespace {

EventCondition<double> condition_of_expression(const Scene& scene) {
  // Kilometres and km/s of an orbit, and the numbers of an own system's scene.
  const bool is_in_km = is_orbit(scene.system.model);
  const double length = is_in_km ? scene.units.length_km : 1;
  const double momentum = is_in_km ? length / scene.units.time_s : 1;
  const auto list = std::make_shared<const OperationList>(
      record_function(event_function(scene.system, scene.event->expression)));
  return [length, momentum, list](const SixNumbers<Series<double>>& z) {
    std::vector<Series<double>> inputs;
    for (std::size_t i = 0; i < 6; ++i) {
      inputs.push_back(z[i] * (i < 3 ? length : momentum));
    }
    return evaluate_on_series<double>(*list, inputs)[0];
  };
}

}  // namespace

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
    case EventSurface::expression:
      return condition_of_expression(scene);
    case EventSurface::apsis:
      break;
  }
  return [](const Z& z) { return z[0] * z[3] + z[1] * z[4] + z[2] * z[5]; };
}

EventStudy study_event(const Scene& asked, const ProgressCallback& progress) {
  require_coasting(asked);
  require_deviation_problem(asked, asked.event.has_value(), "event");
  const Scene scene = with_free_coordinates(asked);
  if (!make_system(scene).is_autonomous()) {
    throw Error(
        ErrorKind::scene,
        fmt::format("event: the model's forces depend on the time, and the times of neighbours "
                    "would be no argument of theirs; must be {}",
                    is_orbit(scene.system.model) ? "zonal-gravity or kepler" : "without the time"));
  }
  const EventCondition<double> condition = event_condition(scene);
  if (progress) progress("event", 0);
  EventSearch search(scene, condition);
  const std::optional<double> near = search.find(scene.event->number);
  if (!near) {
    const int found = search.found();
    const bool is_in_km =
        scene.event->surface == EventSurface::expression && is_orbit(scene.system.model);
    throw Error(
        ErrorKind::scene,
        fmt::format("event.number: no such event, got {}, where within jet.duration "
                    "({:.10g} s) the chief has {}; must be {}a longer jet.duration, another "
                    "surface or another direction would be right{}",
                    scene.event->number, scene.duration * scene.units.time_s,
                    found == 0 ? "none" : std::to_string(found),
                    found == 0 ? "one that it meets: " : fmt::format("at most {}, or ", found),
                    is_in_km ? "; the expression is of km and km/s" : ""));
  }
  if (progress) progress("event", 0.2);
  SixNumbers<double> chief = six_numbers(scene.nominal);
  const auto map_of_order = [&](int order) {
    return event_map<double>(make_system(scene), chief, scene.start_time, *near, order,
                             scene_gauss(scene, most_event_tolerance), condition);
  };
  EventStudy study{scene, map_of_order(scene.order), 0, 0, {}};
  // What linear polynomials leave out is of the second degree.
  const EventFlights flights(scene, condition, study.map,
                             scene.order > 1 ? study.map : map_of_order(2));
  study.flown = flights.count();
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
