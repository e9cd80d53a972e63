#include "studies/skipped_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "formation_scenes.hpp"

// What is said to be left out is what the scene does not need, and the counters of the work that
// was done agree.

namespace hamjet {
namespace {

using Names = std::vector<std::string>;

Names left_out(const PropagationResult& result) {
  Names names;
  for (const SkippedWork& entry : skipped_work(result)) {
    EXPECT_FALSE(entry.why.empty()) << entry.what;
    names.push_back(entry.what);
  }
  return names;
}

std::string reason(const PropagationResult& result, const std::string& what) {
  for (const SkippedWork& entry : skipped_work(result)) {
    if (entry.what == what) return entry.why;
  }
  return "not left out";
}

Scene oscillator_scene(int order) {
  Scene scene;
  scene.system.model = SystemModel::harmonic_oscillator;
  scene.nominal = {1, 0.5};
  scene.duration = 1;
  scene.order = order;
  scene.variables = {0, 1};
  scene.integrators = {precise_gauss()};
  return scene;
}

const std::string rotation = "the variable of the rotation about the axis";

/// What a scene with nothing but a jet leaves out at its end.
Names with_parts(Names names, bool has_all_variables = true) {
  names.emplace_back("reference");
  if (!has_all_variables) names.emplace_back("Poisson brackets");
  for (const char* name : {"generating functions", "relative Hamiltonian", "figure"}) {
    names.emplace_back(name);
  }
  return names;
}

TEST(SkippedWork, OfALinearSystemIsAllAboveTheFirstDegree) {
  const PropagationResult result = propagate(oscillator_scene(3));
  EXPECT_EQ(left_out(result), with_parts({"degrees 2 to 3"}));
  const RunResult& run = result.runs[0];
  for (const auto& component : run.jet) {
    for (std::size_t k = component.space().first(2); k < component.size(); ++k) {
      EXPECT_EQ(component[k], 0);
    }
  }
  EXPECT_EQ(run.counts.inversions, 0);
  EXPECT_EQ(run.counts.exactness_residuals, 0);
  EXPECT_EQ(run.counts.poisson_brackets, 1);  // of q and p
  EXPECT_EQ(left_out(propagate(oscillator_scene(1))), with_parts({}));
}

TEST(SkippedWork, IsNothingOfWhatTheSceneAsksFor) {
  Scene scene = oscillator_scene(1);
  scene.reference = ReferenceSettings{};
  scene.kinds = {"F1", "F2"};
  scene.relative_hamiltonian_times = {0};
  scene.figure = FigureSettings{FigureQuantity::energy_error, ""};
  const PropagationResult result = propagate(scene);
  EXPECT_EQ(left_out(result), Names());
  EXPECT_EQ(result.runs[0].counts.inversions, 2);
  EXPECT_EQ(result.runs[0].counts.exactness_residuals, 2);
  EXPECT_TRUE(result.reference.has_value());
  scene.checks[SelfCheckName::energy].is_on = false;
  EXPECT_EQ(left_out(propagate(scene)), Names{"check energy"});
}

TEST(SkippedWork, OfZonalHarmonicsIsThoseThatAreAbsent) {
  Scene scene = paper_chief(1);
  scene.duration = 0.1;
  EXPECT_EQ(left_out(propagate(scene)), with_parts({"J4 to J20", rotation}));
  scene.system.J[3] = 0;
  EXPECT_EQ(left_out(propagate(scene)), with_parts({"J3", "J4 to J20", rotation}));
  scene.system.J[6] = 5e-7;
  const PropagationResult result = propagate(scene);
  EXPECT_EQ(left_out(result), with_parts({"J3", "J4", "J5", "J7 to J20", rotation}));
  EXPECT_NE(reason(result, rotation).find("5 of 6 variables were integrated"), std::string::npos);
  scene.symmetry = FlowSymmetry::none;
  EXPECT_EQ(left_out(propagate(scene)), with_parts({"J3", "J4", "J5", "J7 to J20"}));
  // Legendre's recursion goes through every degree.
  EXPECT_NE(reason(result, "J4").find("J6 needs the steps through its degree"), std::string::npos);
  EXPECT_EQ(reason(result, "J7 to J20").find("needs"), std::string::npos);
}

/// The largest difference of a coefficient of one degree, in parts of the largest.
double difference(const RunResult& a, const RunResult& b, int degree) {
  const SeriesSpace& space = a.jet[0].space();
  Extended most = 0;
  Extended size = 0;
  for (std::size_t i = 0; i < a.jet.size(); ++i) {
    for (std::size_t k = space.first(degree); k < space.first(degree + 1); ++k) {
      most = std::max(most, Extended(abs(a.jet[i][k] - b.jet[i][k])));
      size = std::max(size, Extended(abs(b.jet[i][k])));
    }
  }
  return static_cast<double>(Extended(most / size));
}

// The implicit midpoint rule does not commute with a shift in time: what that costs is told as the
// jets of both runs differ. Along a line some ten coefficients come together.
TEST(SkippedWork, OfTheShiftInTimeIsSaidWithWhatItCosts) {
  Scene scene = paper_chief(2);
  scene.duration = 2;
  scene.integrators[0].stages = 1;
  scene.integrators[0].tolerance.reset();
  scene.integrators[0].step_canonical = 0.02;
  scene.symmetry = FlowSymmetry::none;
  const PropagationResult whole = propagate(scene);
  scene.symmetry = FlowSymmetry::rotation_and_time;
  const PropagationResult result = propagate(scene);
  const std::string shift = "the variable of the shift in time";
  EXPECT_EQ(left_out(result), with_parts({"J4 to J20", rotation, shift}));
  EXPECT_NE(reason(result, shift).find("4 of 6 variables were integrated"), std::string::npos);
  const std::vector<double>& told = result.runs[0].time_shift_difference;
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[0], 0);
  for (int d = 1; d <= 2; ++d) {
    const double found = difference(result.runs[0], whole.runs[0], d);
    const auto degree = static_cast<std::size_t>(d);
    EXPECT_GT(found, 1e-8);
    EXPECT_GT(told[degree], found / 30) << d;
    EXPECT_LT(told[degree], found * 30) << d;
  }
  const SelfCheck* symplectic = nullptr;
  for (const SelfCheck& check : result.runs[0].checks) {
    if (check.name == SelfCheckName::symplecticity) symplectic = &check;
  }
  ASSERT_NE(symplectic, nullptr);
  EXPECT_EQ(symplectic->state, SelfCheckState::not_applicable);
  EXPECT_TRUE(whole.runs[0].time_shift_difference.empty());
}

// A run's jet is the same whatever deputies are to be predicted by; polynomials in the scene's
// coordinates are beside it, and where these are not known it says so.
TEST(SkippedWork, IsTheCoordinatesThatAreNotKnown) {
  Scene scene = paper_chief(2);
  scene.duration = 0.1;
  const PropagationResult plain = propagate(scene);
  scene.coordinates = {JetCoordinates::nodal, JetCoordinates::poincare};
  const PropagationResult result = propagate(scene);
  Names names = with_parts({"J4 to J20", rotation});
  EXPECT_EQ(left_out(result), names);
  ASSERT_TRUE(result.runs[0].charted);
  EXPECT_EQ(result.runs[0].charted->failure, "");
  const auto found = result.runs[0].jet[5].coefficients();
  const auto expected = plain.runs[0].jet[5].coefficients();
  EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
  scene.coordinates = JetCoordinates::automatic;
  const PropagationResult automatic = propagate(scene);
  names.insert(names.begin(), "auto coordinates");
  EXPECT_EQ(left_out(automatic), names);
  EXPECT_FALSE(automatic.runs[0].charted);
}

TEST(SkippedWork, OfAnEquatorialOrbitIsTheMotionOutOfThePlane) {
  Scene scene = kepler_chief(0.1, 7000, 1000, 2);
  scene.variables = {0, 1, 3, 4};
  PropagationResult result = propagate(scene);
  EXPECT_EQ(left_out(result), with_parts({"components z, pz", rotation}));
  EXPECT_EQ(result.runs[0].jet.size(), 4U);
  EXPECT_EQ(result.runs[0].counts.poisson_brackets, 6);  // 4 components in pairs
  scene.variables = {0, 1};
  result = propagate(scene);
  EXPECT_EQ(left_out(result), with_parts({"components z, pz", "variables px, py"}, false));
  EXPECT_EQ(result.runs[0].counts.poisson_brackets, 0);
}

}  // namespace
}  // namespace hamjet
