#include "../../src/studies/stability/rounding_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/stability/stability.hpp"
#include "support/magnitude.hpp"
#include "support/scenes.hpp"

// What rounding does is bounded on the oscillator, whose flow is a rotation and amplifies
// nothing, and compared with half-ulp starts integrated in extended precision on Kepler's problem.

namespace hamjet {
namespace {

constexpr double u = 0x1p-53;

const std::string oscillator_case = R"(schema = 1
title = "oscillator"
)" + test::oscillator_tables + R"([jet]
order = 1
duration_canonical = 10
)" + test::gauss8("step_canonical = 0.1");

const std::string eccentric_orbit = R"(schema = 1
title = "Kepler from perigee, e = 0.9"
)" + test::perigee_tables + R"([jet]
order = 1
duration_canonical = 6.5
)" + test::gauss8("tolerance = 1e-15");

Scene scene_of(const std::string& text, const std::vector<io::Override>& changes = {}) {
  return io::parse_scene(text, "case.toml", changes);
}

RoundingFloor floor_of(const Scene& scene) {
  RoundingSample sample;
  sample.follow(scene, make_problem(scene));
  return sample.floor();
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// A number between -1 and 1.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(static_cast<std::int64_t>(random()) >> 11) * 0x1p-52;
}

TEST(RoundingSample, NoStepRoundsNothing) {
  const RoundingFloor floor =
      floor_of(scene_of(oscillator_case, {{"jet.duration_canonical", "0"}}));
  EXPECT_EQ(largest(floor.state), 0);
  EXPECT_EQ(largest(floor.matrix), 0);
}

// A rotation keeps the size of what was rounded. Of all that a step of 0.1 on a circle of radius 1
// disturbs the sum is below u (1 + 2 x 0.1 + 0.1) by random numbers and 0.1 u by the rounded
// coefficients; the start and the duration of 10 add u and 10 u.
TEST(RoundingSample, OnACircleItIsBelowTheSumOfAllRoundings) {
  for (const char* steps : {"0.1", "0.01"}) {
    const RoundingFloor floor =
        floor_of(scene_of(oscillator_case, {{"integrator.gauss8.step_canonical", steps}}));
    const double step = std::stod(steps);
    const double all = u * (1 + 10 + 10 / step * (std::sqrt(2) * (1 + 3 * step) + step));
    const double random = u * std::sqrt(10 / step);
    for (const auto& values : {floor.state, floor.matrix}) {
      EXPECT_LT(largest(values), all);
      EXPECT_GT(largest(values), random);
    }
  }
}

// The same sample, in 113 bits.
TEST(RoundingSample, FollowsThePrecision) {
  const RoundingFloor coarse = floor_of(scene_of(oscillator_case));
  const RoundingFloor fine = floor_of(scene_of(oscillator_case, {{"precision", "\"extended\""}}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(fine.state[i] / (coarse.state[i] * 0x1p-60), 1, 1e-6);
  }
}

// 16 half-ulp starts, integrated in extended precision: the floor, which has the roundings on the
// way besides, is above what they do to each component and each first derivative, and not above a
// thousand times of the largest.
TEST(RoundingSample, HoldsWhatHalfUlpStartsDo) {
  const Scene scene = scene_of(eccentric_orbit, {{"jet.order", "2"}});
  const ComputedProblem problem = make_problem(scene);
  const RoundingFloor floor = floor_of(scene);
  const auto flow_from = [&](const std::vector<Extended>& start) {
    FlowProblem<Extended> flow{problem.system, problem.space,      problem.variables,
                               start,          problem.start_time, Extended(scene.duration)};
    GaussSettings gauss;
    gauss.stages = 16;
    gauss.tolerance = 1e-22;
    IntegrationStatistics statistics;
    return integrate_gauss<Extended>(flow, gauss, statistics);
  };
  const std::vector<Extended> start(problem.nominal.begin(), problem.nominal.end());
  const FlowJet<Extended> jet = flow_from(start);
  std::mt19937_64 random(7);
  const std::size_t n = jet.size();
  std::vector<double> state(n, 0);
  std::vector<double> matrix(n * n, 0);
  for (int sample = 0; sample < 16; ++sample) {
    std::vector<Extended> moved = start;
    for (Extended& x : moved) x += x * u * uniform(random);
    const FlowJet<Extended> other = flow_from(moved);
    for (std::size_t i = 0; i < n; ++i) {
      const auto difference = [&](std::size_t k) {
        return std::abs(static_cast<double>(Extended(other[i][k] - jet[i][k])));
      };
      state[i] = test::larger(state[i], difference(0));
      for (std::size_t j = 0; j < n; ++j) {
        double& entry = matrix[i * n + j];
        entry = test::larger(entry, difference(problem.space->linear_index(j)));
      }
    }
  }
  ASSERT_EQ(n, 6U);  // all components of the model, expanded in all of them
  for (std::size_t i = 0; i < n; ++i) EXPECT_LE(state[i], floor.state[i]) << i;
  for (std::size_t k = 0; k < n * n; ++k) EXPECT_LE(matrix[k], floor.matrix[k]) << k;
  EXPECT_LT(largest(floor.state), 1e3 * largest(state));
  EXPECT_LT(largest(floor.matrix), 1e3 * largest(matrix));
  // What symmetry keeps at zero is not disturbed: the orbit lies in a plane.
  EXPECT_EQ(floor.state[2], 0);
  EXPECT_EQ(floor.matrix[2], 0);
}

// Runs that round differently: other steps, other summation, explicit methods. Each differs from
// the flow in extended precision by less than the verdict allows; a mistake of 1e-9 in the system
// is far above it.
TEST(RoundingSample, HoldsEveryWayOfRounding) {
  const Scene exact = scene_of(eccentric_orbit, {{"precision", "\"extended\""},
                                                 {"integrator.gauss8.stages", "12"},
                                                 {"integrator.gauss8.tolerance", "1e-24"}});
  const FlowJet<Extended> right = propagate(exact).runs.front().jet;
  for (const auto& changes : std::vector<std::vector<io::Override>>{
           {},
           {{"integrator.gauss8.compensated_summation", "false"}},
           {{"integrator.gauss8.stages", "6"}},
           {{"integrator.gauss8.stages", "12"}},
           {{"jet.order", "3"}}}) {
    StabilityCase subject{"case", "title", "group", "why", {}, scene_of(eccentric_orbit, changes)};
    for (const Series<Extended>& component : right) {
      subject.expected.state.push_back(component[0]);
      for (std::size_t k = 1; k <= 6; ++k) subject.expected.matrix.push_back(component[k]);
    }
    EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::right)
        << run_stability_case(subject).text;
    subject.expected.state[0] *= Extended(1) + Extended(1e-9);
    EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
  }
}

}  // namespace
}  // namespace hamjet
