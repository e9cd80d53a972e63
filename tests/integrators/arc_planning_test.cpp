#include <gtest/gtest.h>

#include <optional>

#include "dynamics/oscillator_pair.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "support/flow.hpp"

// Tests the number of arcs in a plan, and that a run takes this number.

namespace hamjet {
namespace {

using test::adaptive;
using test::Flow;

TEST(ArcPlanning, DecidesFromTheCounts) {
  Flow<double> flow = test::flow_of(test::paper_orbit(), 6);
  flow.duration *= 5;
  const ArcPlan plan = plan_arcs(test::problem_of(flow), adaptive(8, 1e-12), std::nullopt);
  EXPECT_GE(plan.arcs, 4U);
  EXPECT_GT(plan.speed_ups[2], 1.8 * plan.speed_ups[1]);
  EXPECT_GT(plan.speed_ups[1], 1.8 * plan.speed_ups[0]);
  // Unsplit, five variables are integrated for six: 462 coefficients to order 6 for 924, whose
  // products have 0.42 of the multiply-adds; arcs from a cut on have all six.
  EXPECT_LT(plan.speed_ups[0], 0.6);
  auto all = test::problem_of(flow);
  all.symmetry = FlowSymmetry::none;
  const ArcPlan of_all = plan_arcs(all, adaptive(8, 1e-12), std::nullopt);
  EXPECT_GT(of_all.speed_ups[1], 1.7);
  EXPECT_GT(of_all.speed_ups[2], 3.0);
  EXPECT_LT(of_all.speed_ups[0], 1.0);
  // A composition in lanes, see HornerMultiplyAdds, and little other work.
  EXPECT_GE(plan.composition_multiply_adds, 8 * 381640);
  EXPECT_LE(plan.composition_multiply_adds, 1.2 * 8 * 381640);
  // At order 1 the nominal is most of the work, and a linear system has no other work. With three
  // of six variables later arcs cost four times the work.
  flow.order = 1;
  EXPECT_EQ(plan_arcs(test::problem_of(flow), adaptive(8, 1e-12), std::nullopt).arcs, 1U);
  flow.order = 4;
  flow.variables = {0, 1};
  EXPECT_EQ(plan_arcs(test::problem_of(flow), adaptive(8, 1e-12), std::nullopt).arcs, 1U);
  const Flow<double> pair{oscillator_pair(1, 1, 2), {1, 0.5, 0, 0}, 80, 6, {}};
  EXPECT_EQ(plan_arcs(test::problem_of(pair), adaptive(8, 1e-12), std::nullopt).arcs, 1U);
}

TEST(ArcPlanning, IsWhatIsDone) {
  Flow<double> flow = test::flow_of(test::paper_orbit(), 4);
  flow.duration = 30;
  const auto problem = test::problem_of(flow);
  for (const std::optional<std::size_t>& asked :
       {std::optional<std::size_t>(), std::optional<std::size_t>(3)}) {
    const ArcPlan plan = plan_arcs(problem, adaptive(), asked);
    IntegrationStatistics statistics;
    ArcStatistics arcs;
    integrate_in_arcs<double>(problem, adaptive(), {asked, 2}, statistics, arcs);
    EXPECT_EQ(arcs.plan.arcs, plan.arcs);
    EXPECT_EQ(arcs.plan.steps, statistics.steps);
    EXPECT_EQ(arcs.plan.speed_ups, plan.speed_ups);
    EXPECT_EQ(arcs.plan.reason, plan.reason);
    EXPECT_EQ(arcs.compositions, static_cast<long>(plan.arcs) - 1);
  }
}

}  // namespace
}  // namespace hamjet
