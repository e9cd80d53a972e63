#include <cmath>
#include <string>
#include <vector>

#include "eval_command_test.hpp"
#include "support/text.hpp"

// `hamjet eval` in forms of a deputy that are no linear functions of its deviation.

namespace hamjet::test {
namespace {

constexpr double circle_m = 7e6;

using EvalForms = EvalTest;

TEST_F(EvalForms, RelativeElementsOfKeplersMotionStay) {
  // Without a difference of the semi-major axes, Kepler's motion changes none of the others, at
  // whatever time; beyond order 5 the polynomial misses some (100 m)^6 / (7000 km)^5.
  const std::string tilted =
      changed(changed(circular_scene, "[0, 7, 0]", "[0, 4.2, 5.6]"), "6.283185307179586", "4.5");
  store("tilted", tilted);
  const std::vector<double> elements = {0, 50, 20, -10, 30, 15};
  const Json json =
      eval_json({"tilted", "--frame", "relative-elements", "--deviation", "0,50,20,-10,30,15"});
  const char* const columns[] = {"a_da_m",  "a_dlambda_m", "a_dex_m",
                                 "a_dey_m", "a_dix_m",     "a_diy_m"};
  const Json& row = json["rows"][0];
  // The miss of the position is a few nm of rounding, and elements enlarge it by a small factor.
  EXPECT_LT(row["miss_estimate_m"].get<double>(), 1e-7);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(row[columns[i]].get<double>(), elements[i], 1e-6) << columns[i];
  }
  EXPECT_EQ(json["frame"], "relative-elements");
  // The deputy is on the chief's circle, 200 m ahead: it is at rest in the turning axes at any
  // time.
  const Json ahead = eval_json(
      {"tilted", "--frame", "curvilinear", "--to", "RTN", "--deviation", "0,200,0,0,0,0"});
  const double angle = 200 / circle_m;
  EXPECT_NEAR(ahead["rows"][0]["R_m"].get<double>(), circle_m * (std::cos(angle) - 1), 1e-7);
  EXPECT_NEAR(ahead["rows"][0]["T_m"].get<double>(), circle_m * std::sin(angle), 1e-7);
  EXPECT_NEAR(ahead["rows"][0]["vT_m_s"].get<double>(), 0, 1e-10);
  EXPECT_EQ(ahead["final_frame"], "RTN");
}

TEST_F(EvalForms, FormsOfADeputyThatDoNotFitAreRefused) {
  store("circular", circular_scene);
  expect_error({"eval", "circular", "--frame", "relative-elements", "--deviation", "0,0,0,0,0,0"},
               4, {"equatorial plane and has no node"});
  expect_error({"eval", "circular", "--frame", "curvilinear", "--deviation", "-8e6,0,0,0,0,0"}, 2,
               {"--deviation: curvilinear coordinates: the deputy must be above the centre"});
  expect_error({"eval", "circular", "--to", "canonical", "--deviation", "0,0,0,0,0,0"}, 2,
               {"--to canonical: got --frame RTN, must both be canonical or neither"});
  expect_error({"eval", "circular", "--to", "curvlinear", "--deviation", "0,0,0,0,0,0"}, 2,
               {"--to curvlinear: no such frame", "did you mean curvilinear?"});
}

}  // namespace
}  // namespace hamjet::test
