#include "../../../src/studies/formation/thrust/bang_bang_search.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "../../../src/studies/formation/thrust/threshold_crossing.hpp"

namespace hamjet {
namespace {

const double pi = std::numbers::pi;

/// Free space, H = p^2 / 2, or an oscillator in each coordinate, H = (p^2 + q^2) / 2.
DynamicalSystem system_of(double stiffness) {
  return make_system("test", 3, [=](const auto& q, const auto& p) {
    auto h = p[0] * p[0] / 2 + p[1] * p[1] / 2 + p[2] * p[2] / 2;
    if (stiffness != 0) h = h + (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) * stiffness / 2;
    return h;
  });
}

/// From rest at 0 to rest at distance 1 along the first axis in the time 2. The thrust of least
/// energy is linear in the time, u = 6 d / T^2 (1 - 2 t / T).
BangBangTask rest_to_rest(double most) {
  BangBangTask task;
  task.start = {0, 0, 0, 0, 0, 0};
  task.end = {1, 0, 0, 0, 0, 0};
  task.energy_costates = {-1.5, 0, 0, -1.5, 0, 0};
  task.energy_largest = 1.5;
  task.most = most;
  task.tolerance = 1e-10;
  return task;
}

// Full thrust from 0 to t1 and back from T - t1 to T goes d = a t1 (T - t1).
TEST(BangBangSearch, RestToRestIsThatOfTheClosedForm) {
  const SwitchedFlight flight(system_of(0), ClockTime::epoch(), 2);
  for (const double most : {1.01, 1.25, 1.5, 4.0, 100.0}) {
    const BangBangThrust thrust = bang_bang_thrust(flight, rest_to_rest(most));
    ASSERT_EQ(thrust.failure, "") << most;
    ASSERT_EQ(thrust.flown.size(), 4U) << most;  // full, off, full, and the end
    EXPECT_EQ(thrust.flown[0].phase, ThrustPhase::full);
    EXPECT_EQ(thrust.flown[1].phase, ThrustPhase::off);
    EXPECT_EQ(thrust.flown[2].phase, ThrustPhase::full);
    const double first = 1 - std::sqrt(1 - 1 / most);
    EXPECT_NEAR(thrust.flown[0].end, first, 1e-12) << most;
    EXPECT_NEAR(thrust.flown[1].end, 2 - first, 1e-12) << most;
    EXPECT_LT(thrust.miss.norm(), 1e-13) << most;
    // The primer vector is linear in time, and 1 at both switches.
    EXPECT_NEAR(thrust.costates[3], -1 / (1 - first), 1e-11 / (1 - first)) << most;
  }
}

// The same while the mass falls, with the acceleration a = a0 exp(v / c) after the change v: a burn
// to the speed V takes the time c / a (1 - exp(-V / c)), c / a being the time in which the mass
// would be used up, and goes c ((c / a - t) ln(1 - t a / c) + t); V is such that the way is 1.
// An acceleration of 0.95 would be too weak if it did not grow.
TEST(BangBangSearch, RestToRestByFallingMassIsThatOfTheClosedForm) {
  const SwitchedFlight flight(system_of(0), ClockTime::epoch(), 2);
  using Thruster = std::pair<double, double>;
  for (const Thruster& thruster :
       {Thruster(1.25, 100), Thruster(1.25, 2), Thruster(1.25, 1), Thruster(0.95, 1)}) {
    const double exhaust = thruster.second;
    BangBangTask task = rest_to_rest(thruster.first);
    task.inverse_exhaust = 1 / exhaust;
    const auto burn_time = [&](double acceleration, double speed) {
      return -exhaust / acceleration * std::expm1(-speed / exhaust);
    };
    const auto way_from_rest = [&](double acceleration, double time) {
      const double whole = exhaust / acceleration;
      return exhaust * ((whole - time) * std::log1p(-time / whole) + time);
    };
    const auto times_and_way = [&](double speed) {
      const double later = task.most * std::exp(speed / exhaust);
      const double first = burn_time(task.most, speed), last = burn_time(later, speed);
      return std::array{first, last,
                        way_from_rest(task.most, first) + speed * (2 - first - last) +
                            speed * last - way_from_rest(later, last)};
    };
    double low = 0.5, high = 0.9;  // of a mass that stays the same V is 0.69
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (times_and_way(middle)[2] < 1 ? low : high) = middle;
    }
    const auto [first, last, way] = times_and_way(low);
    ASSERT_NEAR(way, 1, 1e-14);
    const BangBangThrust thrust = bang_bang_thrust(flight, task);
    ASSERT_EQ(thrust.failure, "") << exhaust;
    ASSERT_EQ(thrust.flown.size(), 4U) << exhaust;
    EXPECT_NEAR(thrust.flown[0].end, first, 1e-11) << exhaust;
    EXPECT_NEAR(thrust.flown[1].end, 2 - last, 1e-11) << exhaust;
    EXPECT_NEAR(thrust.flown[1].acceleration, task.most * std::exp(low / exhaust), 1e-11);
    EXPECT_NEAR(thrust.flown[3].acceleration, task.most * std::exp(2 * low / exhaust), 1e-11);
  }
}

// The least acceleration that goes the way is that of thrust without a pause, 4 d / T^2 = 1.
TEST(BangBangSearch, TooWeakIsToldWithTheLeastThatIsNot) {
  const SwitchedFlight flight(system_of(0), ClockTime::epoch(), 2);
  const BangBangThrust thrust = bang_bang_thrust(flight, rest_to_rest(0.5));
  EXPECT_NE(thrust.failure, "");
  ASSERT_TRUE(thrust.lowest);
  EXPECT_GE(*thrust.lowest, 1);
  EXPECT_LE(*thrust.lowest, 1.01);
}

TEST(BangBangSearch, TooStrongEndsAtOnce) {
  const SwitchedFlight flight(system_of(0), ClockTime::epoch(), 2);
  const BangBangThrust thrust = bang_bang_thrust(flight, rest_to_rest(1e8));
  EXPECT_NE(thrust.failure.find("times as strong as least energy asks for"), std::string::npos)
      << thrust.failure;
  EXPECT_LE(thrust.flights, 1);
}

TEST(BangBangSearch, ADeputyThatArrivesByCoastingNeedsNoThrust) {
  const SwitchedFlight flight(system_of(1), ClockTime::epoch(), 2 * pi);
  BangBangTask task;
  task.start = task.end = {0.01, 0, 0, 0, 0.02, 0};  // a whole period
  task.energy_costates = {0, 0, 0, 0, 0, 0};
  task.most = 1;
  task.tolerance = 1e-10;
  const BangBangThrust thrust = bang_bang_thrust(flight, task);
  EXPECT_EQ(thrust.failure, "");
  ASSERT_EQ(thrust.flown.size(), 2U);
  EXPECT_EQ(thrust.flown[0].phase, ThrustPhase::off);
}

// What is asked is a fifth of the miss that is allowed: it is gone all the same.
TEST(BangBangSearch, AMissThatIsAllowedDoesNotSpareTheWay) {
  const SwitchedFlight flight(system_of(0), ClockTime::epoch(), 2);
  BangBangTask task = rest_to_rest(1.25);
  task.tolerance = 5;
  const BangBangThrust thrust = bang_bang_thrust(flight, task);
  ASSERT_EQ(thrust.failure, "");
  EXPECT_NEAR(thrust.flown[0].end, 1 - std::sqrt(1 - 1 / 1.25), 1e-5);
}

// Across the orbit of a circular chief a deputy oscillates (Clohessy and Wiltshire), and is brought
// to rest there over a revolution by two burns about the passages of the plane, each of 2 a sin h
// with half its length h, together the amplitude; impulses take the amplitude itself.
TEST(BangBangSearch, OutOfPlaneMotionIsStoppedAsByTheClosedForm) {
  const SwitchedFlight flight(system_of(1), ClockTime::epoch(), 2 * pi);
  constexpr double amplitude = 0.01;
  BangBangTask task;
  task.start = {0, 0, amplitude, 0, 0, 0};
  task.end = {0, 0, 0, 0, 0, 0};
  // u = k sin t with k pi = amplitude.
  task.energy_costates = {0, 0, amplitude / pi, 0, 0, 0};
  task.energy_largest = amplitude / pi;
  task.tolerance = 1e-12;
  double last = 4 * amplitude / pi;  // the integral of |u| of the thrust of least energy
  for (const double times : {0.26, 0.3, 1.0, 10.0, 300.0}) {
    task.most = times * amplitude;
    const BangBangThrust thrust = bang_bang_thrust(flight, task);
    ASSERT_EQ(thrust.failure, "") << times;
    ASSERT_EQ(thrust.flown.size(), 6U) << times;
    const double half = std::asin(1 / (4 * times));
    double change = 0;
    for (const std::size_t k : {1U, 3U}) {
      EXPECT_EQ(thrust.flown[k].phase, ThrustPhase::full);
      const double middle = k == 1 ? pi / 2 : 3 * pi / 2;
      EXPECT_NEAR(thrust.flown[k].start, middle - half, 1e-11) << times;
      EXPECT_NEAR(thrust.flown[k].end, middle + half, 1e-11) << times;
      change += task.most * thrust.flown[k].length();
    }
    EXPECT_GE(change, amplitude);
    // Beside impulses burns lose h^2 / 6 of what they change, to the next order.
    EXPECT_NEAR(change / amplitude - 1, half * half / 6, 0.1 * half * half * half * half + 1e-9);
    // 0.26 and 0.3 are below the 1 / pi of the thrust of least energy, which may take less.
    if (times > 1 / pi) {
      EXPECT_LE(change, last);
      last = change;
    }
  }
  task.most = 0.2 * amplitude;
  const BangBangThrust weak = bang_bang_thrust(flight, task);
  ASSERT_TRUE(weak.lowest) << weak.failure;
  EXPECT_GE(*weak.lowest, 0.25 * amplitude);
  EXPECT_LE(*weak.lowest, 0.2525 * amplitude);
}

// The derivatives by costates and law against differences of flights, across switches.
TEST(BangBangSearch, DerivativesAreThoseOfFlights) {
  const SwitchedFlight flight(system_of(1), ClockTime::epoch(), 5);
  const std::vector<double> start = {0.1, 0.2, -0.1, 0, 0.3, 0.1, 0.6, -1.8, 0.4, 0.5, 0.2, -0.7};
  const SwitchedThrust change = {0.3, -0.2, 0.25};
  for (const SwitchedThrust& law : {SwitchedThrust{0.2, 0}, SwitchedThrust{0.2, 0.3},
                                    SwitchedThrust{0.2, 1}, SwitchedThrust{0.2, 0, 0.5}}) {
    const double smoothing = law.smoothing;
    const auto flown = flight.fly(start, law);
    ASSERT_GT(flown.size(), smoothing < 1 ? 3U : 1U) << smoothing;
    // With e = 0 the law may change its limit alone, and with e = 1 its form changes too.
    const SwitchedThrust by = {change.most, smoothing == 0.3 ? change.smoothing : 0,
                               law.mass_falls() ? change.inverse_exhaust : 0};
    const SwitchedFlight::Commanded commanded = flight.commanded(flown, law, by);
    constexpr double step = 1e-5;
    for (Eigen::Index j = 0; j < 7; ++j) {
      Eigen::Matrix<double, 6, 1> difference;
      for (const double sign : {1.0, -1.0}) {
        std::vector<double> moved = start;
        SwitchedThrust moved_law = law;
        if (j < 6) {
          moved[static_cast<std::size_t>(6 + j)] += sign * step;
        } else {
          moved_law.most += sign * step * by.most;
          moved_law.smoothing += sign * step * by.smoothing;
          moved_law.inverse_exhaust += sign * step * by.inverse_exhaust;
        }
        const auto end = flight.fly(moved, moved_law).back().state;
        for (Eigen::Index i = 0; i < 6; ++i) {
          const double x = sign * end[static_cast<std::size_t>(i)] / (2 * step);
          difference[i] = sign > 0 ? x : difference[i] + x;
        }
      }
      // Differences are wrong by step^2, and by rounding over the step.
      EXPECT_LT((difference - commanded.col(j)).norm(), 1e-7) << smoothing << ", column " << j;
    }
  }
}

// A parabola that dips below a threshold between the places that are looked at.
TEST(ThresholdCrossing, AShortDipIsFound) {
  const std::vector<double> parabola = {0.09, -0.6, 1};  // (x - 0.3)^2
  const auto fall = first_fall_below(parabola, 1e-10, 1, false);
  ASSERT_TRUE(fall);
  EXPECT_NEAR(fall->place, 0.3 - 1e-5, 1e-10);
  EXPECT_NEAR(fall->slope, -2e-5, 1e-9);
  EXPECT_FALSE(first_fall_below(parabola, -1e-10, 1, false));
  // It begins at the threshold and rises above it, or comes back to it.
  EXPECT_FALSE(first_rise_above({0, -1, 1}, 0, 0.9, true));
  const auto rise = first_rise_above({0, -1, 1}, 0, 1.1, true);
  ASSERT_TRUE(rise);
  EXPECT_NEAR(rise->place, 1, 1e-15);
  EXPECT_NEAR(rise->slope, 1, 1e-14);
}

}  // namespace
}  // namespace hamjet
