#include "hamjet/integrators/error_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

// Estimates are compared with errors that the test adds to a jet, or that extended precision shows.

namespace hamjet::test {
namespace {

struct Orbit {
  DynamicalSystem system = kepler();
  FlowProblem<double> problem{system,
                              SeriesSpace::create(6, 3),
                              {0, 1, 2, 3, 4, 5},
                              {1, 0, 0, 0, 0.9, 0.7},
                              ClockTime::epoch(),
                              7};

  FlowJet<double> jet(double tolerance = 1e-13) const {
    GaussSettings settings;
    settings.tolerance = tolerance;
    IntegrationStatistics statistics;
    return integrate_gauss<double>(problem, settings, statistics);
  }
};

TEST(ErrorEstimate, IsSmallForAGoodJet) {
  const Orbit orbit;
  const auto estimate = estimate_error<double>(orbit.problem, orbit.jet());
  ASSERT_EQ(estimate.size(), 4U);
  for (const double error : estimate) {
    EXPECT_GT(error, 1e-16);  // the estimate is never below the rounding of the numbers
    EXPECT_LT(error, 1e-10);
  }
}

TEST(ErrorEstimate, SeesOneWrongCoefficientOfAnyMonomial) {
  const Orbit orbit;
  const FlowJet<double> good = orbit.jet();
  const SeriesSpace& space = *orbit.problem.space;
  for (std::size_t k = 0; k < space.size(); ++k) {
    const int degree = space.degree(k);
    FlowJet<double> wrong = good;
    wrong[k % 6][k] += 1e-6 * largest_of_degree(good, degree);
    const auto estimate = estimate_error<double>(orbit.problem, wrong);
    const double seen = estimate[static_cast<std::size_t>(degree)];
    EXPECT_GT(seen, 1e-7) << k;
    EXPECT_LT(seen, 1e-4) << k;
    for (int d = 0; d <= 3; ++d) {
      if (d == degree) continue;
      EXPECT_LT(estimate[static_cast<std::size_t>(d)], 1e-10) << k << ", " << d;
    }
  }
}

/// A jet and the lines for which its tolerance was chosen.
struct KnownLines {
  FlowJet<double> jet;
  std::vector<JetAlongLine<double>> lines;

  explicit KnownLines(const Orbit& orbit) {
    GaussSettings settings;
    settings.tolerance = 1e-13;
    IntegrationStatistics statistics;
    jet = integrate_gauss<double>(orbit.problem, settings, statistics);
    lines = std::get<std::vector<JetAlongLine<double>>>(statistics.finer_lines);
  }
};

TEST(ErrorEstimate, TakesKnownLinesInThePlaceOfTheSecondRun) {
  const Orbit orbit;
  const KnownLines known(orbit);
  ASSERT_EQ(known.lines.size(), 2U);
  double done = 0;
  ErrorEstimateSettings settings;
  settings.progress = [&](double fraction) { done = fraction; };
  const auto with = estimate_error<double>(orbit.problem, known.jet, settings, known.lines);
  EXPECT_EQ(done, 0.5);
  const auto without = estimate_error<double>(orbit.problem, known.jet, settings);
  EXPECT_EQ(done, 1);
  for (std::size_t d = 0; d < with.size(); ++d) {
    EXPECT_GT(with[d], 0.1 * without[d]) << d;
    EXPECT_LT(with[d], 10 * without[d]) << d;
  }
}

TEST(ErrorEstimate, MakesTheSecondRunWhereKnownLinesDisagree) {
  const Orbit orbit;
  const KnownLines known(orbit);
  const auto without = estimate_error<double>(orbit.problem, known.jet);
  auto wrong = known.lines;
  wrong[1].jet[0][3] *= 1 + 1e-6;
  EXPECT_EQ(estimate_error<double>(orbit.problem, known.jet, {}, wrong), without);
}

TEST(ErrorEstimate, SeesOneWrongCoefficientBesideKnownLines) {
  const Orbit orbit;
  const KnownLines known(orbit);
  const SeriesSpace& space = *orbit.problem.space;
  for (std::size_t k = 0; k < space.size(); ++k) {
    const int degree = space.degree(k);
    FlowJet<double> wrong = known.jet;
    wrong[k % 6][k] += 1e-6 * largest_of_degree(known.jet, degree);
    const double seen = estimate_error<double>(orbit.problem, wrong, {},
                                               known.lines)[static_cast<std::size_t>(degree)];
    EXPECT_GT(seen, 1e-7) << k;
    EXPECT_LT(seen, 1e-4) << k;
  }
}

TEST(ErrorEstimate, OfAJetThatIsWrongByManyPowersOfTenSaysSo) {
  const Orbit orbit;
  FlowJet<double> wrong = orbit.jet();
  wrong[0][50] = 1e19;
  EXPECT_GT(estimate_error<double>(orbit.problem, wrong)[3], 1e15);
}

TEST(ErrorEstimate, HoldsForOtherMethodsSubsetsAndBackwards) {
  Orbit orbit;
  orbit.problem.duration = -2;
  orbit.problem.space = SeriesSpace::create(2, 3);
  orbit.problem.variables = {1, 3};
  IntegrationStatistics statistics;
  const auto verlet = integrate_velocity_verlet<double>(orbit.problem, {0.01}, statistics);
  const FlowJet<double> exact = orbit.jet(1e-15);
  const auto estimate = estimate_error<double>(orbit.problem, verlet);
  for (int d = 0; d <= 3; ++d) {
    double error = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = orbit.problem.space->first(d); k < orbit.problem.space->first(d + 1);
           ++k) {
        error = larger(error, std::abs(verlet[i][k] - exact[i][k]));
      }
    }
    error /= largest_of_degree(exact, d);
    EXPECT_LT(error, 10 * estimate[static_cast<std::size_t>(d)]) << d;
    EXPECT_GT(error, 0.01 * estimate[static_cast<std::size_t>(d)]) << d;
  }
}

