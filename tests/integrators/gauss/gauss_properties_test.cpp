#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../integrator_checks.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

// Identities that the jet of a flow, or of a symmetric one-step method, obeys.

namespace hamjet {
namespace {

TEST(Gauss, ZeroDurationIsTheIdentityExactly) {
  for (const auto& settings : {test::adaptive(), test::fixed_step(2, 0.1)}) {
    IntegrationStatistics statistics;
    auto flow = test::flow_of(test::paper_orbit(), 3);
    flow.duration = 0;
    const auto jet = test::run_gauss(flow, settings, &statistics);
    EXPECT_EQ(statistics.steps, 0);
    test::expect_identity(jet, flow.start);
  }
}

TEST(Gauss, FixedStepsDivideTheSpan) {
  const auto steps = [](double duration, double step) {
    IntegrationStatistics statistics;
    const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, duration, 1, {}};
    test::run_gauss(flow, test::fixed_step(2, step), &statistics);
    EXPECT_EQ(statistics.vector_field_evaluations, 2 * statistics.steps);
    return statistics.steps;
  };
  EXPECT_EQ(steps(test::paper_orbit().duration, 0.01), 3142);  // 10 pi is no multiple of 0.01
  EXPECT_EQ(steps(1, 0.3), 4);
  EXPECT_EQ(steps(-1, 0.3), 4);
  EXPECT_EQ(steps(1, 0.1), 10);
  EXPECT_EQ(steps(0.1, 1), 1);
}

TEST(Gauss, ObserverSeesEveryStepAndTheExactEnd) {
  for (const auto& settings : {test::adaptive(), test::fixed_step(8, 0.3)}) {
    auto flow = test::flow_of(test::paper_orbit(), 1);
    flow.duration = -1;
    const auto problem = test::problem_of(flow);
    IntegrationStatistics statistics;
    std::vector<double> times{0};
    const auto jet = integrate_gauss<double>(problem, settings, statistics,
                                             [&](const double& t, const FlowJet<double>& now) {
                                               times.push_back(t);
                                               EXPECT_EQ(now.size(), 6u);
                                             });
    EXPECT_EQ(times.size(), static_cast<std::size_t>(statistics.steps) + 1);
    EXPECT_EQ(times.back(), -1);
    EXPECT_TRUE(std::is_sorted(times.rbegin(), times.rend()));
  }
}

/// For each degree, the largest sum of absolute values of the terms of a composition, to which its
/// round-off is relative.
double term_scale(FlowJet<double> second, FlowJet<double> first, int degree) {
  for (auto* jet : {&second, &first}) {
    for (auto& u : *jet) {
      for (auto& c : u.coefficients()) c = std::abs(c);
    }
  }
  return test::largest_of_degree(test::chained(second, first), degree);
}

TEST(Gauss, OutAndBackIsTheIdentity) {
  const auto out = test::flow_of(test::paper_orbit(), 3);
  const auto there = test::run_gauss(out);
  auto back = out;
  back.start = test::final_state(there);
  back.duration = -out.duration;
  const auto returned = test::run_gauss(back);
  const auto both = test::chained(returned, there);
  for (int d = 0; d <= 3; ++d) {
    // 1e-13 is the error of each direction; at degree 0 the norm of the way back amplifies it.
    const double scale = d == 0 ? test::paper_orbit().matrix_norm : term_scale(returned, there, d);
    const auto identity = starting_jet(test::problem_of(out));
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LE(test::largest_of_degree(both[i] - identity[i], d), 1e-13 * scale) << "degree " << d;
    }
  }
}

TEST(Gauss, HalvesComposeToTheWhole) {
  const double t = test::paper_orbit().duration;
  const auto whole = test::paper_jet<double>(t, 4, test::adaptive(8, 1e-16));
  const auto first = test::paper_jet<double>(t / 2, 4, test::adaptive(8, 1e-16));
  auto rest = test::flow_of(test::paper_orbit(), 4);
  rest.start = test::final_state(first);
  rest.duration = t / 2;
  const auto second = test::run_gauss(rest, test::adaptive(8, 1e-16));
  const auto both = test::chained(second, first);
  for (int d = 0; d <= 4; ++d) {
    const double condition = term_scale(second, first, d) / test::largest_of_degree(whole, d);
    EXPECT_LE(test::relative_error(both, whole, d), 1e-13 * (1 + condition)) << "degree " << d;
  }
}

TEST(Gauss, MirrorOfTheMotionRunsBackwards) {
  // H is even in p: with R (q, p) = (q, -p), Phi_-t R = R Phi_t. The method is symmetric, so fixed
  // steps obey this to round-off even where they are far from the flow.
  const auto forwards = test::paper_jet<double>(3, 2, test::fixed_step(2, 0.5));
  auto flow = test::flow_of(test::paper_orbit(), 2);
  for (std::size_t i = 3; i < 6; ++i) flow.start[i] = -flow.start[i];
  flow.duration = -3;
  const auto backwards = test::run_gauss(flow, test::fixed_step(2, 0.5));
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < forwards[i].size(); ++k) {
      const auto e = forwards[i].space().exponents(k);
      const int sign = ((e[3] + e[4] + e[5]) % 2 == 0) == (i < 3) ? 1 : -1;
      const double scale = test::largest_of_degree(forwards, forwards[i].space().degree(k));
      EXPECT_NEAR(backwards[i][k], sign * forwards[i][k], 1e-14 * scale);
    }
  }
}

