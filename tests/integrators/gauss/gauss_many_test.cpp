#include "hamjet/integrators/gauss_many.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"

// Orbits that are integrated side by side. Each result agrees with a closed form, is the jet of a
// symplectic map, and equals the result of the orbit alone.

namespace hamjet {
namespace {

using Outcomes = std::vector<ManyFlowsOutcome>;
using States = std::vector<std::vector<double>>;

/// Orbits of semi-major axis 1 and mu = 1 from perigee, of eccentricities from 0 to 0.9, each in a
/// plane of its own.
States orbits_of_axis_one(std::size_t count) {
  States states;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i);
    const double e = 0.9 * x / static_cast<double>(count - 1);
    const double speed = std::sqrt((1 + e) / (1 - e));
    const double inclination = 0.3 + x;
    const double node = 2 * x;
    const double c = std::cos(node);
    const double s = std::sin(node);
    const double along = speed * std::cos(inclination);
    states.push_back(
        {(1 - e) * c, (1 - e) * s, 0, -along * s, along * c, speed * std::sin(inclination)});
  }
  return states;
}

FlowProblem<double> problem_of(const DynamicalSystem& system, int order, double duration) {
  const std::size_t size = system.dimension();
  FlowProblem<double> problem{system,  SeriesSpace::create(size, order), {}, {}, ClockTime::epoch(),
                              duration};
  problem.variables.resize(size);
  std::iota(problem.variables.begin(), problem.variables.end(), std::size_t{0});
  problem.initial_state.assign(size, 0);
  return problem;
}

/// The jet of order 1 or 2 of Kepler's flow about an orbit of axis 1 after its period 2 pi: a
/// neighbour z of energy E has the period T = 2 pi (-2 E)^(-3/2) and comes to z at that time, so
/// that at 2 pi it is where it was tau = T - 2 pi before,
///
///   z - tau z' + tau^2 z'' / 2 - .. ,   z' = (p, f) ,   z'' = (f, -p/r^3 + 3 (q.p) q / r^5) .
FlowJet<double> after_a_period(const std::vector<double>& state, const SpacePointer& space) {
  std::vector<Series<double>> z;
  for (std::size_t i = 0; i < 6; ++i) {
    z.emplace_back(space, state[i]);
    z[i][space->linear_index(i)] = 1;
  }
  const auto dot = [&](std::size_t a, std::size_t b) {
    return z[a] * z[b] + z[a + 1] * z[b + 1] + z[a + 2] * z[b + 2];
  };
  const Series<double> r2 = dot(0, 0);
  const Series<double> cube = pow(r2, -1.5);
  const Series<double> minus_two_energies = 2.0 * pow(r2, -0.5) - dot(3, 3);
  Series<double> tau = (2 * std::numbers::pi) * pow(minus_two_energies, -1.5);
  tau[0] = 0;
  FlowJet<double> result(6, Series<double>(space));
  const Series<double> turn = 3.0 * (dot(0, 3) / r2);
  for (std::size_t c = 0; c < 3; ++c) {
    const Series<double> force = -1.0 * (z[c] * cube);
    const Series<double> jerk = (turn * z[c] - z[3 + c]) * cube;
    result[c] = z[c] - tau * z[3 + c] + 0.5 * (tau * tau * force);
    result[3 + c] = z[3 + c] - tau * force + 0.5 * (tau * tau * jerk);
  }
  return result;
}

/// For each degree, the largest difference of a coefficient relative to the largest of `wanted`.
std::vector<double> relative_errors(const FlowJet<double>& jet, const FlowJet<double>& wanted) {
  const SeriesSpace& space = wanted[0].space();
  std::vector<double> result;
  for (int d = 0; d <= space.order(); ++d) {
    double difference = 0;
    double largest = 0;
    for (std::size_t i = 0; i < jet.size(); ++i) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        difference = std::max(difference, std::abs(jet[i][k] - wanted[i][k]));
        largest = std::max(largest, std::abs(wanted[i][k]));
      }
    }
    result.push_back(largest > 0 ? difference / largest : difference);
  }
  return result;
}

