#include <algorithm>
#include <cmath>
#include <vector>

#include "command_test.hpp"
#include "support/magnitude.hpp"

// On another instruction set a jet differs by round-off alone: contraction of products and sums and
// the width of vectors change its digits. portable_jet.csv is the jet of this scene by a portable
// build for x86-64 (-DHAMJET_NATIVE=OFF: SSE2, no fused multiply-adds), with 17 digits.

namespace hamjet::test {
namespace {

constexpr int order = 3;
constexpr int steps = 43;
constexpr double duration = 10.75;

/// The paper's orbit, one revolution, in fixed steps: where a tolerance chooses them, a step more
/// or less would differ by more than round-off.
constexpr const char* portable_scene = R"(schema = 1
title = "portable"
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4405
radius_km = 6378.137
J2 = 1.082626675e-3
J3 = 2.532436e-6
[nominal]
a_km = 10000
e = 0.3
i_deg = 60
raan_deg = 0
argp_deg = 0
ta_deg = 0
[jet]
order = 3
duration_canonical = 10.75
[[integrator]]
label = "gauss8"
method = "gauss"
stages = 8
step_canonical = 0.25
)";

double largest_of_degree(const Table& jet, int wanted) {
  double largest = 0;
  for (const auto& row : jet.rows) {
    if (degree(row) == wanted) largest = std::max(largest, std::abs(std::stod(row.back())));
  }
  return largest;
}

// The bound: the update is summed with compensation, so that a step of length h rounds by a unit
// u = 2^-53 of its increment, of the size h times the largest numbers; say twice that, in either of
// two builds, and to the same side in every step of the duration T. To move a point of the nominal
// by delta moves the coefficients of degree d by up to (d + 1) C_(d+1) delta, with C_d the largest
// coefficient of degree d at the end. Relative to C_d that is
//
//   4 T u (d + 1) C_(d+1) / C_d ,
//
// 2e-13 to 1e-12 here. For the highest degree C_(d+1) / C_d is taken to be as for the one before.
TEST_F(CommandTest, PortableBuildAgreesToRoundOff) {
  write("portable.toml", portable_scene);
  succeed({"run", "portable.toml", "-q", "-o", "results"});
  const Json summary = read_json(directory_ / "results/summary.json");
  ASSERT_EQ(summary["runs"][0]["steps"], steps);
  const Table here = read_table(directory_ / "results/gauss8/jet.csv");
  const Table stored = read_table(HAMJET_SOURCE_DIR "/tests/cli/portable_jet.csv");
  // C(6 + 3, 3) = 84 coefficients for each of 6 components.
  ASSERT_EQ(stored.rows.size(), 6U * 84U);
  ASSERT_EQ(here.header, stored.header);
  ASSERT_EQ(here.rows.size(), stored.rows.size());
  std::vector<double> largest;
  for (int d = 0; d <= order; ++d) largest.push_back(largest_of_degree(stored, d));
  largest.push_back(largest[order] * largest[order] / largest[order - 1]);
  std::vector<double> difference(order + 1, 0);
  for (std::size_t i = 0; i < here.rows.size(); ++i) {
    ASSERT_TRUE(std::equal(here.rows[i].begin(), here.rows[i].end() - 1, stored.rows[i].begin()));
    double& worst = difference[static_cast<std::size_t>(degree(stored.rows[i]))];
    worst =
        larger(worst, std::abs(std::stod(here.rows[i].back()) - std::stod(stored.rows[i].back())));
  }
  for (std::size_t d = 0; d <= order; ++d) {
    const double bound = 4 * duration * 0x1p-53 * static_cast<double>(d + 1) * largest[d + 1];
    EXPECT_LE(difference[d], bound) << d;
  }
}

}  // namespace
}  // namespace hamjet::test
