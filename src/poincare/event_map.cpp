#include "hamjet/poincare/event_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../algebra/instantiated_real.hpp"
#include "../charts/carried_states.hpp"
#include "../charts/time_scaled_system.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

template <class Real>
SixNumbers<Series<Real>> six_of(const FlowJet<Real>& jet) {
  return {jet[0], jet[1], jet[2], jet[3], jet[4], jet[5]};
}

/// Distance and speed at a state that moves along the flow, a series of the time: positions and
/// momenta have units of their own, and `time` is one in which they change by about their sizes.
template <class Real>
struct StateSizes {
  explicit StateSizes(const SixNumbers<Series<Real>>& flown) {
    using std::sqrt;
    const auto norm = [&](std::size_t i, std::size_t power) {
      Real sum = 0;
      for (std::size_t k = i; k < i + 3; ++k) sum += flown[k][power] * flown[k][power];
      return Real(sqrt(sum));
    };
    distance = norm(0, 0);
    speed = norm(3, 0);
    // Where a system turns round momenta vanish with rates, and their ratio stays.
    const Real rates = norm(0, 1) * norm(3, 1);
    if (rates > Real(0)) time = sqrt(Real(distance * speed / rates));
    distance = std::max(distance, Real(norm(0, 1) * time));
    speed = std::max(speed, Real(norm(3, 1) * time));
    // At rest, or at the origin, nothing else is there to measure by.
    if (!(speed > Real(0))) speed = Real(1);
    if (!(distance > Real(0))) distance = Real(1);
  }

  Real of(std::size_t place) const { return place < 3 ? distance : speed; }

  Real distance;
  Real speed;
  Real time = 0;
};

/// A condition at one state: its value, its derivative along the flow, and the sine of the angle
/// between the flow and the surface on which it is constant, in parts of the state's sizes.
template <class Real>
struct Crossing {
  Real value;
  Real slope;
  Real sine;
  Real time;  ///< in which the state changes by about its own size
};

template <class Real>
Crossing<Real> crossing_at(const SharedSystem& system, const SixNumbers<Series<Real>>& z,
                           const EventCondition<Real>& condition) {
  using std::abs;
  using std::sqrt;
  const SpacePointer line = SeriesSpace::create(1, 1);
  const SpacePointer space = SeriesSpace::create(6, 1);
  const auto constant = [&](std::size_t i) { return Series<Real>(line, z[i][0]); };
  const auto one = [&](std::size_t i) { return Series<Real>::variable(space, i, z[i][0]); };
  const SixNumbers<Series<Real>> flown = carried<Real>(
      system, {constant(0), constant(1), constant(2), constant(3), constant(4), constant(5)},
      Series<Real>::variable(line, 0));
  const Series<Real> value = condition(flown);
  const Series<Real> nearby = condition({one(0), one(1), one(2), one(3), one(4), one(5)});
  const StateSizes<Real> sizes(flown);
  Real gradient = 0;
  Real speed = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Real slope = nearby[1 + i] * sizes.of(i);
    const Real rate = flown[i][1] / sizes.of(i);
    gradient += slope * slope;
    speed += rate * rate;
  }
  return {value[0], value[1], Real(abs(value[1])) / sqrt(Real(gradient * speed)), sizes.time};
}

}  // namespace

template <class Real>
EventMap<Real> event_map(const DynamicalSystem& system, const SixNumbers<Real>& chief,
                         const ClockTime& start_time, const Real& near, int order,
                         const GaussSettings& gauss, const EventCondition<Real>& condition) {
  using std::abs;
  using std::sqrt;
  if (!system.is_autonomous()) {
    throw Error(
        ErrorKind::usage,
        "event: the system depends on the time, must be one whose flow is the same at every "
        "start");
  }
  const SharedSystem shared(system);
  const SharedSystem crossing(time_scaled_first_order(system));
  const SpacePointer space = SeriesSpace::create(6, order);
  FlowProblem<Real> flow{shared, space, {}, {}, start_time};
  flow.symmetry = FlowSymmetry::none;
  flow.initial_jet = FlowJet<Real>();
  for (std::size_t i = 0; i < 6; ++i) {
    flow.variables.push_back(i);
    flow.initial_jet->push_back(Series<Real>::variable(space, i, chief[i]));
  }
  IntegrationStatistics statistics;
  const auto advance = [&](const Real& time) {
    if (time == Real(0)) return;
    flow.duration = time;
    flow.initial_state.clear();
    for (const auto& component : *flow.initial_jet) flow.initial_state.push_back(component[0]);
    *flow.initial_jet = integrate_gauss<Real>(flow, gauss, statistics);
    flow.start_time = flow.start_time + time;
  };
  advance(near);
  Real time = near;
  Real rate = 0;
  constexpr int most_iterations = 40;
  const Real least = Real(16) * std::numeric_limits<Real>::epsilon();
  // Steps that no longer shrink are rounding if they are no larger than this: towards a surface
  // that is only touched they halve.
  const Real largest_rounding = sqrt(std::numeric_limits<Real>::epsilon());
  Real previous = 0;
  for (int i = 0;; ++i) {
    const Crossing<Real> at = crossing_at(crossing, six_of(*flow.initial_jet), condition);
    rate = at.slope;
    const Real step = -at.value / at.slope;
    const Real scale = abs(near) + at.time;
    // At a smaller angle the time of a neighbour is no series but next to the chief.
    constexpr double least_sine = 1e-6;
    if (!(at.sine > Real(least_sine))) {
      throw Error(
          ErrorKind::numerical,
          fmt::format("event: at {:.10g} canonical the flow only touches the surface, so that the "
                      "time at which neighbours meet it cannot be expanded in a series",
                      static_cast<double>(time)));
    }
    if (!(abs(step) < Real(0.5) * scale) || i == most_iterations) {
      throw Error(ErrorKind::numerical,
                  fmt::format("event: the chief has none near {:.10g} canonical",
                              static_cast<double>(near)));
    }
    const bool is_rounding =
        i > 0 && abs(step) > Real(0.7) * previous && abs(step) <= largest_rounding * scale;
    if (abs(step) <= least * scale || is_rounding) break;
    advance(step);
    time += step;
    previous = abs(step);
  }
  EventMap<Real> map{Series<Real>(space, time), six_of(*flow.initial_jet)};
  for (int i = 0; i < order; ++i) {
    Series<Real> left = condition(map.state) / Real(-rate);
    left[0] = Real(0);
    map.state = carried<Real>(crossing, map.state, left);
    map.time += left;
  }
  return map;
}

template EventMap<InstantiatedReal> event_map(const DynamicalSystem&,
                                              const SixNumbers<InstantiatedReal>&, const ClockTime&,
                                              const InstantiatedReal&, int, const GaussSettings&,
                                              const EventCondition<InstantiatedReal>&);

}  // namespace hamjet
