#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "dynamics/spring_pendulum.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "support/flow.hpp"

// A composition that would lose digits is not computed: a requested number of arcs is refused, and
// the plan's own number becomes 1.

namespace hamjet {
namespace {

/// A mass on a spring without gravity, which turns slowly about the point of suspension. Besides
/// the energy there is a second integral, the angular momentum L, and the angle shears at a rate
/// that depends on it: deviations of size 1 turn the plane by an angle of size t. At a cut only the
/// energy is a coordinate. In the linear ones, L of a deviation that has turned that far is what is
/// left of terms of size t^2, and the map behind the cut turns an error in it into t times itself.
test::Flow<double> turning_spring() {
  return {spring_pendulum(1, 1, 1, 0), {1.1, 0, 0, 0.01}, 300, 5, {}};
}

TEST(ArcLoss, RefusesTheNumberThatWasAskedFor) {
  const auto flow = turning_spring();
  const auto problem = test::problem_of(flow);
  for (const std::size_t arcs : {2U, 4U}) {
    SCOPED_TRACE(arcs);
    IntegrationStatistics statistics;
    ArcStatistics arc_statistics;
    try {
      integrate_in_arcs<double>(problem, test::adaptive(8, 1e-13), {arcs, 2}, statistics,
                                arc_statistics);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::numerical);
      const std::string text = error.what();
      EXPECT_EQ(text.find(fmt::format("arcs: the composition of {} arcs would be wrong by ", arcs)),
                0U)
          << text;
      EXPECT_NE(text.find(", where the unsplit run is wrong by "), std::string::npos) << text;
      EXPECT_TRUE(text.ends_with("; one arc, or auto, keeps all digits")) << text;
    }
  }
}

TEST(ArcLoss, MakesAutoStayUnsplitAndSayWhy) {
  const auto flow = turning_spring();
  const auto problem = test::problem_of(flow);
  const GaussSettings method = test::adaptive(8, 1e-13);
  const ArcPlan plan = plan_arcs<double>(problem, method, std::nullopt);
  ASSERT_GT(plan.arcs, 1U) << plan.reason;
  IntegrationStatistics statistics;
  ArcStatistics arcs;
  const auto jet = integrate_in_arcs<double>(problem, method, {std::nullopt, 2}, statistics, arcs);
  EXPECT_EQ(arcs.plan.arcs, 1U);
  for (const double speed_up : arcs.plan.speed_ups) EXPECT_EQ(speed_up, 1);
  EXPECT_EQ(arcs.plan.reason.find(
                fmt::format("the composition of {} arcs would be wrong by ", plan.arcs)),
            0U)
      << arcs.plan.reason;
  EXPECT_NE(arcs.plan.reason.find(", where the unsplit run is wrong by "), std::string::npos)
      << arcs.plan.reason;
  // The result equals the run without arcs, bit for bit.
  IntegrationStatistics whole;
  const auto unsplit = test::run_gauss(flow, method, &whole);
  EXPECT_EQ(statistics.steps, whole.steps);
  for (std::size_t i = 0; i < unsplit.size(); ++i) {
    for (std::size_t k = 0; k < unsplit[i].size(); ++k) {
      EXPECT_EQ(jet[i][k], unsplit[i][k]) << "component " << i << ", coefficient " << k;
    }
  }
}

}  // namespace
}  // namespace hamjet
