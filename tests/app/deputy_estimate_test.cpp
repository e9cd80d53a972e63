#include <gtest/gtest.h>

#include <cstdint>

#include "app/estimated_deputies.hpp"

// The estimated miss of random deputies beside the true one; error_estimate_statistics does the
// same with hundreds.

namespace hamjet::test {
namespace {

TEST(DeputyEstimate, IsNotFarBelowTheMissOfRandomDeputies) {
  int judged = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const DrawnDeputy drawn = drawn_deputy(seed);
    if (drawn.scene.coordinates == JetCoordinates::automatic) continue;  // takes long
    const auto one = judged_deputy(drawn);
    if (!one) continue;
    ++judged;
    EXPECT_LT(one->ratio(), 30) << description(drawn, *one) << ": miss " << one->error_m
                                << " m, estimate " << one->estimate.miss_m() << " m";
  }
  EXPECT_GT(judged, 15);
}

// The axes are the chief's, and the chief is a part of a millimetre from where it is said to be: so
// little turns them, and the deputy is twenty times as far away as the chief is from the centre.
TEST(DeputyEstimate, HoldsWhatTheChiefsErrorTurnsTheAxesBy) {
  DrawnDeputy drawn;
  Scene& scene = drawn.scene;
  scene.name = "far";
  scene.system.model = SystemModel::kepler;
  constexpr double e = 0.9;
  scene.units = units_of_axis(70000, 1);
  // At the perigee of an inclined ellipse.
  const double speed = std::sqrt((1 + e) / (1 - e));
  scene.nominal = {(1 - e) * 0.6,      (1 - e) * 0.8,     0,
                   -0.8 * speed * 0.8, 0.6 * speed * 0.8, speed * 0.6};
  scene.variables = {0, 1, 2, 3, 4, 5};
  scene.duration = 20 * std::numbers::pi;
  scene.order = 3;
  scene.coordinates = JetCoordinates::flow_box;
  IntegratorSettings gauss;
  gauss.label = "gauss";
  gauss.tolerance = 1e-12;
  scene.integrators = {gauss};
  drawn.frames = {"RTN", {}, "inertial"};
  drawn.row = {0, 0, 0, 0, 9, 0};
  const auto in_axes = judged_deputy(drawn);
  ASSERT_TRUE(in_axes);
  EXPECT_GT(in_axes->error_m, 1e-5);
  EXPECT_LT(in_axes->ratio(), 10) << in_axes->error_m << " " << in_axes->estimate.miss_m();
  // Along inertial axes nothing turns.
  drawn.frames.frame = "inertial";
  drawn.frames.derivatives.reset();
  drawn.row = {0, 0, 0, -0.8 * 0.8 * 9, 0.6 * 0.8 * 9, 0.6 * 9};
  const auto inertial = judged_deputy(drawn);
  ASSERT_TRUE(inertial);
  EXPECT_LT(inertial->ratio(), 10);
  EXPECT_LT(inertial->estimate.miss_m(), in_axes->estimate.miss_m());
}

}  // namespace
}  // namespace hamjet::test
