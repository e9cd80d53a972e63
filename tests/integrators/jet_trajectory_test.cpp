#include "hamjet/integrators/jet_trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "support/flow.hpp"

// Jets at times between the steps. The expected values come from Runge-Kutta-Fehlberg 7(8) from
// time to time, which shares neither the method nor the steps nor the interpolation between the
// steps.

namespace hamjet {
namespace {

/// From 10 degrees behind the perigee of an orbit of this eccentricity, in the Earth's field to
/// degree 6; momenta are canonical.
FlowProblem<double> eccentric_orbit(double eccentricity, double revolutions, int order) {
  constexpr double mu = 398600.4415;
  const double axis = 7000 / (1 - eccentricity);
  const CartesianState state = state_from_elements({axis, eccentricity, 63, 20, 40, 10}, mu);
  double square = 0;
  for (const Extended& x : state.position_km) square += std::pow(static_cast<double>(x), 2);
  const double length = std::sqrt(square), speed = std::sqrt(mu / length);
  test::Flow<double> flow{
      zonal_gravity(
          {1,
           6378.1363 / length,
           {{2, 1.0826e-3}, {3, -2.533e-6}, {4, -1.620e-6}, {5, -2.273e-7}, {6, 5.407e-7}}}),
      {},
      2 * std::numbers::pi * revolutions * std::pow(axis / length, 1.5),
      order,
      {}};
  for (const Extended& x : state.position_km) {
    flow.start.push_back(static_cast<double>(x) / length);
  }
  for (const Extended& v : state.velocity_km_s) {
    flow.start.push_back(static_cast<double>(v) / speed);
  }
  return test::problem_of(flow);
}

/// Times within the duration, moving away from 0.
std::vector<double> random_times(double duration, std::size_t count) {
  std::mt19937_64 generator(18);
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i) times.push_back(duration * fraction(generator));
  std::sort(times.begin(), times.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  return times;
}

/// The problem that continues from a jet.
FlowProblem<double> going_on(FlowProblem<double> problem, FlowJet<double> jet, double duration) {
  problem.initial_state = test::final_state(jet);
  problem.initial_jet = std::move(jet);
  problem.duration = duration;
  return problem;
}

double largest_of_degree(const FlowJet<double>& jet, int degree) {
  double largest = 0;
  const SeriesSpace& space = jet[0].space();
  for (const Series<double>& component : jet) {
    for (std::size_t k = space.first(degree); k < space.first(degree + 1); ++k) {
      largest = std::max(largest, std::abs(component[k]));
    }
  }
  return largest;
}

/// The largest error of each degree over 1000 times, relative to the larger of its largest
/// coefficients at the time and at the end.
std::vector<double> largest_errors(const JetTrajectory<double>& trajectory,
                                   const FlowProblem<double>& problem) {
  const int order = problem.space->order();
  std::vector<double> errors(static_cast<std::size_t>(order) + 1, 0);
  FlowJet<double> expected = starting_jet(problem);
  double reached = 0;
  for (const double time : random_times(problem.duration, 1000)) {
    IntegrationStatistics statistics;
    // The tolerance is 1000 times finer than that of the trajectories; finer steps would only add
    // rounding.
    expected = integrate_fehlberg78<double>(going_on(problem, std::move(expected), time - reached),
                                            {.tolerance = 1e-13}, statistics);
    reached = time;
    const FlowJet<double> jet = trajectory.at(time);
    for (int d = 0; d <= order; ++d) {
      const double then = largest_of_degree(expected, d);
      const double scale = std::max(then, largest_of_degree(trajectory.final_jet(), d));
      double& error = errors[static_cast<std::size_t>(d)];
      error = test::larger(error, test::relative_error(jet, expected, d) * then / scale);
    }
  }
  return errors;
}

TEST(JetTrajectory, IsRightToTheToleranceAtAnyTime) {
  constexpr double tolerance = 1e-10;
  for (const double revolutions : {1.5, -1.5}) {
    for (const int stages : {4, 8}) {
      const auto problem = eccentric_orbit(0.6, revolutions, 3);
      const JetTrajectory<double> trajectory(problem, test::adaptive(stages, tolerance));
      const std::vector<double> errors = largest_errors(trajectory, problem);
      // The tolerance is one for each period of the linearised motion.
      const double allowed = 10 * tolerance * trajectory.statistics().periods;
      for (std::size_t d = 0; d < errors.size(); ++d) {
        EXPECT_LE(errors[d], allowed)
            << stages << " stages, " << revolutions << " revolutions, degree " << d;
      }
      // Random times are not ends of steps, so that the test covers the places between them.
      EXPECT_LT(trajectory.step_times().size(), 500U);
    }
  }
}

TEST(JetTrajectory, HasTheEndsOfTheStepsAsTheyWere) {
  const auto problem = eccentric_orbit(0.3, 1, 2);
  std::vector<FlowJet<double>> jets = {starting_jet(problem)};
  const JetTrajectory<double> trajectory(
      problem, test::adaptive(8, 1e-12), 256e6,
      [&](const double&, const FlowJet<double>& jet) { jets.push_back(jet); });
  const auto& times = trajectory.step_times();
  ASSERT_EQ(times.size(), jets.size());
  EXPECT_EQ(trajectory.kept_jets(), jets.size());
  EXPECT_EQ(times.back(), problem.duration);
  IntegrationStatistics statistics;
  const auto alone = integrate_gauss<double>(problem, test::adaptive(8, 1e-12), statistics);
  EXPECT_EQ(statistics.steps, trajectory.statistics().steps);
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t k = 0; k < alone[c].size(); ++k) {
      EXPECT_EQ(trajectory.final_jet()[c][k], alone[c][k]);
      for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(trajectory.at(times[i])[c][k], jets[i][c][k]);
      }
    }
  }
}

