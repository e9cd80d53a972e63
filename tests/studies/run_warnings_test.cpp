#include "studies/checks/run_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "formation_scenes.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/checks/kept_tolerance.hpp"

// What is said of a run that no check fails.

namespace hamjet {
namespace {

TEST(RunWarnings, OfADegreeWithoutADigit) {
  // Sixteen steps of Verlet in a revolution at e = 0.9: far beyond what they can follow.
  Scene scene = kepler_chief(0.9, 7000, 5000, 2);
  scene.kinds.reset();
  scene.duration = 2 * std::numbers::pi * std::pow(10, 1.5);  // perigee is at 1
  scene.integrators[0].method = IntegrationMethod::velocity_verlet;
  scene.integrators[0].tolerance.reset();
  scene.integrators[0].step_canonical = 12;
  const RunResult lost = propagate(scene).runs[0];
  const std::vector<double>& estimate = *lost.error_estimate.by_degree;
  ASSERT_GE(*std::max_element(estimate.begin(), estimate.end()), 1);
  const SelfCheck& check = lost.checks[static_cast<std::size_t>(SelfCheckName::error_estimate)];
  EXPECT_EQ(check.state, SelfCheckState::passed);
  EXPECT_NE(check.text.find("not one digit of degree"), std::string::npos) << check.text;
  ASSERT_EQ(run_warnings(scene, lost).size(), 1U);
  EXPECT_NE(run_warnings(scene, lost)[0].find("not one digit"), std::string::npos);
  // An error that is no number is no digit either, wherever it stands.
  RunResult unknown = lost;
  unknown.error_estimate.by_degree = {std::nan(""), 1e-3};
  ASSERT_EQ(run_warnings(scene, unknown).size(), 1U);
  EXPECT_NE(run_warnings(scene, unknown)[0].find("degree 0"), std::string::npos);
  scene.integrators = {precise_gauss()};
  EXPECT_TRUE(run_warnings(scene, propagate(scene).runs[0]).empty());
}

// Rounding grows with the degree and with close passages, so that the high degrees of such a jet
// have no digits for a tolerance of 1e-13, whatever the steps: they are said to have lost it, and
// why.
TEST(RunWarnings, OfDegreesThatRoundingKeepsFromTheirTolerance) {
  Scene scene = kepler_chief(0.88, 7200, std::sqrt(7200.0 * 7200 * 7200 / 398600.4415), 4);
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = 1.082626675e-3;
  scene.canonical_radius = 0.88;
  scene.nominal = {1, 0, 0, 0, 0.8 * std::sqrt(1.88), 0.6 * std::sqrt(1.88)};
  scene.duration = 4.5 * 2 * std::numbers::pi * std::pow(0.12, -1.5);
  scene.integrators[0].tolerance = 1e-13;
  const RunResult run = propagate(scene).runs[0];
  ASSERT_EQ(run.failure, "");
  const std::vector<KeptTolerance> tolerance = kept_tolerance(scene, run);
  ASSERT_EQ(tolerance.size(), 5U);
  const std::size_t kept = degrees_kept(tolerance);
  ASSERT_GT(kept, 0U);
  ASSERT_LT(kept, 5U);
  EXPECT_FALSE(tolerance[4].is_kept());
  EXPECT_TRUE(tolerance[4].is_rounding);
  EXPECT_GT(tolerance[4].rounding, 1e-2 * tolerance[4].error);
  const std::vector<std::string> warnings = run_warnings(scene, run);
  ASSERT_EQ(warnings.size(), 1U);
  for (const char* const words : {"degree 4 has", "rounding, which alone makes", "\"extended\""}) {
    EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
  }
  scene.order = 1;
  EXPECT_TRUE(run_warnings(scene, propagate(scene).runs[0]).empty());
}

// Errors beyond what rounding explains are those of the steps.
TEST(RunWarnings, OfDegreesThatStepsKeepFromTheirTolerance) {
  Scene scene = paper_chief(2);
  scene.duration = 12;
  scene.integrators = {precise_gauss()};
  scene.integrators[0].tolerance = 1e-9;
  RunResult run = propagate(scene).runs[0];
  EXPECT_EQ(degrees_kept(kept_tolerance(scene, run)), 3U);
  run.error_estimate.by_degree = {1e-9, 1e-3, 1e-9};
  run.statistics.rounding_by_degree.clear();
  const std::vector<KeptTolerance> tolerance = kept_tolerance(scene, run);
  EXPECT_EQ(degrees_kept(tolerance), 1U);
  EXPECT_FALSE(tolerance[1].is_rounding);
  EXPECT_NE(tolerance_warning(scene, run).find("degree 0 alone keeps it, degree 1 has 1.0e-03"),
            std::string::npos)
      << tolerance_warning(scene, run);
  // Fixed steps promise nothing.
  run.settings.tolerance.reset();
  EXPECT_TRUE(kept_tolerance(scene, run).empty());
}

}  // namespace
}  // namespace hamjet
