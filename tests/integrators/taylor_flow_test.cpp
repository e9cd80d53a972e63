#include "integrators/taylor_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "support/flow.hpp"

namespace hamjet {
namespace {

const std::vector<double> start = {1, 0, 0, 0.1, 0.9, 0.5};

SharedSystem oblate() {
  ZonalGravity field{.mu = 1, .radius = 0.9};
  field.J[2] = 1e-3;
  field.J[3] = -2.5e-6;
  return zonal_gravity(field);
}

// The flow is compared with Gauss's method in extended precision, which shares no step; each lane
// has its own time.
TEST(TaylorFlow, CarriesEachLaneByItsOwnTime) {
  const SharedSystem system = oblate();
  const std::vector<double> times = {0.0, 1e-9, 0.3, -2.0, 12.0, -0.01};
  std::vector<double> states;
  for (std::size_t k = 0; k < times.size(); ++k)
    states.insert(states.end(), start.begin(), start.end());
  TaylorFlow(system).advance(states, ClockTime::epoch(), times);
  for (std::size_t k = 0; k < times.size(); ++k) {
    test::Flow<Extended> flow{*system, {start.begin(), start.end()}, Extended(times[k]), 1, {}};
    const auto exact = test::final_state(test::run_gauss(flow, test::adaptive(8, 1e-22)));
    for (std::size_t i = 0; i < 6; ++i) {
      // The rounding along the way, which grows along the orbit.
      EXPECT_NEAR(states[6 * k + i], static_cast<double>(exact[i]),
                  3e-15 * (1 + std::abs(times[k])))
          << times[k];
    }
  }
}

// Each lane's result equals, bit by bit, its result alone, whatever the other lanes contain.
TEST(TaylorFlow, ALaneDoesNotDependOnTheOthers) {
  const SharedSystem system = oblate();
  const std::vector<double> times = {1e-7, 0.02, 0.3, -2.0, 1e-3, 0.7, -0.01, 0.11};
  std::vector<double> together;
  for (std::size_t k = 0; k < times.size(); ++k) {
    together.insert(together.end(), start.begin(), start.end());
  }
  TaylorFlow(system).advance(together, ClockTime::epoch(), times);
  for (std::size_t k = 0; k < times.size(); ++k) {
    std::vector<double> alone = start;
    TaylorFlow(system).advance(alone, ClockTime::epoch(), std::span(&times[k], 1));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(alone[i], together[6 * k + i]) << times[k];
  }
}

TEST(TaylorFlow, SaysHowFarItsPolynomialReaches) {
  const SharedSystem system = oblate();
  TaylorFlow flow(system);
  for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane)
    flow.set_state(lane, ClockTime::epoch(), start);
  flow.expand();
  const double reach = flow.reach(0);
  EXPECT_GT(reach, 0.1);
  for (const double time : {reach, -reach}) {
    std::vector<double> state(6);
    flow.evaluate(3, time, state);
    test::Flow<Extended> exact{*system, {start.begin(), start.end()}, Extended(time), 1, {}};
    const auto end = test::final_state(test::run_gauss(exact, test::adaptive(8, 1e-22)));
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(state[i], static_cast<double>(end[i]), 2e-15) << time;
    }
  }
}

// An expansion that knows its times takes as many powers as they need, and is right at them.
TEST(TaylorFlow, TakesAsManyPowersAsATimeNeeds) {
  const SharedSystem system = oblate();
  TaylorFlow flow(system);
  for (std::size_t lane = 0; lane < TaylorFlow::lanes; ++lane)
    flow.set_state(lane, ClockTime::epoch(), start);
  int last = 0;
  for (const double time : {1e-4, 0.003, 0.03, -0.15}) {
    flow.expand(std::vector<double>{0.5 * time, time});
    EXPECT_GT(flow.powers(0), last);
    EXPECT_LT(flow.powers(0), TaylorFlow::order);
    last = flow.powers(0);
    EXPECT_EQ(flow.within_reach(1, time), time);
    std::vector<double> state(6);
    flow.evaluate(1, time, state);
    test::Flow<Extended> exact{*system, {start.begin(), start.end()}, Extended(time), 1, {}};
    const auto end = test::final_state(test::run_gauss(exact, test::adaptive(8, 1e-22)));
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(state[i], static_cast<double>(end[i]), 1e-15) << time;
    }
    // The polynomial does not reach much further, and reports this.
    EXPECT_LT(std::abs(flow.within_reach(1, 20 * time)), 20 * std::abs(time));
  }
}

