#include "hamjet/uncertainty/keep_out_margin.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "integrators/taylor_flow.hpp"
#include "relative_orbits.hpp"
#include "support/errors.hpp"

namespace hamjet {
namespace {

using test::RelativeOrbit;

// Perpendicular vectors: the second crosses the first one's path a quarter turn after the start at
// offset + 2 e, and three quarters after it at offset - 2 e. There the ellipsoid is longest and the
// path turns, so that a deviation along the orbit touches its tip first.
TEST(KeepOutMargin, IsThatOfARelativeEllipseAcrossThePath) {
  constexpr double unit = 1e-7;
  const RelativeOrbit orbit{unit, unit, std::numbers::pi / 2, 10 * unit};
  EncounterProblem problem = orbit.problem(7, 2);
  problem.radius = unit;
  problem.spacecraft[1].factor.col(0) = RelativeOrbit::along_the_orbit(unit);
  const KeepOutMargin margin = keep_out_margin(problem, unit * Eigen::Vector3d(0.5, 1, 0.5));
  ASSERT_TRUE(margin.deviations);
  // 10 - 2 - 1; the second order is 1e-6 of the distances, the time where the length is flat.
  EXPECT_NEAR(*margin.deviations, 7, 1e-4);
  EXPECT_NEAR(margin.time, 1.5 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(margin.deviation[6], -7, 1e-4);
  EXPECT_NEAR(margin.flown_ratio, 1, 1e-5);
}

TEST(KeepOutMargin, IsNoneWhereNothingLeadsThereAndZeroWithin) {
  constexpr double unit = 1e-7;
  // Parallel vectors of one size: a circle of radius e about the path, wherever along it.
  EncounterProblem problem = RelativeOrbit{unit, unit, 0, 10 * unit}.problem(7, 2);
  problem.radius = unit;
  problem.spacecraft[1].factor.col(0) = RelativeOrbit::along_the_orbit(unit);
  EXPECT_FALSE(keep_out_margin(problem, unit * Eigen::Vector3d(0.9, 5, 0.9)).deviations);
  EncounterProblem within = RelativeOrbit{unit, unit, std::numbers::pi / 2, 0}.problem(7, 2);
  within.radius = unit;
  within.spacecraft[1].factor.col(0) = RelativeOrbit::along_the_orbit(unit);
  EXPECT_EQ(keep_out_margin(within, unit * Eigen::Vector3d(0.5, 3, 0.5)).deviations, 0);
  test::expect_error([&] { keep_out_margin(within, Eigen::Vector3d(1, 0, 1)); }, ErrorKind::usage,
                     {"semi-axes must be positive"}, "zero");
}

// Five revolutions at e = 0.3 with an ellipsoid that the relative path, forty times as wide,
// crosses between two of 64 looks in a revolution: of the many minima those that looks lie beside
// are not the lowest. Expected: numpy and scipy, the variational equations of both orbits by DOP853
// at 1e-13, the trust-region problem at 20001 times and at as many about the least, three times; by
// the linear theory, of which the second order is (0.2 of 1e-6)^2 in distances of 1e-6.
TEST(KeepOutMargin, IsTheLeastOfManyMinimaThatLooksPassBy) {
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.to = 31.744323;
  problem.order = 2;
  problem.radius = 1e-6;
  problem.settings.tolerance = 1e-12;
  problem.spacecraft[0].state = {0.692783, 0.998003, 0.296294, -0.527754, 0.336267, -0.45581};
  problem.spacecraft[1].state = problem.spacecraft[0].state;
  const std::array<double, 6> offset = {7.08639e-05,  -2.2527e-05, -0.000104809,
                                        -1.02059e-06, 4.73868e-06, -3.06952e-07};
  for (std::size_t i = 0; i < 6; ++i) problem.spacecraft[1].state[i] += offset[i];
  problem.spacecraft[1].factor.diagonal() << 1.4757e-07, 4.50787e-07, 9.11186e-09, 1.6295e-07,
      4.52141e-09, 2.79185e-08;
  const KeepOutMargin margin =
      keep_out_margin(problem, Eigen::Vector3d(9.31535e-06, 2.10908e-06, 6.12078e-06));
  ASSERT_TRUE(margin.deviations);
  EXPECT_NEAR(*margin.deviations, 0.2097265, 1e-4);
  EXPECT_NEAR(margin.time, 26.97108, 1e-3);
}

/// The least ratio along a flight with the full equations.
double least_flown_ratio(const EncounterProblem& problem, const Eigen::Vector3d& axes,
                         const Eigen::Matrix<double, 12, 1>& xi) {
  std::vector<double> states;
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const Eigen::Matrix<double, 6, 1> deviation =
        problem.spacecraft[craft].factor * xi.segment<6>(static_cast<Eigen::Index>(6 * craft));
    for (std::size_t i = 0; i < 6; ++i) {
      states.push_back(problem.spacecraft[craft].state[i] +
                       deviation[static_cast<Eigen::Index>(i)]);
    }
  }
  const std::vector<double>& mean = problem.spacecraft[0].state;
  states.insert(states.end(), mean.begin(), mean.end());
  TaylorFlow flow(problem.system);
  constexpr int steps = 2000;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= steps; ++k) {
    if (k > 0)
      flow.advance(states, ClockTime((k - 1) * problem.to / steps),
                   std::vector<double>(3, problem.to / steps));
    const ChiefFrame frame(std::span<const double>(states).last(6), {},
                           RelativeFrame::rtn_inertial);
    const Eigen::Vector3d relative(states[6] - states[0], states[7] - states[1],
                                   states[8] - states[2]);
    least = std::min(least, frame.along_axes(relative).cwiseQuotient(axes).norm());
  }
  return least;
}

// The separation is kilometres over ten revolutions, far beyond the linear range.
TEST(KeepOutMargin, HoldsOfFlights) {
  constexpr double kilometre = 1.0 / 7000;
  const RelativeOrbit orbit{0.3 * kilometre, 0.4 * kilometre, 1, 5 * kilometre};
  EncounterProblem problem = orbit.problem(20 * std::numbers::pi, 3);
  problem.radius = kilometre;
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor.diagonal() << 10, 20, 10, 0.01 / 1.08, 0.01 / 1.08, 0.02 / 1.08;
    craft.factor *= 1e-3 * kilometre;
  }
  const Eigen::Vector3d axes = kilometre * Eigen::Vector3d(0.5, 1, 0.5);
  const KeepOutMargin margin = keep_out_margin(problem, axes);
  ASSERT_TRUE(margin.deviations);
  EXPECT_GT(*margin.deviations, 1);
  EXPECT_NEAR(margin.deviation.norm(), *margin.deviations, 1e-12 * *margin.deviations);
  EXPECT_NEAR(margin.flown_ratio, 1, 1e-3);
  EXPECT_LT(least_flown_ratio(problem, axes, 1.02 * margin.deviation), 1);
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 30; ++k) {
    Eigen::Matrix<double, 12, 1> xi;
    for (double& x : xi) x = normal(engine);
    // Half of them are about the worst direction.
    xi *= (k % 2 == 0 ? 1.0 : 0.05) / xi.norm();
    if (k % 2 == 1) xi += margin.deviation.normalized();
    xi *= 0.98 * *margin.deviations / xi.norm();
    EXPECT_GT(least_flown_ratio(problem, axes, xi), 1) << k;
  }
}

}  // namespace
}  // namespace hamjet
