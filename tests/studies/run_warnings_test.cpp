#include "studies/checks/run_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "formation_scenes.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/studies/propagation.hpp"

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

}  // namespace
}  // namespace hamjet
