#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "../../src/studies/integration.hpp"
#include "integrator_cases.hpp"
#include "studies/descriptions/method_description.hpp"
#include "support/convergence.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

// CVODE's multistep formulas and the explicit Runge-Kutta pair with controlled steps: no two-form
// of theirs is preserved, no order is fixed, no step is retraced. Two-form, energy and way back are
// errors like any other, which follow the tolerance. Gauss with controlled steps stands beside
// them: each of its steps is symplectic whatever its size, so that its two-form does not.

namespace hamjet {
namespace {

struct AdaptiveMethod {
  std::string name;
  IntegrationMethod method;
};

void PrintTo(const AdaptiveMethod& method, std::ostream* out) { *out << method.name; }

constexpr double tolerances[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};

/// What the symplectic and the symmetric integrators keep to (integrator_properties_test).
constexpr double round_off = 1e-13;

struct Integration {
  FlowJet<double> jet;
  long steps = 0;
  double energy_error = 0;   ///< the largest along the nominal
  double largest_state = 0;  ///< the largest |z_i| along the nominal
  double largest_slope = 0;  ///< the largest sum of |dH/dz_i| along the nominal
};

/// A jet of order 2 over one period, or back from where it led to.
Integration run(IntegrationMethod method, const test::IntegratorCase& one, double tolerance,
                const std::vector<double>& start, double duration) {
  const test::Flow<double> flow{one.system, start, duration, 2, {}};
  IntegratorSettings settings;
  settings.method = method;
  settings.stages = 4;
  settings.tolerance = tolerance;
  IntegrationStatistics statistics;
  Integration result;
  const double initial = test::energy(one.system, start);
  result.jet = integrate<double>(
      test::problem_of(flow), settings, statistics, [&](const double&, const FlowJet<double>& jet) {
        const auto z = test::final_state(jet);
        double slope = 0;  // z' = J grad H
        for (const double rate : test::evaluate_list(one.system.vector_field, z)) {
          slope += std::abs(rate);
        }
        for (const double x : z) result.largest_state = std::max(result.largest_state, std::abs(x));
        result.largest_slope = std::max(result.largest_slope, slope);
        result.energy_error =
            test::larger(result.energy_error, std::abs(test::energy(one.system, z) - initial));
      });
  result.steps = statistics.steps;
  return result;
}

class IntegratorTolerance
    : public ::testing::TestWithParam<std::tuple<AdaptiveMethod, test::IntegratorCase>> {
 protected:
  void SetUp() override {
    if (!description_of(method()).is_built()) GTEST_SKIP() << "this build has no CVODE";
  }
  IntegrationMethod method() const { return std::get<0>(GetParam()).method; }
  const test::IntegratorCase& problem() const { return std::get<1>(GetParam()); }

  Integration there(double tolerance) const {
    return run(method(), problem(), tolerance, problem().start, problem().period);
  }

  /// Expects an error that follows the tolerance. A formula of order p whose error in a step is
  /// kept at the tolerance has a step of tolerance^(1/(p+1)) and an error of tolerance^(p/(p+1))
  /// over the duration, which from p = 1 on is an exponent of 1/2 at least. Single errors scatter
  /// about this (a multistep formula changes its order), the fit and the whole range do not. What
  /// is at round-off is left out; at the loosest tolerance the error is far above it.
  static void expect_to_follow(const std::vector<double>& errors) {
    std::vector<double> abscissae;
    std::vector<double> ordinates;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (errors[k] < round_off) continue;
      abscissae.push_back(tolerances[k]);
      ordinates.push_back(errors[k]);
    }
    ASSERT_GE(ordinates.size(), 5U);
    const double exponent = test::fitted_order(abscissae, ordinates);
    RecordProperty("exponent", fmt::format("{:.2f}, from {:.2g} to {:.2g}", exponent,
                                           errors.front(), errors.back()));
    EXPECT_GE(exponent, 0.5);
    EXPECT_LE(errors.back(), errors.front() * std::sqrt(1e-12 / 1e-4));
    EXPECT_GE(errors.front(), 1e4 * round_off);
  }
};

// Expected: the brackets of the jet's components fail by an error that follows the tolerance.
TEST_P(IntegratorTolerance, TwoForm) {
  std::vector<double> errors;
  for (const double tolerance : tolerances) {
    errors.push_back(test::worst_symplecticity(there(tolerance).jet));
  }
  expect_to_follow(errors);
}

// Expected: the error of the energy falls with the tolerance too. The energy is constant along the
// flow, so that the errors of the steps add up and are not carried on: n steps, in each of them a
// root mean square of at most the tolerance (1 + |z|) over N coefficients and so sqrt(N) times as
// much in one (the pair: in every one), times the sum of |dH/dz|.
TEST_P(IntegratorTolerance, Energy) {
  std::vector<double> errors;
  for (const double tolerance : tolerances) {
    const Integration one = there(tolerance);
    const auto coefficients = static_cast<double>(one.jet.size() * one.jet.front().space().size());
    EXPECT_LE(one.energy_error, static_cast<double>(one.steps) * tolerance *
                                    std::sqrt(coefficients) * (1 + one.largest_state) *
                                    one.largest_slope)
        << tolerance;
    errors.push_back(one.energy_error);
  }
  expect_to_follow(errors);
}

// Expected: the distance from the start after the way there and back falls with the tolerance too.
// If the steps were retraced, it would be at round-off.
TEST_P(IntegratorTolerance, TimeReversibility) {
  std::vector<double> errors;
  for (const double tolerance : tolerances) {
    const auto end = test::final_state(there(tolerance).jet);
    const auto home =
        test::final_state(run(method(), problem(), tolerance, end, -problem().period).jet);
    double distance = 0;
    for (std::size_t i = 0; i < home.size(); ++i) {
      distance = test::larger(distance, std::abs(home[i] - problem().start[i]));
    }
    errors.push_back(distance);
  }
  expect_to_follow(errors);
}

INSTANTIATE_TEST_SUITE_P(
    All, IntegratorTolerance,
    ::testing::Combine(::testing::Values(AdaptiveMethod{"CvodeAdams",
                                                        IntegrationMethod::cvode_adams},
                                         AdaptiveMethod{"CvodeBdf", IntegrationMethod::cvode_bdf},
                                         AdaptiveMethod{"Fehlberg", IntegrationMethod::fehlberg78}),
                       ::testing::ValuesIn(test::integrator_cases())),
    [](const auto& instance) {
      return std::get<0>(instance.param).name + "On" + std::get<1>(instance.param).name;
    });

// Expected: the brackets at round-off at every tolerance, while the error of the nominal, against
// 16 stages, is far above it at the loosest: what the program reports as the difference.
TEST(IntegratorToleranceOfGauss, KeepsTheTwoFormAtAnyTolerance) {
  for (const auto& one : test::integrator_cases()) {
    const test::Flow<double> flow{one.system, one.start, one.period, 0, {}};
    const auto exact = test::run_gauss(flow, test::adaptive(16, 1e-15));
    for (const double tolerance : tolerances) {
      const Integration gauss =
          run(IntegrationMethod::gauss, one, tolerance, one.start, one.period);
      EXPECT_LE(test::worst_symplecticity(gauss.jet), round_off) << one.name << " " << tolerance;
      if (tolerance == tolerances[0]) {
        EXPECT_GE(test::relative_error(gauss.jet, exact, 0), 1e4 * round_off) << one.name;
      }
    }
  }
}

}  // namespace
}  // namespace hamjet
