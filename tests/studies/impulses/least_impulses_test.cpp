#include "studies/formation/impulses/least_impulses.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "circle_transfers.hpp"
#include "studies/formation/impulses/clp_solver.hpp"
#include "support/errors.hpp"

// Tests the solver of least impulses and the checks of its answers.

namespace hamjet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Least 2 x + 3 y with x + y >= 2 and y <= 1.5 x.
struct SmallProgram : LinearProgram {
  static constexpr double any = std::numeric_limits<double>::max();
  SmallProgram() : LinearProgram({{2, any}, {-any, 0}}) {
    add({{2, any, {{0, 1}, {1, -1.5}}}, {3, any, {{0, 1}, {1, 1}}}});
  }
};

TEST(LinearProgram, GrowsByColumns) {
  SmallProgram program;
  program.solve();
  EXPECT_NEAR(program.values()[0], 2, 1e-9);
  EXPECT_NEAR(program.values()[1], 0, 1e-9);
  EXPECT_NEAR(program.duals()[0], 2, 1e-9);  // the price of one more unit of the first row
  // A variable that does twice as much for the same price, but of which there is half.
  program.add({{2, 0.5, {{0, 2}}}});
  program.solve();
  EXPECT_NEAR(program.values()[0], 1, 1e-9);
  EXPECT_NEAR(program.values()[2], 0.5, 1e-9);
  program.fix(2, 0.25);
  program.set_costs({3, 2, 2});
  program.solve();
  EXPECT_NEAR(program.values()[0], 0.6, 1e-9);  // x + y = 1.5 and y = 1.5 x
  EXPECT_NEAR(program.values()[1], 0.9, 1e-9);
}

TEST(LinearProgram, AFailureIsAnError) {
  SmallProgram impossible;
  impossible.fix(0, 0);
  test::expect_error(ErrorKind::numerical, "it has no solution", [&] { impossible.solve(); });
  SmallProgram boundless;
  boundless.set_costs({-1, 0});
  EXPECT_THROW(boundless.solve(), UnprovedLeast);
}

// Out of the plane of a circle an impulse v at the angle t makes v (-sin t, cos t) of (z, v_z); the
// least sum is that of one pair of all pairs of times. (Caratheodory's theorem.)
TEST(LeastImpulses, AreTheLeastOfAllPairs) {
  constexpr int intervals = 60;
  const double duration = 4;
  const std::vector<ImpulseEffect> effects = effects_of_circle(duration, intervals);
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 25; ++draw) {
    Vector6 change = Vector6::Zero();
    change[2] = normal(generator);
    change[5] = normal(generator);
    double least = infinity;
    for (int i = 0; i <= intervals; ++i) {
      for (int j = 0; j < i; ++j) {
        const double a = duration * i / intervals, b = duration * j / intervals;
        const double first = (change[2] * std::cos(b) + change[5] * std::sin(b)) / std::sin(b - a);
        const double second = (change[2] * std::cos(a) + change[5] * std::sin(a)) / std::sin(a - b);
        if (std::abs(std::sin(a - b)) < 1e-9) continue;
        least = std::min(least, std::abs(first) + std::abs(second));
      }
    }
    EXPECT_NEAR(least_impulses(effects, change).cost, least, 1e-8 * least) << draw;
  }
}

// Every answer of the solver is checked without the solver.
TEST(LeastImpulses, WhatIsNotTheLeastIsSeen) {
  const std::vector<ImpulseEffect> effects = effects_of_circle(3 * std::numbers::pi, 48);
  Vector6 change;
  change << 1, -2, 0.5, 0.3, 0.4, -0.7;
  const LeastImpulses right = least_impulses(effects, change);
  double largest = 0;
  for (const ChosenImpulse& one : right.impulses) largest = std::max(largest, one.change.norm());
  EXPECT_NO_THROW(require_least(effects, change, infinity, right));
  EXPECT_THROW(require_least(effects, change, 0.9 * largest, right), UnprovedLeast);
  const auto refuses = [&](const auto& spoil) {
    LeastImpulses wrong = right;
    spoil(wrong);
    EXPECT_THROW(require_least(effects, change, infinity, wrong), UnprovedLeast);
  };
  // The checks are tried on another change, on no change, and on a change that is not a number.
  refuses([](LeastImpulses& one) { one.impulses[0].change *= 1 + 1e-6; });
  refuses([](LeastImpulses& one) { one.impulses.clear(); });
  refuses([](LeastImpulses& one) { one.impulses[0].change[1] = std::nan(""); });
  // The refusals are tried on a costate that proves less, on a bound above the proved one, and on a
  // wrong sum.
  refuses([](LeastImpulses& one) { one.costate *= 0.999; });
  refuses([](LeastImpulses& one) { one.costate.setConstant(std::nan("")); });
  refuses([](LeastImpulses& one) { one.lower_bound *= 1.001; });
  refuses([](LeastImpulses& one) { one.cost *= 0.999; });
  // The same change is made by more impulses: there and back at one time.
  refuses([&](LeastImpulses& one) {
    const Eigen::Vector3d there(0.1, 0, 0);
    one.impulses.push_back({0, there});
    one.impulses.push_back({0, -there});
    one.cost += 2 * there.norm();
  });
}

// A day near a circle of 7000 km, impulses of at most 0.1 m/s some 81 s apart, in metres and the
// mean motion: the relative eccentricity and inclination vectors change by 250 and 500 m along
// parallels, which radial and normal components of the same impulses do, n sqrt(250^2 + 500^2).
TEST(LimitedImpulses, OverManyRevolutionsThatAreEnoughForTheUnlimitedSum) {
  const double limit = 92.76;
  for (const double revolutions : {9.8009, 10.3186, 13.4248}) {
    const double duration = 2 * std::numbers::pi * revolutions;
    const auto intervals = static_cast<int>(72 * revolutions);
    const std::vector<ImpulseEffect> effects = effects_of_circle(duration, intervals);
    Vector6 change;
    change << 0, -500, 0, -250, 0, -500;
    const auto found = least_impulses(effects, change, limit).least;
    ASSERT_TRUE(found.has_value());
    const double sum = std::hypot(250, 500);
    EXPECT_GE(found->cost, sum * (1 - 1e-9));
    EXPECT_LT(found->cost, sum * (1 + 1e-4));
    EXPECT_NO_THROW(require_least(effects, change, limit, *found));
  }
}

// Impulses of one size at all times make the change with the least limit there is; below it there
// are none, however far.
TEST(LimitedImpulses, ALimitThatIsTooLowIsTold) {
  const std::vector<ImpulseEffect> effects = effects_of_circle(8 * std::numbers::pi, 96);
  Vector6 change;
  change << 0, 0, 0.3, 0, 0, 0.7;
  // Sum |cos| over the times, to the side of the change: sum_k |B_k^T y| with y along it.
  const Vector6 along = change.normalized();
  double reach = 0;
  for (const ImpulseEffect& effect : effects) reach += (effect.transpose() * along).norm();
  const double most = change.norm() / reach;
  for (const double limit : {0.999 * most, 0.1 * most, 1e-12, 1e-300}) {
    const LimitedImpulses found = least_impulses(effects, change, limit);
    EXPECT_FALSE(found.least.has_value());
    EXPECT_GT(found.limit_needed, limit);
    EXPECT_GT(found.limit_needed, 0.01 * most);
  }
  EXPECT_TRUE(least_impulses(effects, change, 10 * most).least.has_value());
}

}  // namespace
}  // namespace hamjet
