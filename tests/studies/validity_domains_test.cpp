#include <gtest/gtest.h>

#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/validity.hpp"
#include "support/text.hpp"

// How many domains a set takes. Expected: one within the reach that the study itself proves by
// other deputies, more beyond it and the more the further, and one again in flow boxes.

namespace hamjet {
namespace {

const std::string two_revolutions = R"(schema = 1
title = "far"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 1.08262668355315e-3
[nominal]
a_km = 6892.9
e = 0.0012
i_deg = 97.44
raan_deg = 30
argp_deg = 90
ta_deg = 0
[jet]
order = 3
duration_orbits = 2
[validity]
count = 1
samples = 10
)";

ValidityResult validity_of(const std::string& more, const std::string& jet = "") {
  const std::string scene = test::changed(two_revolutions, "order = 3\n", "order = 3\n" + jet);
  return study_validity(io::parse_scene(scene + more, "file.toml"));
}

TEST(ValidityDomains, GrowWithTheSeparationBeyondTheReach) {
  const ValidityResult without = validity_of("");
  EXPECT_FALSE(without.domains);
  const double reach = without.points.back().entries.back().proved_m;
  std::size_t fewer = 1;
  for (const double times : {0.95, 2.5, 5.0}) {
    const ValidityResult result =
        validity_of("separation_m = " + std::to_string(times * reach) + "\n");
    ASSERT_TRUE(result.domains);
    EXPECT_EQ(result.domains->deputies, 250U);
    EXPECT_EQ(result.flights, without.flights + 250);
    EXPECT_EQ(result.points.back().entries.back().proved_m, reach);
    EXPECT_LE(result.domains->miss_m, 1);
    EXPECT_EQ(result.domains->not_right, 0U);
    if (times < 1) {
      EXPECT_EQ(result.domains->count(), 1U);
      EXPECT_EQ(result.domains->split_across, "");
    } else {
      EXPECT_GT(result.domains->count(), fewer);
      EXPECT_NE(result.domains->split_across, "");
    }
    fewer = result.domains->count();
  }
}

TEST(ValidityDomains, LimitIsToldAndFlowBoxesTakeOne) {
  const std::string far = "separation_m = 15e3\nmost_domains = 3\n";
  const ValidityResult limited = validity_of(far);
  EXPECT_EQ(limited.domains->count(), 3U);
  EXPECT_GT(limited.domains->not_right, 0U);
  EXPECT_GT(limited.domains->miss_m, 1);
  const ValidityResult boxes = validity_of(far, "coordinates = \"flow-box\"\n");
  EXPECT_EQ(boxes.domains->count(), 1U);
  EXPECT_EQ(boxes.domains->not_right, 0U);
}

}  // namespace
}  // namespace hamjet
