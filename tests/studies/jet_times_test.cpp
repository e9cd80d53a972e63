#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hamjet/studies/propagation.hpp"
#include "studies/formation_scenes.hpp"
#include "support/errors.hpp"

// The jets of one run at several times. Expected: the results of separate runs to each time in
// extended precision, and the same jet at the end as without the times.

namespace hamjet::test {
namespace {

/// The paper's orbit to order 3, about a revolution, coarse enough for errors above rounding.
Scene scene_with_times(std::vector<double> times) {
  Scene scene = paper_chief(3);
  scene.duration = 12;
  scene.integrators = {precise_gauss()};
  scene.integrators[0].tolerance = 1e-8;
  scene.jet_times = std::move(times);
  return scene;
}

TEST(JetTimes, AreRightAndTheirEstimatesAreNotFarBelowTheErrors) {
  const PropagationResult result = propagate(scene_with_times({1.5, 6, 11.25}));
  const RunResult& run = result.runs.at(0);
  ASSERT_EQ(run.jets.size(), 3U);
  for (const JetAtTime& one : run.jets) {
    Scene fine = scene_with_times({});
    fine.duration = one.time;
    fine.precision = Precision::extended;
    fine.integrators[0].tolerance = 1e-20;
    fine.checks[SelfCheckName::error_estimate].is_on = false;
    const FlowJet<Extended> right = propagate(fine).runs.at(0).jet;
    const std::vector<double> errors = relative_error_by_degree(one.jet, right);
    ASSERT_EQ(one.error_estimate.size(), errors.size());
    for (std::size_t d = 0; d < errors.size(); ++d) {
      EXPECT_LT(errors[d], 1e-6) << one.time << ", degree " << d;
      // The factor by which the estimate of one scene may be wrong.
      EXPECT_GT(100 * one.error_estimate[d], errors[d]) << one.time << ", degree " << d;
      EXPECT_LT(one.error_estimate[d], 1e-5) << one.time << ", degree " << d;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(one.nominal[i], static_cast<double>(one.jet[i].constant()));
    }
  }
}

TEST(JetTimes, LeaveTheJetAtTheEndAsItIs) {
  for (const Precision precision : {Precision::double_precision, Precision::extended}) {
    Scene scene = scene_with_times({});
    scene.precision = precision;
    const RunResult alone = propagate(scene).runs.at(0);
    scene.jet_times = {3, 4};
    const RunResult with_times = propagate(scene).runs.at(0);
    EXPECT_EQ(with_times.statistics.steps, alone.statistics.steps);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_TRUE(std::equal(alone.jet[i].coefficients().begin(), alone.jet[i].coefficients().end(),
                             with_times.jet[i].coefficients().begin()));
    }
  }
}

TEST(JetTimes, TakeAMethodThatHasThem) {
  Scene scene = scene_with_times({3});
  scene.integrators[0].method = IntegrationMethod::fehlberg78;
  expect_error([&] { propagate(scene); }, ErrorKind::usage, {"fehlberg78", "must be gauss"},
               "fehlberg78");
  scene = scene_with_times({3});
  scene.arcs = 2;
  expect_error([&] { propagate(scene); }, ErrorKind::scene, {"jet.arcs", "a list of times"},
               "arcs");
}

}  // namespace
}  // namespace hamjet::test
