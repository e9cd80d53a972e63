#include "integrators/gauss/contraction.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

// Tests when a fixed-point iteration stops. The expected outcomes follow from the definition.

namespace hamjet {
namespace {

TEST(Contraction, NoChangeTwiceIsTheSolution) {
  for (const bool contracts_once_more : {false, true}) {
    Contraction<double> contraction(contracts_once_more);
    EXPECT_EQ(contraction.judge(0), Contraction<double>::goes_on);
    EXPECT_EQ(contraction.judge(0), Contraction<double>::is_rounding);
  }
}

TEST(Contraction, EndsOneChangeEarlierWhereWhatIsLeftContractsOnceMore) {
  // Each change is a hundredth of the last one: 1e-4, 1e-6 .. 1e-18. The remaining error after
  // 1e-18 is 1e-20, below 2^-12 of a rounding, 5.4e-20. If the error contracts once more, it is
  // 1e-20 after 1e-16 too.
  for (const bool contracts_once_more : {false, true}) {
    Contraction<double> contraction(contracts_once_more);
    double size = 1e-4;
    int judged = 1;
    while (contraction.judge(size) == Contraction<double>::goes_on) {
      size *= 1e-2;
      ++judged;
    }
    EXPECT_EQ(judged, contracts_once_more ? 7 : 8);
  }
}

TEST(Contraction, ShortStepsNeedNoNewton) {
  // Guesses that are right to the last bit are not changed; a try then takes a few evaluations.
  const std::vector<double> start = {1, 0, 0, 0, 1, 0};
  const FlowProblem<double> problem{kepler(), SeriesSpace::create(6, 1), {0, 1, 2, 3, 4, 5},
                                    start,    ClockTime::epoch(),        2.0};
  for (const int stages : {4, 6, 8}) {
    GaussSettings settings;
    settings.stages = stages;
    settings.step = 0.02;
    IntegrationStatistics statistics;
    integrate_gauss<double>(problem, settings, statistics);
    EXPECT_EQ(statistics.most_newton_iterations, 0);
    EXPECT_LE(statistics.nominal_evaluations, 15 * statistics.steps) << stages << " stages";
  }
}

}  // namespace
}  // namespace hamjet
