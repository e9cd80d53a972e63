#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "app/estimated_deputies.hpp"

// The estimated miss of random deputies is compared with the true one. The program
// error_estimate_statistics does the same with hundreds of deputies.

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

// The axes are the chief's, and the chief's position is wrong by a part of a millimetre. This error
// turns the axes by little, but the deputy is twenty times as far away as the chief is from the
// centre.
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

/// A scene about an oblate earth, by Gauss to the rounding of the numbers.
DrawnDeputy about_the_earth(const std::array<double, 6>& nominal_km, JetCoordinates coordinates,
                            int order, double duration_s) {
  DrawnDeputy drawn;
  Scene& scene = drawn.scene;
  scene.name = "earth";
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.mu_km3_s2 = 398600.4415;
  scene.system.radius_km = 6378.1363;
  scene.system.J[2] = 1.08262668e-3;
  scene.units = units_of_axis(1, 1);  // in units of a kilometre
  scene.canonical_radius = scene.system.radius_km;
  for (std::size_t i = 0; i < 6; ++i) {
    scene.nominal.push_back(nominal_km[i] * (i < 3 ? 1 : scene.units.time_s));
    scene.variables.push_back(i);
  }
  scene.duration = duration_s / scene.units.time_s;
  scene.coordinates = coordinates;
  scene.order = order;
  IntegratorSettings gauss;
  gauss.label = "gauss";
  gauss.tolerance = 1e-12;
  scene.integrators = {gauss};
  drawn.frames = {"inertial", {}, {}};
  return drawn;
}

// The orbit is three degrees from the equatorial plane and ends 110 000 km from the centre. The
// rounding of the node is twenty times that of the position.
TEST(DeputyEstimate, HoldsWhatCoordinatesRoundNearTheirSingularities) {
  DrawnDeputy drawn = about_the_earth({-5687.27, 4735.29, -240.1, 7.67039, 6.59714, -0.388368},
                                      JetCoordinates::flow_box, 3, 46000);
  int judged = 0;
  for (const double metres : {0.05, 0.1, 0.3, 0.7}) {
    drawn.row = {-metres, -0.9 * metres, 1.5 * metres, -1e-3 * metres, 1e-3 * metres, 0};
    for (const bool is_stored : {false, true}) {
      drawn.is_stored = is_stored;
      const auto one = judged_deputy(drawn);
      ASSERT_TRUE(one);
      ++judged;
      EXPECT_LT(one->ratio(), 10) << metres << " " << one->error_m << " " << one->estimate.miss_m();
      EXPECT_LT(one->estimate.miss_m(), 1e-3);
    }
  }
  EXPECT_EQ(judged, 8);
}

// After a whole period the highest degree happens to contribute little although the series
// continues.
TEST(DeputyEstimate, IsNotDecidedByOneDegreeThatHappensToBeSmall) {
  DrawnDeputy drawn = about_the_earth({6199.08526506, -3881.14696549, -4193.04125836,
                                       -1.90084557041, 2.71665599309, -8.72075691986},
                                      JetCoordinates::nodal, 4, 121537);
  drawn.scene.system.J[3] = -2.53265648533224e-06;
  drawn.scene.system.J[4] = -1.619621591367e-06;
  drawn.row = {2701.12354, 2795.18724, -743.446166, -0.00751937872, -0.0900156269, -0.14996156};
  const auto one = judged_deputy(drawn);
  ASSERT_TRUE(one);
  EXPECT_GT(one->error_m, 1000);
  EXPECT_LT(one->ratio(), 3) << one->error_m << " " << one->estimate.miss_m();
}

}  // namespace
}  // namespace hamjet::test
