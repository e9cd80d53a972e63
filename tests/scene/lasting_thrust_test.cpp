#include <gtest/gtest.h>

#include <string>

#include "scene_samples.hpp"

// What a thrust that lasts does not look at is refused, for transfers and for assignments.

namespace hamjet::io {
namespace {

const std::string circle = circle_scene;
const std::string thrust_ends = R"([transfer]
times_s = [16, 32]
thrust = "energy-optimal"
)";
const std::string places = R"(start = { position_m = [1, 2, 30] }
end = { position_m = [0, 0, 40] }
)";
const std::string slots = R"([[assignment.deputy]]
position_m = [1, 2, 3]
[[assignment.slot]]
position_m = [4, 5, 6]
)";

TEST(LastingThrust, OfATransferRefusesAnEllipsoidToStayOutOf) {
  parse_scene(circle + thrust_ends + places, "file.toml");
  expect_scene_error(circle + thrust_ends + "keep_out_m = [1, 1, 1]\n" + places,
                     {"transfer.keep_out_m: not looked at on ways of a thrust that lasts",
                      "got an array", "beside thrust = \"impulses\""});
  const std::string least_fuel =
      "[transfer]\ntimes_s = [16, 32]\nthrust = \"fuel-optimal\"\n" + places;
  const std::string thruster = "[thruster]\nacceleration_m_s2 = 1\n";
  parse_scene(circle + least_fuel + thruster, "file.toml");
  expect_scene_error(circle + least_fuel + "keep_out_m = [1, 1, 1]\n" + thruster,
                     {"transfer.keep_out_m: not looked at on ways of a thrust that lasts"});
}

TEST(LastingThrust, OfAnAssignmentRefusesBudgetAndThruster) {
  parse_scene(circle + thrust_ends + slots, "file.toml");
  expect_scene_error(circle + thrust_ends + "budget_m_s = 2\n" + slots,
                     {"assignment: transfer.budget_m_s, got it beside a thrust that lasts"});
  expect_scene_error(circle + thrust_ends + slots + "[thruster]\nacceleration_m_s2 = 0.01\n",
                     {"assignment: thruster: got the table [thruster] beside a thrust that lasts",
                      "largest_thrust_m_s2"});
}

}  // namespace
}  // namespace hamjet::io
