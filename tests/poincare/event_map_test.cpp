#include "hamjet/poincare/event_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "../charts/orbits.hpp"
#include "../support/flow.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"
#include "independent_flight.hpp"

namespace hamjet {
namespace {

using test::ChiefOrbit;
using test::IndependentFlight;
using test::orbit_of;

const GaussSettings event_gauss = test::adaptive(8, 1e-14);

/// The ascending node: the height over the equator.
Series<double> height(const SixNumbers<Series<double>>& z) { return z[2]; }
/// An apsis: the product of position and velocity.
Series<double> radial(const SixNumbers<Series<double>>& z) {
  return z[0] * z[3] + z[1] * z[4] + z[2] * z[5];
}

template <class Condition>
double value_at(const Condition& condition, const IndependentFlight::State& state) {
  const SpacePointer space = SeriesSpace::create(1, 0);
  const auto z = test::rounded(state);
  const auto constant = [&](std::size_t i) { return Series<double>(space, z[i]); };
  return condition(
      {constant(0), constant(1), constant(2), constant(3), constant(4), constant(5)})[0];
}

// Deputies pass the node and the apsis when the polynomials say, and where: flown by the test's own
// integrator to the predicted time, the condition holds and the state is the predicted one, with an
// error that falls as the deviation to the power of the order + 1.
TEST(EventMap, PredictsEventsOfDeputiesThatAreFlownIndependently) {
  ChiefOrbit orbit = orbit_of(9000, 0.2, 50, 30, 70, 40);
  orbit.field = test::egm96(orbit.field.radius);
  const IndependentFlight flight(orbit.field);
  const auto try_condition = [&](const EventCondition<double>& condition, double near) {
    const auto map = event_map<double>(zonal_gravity(orbit.field), orbit.start, ClockTime::epoch(),
                                       near, 3, event_gauss, condition);
    const auto miss = [&](double size) {
      std::mt19937_64 generator(7);
      double largest = 0;
      for (int k = 0; k < 4; ++k) {
        const SixNumbers<double> deviation = test::random_deviation(generator, size);
        SixNumbers<double> deputy = orbit.start;
        for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
        const auto end = flight(test::long_state(deputy), evaluate<double>(map.time, deviation));
        largest = std::max(largest, std::abs(value_at(condition, end)));
        for (std::size_t i = 0; i < 6; ++i) {
          largest = std::max(largest, std::abs(static_cast<double>(end[i]) -
                                               evaluate<double>(map.state[i], deviation)));
        }
      }
      return largest;
    };
    EXPECT_LT(miss(1e-5), 1e-12);
    EXPECT_NEAR(std::log2(miss(8e-3) / miss(4e-3)), 4, 0.6);
  };
  try_condition(height, 0.75 * orbit.period);
  try_condition(radial, 0.9 * orbit.period);
}

// On a circle of Kepler's problem a deputy that starts ahead by an angle comes to the node earlier
// by that angle over the mean motion, and one that is higher by dr, at the speed of its own circle,
// later: the time is theta r^(3/2), of which this is the series.
TEST(EventMap, HasTheTimesOfKeplersCircles) {
  const double inclination = 0.7;
  const double c = std::cos(inclination), s = std::sin(inclination);
  // The way from the descending node to the ascending one is half a turn.
  const SixNumbers<double> chief = {-1, 0, 0, 0, -c, -s};
  const auto map = event_map<double>(kepler(), chief, ClockTime::epoch(), 3.0, 4, event_gauss,
                                     EventCondition<double>(height));
  EXPECT_NEAR(map.time[0], std::numbers::pi, 1e-13);
  for (const double dr : {1e-2, -2e-2}) {
    const double r = 1 + dr;
    const double dv = 1 / std::sqrt(r) - 1;
    const SixNumbers<double> deviation = {-dr, 0, 0, 0, -c * dv, -s * dv};
    // The next power of dr, with a coefficient of the order of the turn.
    EXPECT_NEAR(evaluate<double>(map.time, deviation), std::numbers::pi * std::pow(r, 1.5),
                20 * std::pow(std::abs(dr), 5));
  }
}

// The time between the nodes of a circle is half its period in any unit of length, from an
// astronomical unit to a metre for orbits about the Earth; of mu = 1 it goes as r^(3/2).
TEST(EventMap, FindsTheNodeInAnyUnitOfLength) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const double r : {4.7e-5, 1e-3, 1.0, 7e6, 1e9}) {
    const double speed = 1 / std::sqrt(r), time = r * std::sqrt(r);
    const SixNumbers<double> chief = {-r, 0, 0, 0, -c * speed, -s * speed};
    const auto map = event_map<double>(kepler(), chief, ClockTime::epoch(), 3.0 * time, 2,
                                       event_gauss, EventCondition<double>(height));
    EXPECT_NEAR(map.time[0] / time, std::numbers::pi, 1e-13) << r;
    EXPECT_NEAR(map.state[0][0] / r, 1, 1e-13) << r;
  }
}

// Where the flow only touches the surface of the condition, its time is no series.
TEST(EventMap, RefusesASurfaceThatTheFlowTouches) {
  const SixNumbers<double> circle = {1, 0, 0, 0, 1, 0};
  const auto highest = [](const SixNumbers<Series<double>>& z) { return z[1] - 1.0; };
  EXPECT_THROW(event_map<double>(kepler(), circle, ClockTime::epoch(), std::numbers::pi / 2, 2,
                                 event_gauss, EventCondition<double>(highest)),
               Error);
  const auto never = [](const SixNumbers<Series<double>>& z) { return z[1] - 3.0; };
  EXPECT_THROW(event_map<double>(kepler(), circle, ClockTime::epoch(), 1.0, 2, event_gauss,
                                 EventCondition<double>(never)),
               Error);
}

}  // namespace
}  // namespace hamjet
