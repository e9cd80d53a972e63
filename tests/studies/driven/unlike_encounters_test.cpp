#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "algebra/state_sums.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/earth_system.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/uncertainty/collision_study.hpp"
#include "studies/uncertainty/safety_study.hpp"

// Collisions and passive safety of deputies with another C_D A / m, or C_R A / m, than their chief.
// Expected: flights of each spacecraft in a scene of its own, whose chief it is, and closed forms.

namespace hamjet::unlike_encounters_tests {
namespace {

constexpr double chief_drag = 0.02;
constexpr double deputy_drag = 0.03;
constexpr double density = 1e-12;
/// Standard deviations along each axis, of both spacecraft.
constexpr double position_m = 0.5;
constexpr double velocity_m_s = 2e-4;

/// What a deceleration f, the difference of both, leads forwards: 3/2 f t^2 (Clohessy-Wiltshire
/// without the terms of one revolution, 4 f / n^2).
double lead_m(double t) {
  const double speed_squared = 398600.4415e9 / 6878.1363e3;
  return 1.5 * (deputy_drag - chief_drag) * density * speed_squared / 2 * t * t;
}

/// A polar orbit in air of one density, and a deputy so far behind that its drag leads it to the
/// chief after six hours.
Scene catching_up(double drag, const std::string& uncertainty) {
  const std::string known = "position_m = [0.5, 0.5, 0.5]\nvelocity_m_s = [2e-4, 2e-4, 2e-4]\n";
  return io::parse_scene(
      "[system]\nmodel = \"earth\"\ngravity_degree = 2\nsun = false\nmoon = false\n"
      "atmosphere = \"table\"\nheights_km = [100, 300, 600, 900]\n"
      "densities_kg_m3 = [1e-12, 1e-12, 1e-12, 1e-12]\n[spacecraft]\ndrag_m2_kg = 0.02\n"
      "[nominal]\nepoch_utc = \"2026-03-01T06:00:00\"\nheight_km = 500\ni_deg = 90\n"
      "raan_deg = 30\nu_deg = 0\n[deputy]\nposition_m = [0, " +
          std::to_string(-lead_m(6 * 3600)) + ", 0]\nspacecraft = { drag_m2_kg = " +
          std::to_string(drag) + " }\n[jet]\norder = 2\nduration_s = 25200\n[uncertainty]\n" +
          known + "[uncertainty.deputy]\n" + known + uncertainty,
      "unlike.toml");
}

/// Flights of a spacecraft with the coefficients of the scene's chief, which know of no other one.
class Alone {
 public:
  explicit Alone(Scene scene) : scene_(std::move(scene)) {
    scene_.deputy.reset();
    system_ = SharedSystem(make_system(scene_));
  }
  std::vector<double> end(const std::vector<double>& state, double from, double to) const {
    return exact_flow(system_, state, scene_.start_time + from, to - from);
  }

 private:
  Scene scene_;
  SharedSystem system_;
};

Scene of_deputy(Scene scene) {
  EarthSettings& earth = *scene.system.earth;
  earth.drag_m2_kg = scene.deputy->drag_m2_kg.value_or(earth.drag_m2_kg);
  earth.radiation_m2_kg = scene.deputy->radiation_m2_kg.value_or(earth.radiation_m2_kg);
  return scene;
}

std::vector<double> deputy_start(const Scene& scene, const RelativeState& start) {
  return state_sum(
      scene.nominal,
      ChiefFrame(scene.nominal, metric_units(scene), scene.deputy->frame).deviation(start));
}

/// The least distance, in metres, of two flights in a window, looked at from time to time and by
/// straight lines between the looks along axes that turn with the first: there both drift by
/// centimetres a second.
class Separation {
 public:
  Separation(const Scene& scene, double from_s, double to_s)
      : units_(metric_units(scene)), from_s_(from_s), to_s_(to_s) {}

  double least_m(const Alone& one, std::vector<double> first, const Alone& other,
                 std::vector<double> second) const {
    double now = from_s_ / units_.time_s;
    const double step = 120 / units_.time_s;
    first = one.end(first, 0, now);
    second = other.end(second, 0, now);
    double least = std::numeric_limits<double>::infinity();
    Eigen::Vector3d before = apart(first, second);
    while (now < to_s_ / units_.time_s - 1e-9) {
      first = one.end(first, now, now + step);
      second = other.end(second, now, now + step);
      now += step;
      const Eigen::Vector3d after = apart(first, second);
      const Eigen::Vector3d way = after - before;
      const double part = std::clamp(-before.dot(way) / way.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (before + part * way).norm());
      before = after;
    }
    return least * units_.length_m;
  }

 private:
  static Eigen::Vector3d apart(const std::vector<double>& first,
                               const std::vector<double>& second) {
    return ChiefFrame(first, {}, RelativeFrame::rtn_inertial)
        .along_axes({second[0] - first[0], second[1] - first[1], second[2] - first[2]});
  }