TEST(Gauss, FirstOrderFormEqualsSecondOrderForm) {
  for (const int stages : {1, 3, 8}) {
    auto flow = test::flow_of(test::paper_orbit(), 3);
    flow.duration = 5;
    ASSERT_TRUE(flow.system.second_order.has_value());
    const auto second = test::run_gauss(flow, test::fixed_step(stages, 0.25));
    flow.system.second_order.reset();
    const auto first = test::run_gauss(flow, test::fixed_step(stages, 0.25));
    // Both are twenty steps of the same map, solved in two ways, each to round-off.
    for (int d = 0; d <= 3; ++d) EXPECT_LE(test::relative_error(first, second, d), 1e-13);
  }
}

/// Compares the second-order form of a system with its general form.
void expect_agreement_of_forms(DynamicalSystem system) {
  ASSERT_TRUE(system.second_order.has_value());
  test::Flow<double> flow{std::move(system), {0.3, -0.2, 0.5, 0.1}, 2, 4, {}};
  const auto second = test::run_gauss(flow, test::fixed_step(4, 0.1));
  flow.system.second_order.reset();
  const auto first = test::run_gauss(flow, test::fixed_step(4, 0.1));
  for (int d = 0; d <= 4; ++d) EXPECT_LE(test::relative_error(first, second, d), 1e-13) << d;
}

TEST(Gauss, CoupledMassesAgreeInBothForms) {
  // H = p^T W p / 2 + V(q) with a full matrix W: the mass matrix enters every stage.
  expect_agreement_of_forms(make_system("coupled", 2, [](auto q, auto p) {
    return p[0] * p[0] + p[0] * p[1] / 2 + 2 * p[1] * p[1] + cos(q[0]) * q[1] + square(q[1]) +
           square(square(q[0])) / 4;
  }));
  // One force is linear and has no remainders.
  expect_agreement_of_forms(make_system("half linear", 2, [](auto q, auto p) {
    return p[0] * p[0] + p[0] * p[1] / 2 + 2 * p[1] * p[1] + square(square(q[0])) / 4 +
           square(q[1]);
  }));
}

TEST(Gauss, LowOrderIsTheBeginningOfHighOrder) {
  const auto high = test::paper_jet<double>(10, 4, test::adaptive());
  for (const int order : {1, 2, 3}) {
    const auto low = test::paper_jet<double>(10, order, test::adaptive());
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < low[i].size(); ++k) {
        const int degree = low[i].space().degree(k);
        // The operations and their order are the same, so that no rounding differs. The end map of
        // the highest degree sums the same terms in another order.
        const double rounding = degree < order ? 0 : 1e-13 * test::largest_of_degree(high, degree);
        EXPECT_NEAR(low[i][k], high[i][k], rounding);
      }
    }
  }
}

TEST(Gauss, FewerVariablesGiveTheSliceOfTheFullJet) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  flow.duration = 10;
  const auto full = test::run_gauss(flow);
  flow.variables = {5, 1};  // the times are in any order
  const auto part = test::run_gauss(flow);
  const SeriesSpace& space = part[0].space();
  for (std::size_t k = 0; k < space.size(); ++k) {
    std::vector<std::uint8_t> exponents(6, 0);
    exponents[5] = space.exponents(k)[0];
    exponents[1] = space.exponents(k)[1];
    const std::size_t same = full[0].space().index(exponents);
    for (std::size_t i = 0; i < 6; ++i) {
      // Both are sums of the same terms, in another order.
      EXPECT_NEAR(part[i][k], full[i][same],
                  1e-13 * test::largest_of_degree(full, space.degree(k)));
    }
  }
}

TEST(Gauss, PlanarSystemEqualsThePlanarPartOfTheFullOne) {
  const auto orbit = test::reference_orbit("EQ-J2-CIRC");
  const auto full_flow = test::flow_of(orbit, 3);
  const auto full = test::run_gauss(full_flow);
  const std::vector<std::size_t> kept{0, 1};
  const test::Flow<double> flow{restrict_system(full_flow.system, kept),
                                {orbit.start[0], orbit.start[1], orbit.start[3], orbit.start[4]},
                                orbit.duration,
                                3,
                                {}};
  const auto planar = test::run_gauss(flow);
  const SeriesSpace& space = planar[0].space();
  const std::size_t same_component[] = {0, 1, 3, 4};
  for (std::size_t k = 0; k < space.size(); ++k) {
    std::vector<std::uint8_t> exponents(6, 0);
    for (std::size_t v = 0; v < 4; ++v) exponents[same_component[v]] = space.exponents(k)[v];
    const std::size_t same = full[0].space().index(exponents);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(planar[i][k], full[same_component[i]][same],
                  1e-12 * test::largest_of_degree(full, space.degree(k)));
    }
  }
}

TEST(Gauss, EverySupportedNumberOfStagesAgrees) {
  // The cases are sixteen numbers of stages and five widths of a pack, with padding.
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.duration = 1;
  const auto expected = test::run_gauss(flow, test::adaptive(8, 1e-18));
  for (int stages = 4; stages <= 16; ++stages) {
    const auto jet = test::run_gauss(flow, test::fixed_step(stages, 1.0 / 64));
    for (int d = 0; d <= 2; ++d) EXPECT_LE(test::relative_error(jet, expected, d), 1e-13) << stages;
  }
}

}  // namespace
}  // namespace hamjet
