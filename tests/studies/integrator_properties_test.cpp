#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../../src/studies/integration.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "integrator_cases.hpp"
#include "support/convergence.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

// Tests every integrator with fixed steps on every system of the paper: the theory's statements on
// its two-form, order, reversibility and energy. Methods that choose their steps by a tolerance
// promise none of these, see integrator_tolerance_test.

namespace hamjet {
namespace {

struct Method {
  std::string name;
  IntegratorSettings settings;
  int order;
  bool is_symplectic;  ///< in (q, p)
  bool is_symmetric;
};

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

Method gauss_method(int stages) {
  Method method{"Gauss" + std::to_string(stages), {}, 2 * stages, true, true};
  method.settings.stages = stages;
  return method;
}

Method verlet_method(int order) {
  Method method{"Verlet" + std::to_string(order), {}, order, true, true};
  method.settings.method = IntegrationMethod::velocity_verlet;
  method.settings.order = order;
  return method;
}

Method newmark_method(double beta) {
  Method method{beta == 0 ? "Newmark0" : "NewmarkQuarter", {}, 2, beta == 0, true};
  method.settings.method = IntegrationMethod::newmark;
  method.settings.beta = beta;
  return method;
}

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const int stages : {1, 2, 3, 4, 8}) methods.push_back(gauss_method(stages));
  Method stormer{"Stormer", {}, 1, true, false};
  stormer.settings.method = IntegrationMethod::stormer;
  methods.push_back(stormer);
  for (const int order : {2, 4, 6, 8}) methods.push_back(verlet_method(order));
  for (const double beta : {0.0, 0.25}) methods.push_back(newmark_method(beta));
  Method fehlberg{"Fehlberg", {}, 8, false, false};
  fehlberg.settings.method = IntegrationMethod::fehlberg78;
  methods.push_back(fehlberg);
  return methods;
}

class IntegratorProperties
    : public ::testing::TestWithParam<std::tuple<Method, test::IntegratorCase>> {
 protected:
  const Method& method() const { return std::get<0>(GetParam()); }
  const test::IntegratorCase& problem() const { return std::get<1>(GetParam()); }

  template <class Real>
  FlowJet<Real> run(double duration, long steps, int order,
                    const std::vector<Real>& start = {}) const {
    test::Flow<Real> flow{problem().system, start, Real(duration), order, {}};
    if (start.empty()) flow.start.assign(problem().start.begin(), problem().start.end());
    IntegratorSettings settings = method().settings;
    settings.step_canonical = std::abs(duration) / (static_cast<double>(steps) - 0.5);
    IntegrationStatistics statistics;
    const auto jet = integrate<Real>(test::problem_of(flow), settings, statistics, {});
    EXPECT_EQ(statistics.steps, steps);
    return jet;
  }

  /// Steps a period at which the method is neither at round-off nor far off.
  long coarse_steps() const {
    switch (method().order) {
      case 1:
        return 1000;
      case 2:
        return 200;
      case 4:
        return 60;
      case 16:
        return 16;
      default:
        if (method().name == "Fehlberg") return 16;
        return method().settings.method == IntegrationMethod::gauss ? 30 : 40;
    }
  }
};

// Expected: the brackets of the jet's components are those of a symplectic map, to round-off, if
// and only if the method is symplectic. Newmark's with beta > 0 is so in other variables
// (newmark_test).
TEST_P(IntegratorProperties, TwoForm) {
  const double worst = test::worst_symplecticity(run<double>(problem().period, coarse_steps(), 2));
  if (method().is_symplectic) {
    EXPECT_LE(worst, 1e-13);
  } else if (problem().name == "Oscillator" && method().order == 2) {
    // A quadratic energy: the scheme is conjugate to the midpoint rule by a linear map, and its own
    // two-form differs by a factor that is the same at both ends.
    EXPECT_LE(worst, 1e-13);
  } else {
    EXPECT_GE(worst, 1e-10);
  }
}