  MetricUnits units_;
  double from_s_;
  double to_s_;
};

TEST(UnlikeEncounters, CollisionsAreAsFrequentAsInFlights) {
  const std::string collision =
      "[uncertainty.collision]\nradius_m = 25\nwindow_s = [20400, 22800]\nsamples = 20000\n";
  const Scene scene = catching_up(deputy_drag, collision);
  const CollisionResult result = study_collision(scene, 2);
  const double told = result.probability.probability;
  const Alone chief(scene), deputy(of_deputy(scene));
  const Separation separation(scene, result.from_s, result.to_s);
  std::mt19937_64 generator(11);
  std::normal_distribution<double> normal;
  constexpr int flights = 200;
  int hits = 0;
  for (int k = 0; k < flights; ++k) {
    std::array<std::vector<double>, 2> starts = {scene.nominal,
                                                 deputy_start(scene, scene.deputy->start)};
    for (std::vector<double>& start : starts) {
      RelativeState drawn;
      for (double& x : drawn.position_m) x = position_m * normal(generator);
      for (double& x : drawn.velocity_m_s) x = velocity_m_s * normal(generator);
      start = state_sum(
          start,
          ChiefFrame(start, metric_units(scene), RelativeFrame::rtn_inertial).deviation(drawn));
    }
    hits += separation.least_m(chief, starts[0], deputy, starts[1]) < result.watch.radius_m ? 1 : 0;
  }
  const double counted = static_cast<double>(hits) / flights;
  // Five standard deviations of the number of hits.
  EXPECT_NEAR(counted, told, 5 * std::sqrt(told * (1 - told) / flights));
  EXPECT_GT(told, 0.1);
  EXPECT_LT(told, 0.9);
  EXPECT_LE(result.probability.lower, told);
  EXPECT_LT(result.probability.path_error, 0.1);
  // Deputies like their chief stay where they are.
  const CollisionResult alike = study_collision(catching_up(chief_drag, collision), 2);
  EXPECT_LT(alike.probability.probability, 0.2 * told);
}

TEST(UnlikeEncounters, SafetyIsThatOfFlights) {
  const Scene scene = catching_up(
      deputy_drag,
      "[uncertainty.safety]\nkeep_apart_m = 20\nwindow_s = [10800, 18000]\nsamples = 400\n"
      "keep_out_m = [10, 20, 10]\n[[uncertainty.safety.deputy]]\nposition_m = [0, -600, 0]\n");
  const SafetyResult result = study_safety(scene, 2);
  ASSERT_EQ(result.pairs.size(), 3U);
  const Alone chief(scene), deputy(of_deputy(scene));
  const Separation separation(scene, result.from_s, result.to_s);
  RelativeState farther;
  farther.position_m = {0, -600, 0};
  const std::vector<double> of_chief = scene.nominal;
  const std::vector<double> of_first = deputy_start(scene, scene.deputy->start);
  const std::vector<double> of_second = deputy_start(scene, farther);
  const auto expect_mean = [&](std::size_t pair, const std::string& first,
                               const std::string& second, double expected) {
    EXPECT_EQ(result.pairs[pair].first, first);
    EXPECT_EQ(result.pairs[pair].second, second);
    EXPECT_NEAR(result.pairs[pair].mean_separation_m, expected, 2e-3);
  };
  expect_mean(0, "chief", "deputy", separation.least_m(chief, of_chief, deputy, of_first));
  expect_mean(1, "chief", "deputy 2", separation.least_m(chief, of_chief, deputy, of_second));
  expect_mean(2, "deputy", "deputy 2", separation.least_m(deputy, of_first, deputy, of_second));
  // After five hours 25/36 of the way are behind it.
  EXPECT_NEAR(result.pairs[0].mean_separation_m, lead_m(6 * 3600) * 11 / 36, 15);
  // The polynomials are right to the flights with random deviations, each by its own forces.
  for (const SafetyPair& pair : result.pairs) EXPECT_LT(pair.separations.errors[0], 0.05);
  ASSERT_TRUE(result.pairs[0].margin && result.pairs[0].margin->deviations);
  EXPECT_TRUE(result.pairs[0].margin->is_confirmed());
}

// Geostationary satellites in the season of eclipses, of which one has 30 % more area in the light.
TEST(UnlikeEncounters, OfOtherAreaInTheLight) {
  const Scene scene = io::parse_scene(R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
radiation = true
[spacecraft]
radiation_m2_kg = 0.02
[nominal]
epoch_utc = "2026-03-19T20:00:00"
a_km = 42165
e = 0
i_deg = 0.05
raan_deg = 80
u_deg = 50
[deputy]
position_m = [0, -200, 0]
spacecraft = { radiation_m2_kg = 0.026 }
[jet]
order = 2
duration_s = 43200
[uncertainty]
position_m = [1, 1, 1]
[uncertainty.safety]
keep_apart_m = 20
window_s = [36000, 43200]
samples = 200
)",
                                      "light.toml");
  const SafetyResult result = study_safety(scene, 1);
  ASSERT_EQ(result.pairs.size(), 1U);
  const Alone chief(scene), deputy(of_deputy(scene));
  const std::vector<double> start = deputy_start(scene, scene.deputy->start);
  const Separation separation(scene, result.from_s, result.to_s);
  const double flown = separation.least_m(chief, scene.nominal, deputy, start);
  EXPECT_NEAR(result.pairs[0].mean_separation_m, flown, 2e-3);
  // With the chief's area it would be elsewhere by metres.
  EXPECT_GT(std::abs(separation.least_m(chief, scene.nominal, chief, start) - flown), 1);
}

}  // namespace
}  // namespace hamjet::unlike_encounters_tests
