#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"

// Estimates of jets of which some degrees vanish but for rounding: where the forces' terms cancel
// in numbers alone, and where the nominal is a place of symmetry but for its own rounding.

namespace hamjet {
namespace {

RunResult run_of(const std::string& hamiltonian, const std::string& nominal, double duration,
                 int order) {
  const Scene scene = io::parse_scene(
      "[system]\nmodel = \"own\"\ncoordinates = [\"x\"]\nmomenta = [\"p\"]\nhamiltonian = \"" +
          hamiltonian + "\"\n[nominal]\n" + nominal + "\n[jet]\norder = " + std::to_string(order) +
          "\nduration_canonical = " + std::to_string(duration) + "\n",
      "own.toml");
  return propagate(scene).runs.at(0);
}

const SelfCheck& estimate_check(const RunResult& run) {
  return *std::find_if(run.checks.begin(), run.checks.end(), [](const SelfCheck& check) {
    return check.name == SelfCheckName::error_estimate;
  });
}

// log(exp(3 x)) is 3 x: the flow is x + p t - 3 t^2 / 2, p - 3 t, and the force has no higher
// degree.
TEST(NegligibleDegrees, AForceThatCancelsToAConstantHasAnEstimate) {
  for (const double t : {1.0, 3.0}) {
    const RunResult run =
        run_of("p^2/2 + log(exp(3*x))", "coordinates = [0.4]\nmomenta = [0.2]", t, 4);
    ASSERT_TRUE(run.error_estimate.by_degree) << run.error_estimate.failure;
    const std::vector<double>& estimate = *run.error_estimate.by_degree;
    ASSERT_EQ(estimate.size(), 5U);
    EXPECT_EQ(estimate_check(run).state, SelfCheckState::passed) << estimate_check(run).text;
    const double x = 0.4 + 0.2 * t - 1.5 * t * t, p = 0.2 - 3 * t;
    const double size = std::max(std::abs(x), std::abs(p));
    const double nominal = std::max(std::abs(static_cast<double>(run.jet[0][0]) - x),
                                    std::abs(static_cast<double>(run.jet[1][0]) - p));
    EXPECT_LE(nominal / size, 10 * std::max(estimate[0], 0x1p-52));
    EXPECT_LT(estimate[0], 1e-13);
    const double linear = std::abs(static_cast<double>(run.jet[0][2]) - t) / std::max(1.0, t);
    EXPECT_LE(linear, 10 * std::max(estimate[1], 0x1p-52));
    EXPECT_LT(estimate[1], 1e-12);
    for (std::size_t d = 2; d <= 4; ++d) EXPECT_LT(estimate[d], 1e-12) << d;
  }
}

// A pendulum at rest at pi, rounded: even degrees are those of 1.2e-16 away from the symmetry, and
// no coefficient of theirs has a digit. The odd ones are those of the bottom, cos t and sin t.
TEST(NegligibleDegrees, OfSymmetryAreToldBesideTheLinearPart) {
  const RunResult run =
      run_of("p^2/2 + cos(x)", "coordinates = [3.141592653589793]\nmomenta = [0]", 3, 4);
  ASSERT_TRUE(run.error_estimate.by_degree) << run.error_estimate.failure;
  const std::vector<double>& estimate = *run.error_estimate.by_degree;
  EXPECT_EQ(estimate_check(run).state, SelfCheckState::passed) << estimate_check(run).text;
  for (const std::size_t d : {2U, 4U}) EXPECT_LT(estimate[d], 1e-12) << d;
  EXPECT_NEAR(static_cast<double>(run.jet[0][1]), std::cos(3.0), 1e-11);
}

// Degrees that are small and right keep the measure of their own coefficients: x^3 / 1e14 makes a
// degree 2 of 1e-14 of the linear part.
TEST(NegligibleDegrees, WhatIsSmallAndRightIsMeasuredByItself) {
  const RunResult run =
      run_of("p^2/2 + x^2/2 + x^3/1e14", "coordinates = [1]\nmomenta = [0]", 3, 2);
  ASSERT_TRUE(run.error_estimate.by_degree);
  EXPECT_GT((*run.error_estimate.by_degree)[2], 1e-16);
  EXPECT_LT((*run.error_estimate.by_degree)[2], 0.1);
}

}  // namespace
}  // namespace hamjet
