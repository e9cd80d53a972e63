#include "studies/flights/relative_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/single_transfer.hpp"

namespace hamjet {
namespace {

constexpr double radius_m = 7e6;

Scene circle() {
  return kepler_chief(0, radius_m / 1000, std::sqrt(std::pow(7000.0, 3) / 398600.4415), 1);
}

std::optional<RelativeDrift> drift_of(const Scene& scene, const Eigen::Vector3d& position_m,
                                      const Eigen::Vector3d& velocity_m_s = {0, 0, 0}) {
  const ChiefFrame frame(scene.nominal, metric_units(scene), RelativeFrame::rtn_rotating);
  return relative_drift(scene, scene.nominal, frame.deviation({position_m, velocity_m_s}),
                        scene.start_time, RelativeFrame::rtn_rotating);
}

// Clohessy and Wiltshire: x and y' drift by -(6 n x + 3 y') T a revolution, so that rest at x above
// a circle is 12 pi x backwards, and y' = -2 n x holds the place.
TEST(RelativeDrift, IsThatOfClohessyAndWiltshire) {
  const Scene scene = circle();
  const double n = 1 / scene.units.time_s;
  const double x = 10, speed = 0.004;
  const auto drift = drift_of(scene, {x, 0, 0}, {0, speed, 0});
  ASSERT_TRUE(drift.has_value());
  const double T = 2 * std::numbers::pi / n;
  const double linear = -(6 * n * x + 3 * speed) * T;
  EXPECT_NEAR(drift->per_revolution_m, linear, 1e-4 * std::abs(linear));
  ASSERT_TRUE(drift->holding_change_m_s.has_value());
  EXPECT_NEAR(speed + (*drift->holding_change_m_s)[1], -2 * n * x, 1e-4 * 2 * n * x);
}

// At rest behind its chief on a circle a deputy is higher by y^2/(2 a), and turns at the chief's
// rate: vis-viva gives its period, and Kepler's third law the drift, without approximation.
TEST(RelativeDrift, RestFarBehindIsNoPlaceThatHolds) {
  const Scene scene = circle();
  const double y = -60e3 / radius_m;
  const auto drift = drift_of(scene, {0, y * radius_m, 0});
  ASSERT_TRUE(drift.has_value());
  const double r = std::hypot(1, y);
  const double a = 1 / (2 / r - r * r);
  const double expected = -2 * std::numbers::pi * (std::pow(a, 1.5) - 1) * radius_m;
  EXPECT_LT(expected, -9000);
  EXPECT_NEAR(drift->per_revolution_m, expected, 1e-3);
  EXPECT_NEAR(drift->period_difference_s,
              2 * std::numbers::pi * (std::pow(a, 1.5) - 1) * scene.units.time_s, 1e-6);
  // With the energy of the chief, -1/2, there is none.
  ASSERT_TRUE(drift->holding_change_m_s.has_value());
  const Eigen::Vector3d inertial =
      Eigen::Vector3d(-y, 1, 0) + *drift->holding_change_m_s * scene.units.time_s / radius_m;
  EXPECT_NEAR(inertial.squaredNorm(), 2 / r - 1, 1e-11);
  const auto none = drift_of(scene, {0, y * radius_m, 0}, *drift->holding_change_m_s);
  ASSERT_TRUE(none.has_value());
  EXPECT_LT(std::abs(none->per_revolution_m), 0.01);
}

// On the chief's own path, some time later, a deputy passes each place as the chief did: no drift,
// whatever the zonal harmonics do to the orbit.
TEST(RelativeDrift, OnTheSamePathThereIsNone) {
  const Scene scene = paper_chief(1);
  const double later = 2e-3;
  std::vector<double> deviation =
      exact_flow(make_system(scene), scene.nominal, scene.start_time, -later);
  for (std::size_t i = 0; i < deviation.size(); ++i) deviation[i] -= scene.nominal[i];
  const auto drift =
      relative_drift(scene, scene.nominal, deviation, scene.start_time, RelativeFrame::inertial);
  ASSERT_TRUE(drift.has_value());
  EXPECT_LT(std::abs(drift->per_revolution_m), 0.01);
  ASSERT_TRUE(drift->holding_change_m_s.has_value());
  EXPECT_LT(drift->holding_change_m_s->norm(), 1e-6);
}

// An orbit that does not return drifts by no length a revolution.
TEST(RelativeDrift, AnEscapeHasNone) {
  const Scene scene = circle();
  EXPECT_FALSE(drift_of(scene, {0, 0, 0}, {0, 5000, 0}).has_value());
}

}  // namespace
}  // namespace hamjet
