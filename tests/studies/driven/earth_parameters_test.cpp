#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/fields/spherical_harmonic_field.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "studies/earth_system.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/deputy_motion.hpp"

// Parameters of the real Earth as variables of jets, in the units of their names. Derivatives to
// degree 3 are compared by ParameterFlow, with forces written by hand.

namespace hamjet {
namespace {

const std::vector<std::string> names = {"J2",           "thrust_T_m_s2", "density_factor",
                                        "mu_km3_s2",    "thrust_N_m_s2", "drag_m2_kg",
                                        "thrust_R_m_s2"};

Scene scene_of(double duration_s, int order, bool has_parameters = true) {
  std::string variables;
  if (has_parameters) {
    variables = fmt::format(R"(variables = ["x", "y", "z", "px", "py", "pz", "{}"])",
                            fmt::join(names, "\", \""));
  }
  return io::parse_scene(fmt::format(R"(schema = 1
[system]
model = "earth"
gravity_degree = 4
moon = false
atmosphere = "harris-priester"
density_factor = 1.25
[spacecraft]
drag_m2_kg = 2
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 400
i_deg = 63
raan_deg = 30
u_deg = 20
[jet]
order = {}
duration_s = {}
{}
)",
                                     order, duration_s, variables),
                         "earth.toml");
}

/// The derivative of the end by a parameter, from a jet.
std::vector<double> derivative_of(const RunResult& run, std::size_t parameter) {
  std::vector<double> result;
  const std::size_t index = run.jet[0].space().linear_index(6 + parameter);
  for (std::size_t i = 0; i < 6; ++i) result.push_back(static_cast<double>(run.jet[i][index]));
  return result;
}

/// The end of a flight in the units of `scene`, where a change may make the unit of time another.
std::vector<double> end_of(const Scene& scene, const std::function<void(SystemSettings&)>& change) {
  SystemSettings settings = scene.system;
  change(settings);
  const double slower = std::sqrt(scene.system.mu_km3_s2 / settings.mu_km3_s2);
  std::vector<double> start = scene.nominal;
  for (std::size_t i = 3; i < 6; ++i) start[i] *= slower;
  std::vector<double> end = exact_flow(make_system(settings, scene.canonical_radius), start,
                                       scene.start_time, scene.duration / slower);
  for (std::size_t i = 3; i < 6; ++i) end[i] /= slower;
  return end;
}

/// (f(-2h) - 8 f(-h) + 8 f(h) - f(2h)) / 12h, whose error is h^4 relative to a fifth derivative.
std::vector<double> by_differences(const Scene& scene, double h,
                                   const std::function<void(SystemSettings&, double)>& change) {
  std::vector<double> result(6, 0);
  for (const auto& [k, weight] : {std::pair(-2, 1), {-1, -8}, {1, 8}, {2, -1}}) {
    const auto end = end_of(scene, [&](SystemSettings& s) { change(s, k * h); });
    for (std::size_t i = 0; i < 6; ++i) result[i] += weight * end[i] / (12 * h);
  }
  return result;
}

void expect_same(const std::vector<double>& found, const std::vector<double>& right,
                 const std::string& what) {
  double size = 0;
  for (const double x : right) size = std::max(size, std::abs(x));
  ASSERT_GT(size, 0) << what;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], right[i], 1e-8 * size) << what << i;
}

TEST(EarthParameters, DerivativesAreThoseOfScenesWithOtherNumbers) {
  const Scene scene = scene_of(4000, 2);
  const Scene plain = scene_of(4000, 2, false);
  EXPECT_EQ(scene.nominal.size(), 13U);
  const PropagationResult result = propagate(scene);
  const RunResult& run = result.runs.at(0);
  ASSERT_EQ(run.failure, "");
  EXPECT_TRUE(run.failed_checks.empty());
  expect_same(derivative_of(run, 0),
              by_differences(plain, 1e-4,
                             [](SystemSettings& s, double h) {
                               auto field = *s.earth->field;
                               field.C(2, 0) -= h / std::sqrt(5.0);
                               s.earth->field =
                                   std::make_shared<const SphericalHarmonicCoefficients>(field);
                             }),
              "J2");
  expect_same(
      derivative_of(run, 2),
      by_differences(plain, 0.2,
                     [](SystemSettings& s, double h) { s.earth->atmosphere->density_factor += h; }),
      "density_factor");
  expect_same(derivative_of(run, 3),
              by_differences(plain, 40, [](SystemSettings& s, double h) { s.mu_km3_s2 += h; }),
              "mu");
  expect_same(
      derivative_of(run, 5),
      by_differences(plain, 0.3, [](SystemSettings& s, double h) { s.earth->drag_m2_kg += h; }),
      "drag");
}

// In a short time t a constant acceleration moves by t^2 / 2; gravity's gradient changes that by
// n^2 t^2 of it, here 1.3e-4.
TEST(EarthParameters, ThrustsAreAlongTheOrbitsAxes) {
  const double time = 10;
  const Scene scene = scene_of(time, 1);
  const PropagationResult result = propagate(scene);
  const RunResult& run = result.runs.at(0);
  const auto& z = scene.nominal;
  const Eigen::Vector3d q(z[0], z[1], z[2]), p(z[3], z[4], z[5]);
  const Eigen::Vector3d R = q.normalized(), N = q.cross(p).normalized(), T = N.cross(R);
  const std::pair<std::size_t, Eigen::Vector3d> axes[] = {{6, R}, {1, T}, {4, N}};
  for (const auto& [place, axis] : axes) {
    const std::vector<double> derivative = derivative_of(run, place);
    const Eigen::Vector3d moved_m =
        Eigen::Vector3d(derivative.data()) * scene.units.length_km * 1000;
    // The axes turn by n t meanwhile, a third of which counts.
    EXPECT_NEAR((moved_m - axis * time * time / 2).norm(), 0, 0.006 * time * time / 2)
        << names[place];
    EXPECT_NEAR(moved_m.dot(axis), time * time / 2, 5e-4 * time * time / 2) << names[place];
  }
}

// Momenta and parameters are no positions: the lowest point is that of the orbit alone, to what
// another choice of steps leaves.
TEST(EarthParameters, LowestPointIsThatOfTheOrbit) {
  const auto lowest_of = [](bool has_parameters) {
    return propagate(scene_of(6000, 1, has_parameters)).runs.at(0).lowest_point;
  };
  const auto with = lowest_of(true), without = lowest_of(false);
  ASSERT_TRUE(with && without);
  EXPECT_NEAR(with->distance, without->distance, 1e-9);
}

// Deputies are predicted in positions, momenta and what they differ in alone.
TEST(EarthParameters, MotionOfDeputiesLeavesTheOthersOut) {
  const auto motion_of = [](bool has_parameters) {
    Scene scene = scene_of(4000, 2, has_parameters);
    scene.deputy.emplace();
    scene.deputy->start.position_m = {0, -500, 0};
    scene.deputy->drag_m2_kg = 2.2;
    return study_deputy_motion(scene);
  };
  const DeputyMotion with = motion_of(true), without = motion_of(false);
  ASSERT_EQ(with.points.size(), without.points.size());
  EXPECT_EQ(with.points.back().state.position_m, without.points.back().state.position_m);
}

}  // namespace
}  // namespace hamjet
