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
                     {"transfer.budget_m_s: not looked at where pairs have a thrust that lasts",
                      "beside thrust = \"energy-optimal\" in a scene with [assignment]"});
  expect_scene_error(circle + thrust_ends + "largest_impulse_m_s = 2\n" + slots,
                     {"transfer.largest_impulse_m_s: not looked at where pairs"});
  expect_scene_error(circle + thrust_ends + slots + "[thruster]\nacceleration_m_s2 = 0.01\n",
                     {"thruster: a thrust that lasts is not made of burns", "largest_thrust_m_s2",
                      "must be left out"});
  expect_scene_error(circle + thrust_ends + "[assignment]\nkeep_apart_m = 5\n" + slots,
                     {"assignment.keep_apart_m: not looked at on ways of a thrust that lasts"});
  expect_scene_error(
      circle + "[transfer]\ntimes_s = [16, 32]\nthrust = \"fuel-optimal\"\n" + slots,
      {"transfer.thrust: pairs are not followed to such a thrust", "energy-optimal"});
}

// A transfer has two impulses at its ends too, which these are about.
TEST(LastingThrust, OfATransferHasBudgetLimitAndBurnsOfItsImpulses) {
  const Scene scene =
      parse_scene(circle + thrust_ends + "budget_m_s = 2\nlargest_impulse_m_s = 1\n" + places +
                      "[thruster]\nacceleration_m_s2 = 0.01\n",
                  "file.toml");
  EXPECT_EQ(scene.transfer->budget_m_s, 2);
  EXPECT_EQ(scene.transfer->largest_impulse_m_s, 1);
  EXPECT_TRUE(scene.thruster);
}

TEST(LastingThrust, OfNoKindHasKeysOfAnother) {
  const std::string impulses = circle + "[transfer]\ntimes_s = [16, 32]\n";
  const std::string least_fuel = impulses + "thrust = \"fuel-optimal\"\n";
  const std::string thruster = "[thruster]\nacceleration_m_s2 = 1\n";
  for (const std::string key : {"thrust_order = 2", "largest_thrust_m_s2 = 1", "feedback = 3"}) {
    const std::string name = "transfer." + key.substr(0, key.find(' '));
    expect_scene_error(impulses + key + "\n" + places,
                       {name + ": ", "beside thrust = \"impulses\"", "must be beside"});
    if (key.starts_with("thrust_order")) continue;
    expect_scene_error(least_fuel + key + "\n" + places + thruster,
                       {name + ": ", "beside thrust = \"fuel-optimal\"", "must be"});
  }
  for (const std::string key :
       {"longest_burn_s = 9", "shortest_burn_s = 1", "attitude = \"RTN\""}) {
    expect_scene_error(least_fuel + places + thruster + key + "\n",
                       {"thruster." + key.substr(0, key.find(' ')) + ": not looked at",
                        "burns as long as is best", "must be left out"});
  }
  parse_scene(
      least_fuel + places + "[thruster]\nthrust_N = 1\nmass_kg = 9\nspecific_impulse_s = 200\n",
      "file.toml");
  expect_scene_error(least_fuel + places, {"transfer.thrust: no table [thruster]"});
}

TEST(LastingThrust, HasErrorsBesideALawAlone) {
  const std::string law = circle + thrust_ends + "feedback = 3\n";
  parse_scene(law + "errors = {}\n" + places, "file.toml");
  expect_scene_error(circle + thrust_ends + "errors = {}\n" + places,
                     {"transfer.errors: no law to fly by", "without feedback"});
  expect_scene_error(law + "errors = { position_m = [1, -2, 1] }\n" + places,
                     {"transfer.errors.position_m", "no standard deviation, got -2"});
  expect_scene_error(law + "errors = { velocity_m_s = [1, 1] }\n" + places,
                     {"transfer.errors.velocity_m_s"});
  expect_scene_error(law + "errors = { magnitude = 1.5 }\n" + places,
                     {"transfer.errors.magnitude"});
}

}  // namespace
}  // namespace hamjet::io