bool is_same(const FlowJet<double>& a, const FlowJet<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::ranges::equal(x.coefficients(), y.coefficients());
  });
}

/// Fewer than half of the orbits needed more than lanes provide, so that the test is not about
/// single orbits.
void expect_lanes(const Outcomes& outcomes) {
  const auto alone =
      std::ranges::count_if(outcomes, [](const ManyFlowsOutcome& o) { return o.was_alone; });
  EXPECT_LT(2 * alone, std::ssize(outcomes));
}

class GaussManyOfOrder : public testing::TestWithParam<int> {};

TEST_P(GaussManyOfOrder, CirclesBesideEccentricOrbitsCloseAfterTheirPeriod) {
  constexpr double tolerance = 1e-11;
  const auto problem = problem_of(kepler(1), GetParam(), 2 * std::numbers::pi);
  const States states = orbits_of_axis_one(19);
  const Outcomes outcomes = integrate_gauss_many(problem, states, test::adaptive(8, tolerance));
  expect_lanes(outcomes);
  for (std::size_t i = 0; i < states.size(); ++i) {
    SCOPED_TRACE("orbit " + std::to_string(i));
    ASSERT_FALSE(outcomes[i].failure);
    // The promise is for errors along two lines, which are sums over the variables: a single
    // coefficient may have twice the error.
    const double allowed = 2 * 3 * tolerance * std::max(1.0, outcomes[i].statistics.periods);
    for (const double error :
         relative_errors(outcomes[i].jet, after_a_period(states[i], problem.space))) {
      EXPECT_LE(error, allowed);
    }
  }
}

TEST_P(GaussManyOfOrder, JetsAreSymplecticToRounding) {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1e-3;
  field.J[3] = -2.5e-6;
  // With coarse steps the map is far from the flow, but still symplectic.
  const auto problem = problem_of(zonal_gravity(field), GetParam(), 20);
  const Outcomes outcomes =
      integrate_gauss_many(problem, orbits_of_axis_one(11), test::adaptive(6, 1e-5));
  expect_lanes(outcomes);
  for (std::size_t i = 0; i + 3 < outcomes.size(); ++i) {  // the last orbits pass within the Earth
    SCOPED_TRACE("orbit " + std::to_string(i));
    ASSERT_FALSE(outcomes[i].failure);
    for (const SymplecticityDefect& defect : symplecticity_by_degree(outcomes[i].jet)) {
      // The bound counts some thousand roundings, relative to the terms that cancel.
      EXPECT_LE(defect.scaled, 1e3 * std::numeric_limits<double>::epsilon());
    }
  }
}