// Expected: the classical order of the method on the nominal and on the linear part, against 16
// stages of Gauss in extended precision, fitted where the leading term rules: far below what double
// precision resolves for the high orders, and for Fehlberg's pair, whose next term is large.
TEST_P(IntegratorProperties, Order) {
  const bool is_low = method().order <= 2;
  const bool is_highest = method().order == 16;
  const double duration = is_highest ? 5 : 1;
  const double highest = is_low                        ? 1e-2
                         : is_highest                  ? 1e-18
                         : method().name == "Fehlberg" ? 1e-16
                                                       : 1e-9;
  const double lowest = is_highest ? 1e-29 : 1e-24;
  test::Flow<Extended> flow{problem().system, {}, Extended(duration), 1, {}};
  flow.start.assign(problem().start.begin(), problem().start.end());
  const auto reference = test::run_gauss(flow, test::adaptive(16, 1e-31));
  std::vector<double> steps[2];
  std::vector<double> errors[2];
  for (long count = is_low ? 100 : 4; steps[0].size() < 5 || steps[1].size() < 5;
       count += is_highest ? count / 4 : count / 2) {
    ASSERT_LE(count, 3000);
    const auto jet = run<Extended>(duration, count, 1);
    const double largest =
        std::max(test::relative_error(jet, reference, 0), test::relative_error(jet, reference, 1));
    if (largest < lowest) break;
    for (int degree = 0; degree <= 1; ++degree) {
      const double error = test::relative_error(jet, reference, degree);
      if (error > highest || error < lowest) continue;
      steps[degree].push_back(duration / static_cast<double>(count));
      errors[degree].push_back(error);
    }
  }
  for (int degree = 0; degree <= 1; ++degree) {
    ASSERT_GE(steps[degree].size(), 3U) << degree;
    EXPECT_NEAR(test::fitted_order(steps[degree], errors[degree]), method().order, 0.3) << degree;
  }
}

// Expected: a symmetric method retraces its steps backwards to round-off; another does not.
TEST_P(IntegratorProperties, TimeReversibility) {
  const long steps = coarse_steps();
  const auto there = run<double>(problem().period, steps, 1);
  const auto back = run<double>(-problem().period, steps, 1, test::final_state(there));
  double distance = 0;
  for (std::size_t i = 0; i < back.size(); ++i) {
    distance = test::larger(distance, std::abs(back[i][0] - problem().start[i]));
  }
  if (method().is_symmetric) {
    EXPECT_LE(distance, 1e-12);
  } else {
    EXPECT_GE(distance, 1e-10);
  }
}

// Expected: with fixed steps the energy error of a symplectic method, and of Newmark's, which is
// conjugate to one, does not grow from the first periods to the fortieth (Hairer, Lubich and
// Wanner, Geometric Numerical Integration, theorem IX.8.1); that of Fehlberg's grows with time.
TEST_P(IntegratorProperties, EnergyOverFortyPeriods) {
  test::Flow<double> flow{problem().system, problem().start, 40 * problem().period, 0, {}};
  IntegratorSettings settings = method().settings;
  settings.step_canonical = problem().period / static_cast<double>(coarse_steps());
  const double initial = test::energy(problem().system, problem().start);
  double early = 0;
  double late = 0;
  IntegrationStatistics statistics;
  integrate<double>(test::problem_of(flow), settings, statistics,
                    [&](const double& time, const FlowJet<double>& jet) {
                      const double error = std::abs(
                          test::energy(problem().system, test::final_state(jet)) - initial);
                      if (time < 4 * problem().period) early = test::larger(early, error);
                      if (time > 36 * problem().period) late = test::larger(late, error);
                    });
  if (method().name == "Fehlberg") {
    EXPECT_GE(late, 4 * early);
  } else {
    EXPECT_LE(late, 2 * early + 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(All, IntegratorProperties,
                         ::testing::Combine(::testing::ValuesIn(all_methods()),
                                            ::testing::ValuesIn(test::integrator_cases())),
                         [](const auto& instance) {
                           return std::get<0>(instance.param).name + "On" +
                                  std::get<1>(instance.param).name;
                         });

}  // namespace
}  // namespace hamjet