TEST(JetTrajectory, RepeatsTheStepsThatMemoryDidNotKeep) {
  const auto problem = eccentric_orbit(0.3, 3, 2);
  const auto settings = test::adaptive(4, 1e-10);
  const JetTrajectory<double> all(problem, settings);
  const double bytes_of_jet = 6.0 * static_cast<double>(problem.space->size()) * sizeof(double);
  const JetTrajectory<double> few(problem, settings, 5 * bytes_of_jet);
  ASSERT_GT(all.kept_jets(), 50U);
  EXPECT_LE(few.kept_jets(), 5U);
  EXPECT_GE(few.kept_jets(), 3U);
  for (const double time : random_times(problem.duration, 50)) {
    const auto expected = all.at(time), jet = few.at(time);
    // The steps are the same, but each of some hundred steps rounds differently, and the linear
    // flow carries early rounding to the time. A flow of degree d also shears it by the d-th power
    // of the revolutions.
    const double carried = std::max(1.0, largest_of_degree(expected, 1));
    for (int d = 0; d <= 2; ++d) {
      const double floor = 100 * std::numeric_limits<double>::epsilon() * carried * std::pow(10, d);
      EXPECT_LE(test::relative_error(jet, expected, d), floor) << time << ", degree " << d;
    }
  }
}

TEST(JetTrajectory, RefusesOtherTimes) {
  for (const double revolutions : {0.5, -0.5}) {
    const auto problem = eccentric_orbit(0.1, revolutions, 1);
    const JetTrajectory<double> trajectory(problem, test::adaptive(8, 1e-10));
    const double duration = problem.duration;
    for (const double time :
         {-1e-9 * duration, std::nextafter(duration, 2 * duration),
          std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      try {
        (void)trajectory.at(time);
        ADD_FAILURE() << time;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_NE(std::string(error.what()).find("must be between 0 and"), std::string::npos);
      }
    }
  }
}

TEST(JetTrajectory, OfNoDurationIsTheStart) {
  const auto problem = eccentric_orbit(0.1, 0, 2);
  const JetTrajectory<double> trajectory(problem, test::adaptive(8, 1e-10));
  const auto jet = trajectory.at(0), start = starting_jet(problem);
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t k = 0; k < jet[c].size(); ++k) EXPECT_EQ(jet[c][k], start[c][k]);
  }
  EXPECT_THROW((void)trajectory.at(1e-3), Error);
}

}  // namespace
}  // namespace hamjet