TEST_P(GaussManyOfOrder, FixedStepsGiveTheNumericalMapOfOneOrbitAlone) {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1e-2;
  auto problem = problem_of(zonal_gravity(field), GetParam(), 6);
  const States states = orbits_of_axis_one(10);
  // The steps are so long that the method's error is far above rounding.
  const GaussSettings settings = test::fixed_step(4, 0.1);
  const Outcomes outcomes = integrate_gauss_many(problem, states, settings);
  for (std::size_t i = 0; i < 7; ++i) {
    SCOPED_TRACE("orbit " + std::to_string(i));
    problem.initial_state = states[i];
    IntegrationStatistics statistics;
    const auto single = integrate_gauss<double>(problem, settings, statistics);
    ASSERT_FALSE(outcomes[i].was_alone);
    EXPECT_EQ(outcomes[i].statistics.steps, statistics.steps);
    for (const double difference : relative_errors(outcomes[i].jet, single)) {
      // The bound counts 60 steps, each with the rounding of its sums, carried along a flow that
      // shears.
      EXPECT_LE(difference, 60 * 60 * std::numeric_limits<double>::epsilon());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, GaussManyOfOrder, testing::Values(1, 2));

TEST(GaussMany, NoDigitDependsOnTheOtherOrbits) {
  const auto problem = problem_of(kepler(1), 2, 5);
  States states = orbits_of_axis_one(21);
  const GaussSettings settings = test::adaptive(8, 1e-11);
  const Outcomes outcomes = integrate_gauss_many(problem, states, settings);
  std::reverse(states.begin(), states.end());
  ManyFlowsSettings threads;
  threads.threads = 2;
  const Outcomes reversed = integrate_gauss_many(problem, states, settings, threads);
  for (std::size_t i = 0; i < states.size(); ++i) {
    SCOPED_TRACE("orbit " + std::to_string(i));
    const Outcomes alone = integrate_gauss_many(problem, {states[states.size() - 1 - i]}, settings);
    EXPECT_TRUE(is_same(outcomes[i].jet, alone[0].jet));
    EXPECT_TRUE(is_same(outcomes[i].jet, reversed[states.size() - 1 - i].jet));
    EXPECT_EQ(outcomes[i].statistics.steps, alone[0].statistics.steps);
  }
}

TEST(GaussMany, AnOrbitThatFailsIsNamedAndSpoilsNone) {
  auto problem = problem_of(kepler(1), 1, 5);
  States states = orbits_of_axis_one(9);
  const GaussSettings settings = test::adaptive(8, 1e-10);
  const Outcomes sound = integrate_gauss_many(problem, states, settings);
  States with_others = states;
  with_others.insert(with_others.begin() + 3,
                     {1, 0, 0, 0, 0, 0});  // this orbit falls into the centre
  with_others.insert(with_others.begin() + 5,
                     {0, 0, 0, 0, 1, 0});  // this orbit starts in the centre
  with_others.push_back({1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0});
  Outcomes outcomes = integrate_gauss_many(problem, with_others, settings);
  for (const std::size_t i : {std::size_t{11}, std::size_t{5}, std::size_t{3}}) {
    ASSERT_TRUE(outcomes[i].failure) << i;
    EXPECT_TRUE(outcomes[i].jet.empty());
    problem.initial_state = with_others[i];
    IntegrationStatistics statistics;
    test::expect_error(ErrorKind::numerical, outcomes[i].failure->what(),
                       [&] { integrate_gauss<double>(problem, settings, statistics); });
    outcomes.erase(outcomes.begin() + static_cast<std::ptrdiff_t>(i));
  }
  for (std::size_t i = 0; i < sound.size(); ++i) {
    EXPECT_TRUE(is_same(outcomes[i].jet, sound[i].jet)) << i;
  }
}

TEST(GaussMany, SaysOfEachOrbitWhatOneAloneSays) {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[2] = 1e-3;
  auto problem = problem_of(zonal_gravity(field), 1, 15);
  const States states = orbits_of_axis_one(12);
  const GaussSettings settings = test::adaptive(8, 1e-10);
  const Outcomes outcomes = integrate_gauss_many(problem, states, settings);
  for (std::size_t i = 0; i < 8; ++i) {
    SCOPED_TRACE("orbit " + std::to_string(i));
    problem.initial_state = states[i];
    IntegrationStatistics single;
    const auto jet = integrate_gauss<double>(problem, settings, single);
    const IntegrationStatistics& many = outcomes[i].statistics;
    EXPECT_EQ(many.step_tolerance, single.step_tolerance);
    // Steps depend on rounding, by at most a few steps that are repeated in one run and not in the
    // other.
    EXPECT_NEAR(static_cast<double>(many.steps), static_cast<double>(single.steps),
                0.1 * static_cast<double>(single.steps) + 1);
    // The integral of a frequency over steps of another length.
    EXPECT_NEAR(many.periods, single.periods, 0.1 * single.periods);
    const auto& lines = std::get<std::vector<JetAlongLine<double>>>(many.finer_lines);
    const auto& of_single = std::get<std::vector<JetAlongLine<double>>>(single.finer_lines);
    ASSERT_EQ(lines.size(), of_single.size());
    for (std::size_t j = 0; j < lines.size(); ++j) {
      EXPECT_EQ(lines[j].direction, of_single[j].direction);
      for (const double difference : relative_errors(lines[j].jet, of_single[j].jet)) {
        EXPECT_LE(difference, 1e-12);  // both to a hundredth of the tolerance
      }
    }
    for (const double difference : relative_errors(outcomes[i].jet, jet)) {
      EXPECT_LE(difference, 2 * 3 * 1e-10 * single.periods);  // both errors are within the promise
    }
  }
}

TEST(GaussMany, SystemsOfFirstOrderAndOfOneDegreeOfFreedomGoInLanesToo) {
  // A rotor in a rotating frame has no second-order form. Its flow is linear, a combination of two
  // turns.
  const DynamicalSystem rotor =
      make_system("rotor", 2, [](std::span<const Expression> q, std::span<const Expression> p) {
        return (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) / 2.0 + q[0] * p[1] -
               q[1] * p[0];
      });
  ASSERT_FALSE(rotor.second_order);
  const auto flow = problem_of(rotor, 2, 3);
  const Outcomes turned =
      integrate_gauss_many(flow, {{1, 0, 0, 0.5}, {0.3, 2, -1, 0}}, test::adaptive(8, 1e-12));
  for (const ManyFlowsOutcome& outcome : turned) {
    ASSERT_FALSE(outcome.was_alone);
    // q_1 = cos t cos t (from q_1) and so on: the oscillation by t, and the turn by t.
    const double c = std::cos(3.0);
    const double s = std::sin(3.0);
    const auto at = [&](std::size_t i, std::size_t j) {
      return outcome.jet[i][flow.space->linear_index(j)];
    };
    EXPECT_NEAR(at(0, 0), c * c, 1e-11);
    EXPECT_NEAR(at(1, 0), s * c, 1e-11);
    EXPECT_NEAR(at(0, 2), c * s, 1e-11);
    EXPECT_NEAR(at(3, 0), -s * s, 1e-11);
  }

  // A pendulum of small energy and one near the separatrix: side by side and each alone.
  const DynamicalSystem pendulum =
      make_system("pendulum", 1, [](std::span<const Expression> q, std::span<const Expression> p) {
        return p[0] * p[0] / 2.0 - cos(q[0]);
      });
  auto problem = problem_of(pendulum, 2, 6);
  const States states = {{0.1, 0}, {0, 1.99}, {3, 0.5}};
  const Outcomes swung = integrate_gauss_many(problem, states, test::adaptive(8, 1e-11));
  for (std::size_t i = 0; i < states.size(); ++i) {
    problem.initial_state = states[i];
    IntegrationStatistics statistics;
    const auto single = integrate_gauss<double>(problem, test::adaptive(16, 1e-14), statistics);
    for (const double error : relative_errors(swung[i].jet, single)) {
      EXPECT_LE(error, 2 * 3 * 1e-11 * std::max(1.0, statistics.periods)) << i;
    }
  }
}

TEST(GaussMany, WhatLanesAreNotForIsDoneOneAtATime) {
  auto problem = problem_of(kepler(1), 3, 1);
  const States states = orbits_of_axis_one(3);
  const Outcomes outcomes = integrate_gauss_many(problem, states, test::adaptive(8, 1e-10));
  for (std::size_t i = 0; i < states.size(); ++i) {
    problem.initial_state = states[i];
    IntegrationStatistics statistics;
    EXPECT_TRUE(outcomes[i].was_alone);
    EXPECT_TRUE(is_same(outcomes[i].jet,
                        integrate_gauss<double>(problem, test::adaptive(8, 1e-10), statistics)));
  }
  EXPECT_TRUE(integrate_gauss_many(problem, {}, test::adaptive()).empty());
  test::expect_error(ErrorKind::usage, "initial state 1 has 5 numbers, must have 6", [&] {
    integrate_gauss_many(problem, {states[0], {1, 0, 0, 0, 1}}, test::adaptive());
  });
}

}  // namespace
}  // namespace hamjet
