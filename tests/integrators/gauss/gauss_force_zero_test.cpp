#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "integrators/small_systems.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"

// Few stages on motions whose force passes through zero, also at the start: there a relative
// measure of the error has no scale. The oscillator has a closed form, the pendulum a reference of
// 16 stages in extended precision.

namespace hamjet {
namespace {

constexpr double run_time = 10;  // 1.6 revolutions of the oscillator

/// From the lowest point, where the force is zero, with the momentum 1 or at rest.
template <class Real>
test::Flow<Real> from_zero(const DynamicalSystem& system, int momentum = 1) {
  return {system, {Real(0), Real(momentum)}, Real(run_time), 3, {}};
}

const FlowJet<Extended>& pendulum_reference() {
  static const FlowJet<Extended> jet =
      test::run_gauss(from_zero<Extended>(test::pendulum()), test::adaptive(16, 1e-26));
  return jet;
}

/// The flow of the oscillator is the rotation by the time; so is that of a Gauss method, by the sum
/// of these angles (Hairer, Lubich and Wanner, section II.1; they are h - h^3/12 + ... and
/// h - h^5/720 + ...).
double angle_of_step(int stages, double h) {
  return stages == 1 ? 2 * std::atan(h / 2) : 2 * std::atan2(h / 2, 1 - h * h / 12);
}

/// The largest error of the degrees 0 and 1 against a rotation by `angle`.
double error_of_rotation(const FlowJet<double>& jet, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double expected[2][3] = {{s, c, s}, {c, -s, c}};
  double error = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      error = test::larger(error, std::abs(jet[i][k] - expected[i][k]));
    }
  }
  return error;
}

/// The error is within about a factor of ten of the tolerance times the revolutions;
/// tests/README.md states the promise. If it were far below, the steps would be shorter than
/// requested.
void expect_near_tolerance(double error, double tolerance) {
  EXPECT_LE(error, 10 * tolerance * run_time / 6.28);
  EXPECT_GE(error, 1e-3 * tolerance);
}

/// Steps go as the 2s-th root of the tolerance. If a zero of the force counted as a singularity,
/// there would be as many short or repeated steps.
void expect_even_steps(const std::vector<IntegrationStatistics>& runs, int stages) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_LE(runs[i].rejected_steps, 10);
    if (i == 0) continue;
    const double growth =
        static_cast<double>(runs[i].steps) / static_cast<double>(runs[i - 1].steps);
    EXPECT_NEAR(growth, std::pow(100, 0.5 / stages), 0.1 * growth);
  }
}

std::vector<double> tolerances(int stages) {
  // One stage takes half a million steps for 1e-8.
  return stages == 1 ? std::vector{1e-2, 1e-4, 1e-6} : std::vector{1e-2, 1e-4, 1e-6, 1e-8};
}

TEST(GaussForceZero, AdaptiveStepsOfTheOscillatorKeepTheTolerance) {
  for (const int stages : {1, 2}) {
    std::vector<IntegrationStatistics> runs;
    for (const double tolerance : tolerances(stages)) {
      SCOPED_TRACE(::testing::Message() << stages << " stages, tolerance " << tolerance);
      const auto flow = from_zero<double>(harmonic_oscillator());
      double angle = 0;
      double last = 0;
      IntegrationStatistics& statistics = runs.emplace_back();
      const auto jet =
          integrate_gauss<double>(test::problem_of(flow), test::adaptive(stages, tolerance),
                                  statistics, [&](const double& time, const FlowJet<double>&) {
                                    angle += angle_of_step(stages, time - last);
                                    last = time;
                                  });
      expect_near_tolerance(error_of_rotation(jet, run_time), tolerance);
      // The steps that were taken, to round-off.
      EXPECT_LE(error_of_rotation(jet, angle),
                0x1p-52 * (10 + 2 * static_cast<double>(statistics.steps)));
    }
    expect_even_steps(runs, stages);
  }
}

TEST(GaussForceZero, AdaptiveStepsOfThePendulumKeepTheTolerance) {
  for (const int stages : {1, 2}) {
    std::vector<IntegrationStatistics> runs;
    for (const double tolerance : tolerances(stages)) {
      SCOPED_TRACE(::testing::Message() << stages << " stages, tolerance " << tolerance);
      const auto jet = test::run_gauss(from_zero<double>(test::pendulum()),
                                       test::adaptive(stages, tolerance), &runs.emplace_back());
      for (int degree = 0; degree <= 3; ++degree) {
        SCOPED_TRACE(degree);
        expect_near_tolerance(test::relative_error(jet, pendulum_reference(), degree), tolerance);
      }
    }
    expect_even_steps(runs, stages);
  }
}

TEST(GaussForceZero, FixedStepsOfTheOscillatorHaveTheirOrder) {
  for (const int stages : {1, 2}) {
    for (const int momentum : {0, 1}) {
      double before = 0;
      for (const int count : {50, 100, 200, 400}) {
        SCOPED_TRACE(::testing::Message() << stages << " stages, " << count << " steps");
        const double h = run_time / count;
        const auto jet = test::run_gauss(from_zero<double>(harmonic_oscillator(), momentum),
                                         test::fixed_step(stages, h));
        if (momentum == 0) {
          for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(jet[i][0], 0);
        }
        // The state transition matrix; for the momentum 1 its second column is the state too.
        const double error =
            std::hypot(jet[0][1] - std::cos(run_time), jet[0][2] - std::sin(run_time));
        // The chord of the angle by which the method lags.
        const double lag = run_time - count * angle_of_step(stages, h);
        EXPECT_NEAR(error, 2 * std::sin(lag / 2), 1e-13);
        if (before > 0) {
          EXPECT_NEAR(std::log2(before / error), 2 * stages, 0.02);
        }
        before = error;
      }
    }
  }
}

TEST(GaussForceZero, FixedStepsOfThePendulumHaveTheirOrder) {
  for (const int stages : {1, 2}) {
    double before[4] = {};
    for (const int count : {50, 100, 200, 400}) {
      const auto jet = test::run_gauss(from_zero<double>(test::pendulum()),
                                       test::fixed_step(stages, run_time / count));
      for (int degree = 0; degree <= 3; ++degree) {
        const double error = test::relative_error(jet, pendulum_reference(), degree);
        if (before[degree] > 0) {
          EXPECT_NEAR(std::log2(before[degree] / error), 2 * stages, 0.05)
              << stages << " stages, " << count << " steps, degree " << degree;
        }
        before[degree] = error;
      }
    }
  }
}

/// A nominal at rest in an equilibrium has no slopes: the steps must suit the matrix.
TEST(GaussForceZero, AdaptiveStepsAboutAnEquilibriumKeepTheTolerance) {
  for (const int stages : {1, 2, 8}) {
    const auto jet =
        test::run_gauss(from_zero<double>(harmonic_oscillator(), 0), test::adaptive(stages, 1e-6));
    EXPECT_NEAR(jet[0][1], std::cos(run_time), 1.6e-5) << stages << " stages";
    EXPECT_NEAR(jet[0][2], std::sin(run_time), 1.6e-5) << stages << " stages";
  }
}

}  // namespace
}  // namespace hamjet
