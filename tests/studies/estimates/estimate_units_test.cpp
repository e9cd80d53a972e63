#include <gtest/gtest.h>

#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"

// A jet in states and parameters, in air and through the Earth's shadow, does not change with the
// unit of length: the same flow is integrated in the default unit, the distance of the start, and
// in astronomical units.

namespace hamjet {
namespace {

RunResult run_in(const std::string& units, const std::string& variables) {
  const Scene scene = io::parse_scene(R"([system]
model = "earth"
gravity_degree = 7
sun = true
moon = true
atmosphere = "exponential"
bulge_exponent = 2
radiation = true
[nominal]
epoch_tai = "1986-03-14T21:11:50.904447"
a_km = 26566.7013
e = 1.94402494e-06
i_deg = 50.5863504
raan_deg = 156.560433
argp_deg = -151.888595
ta_deg = 0.0
[spacecraft]
drag_m2_kg = 0.0172977691
radiation_m2_kg = 0.00952886794
)" + units + R"([jet]
order = 4
duration_s = 43094.06177846927
)" + variables,
                                      "units.toml");
  return propagate(scene).runs.at(0);
}

void expect_alike(const std::string& variables) {
  const RunResult usual = run_in("", variables);
  const RunResult astronomical = run_in("[units]\nlength_km = 149597870.7\n", variables);
  EXPECT_NEAR(static_cast<double>(astronomical.statistics.steps),
              static_cast<double>(usual.statistics.steps), 1);
  ASSERT_TRUE(usual.error_estimate.by_degree) << usual.error_estimate.failure;
  ASSERT_TRUE(astronomical.error_estimate.by_degree) << astronomical.error_estimate.failure;
  for (std::size_t d = 0; d < usual.error_estimate.by_degree->size(); ++d) {
    const double ratio =
        (*astronomical.error_estimate.by_degree)[d] / (*usual.error_estimate.by_degree)[d];
    EXPECT_GT(ratio, 0.1) << "degree " << d;
    EXPECT_LT(ratio, 10) << "degree " << d;
  }
}

TEST(EstimateUnits, OfStatesInAirAndLightAreNoMatter) { expect_alike(""); }

TEST(EstimateUnits, OfParametersAreNoMatter) {
  expect_alike(
      "variables = [\"x\", \"y\", \"z\", \"px\", \"py\", \"pz\", \"drag_m2_kg\", "
      "\"density_factor\", \"radiation_m2_kg\"]\n");
}

}  // namespace
}  // namespace hamjet
