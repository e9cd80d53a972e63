#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../src/studies/integration.hpp"
#include "dynamics/double_well.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "dynamics/oscillator_pair.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "support/flow.hpp"

// Steps beyond the limit of linear stability are refused, with the frequency times the step and its
// limit in the message.

namespace hamjet {
namespace {

IntegratorSettings fixed(IntegrationMethod method, double step) {
  IntegratorSettings settings;
  settings.method = method;
  settings.step_canonical = step;
  return settings;
}

/// The message of the refusal; empty if there is none.
template <class Real = double>
std::string refusal(const DynamicalSystem& system, const IntegratorSettings& settings,
                    double steps = 50) {
  const test::Flow<Real> flow{system,
                              std::vector<Real>(system.dimension(), Real(1)),
                              Real(steps * *settings.step_canonical),
                              1,
                              {}};
  IntegrationStatistics statistics;
  try {
    integrate<Real>(test::problem_of(flow), settings, statistics, {});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    return error.what();
  }
  return "";
}

void expect_limit(const IntegratorSettings& settings, double limit) {
  for (const double omega : {1e-6, 1.0, 1e6}) {
    const auto system = harmonic_oscillator(0.5, 0.5 * omega * omega);
    IntegratorSettings one = settings;
    one.step_canonical = (1 - 1e-6) * limit / omega;
    EXPECT_EQ(refusal(system, one), "") << omega;
    one.step_canonical = (1 + 1e-6) * limit / omega;
    EXPECT_NE(refusal(system, one).find("unstable"), std::string::npos) << omega;
    EXPECT_NE(refusal(system, one, -50).find("unstable"), std::string::npos) << omega;
  }
}

// Verlet and the symplectic Euler method are stable for omega tau < 2, Newmark's with gamma = 1/2
// for omega tau < 1/sqrt(1/4 - beta), without limit from beta = 1/4 on (Hairer, Lubich and Wanner,
// section I.5.2; Hughes, The Finite Element Method, section 9.1).
TEST(StabilityLimit, IsThatOfTheTextbooks) {
  expect_limit(fixed(IntegrationMethod::velocity_verlet, 1), 2);
  expect_limit(fixed(IntegrationMethod::stormer, 1), 2);
  for (const double beta : {0.0, 1.0 / 12, 1.0 / 6}) {
    IntegratorSettings settings = fixed(IntegrationMethod::newmark, 1);
    settings.beta = beta;
    expect_limit(settings, 1 / std::sqrt(0.25 - beta));
  }
  IntegratorSettings settings = fixed(IntegrationMethod::newmark, 1e4);
  settings.beta = 0.25;
  EXPECT_EQ(refusal(harmonic_oscillator(), settings), "");
}

// A composition is stable where the product of its Verlet matrices has a trace below 2.
TEST(StabilityLimit, OfACompositionIsWhereTheTraceOfItsStepReachesTwo) {
  for (const int order : {4, 6, 8}) {
    std::vector<double> substeps;
    for (const Extended& gamma : composition_substeps(order)) {
      substeps.push_back(static_cast<double>(gamma));
    }
    const auto trace = [&substeps](double y) {
      double a = 1, b = 0, c = 0, d = 1;
      for (const double gamma : substeps) {
        const double h = y * gamma;
        const double m = 1 - h * h / 2, lower = -h * (1 - h * h / 4);
        const double rows[] = {m * a + h * c, m * b + h * d, lower * a + m * c, lower * b + m * d};
        a = rows[0], b = rows[1], c = rows[2], d = rows[3];
      }
      return a + d;
    };
    double limit = 0.1;
    while (std::abs(trace(limit)) <= 2 + 1e-9) limit += 1e-4;
    IntegratorSettings settings = fixed(IntegrationMethod::velocity_verlet, limit - 0.01);
    settings.order = order;
    EXPECT_EQ(refusal(harmonic_oscillator(), settings), "") << order << " " << limit;
    double beyond = limit;  // where the trace is largest in this range of unstable steps
    while (std::abs(trace(beyond + 1e-4)) > std::abs(trace(beyond)) && beyond < 2 * limit) {
      beyond += 1e-4;
    }
    EXPECT_GT(std::abs(trace(beyond)), 2 + 1e-9) << order << " " << limit;
    settings.step_canonical = beyond;
    EXPECT_NE(refusal(harmonic_oscillator(), settings).find("unstable"), std::string::npos);
    settings.step_canonical = 10;
    const std::string text = refusal(harmonic_oscillator(), settings);
    const auto place = text.find("exceeds ");
    ASSERT_NE(place, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(place + 8)), limit, 0.05) << text;
  }
}

TEST(StabilityLimit, MessageNamesTheLimit) {
  const std::string text =
      refusal(harmonic_oscillator(2, 8), fixed(IntegrationMethod::velocity_verlet, 1.05));
  EXPECT_EQ(
      text.find("velocity-verlet: unstable: omega tau = 2.1 exceeds 2; a step of 1 is stable"), 0U)
      << text;
  // The larger root of x^2 - (2 - 2.1^2) x + 1 in magnitude.
  EXPECT_NE(text.find("grow 1.877 times a step"), std::string::npos) << text;
}

// The fastest oscillator decides.
TEST(StabilityLimit, OfAPairIsThatOfTheFasterOscillator) {
  const auto pair = oscillator_pair(1, 1, 1e12);
  EXPECT_EQ(refusal(pair, fixed(IntegrationMethod::velocity_verlet, 1.99e-6)), "");
  const std::string text = refusal(pair, fixed(IntegrationMethod::velocity_verlet, 2.1e-6));
  EXPECT_NE(text.find("omega tau = 2.1 exceeds 2"), std::string::npos) << text;
}

// Fehlberg's method keeps no amplitude, so that growth is what counts: 1e-8 a step is its error.
TEST(StabilityLimit, OfFehlbergIsWhereItsErrorGrows) {
  EXPECT_EQ(refusal(harmonic_oscillator(), fixed(IntegrationMethod::fehlberg78, 0.5)), "");
  const std::string text = refusal(harmonic_oscillator(), fixed(IntegrationMethod::fehlberg78, 8));
  EXPECT_NE(text.find("fehlberg78: unstable: omega tau = 8 exceeds "), std::string::npos) << text;
}

TEST(StabilityLimit, HoldsInExtendedPrecision) {
  const auto settings = fixed(IntegrationMethod::velocity_verlet, 2.1);
  EXPECT_NE(refusal<Extended>(harmonic_oscillator(), settings).find("unstable"), std::string::npos);
}

// Gauss methods have no limit; a nonlinear system has no single one; nothing is run for duration 0.
TEST(StabilityLimit, IsLookedForOnlyWhereThereIsOne) {
  EXPECT_EQ(refusal(harmonic_oscillator(), fixed(IntegrationMethod::gauss, 1e3)), "");
  EXPECT_EQ(refusal(harmonic_oscillator(), fixed(IntegrationMethod::velocity_verlet, 3), 0), "");
  EXPECT_EQ(
      refusal(double_well(), fixed(IntegrationMethod::velocity_verlet, 3), 2).find("unstable"),
      std::string::npos);
}

}  // namespace
}  // namespace hamjet
