#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/transfer.hpp"
#include "low_orbit_text.hpp"
#include "studies/checks/force_sizes.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "support/errors.hpp"

// Studies of spacecraft in the air: a deputy with another C_D A / m is predicted by the chief's
// jet, which is expanded in it.

namespace hamjet {
namespace {

/// Half a day, 514 km up, with zonal harmonics of degree 2; the deputy is with its chief.
Scene scene_of(double chief, double deputy, const std::string& more = {}) {
  return io::parse_scene(
      low_pair_text("atmosphere = \"harris-priester\"", chief, deputy, 97.5, "0, 0, 0") + more,
      "drag.toml");
}

TEST(DragStudies, DeputiesOfOtherDragAreOnTheChiefsJet) {
  // 30 % more area.
  const DeputyMotion motion = study_deputy_motion(scene_of(0.01, 0.013));
  const DeputyMotionPoint& last = motion.points.back();
  const double away = last.state.position_m.norm();
  // A flight of the deputy's own, in a scene whose chief it is: no parameter, no jet.
  const Scene alone = scene_of(0.013, 0.013);
  const Scene chief = scene_of(0.01, 0.01);
  const auto end = [](const Scene& scene) {
    return exact_flow(make_system(scene), scene.nominal, scene.start_time, scene.duration);
  };
  const std::vector<double> a = end(alone), b = end(chief);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  const double length_m = chief.units.length_km * 1000;
  // Flights of half a day differ by their rounding, some micrometres.
  EXPECT_NEAR(away, std::sqrt(square) * length_m, 1e-4);
  EXPECT_GT(away, 50);
  // With one number that differs, degree 1 is linear in it, degree 2 nearly right.
  EXPECT_LT(motion.largest_error_m(3), 1e-3);
  EXPECT_GT(motion.largest_error_m(1), 10 * motion.largest_error_m(2));
}

TEST(DragStudies, AheadByThreeHalvesOfTheDeceleration) {
  const DeputyMotion motion = study_deputy_motion(scene_of(0.01, 0.0102));
  const std::vector<ForceSize> forces = force_sizes(scene_of(0.01, 0.0102));
  const auto drag = std::find_if(forces.begin(), forces.end(),
                                 [](const ForceSize& force) { return force.name == "drag"; });
  ASSERT_NE(drag, forces.end());
  // 3/2 da t^2 with the largest deceleration of the orbit; the bulge makes the mean smaller, but
  // not below a fifth of it (the table's densities at 514 km differ by a factor of 5.6).
  const double most = 1.5 * 0.02 * drag->largest_m_s2 * 43200.0 * 43200.0;
  const double ahead = motion.points.back().state.position_m[1];
  EXPECT_LT(ahead, most);
  EXPECT_GT(ahead, most / 5.6);
}

TEST(DragStudies, NoDragIsNoChange) {
  const Scene none = scene_of(0, 0);
  Scene without = none;
  without.system.earth->atmosphere.reset();
  const auto end = [](const Scene& scene) {
    return exact_flow(make_system(scene), scene.nominal, scene.start_time, scene.duration);
  };
  const std::vector<double> a = end(none), b = end(without);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(a[i], b[i], 1e-11) << i;
}

TEST(DragStudies, RunsSayThatTheMapIsNotSymplectic) {
  const std::string variables =
      "variables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\", \"drag_m2_kg\"]\n";
  const PropagationResult plain = propagate(scene_of(0.01, 0.01));
  ASSERT_EQ(plain.runs.size(), 1U);
  EXPECT_TRUE(plain.runs[0].failed_checks.empty());
  ASSERT_FALSE(plain.runs[0].symplecticity.empty());
  const auto check =
      std::find_if(plain.runs[0].checks.begin(), plain.runs[0].checks.end(),
                   [](const SelfCheck& one) { return one.name == SelfCheckName::symplecticity; });
  ASSERT_NE(check, plain.runs[0].checks.end());
  EXPECT_NE(check->text.find("not symplectic"), std::string::npos) << check->text;
  // Degree 0 of the brackets is the defect of the linear map, which drag makes: far above rounding.
  EXPECT_GT(plain.runs[0].symplecticity[0].scaled, 1e-9);
  const PropagationResult more = propagate(scene_of(0.01, 0.01, variables));
  ASSERT_TRUE(more.runs[0].failure.empty()) << more.runs[0].failure;
  EXPECT_TRUE(more.runs[0].failed_checks.empty());
  EXPECT_EQ(more.runs[0].jet[0].space().variables(), 7U);
  // The jet in seven variables holds the one in six.
  for (std::size_t i = 0; i < 6; ++i) {
    const double one = static_cast<double>(plain.runs[0].jet[i][1]);
    EXPECT_NEAR(static_cast<double>(more.runs[0].jet[i][1]), one, 1e-9 * (1 + std::abs(one)));
  }
}

TEST(DragStudies, TransfersAreSymplecticNoMoreAndArriveAllTheSame) {
  const std::string transfer = "[transfer]\ncount = 2\nend = { position_m = [0, -100, 0] }\n";
  const TransferResult same = study_transfer(scene_of(0.01, 0.01, transfer));
  ASSERT_EQ(same.points.size(), 2U);
  for (const TransferPoint& point : same.points) {
    ASSERT_TRUE(point.has_answer()) << point.failure;
    EXPECT_LT(point.best().miss_m, 1e-3);
  }
}

TEST(DragStudies, OtherStudiesRefuseDeputiesThatDiffer) {
  test::expect_error(ErrorKind::scene, "alike",
                     [&] { study_validity(scene_of(0.01, 0.02, "[validity]\n")); });
}

}  // namespace
}  // namespace hamjet