// Half a revolution from pericentre to apocentre, whose place and speed are closed forms, with
// lengths from that of the Earth's orbits in astronomical units to that in millimetres, and where
// squares of coefficients leave binary64. Lanes of other units go by its side.
TEST(TaylorFlow, IsAsRightInAnyUnitOfLength) {
  constexpr double e = 0.74;
  for (const double a : {1e-60, 1e-12, 5e-5, 1e-3, 1.0, 42164.0, 4.2e7, 4.2e10, 1e20, 1e60}) {
    SCOPED_TRACE(a);
    const double speed = std::sqrt((1 + e) / (1 - e) / a);
    const std::vector<double> pericentre = {a * (1 - e), 0, 0, 0, speed, 0};
    const double half = std::numbers::pi * a * std::sqrt(a);
    std::vector<double> states = pericentre;
    states.insert(states.end(), start.begin(), start.end());
    TaylorFlow flow{SharedSystem(kepler())};
    flow.advance(states, ClockTime::epoch(), std::vector<double>{half, 0.5});
    EXPECT_NEAR(states[0], -a * (1 + e), 1e-14 * a);
    EXPECT_NEAR(states[1], 0, 1e-13 * a);
    EXPECT_NEAR(states[3], 0, 1e-13 * speed);
    EXPECT_NEAR(states[4], -speed * (1 - e) / (1 + e), 1e-14 * speed);
    // The reach of one polynomial is proportional to the time scale of the orbit.
    flow.set_state(0, ClockTime::epoch(), pericentre);
    flow.expand();
    EXPECT_NEAR(flow.reach(0) / half, 0.016, 0.01);
    EXPECT_EQ(flow.within_reach(0, half), flow.reach(0));
  }
}

// If the square of a distance is below binary64 and the force is not finite, there is no result.
// An upright pendulum, at the double next to pi, where the force is rounding alone: its angle and
// momentum from pi grow as sinh and cosh of the time.
TEST(TaylorFlow, StartsAtAnEquilibriumThatIsRounded) {
  const auto pendulum = [](const auto& q, const auto& p) { return p[0] * p[0] * 0.5 - cos(q[0]); };
  const SharedSystem system = make_system("pendulum", 1, pendulum);
  TaylorFlow flow(system);
  const double pi = std::numbers::pi;
  std::vector<double> states = {pi, 0};
  flow.advance(states, ClockTime::epoch(), std::vector<double>{5});
  // Roundings on the way, of an ulp of pi each, grow by as much as e^5.
  EXPECT_NEAR(states[0], pi, 8 * 4.5e-16 * std::exp(5.0));
  EXPECT_NEAR(states[1], 0, 8 * 4.5e-16 * std::exp(5.0));
}

TEST(TaylorFlow, MarksAForceThatIsNotFinite) {
  std::vector<double> states = {1e-200, 0, 0, 0, 1e100, 0};
  TaylorFlow{SharedSystem(kepler())}.advance(states, ClockTime::epoch(),
                                             std::vector<double>{1e-300});
  EXPECT_TRUE(std::isnan(states[0]));
}

TEST(TaylorFlow, MarksCollisionsAndLeavesTheOthers) {
  std::vector<double> states = {1, 0, 0, 0, 0, 0};  // falls into the centre at 1.11
  states.insert(states.end(), start.begin(), start.end());
  std::vector<double> alone(start);
  TaylorFlow flow{SharedSystem(kepler())};
  flow.advance(states, ClockTime::epoch(), std::vector<double>{2.0, 2.0});
  flow.advance(alone, ClockTime::epoch(), std::vector<double>{2.0});
  EXPECT_TRUE(std::isnan(states[0]));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(states[6 + i], alone[i]);
}

}  // namespace
}  // namespace hamjet