TEST(ErrorEstimate, IsZeroWhereTheJetIsExact) {
  Orbit orbit;
  orbit.problem.duration = 0;
  for (const double error : estimate_error<double>(orbit.problem, orbit.jet())) {
    EXPECT_EQ(error, 0);
  }
  // The slices of a linear system vanish above degree 1.
  const DynamicalSystem oscillator = harmonic_oscillator();
  const FlowProblem<double> linear{oscillator, SeriesSpace::create(2, 3), {0, 1},
                                   {1, 0},     ClockTime::epoch(),        5};
  GaussSettings settings;
  settings.tolerance = 1e-12;
  IntegrationStatistics statistics;
  const auto jet = integrate_gauss<double>(linear, settings, statistics);
  const auto estimate = estimate_error<double>(linear, jet);
  EXPECT_GT(estimate[1], 0);
  EXPECT_EQ(estimate[2], 0);
  EXPECT_EQ(estimate[3], 0);
}

// One step of a map x -> x + 1e3 (x - start) shows what is done to the start: the sample is at most
// the map's own factor times half a unit in the last place of the largest number of its kind, and
// the mean over eight directions is above half of that in one of four draws at the least.
TEST(RoundingSample, IsWhatTheMapMakesOfHalfAUnit) {
  const Orbit orbit;
  const FlowJet<double> jet = orbit.jet();
  const double half_unit = 0x1p-53;
  int runs = 0;
  const auto amplify = [&](const FlowProblem<double>& line) {
    ++runs;
    FlowJet<double> end = *line.initial_jet;
    for (std::size_t i = 0; i < 6; ++i) {
      end[i][0] += 1e3 * (end[i][0] - orbit.problem.initial_state[i]);
      EXPECT_EQ(line.initial_state[i], (*line.initial_jet)[i][0]);
    }
    return end;
  };
  const std::vector<double> sample = sample_rounding<double>(orbit.problem, jet, amplify);
  EXPECT_EQ(runs, 8 * 5);
  ASSERT_EQ(sample.size(), 4U);
  // The largest number of the start is 1, which moves by a unit of 2^-52 upwards or 2^-53
  // downwards, or not at all; numbers that are 0 move by any fraction of the unit.
  const double scale = largest_of_degree(jet, 0);
  EXPECT_GE(sample[0] * scale, 1e3 * 0.5 * half_unit);
  EXPECT_LE(sample[0] * scale, 1001 * 2 * half_unit);
  EXPECT_GT(sample[1], 0);
  EXPECT_EQ(sample[2], 0);  // the start has no terms of this degree, and the map makes none
}

// Ten times the sample is above the rounding error of the jet, which extended precision shows.
TEST(RoundingSample, IsOfTheSizeOfRounding) {
  const DynamicalSystem system = kepler();
  const FlowProblem<double> problem{system,
                                    SeriesSpace::create(6, 2),
                                    {0, 1, 2, 3, 4, 5},
                                    {0.1, 0, 0, 0, 3, 3.14},
                                    ClockTime::epoch(),
                                    20};
  GaussSettings settings;
  settings.tolerance = 1e-12;
  settings.controls_all_degrees = true;
  IntegrationStatistics statistics;
  const FlowJet<double> jet = integrate_gauss<double>(problem, settings, statistics);
  const auto sample = sample_rounding<double>(problem, jet, [&](const auto& line) {
    IntegrationStatistics of_line;
    return integrate_gauss<double>(line, settings, of_line);
  });
  FlowProblem<Extended> exact{
      problem.system, problem.space, problem.variables, {}, problem.start_time, 20};
  for (const double x : problem.initial_state) exact.initial_state.emplace_back(x);
  GaussSettings fine = settings;
  fine.stages = 12;
  fine.tolerance = 1e-18;
  const FlowJet<Extended> wanted = integrate_gauss<Extended>(exact, fine, statistics);
  for (int d = 0; d <= 2; ++d) {
    double error = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = problem.space->first(d); k < problem.space->first(d + 1); ++k) {
        error = std::max(error, std::abs(static_cast<double>(Extended(jet[i][k] - wanted[i][k]))));
      }
    }
    error /= largest_of_degree(jet, d);
    const double sampled = sample[static_cast<std::size_t>(d)];
    EXPECT_LE(error, 10 * sampled) << d;
    EXPECT_GE(error, sampled / 1000) << d;  // the sample is not a bound of another size
  }
}

TEST(ErrorEstimate, ErrorsAreNamed) {
  const Orbit orbit;
  ErrorEstimateSettings settings;
  settings.most_steps = 3;
  expect_error(ErrorKind::too_large, "more than 3 steps",
               [&] { estimate_error<double>(orbit.problem, orbit.jet(), settings); });
  FlowJet<double> other = orbit.jet();
  other.pop_back();
  expect_error(ErrorKind::usage, "another number of components",
               [&] { estimate_error<double>(orbit.problem, other); });
  KnownLines known(orbit);
  known.lines[0].direction.pop_back();
  expect_error(ErrorKind::usage, "a known line is of another problem",
               [&] { estimate_error<double>(orbit.problem, known.jet, {}, known.lines); });
}

}  // namespace
}  // namespace hamjet::test
