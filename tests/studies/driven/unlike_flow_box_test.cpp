#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"
#include "studies/formation/deputy_motion.hpp"

// Flow boxes whose polynomials have the deputy's own ballistic coefficient among their variables.

namespace hamjet {
namespace {

Scene far_behind(double kilometres, double area_m2, const std::string& coordinates) {
  return io::parse_scene(
      R"(schema = 1
[system]
model = "earth"
gravity_degree = 4
atmosphere = "harris-priester"
[spacecraft]
mass_kg = 4
area_m2 = 0.03
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 420
i_deg = 97.5
raan_deg = 30
u_deg = 0
[deputy]
position_m = [0, )" +
          std::to_string(-1000 * kilometres) +
          R"(, 0]
spacecraft = { mass_kg = 4, area_m2 = )" +
          std::to_string(area_m2) + R"( }
[jet]
order = 3
duration_s = 11000
coordinates = ")" +
          coordinates + "\"\n",
      "x");
}

// 60 km behind, with 30 % more area than the chief: beside flights with the full equations each
// order of the flow box is right to far less than that of positions and velocities, and the
// difference that the area makes, which is metres, is in it.
TEST(UnlikeFlowBox, ADeputyWithMoreDragIsPredictedFarAway) {
  const DeputyMotion box = study_deputy_motion(far_behind(60, 0.039, "flow-box"));
  EXPECT_EQ(box.coordinates.start, JetCoordinates::flow_box);
  const DeputyMotion cartesian = study_deputy_motion(far_behind(60, 0.039, "cartesian"));
  const DeputyMotion alike = study_deputy_motion(far_behind(60, 0.03, "flow-box"));
  const double by_drag =
      (box.flown.states.back().position_m - alike.flown.states.back().position_m).norm();
  EXPECT_GT(by_drag, 1);
  for (int order = 1; order <= 3; ++order) {
    EXPECT_LT(box.largest_error_m(order), 0.1 * cartesian.largest_error_m(order)) << order;
  }
  EXPECT_LT(box.largest_error_m(3), 0.01 * by_drag);
}

// The error of order n falls by 2^(n+1), or more, when all deviations are halved, that of the
// coefficient among them.
TEST(UnlikeFlowBox, ErrorsFallAsTheNextDegree) {
  const DeputyMotion whole = study_deputy_motion(far_behind(160, 0.054, "flow-box"));
  const DeputyMotion half = study_deputy_motion(far_behind(80, 0.042, "flow-box"));
  for (int order = 1; order <= 2; ++order) {
    const double at_end = whole.points.back().errors_m[static_cast<std::size_t>(order) - 1] /
                          half.points.back().errors_m[static_cast<std::size_t>(order) - 1];
    EXPECT_GT(std::log2(at_end), order + 0.5) << order;
  }
}

// `auto` measures how far deputies are predicted that are like the chief, and takes the flow box.
TEST(UnlikeFlowBox, AutoTakesIt) {
  const DeputyMotion motion = study_deputy_motion(far_behind(60, 0.039, "auto"));
  EXPECT_EQ(motion.coordinates.start, JetCoordinates::flow_box);
  EXPECT_FALSE(motion.coordinates.reaches.empty());
}

}  // namespace
}  // namespace hamjet
