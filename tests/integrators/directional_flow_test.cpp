#include "integrators/directional_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"
#include "integrator_checks.hpp"

// A method commutes with the restriction to lines: its result for the lines is the full jet of the
// same steps along the lines.

namespace hamjet {
namespace {

template <class Integrate>
void expect_restriction(const Integrate& integrate) {
  for (const int order : {0, 1, 2, 4, 5}) {
    const DynamicalSystem system = zonal_gravity({1, 1, {{2, 1.0826e-3}, {3, -2.5e-6}}});
    const FlowProblem<double> problem = test::orbit_problem(system, order, 2.0);
    const DirectionalFlow<double> flow(problem, 2);
    const auto lines = flow.integrate(integrate);
    const auto restricted = flow.restrict(integrate(problem));
    ASSERT_EQ(lines.size(), 2u);
    const std::vector<double> difference = flow.relative_difference(lines, restricted);
    ASSERT_EQ(difference.size(), static_cast<std::size_t>(order) + 1);
    // The bound is a sample of rounding: some 100 operations in each step, which add up at random
    // over tens of steps, and up to 252 coefficients of a degree in a sum.
    for (const double x : difference) EXPECT_LT(x, 2e-13) << "order " << order;
  }
}

TEST(DirectionalFlow, IsTheJetAlongLinesWithGauss) {
  expect_restriction([](const FlowProblem<double>& problem) {
    GaussSettings settings;
    settings.step = 0.1;
    IntegrationStatistics statistics;
    return integrate_gauss<double>(problem, settings, statistics);
  });
}

TEST(DirectionalFlow, IsTheJetAlongLinesWithSplitting) {
  expect_restriction([](const FlowProblem<double>& problem) {
    IntegrationStatistics statistics;
    return integrate_symmetric_composition<double>(problem, {4, 0.1}, statistics);
  });
}

TEST(DirectionalFlow, ShowsWhatDiffersAtItsDegree) {
  const DynamicalSystem system = zonal_gravity({1, 1, {{2, 1.0826e-3}}});
  const DirectionalFlow<double> flow(test::orbit_problem(system, 3, 1.0), 2);
  const auto lines = flow.integrate([](const FlowProblem<double>& problem) {
    IntegrationStatistics statistics;
    GaussSettings settings;
    settings.step = 0.1;
    return integrate_gauss<double>(problem, settings, statistics);
  });
  for (std::size_t line = 0; line < 2; ++line) {
    auto changed = lines;
    changed[line][1][2] *= 1.5;
    const std::vector<double> difference = flow.relative_difference(changed, lines);
    for (std::size_t d = 0; d < difference.size(); ++d) EXPECT_EQ(difference[d] > 0, d == 2);
  }
}

}  // namespace
}  // namespace hamjet
