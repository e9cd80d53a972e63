#include <gtest/gtest.h>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {
namespace {

// After a whole period F1 is singular, and the polynomials ask for a velocity with which no way can
// be followed. The answers for shorter times stay.
TEST(KeepOut, AWayThatCannotBeFollowedIsForbidden) {
  const TransferResult result = study_transfer(io::parse_scene(R"(
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 18496.2644
e = 0.0731228373
i_deg = 5.55844534
raan_deg = 83.7430808
argp_deg = -64.4802428
ta_deg = -34.9851764
[jet]
order = 4
duration_s = -25034.39025448461
[transfer]
count = 11
refine = true
keep_out_m = [4.453460535475438, 29.28989497995526, 4.548430488100978]
start = { a_da_m = 0.0, a_dlambda_m = 39.70366839268276, a_dex_m = 157.841553, a_dey_m = -8.7480018, a_dix_m = -33.899978, a_diy_m = 42.8503084 }
end = { a_da_m = 0.0, a_dlambda_m = 36.3252393, a_dex_m = 161.162466, a_dey_m = -12.2903207, a_dix_m = -76.8284151, a_diy_m = 28.948831 }
)",
                                                               "whole-period.toml"));
  ASSERT_EQ(result.points.size(), 11U);
  int forbidden = 0;
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.keep_out_ratio) << point.time;
    if (*point.keep_out_ratio > 0) continue;
    EXPECT_TRUE(point.is_near_singular) << point.time;
    EXPECT_FALSE(point.is_allowed()) << point.time;
    ++forbidden;
  }
  EXPECT_EQ(forbidden, 1);
}

}  // namespace
}  // namespace hamjet
