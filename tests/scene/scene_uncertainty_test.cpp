#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene_samples.hpp"

// The table [uncertainty], and the refusal of bad covariances.

namespace hamjet::io {
namespace {

const std::string about_earth = R"([system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
position_km = [7000, 0, 0]
velocity_km_s = [0, 7.5, 0]
[jet]
duration_s = 6000
)";

Scene scene_with_tables(const std::string& tables) {
  return parse_scene(about_earth + tables, "file.toml");
}

std::string rows(const std::string& fifth_row = "[0, 0, 0, 0, 1e-2, 0]",
                 const std::string& sixth_row = "[0, 0, 0, 0, 0, 1e-2]") {
  return "covariance_m_m_s = [[1e4, 0, 0, 0, 0, 0],\n [0, 4e4, 0, 0, 0, 0],\n"
         " [0, 0, 9e4, 0, 0, 0],\n [0, 0, 0, 1e-2, 0, 0],\n " +
         fifth_row + ",\n " + sixth_row + "]\n";
}

TEST(SceneUncertainty, StandardDeviationsAreASquareRoot) {
  const Scene scene =
      scene_with_tables("[uncertainty]\nposition_m = [1, 2, 3]\nvelocity_m_s = [0.1, 0, 0.3]\n");
  ASSERT_TRUE(scene.uncertainty && scene.uncertainty->chief);
  const StateUncertainty& chief = *scene.uncertainty->chief;
  EXPECT_EQ(chief.frame, RelativeFrame::rtn_inertial);
  EXPECT_EQ(chief.covariance.rank(), 5);
  const std::vector<double> expected = {1, 2, 3, 0.1, 0, 0.3};
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_EQ(chief.covariance.standard_deviations()[i], expected[static_cast<std::size_t>(i)]);
  }
  // There is one time, the end, and neither a deputy nor a burn.
  ASSERT_EQ(scene.uncertainty->times.size(), 1u);
  EXPECT_EQ(scene.uncertainty->times[0], scene.duration);
  EXPECT_FALSE(scene.uncertainty->deputy);
  EXPECT_FALSE(scene.uncertainty->burn);
}

TEST(SceneUncertainty, AMatrixAndStandardDeviationsAreTheSameCovariance) {
  const Matrix<double> of_matrix =
      scene_with_tables("[uncertainty]\n" + rows()).uncertainty->chief->covariance.matrix();
  const Matrix<double> of_deviations =
      scene_with_tables(
          "[uncertainty]\nposition_m = [100, 200, 300]\nvelocity_m_s = [0.1, 0.1, 0.1]\n")
          .uncertainty->chief->covariance.matrix();
  EXPECT_LT((of_matrix - of_deviations)
                .cwiseQuotient(of_deviations.diagonal().cwiseSqrt() *
                               of_deviations.diagonal().cwiseSqrt().transpose())
                .norm(),
            1e-14);
}

TEST(SceneUncertainty, FramesAndDerivativesAreThoseOfTheTableOrOfTheOneAbove) {
  const std::string deputy = "[deputy]\nposition_m = [0, 100, 0]\n";
  const auto frame = [&](const std::string& of_table, const std::string& of_deputy) {
    return scene_with_tables(deputy + "[uncertainty]\n" + of_table +
                             "position_m = [1, 1, 1]\n[uncertainty.deputy]\n" + of_deputy +
                             "position_m = [1, 1, 1]\n")
        .uncertainty->deputy->frame;
  };
  EXPECT_EQ(frame("", ""), RelativeFrame::rtn_inertial);
  EXPECT_EQ(frame("derivatives = \"rotating\"\n", ""), RelativeFrame::rtn_rotating);
  EXPECT_EQ(frame("frame = \"inertial\"\n", ""), RelativeFrame::inertial);
  EXPECT_EQ(frame("frame = \"inertial\"\n", "frame = \"RTN\"\n"), RelativeFrame::rtn_inertial);
}

// A table inherits only what its own frame takes: inertial axes have one kind of derivatives.
TEST(SceneUncertainty, ATableInheritsNothingThatItsFrameDoesNotTake) {
  const Scene scene = scene_with_tables(
      "[deputy]\nposition_m = [0, 10, 0]\n[uncertainty]\nframe = \"RTN\"\nderivatives = "
      "\"rotating\"\nposition_m = [1, 1, 1]\n[uncertainty.deputy]\nframe = \"inertial\"\n"
      "position_m = [1, 1, 1]\n[uncertainty.burn]\nframe = \"inertial\"\nvelocity_change_m_s = "
      "[0, 1, 0]\nmagnitude = 0.1\n");
  EXPECT_EQ(scene.uncertainty->chief->frame, RelativeFrame::rtn_rotating);
  EXPECT_EQ(scene.uncertainty->deputy->frame, RelativeFrame::inertial);
  EXPECT_EQ(scene.uncertainty->burn->frame, RelativeFrame::inertial);
}

TEST(SceneUncertainty, ABurnHasTheCovarianceOfGates) {
  // The burn is along T: an error of its size moves vT, one of its direction vR and vN.
  const auto burn = scene_with_tables(
                        "[uncertainty.burn]\nvelocity_change_m_s = [0, 10, 0]\nmagnitude = 0.01\n"
                        "direction_deg = 0.5\n")
                        .uncertainty->burn;
  ASSERT_TRUE(burn);
  const Matrix<double> covariance = burn->covariance().matrix();
  const double across = 10 * 0.5 * std::acos(-1.0) / 180;
  EXPECT_NEAR(covariance(3, 3), across * across, 1e-15);
  EXPECT_NEAR(covariance(4, 4), 0.01, 1e-15);
  EXPECT_NEAR(covariance(5, 5), across * across, 1e-15);
  EXPECT_NEAR(covariance(3, 4), 0, 1e-15);
  EXPECT_EQ(covariance.topLeftCorner(3, 6).norm(), 0);
}

TEST(SceneUncertainty, BadCovariancesAreRefusedByName) {
  const auto refuse = [](const std::string& tables, const std::vector<std::string>& words) {
    expect_scene_error(about_earth + tables, words);
  };
  refuse("[uncertainty]\n" + rows("[0, 0, 0, 0, 1e-2, 1e-3]"),
         {"file.toml:10", "uncertainty.covariance_m_m_s", "not symmetric", "vN with vT"});
  refuse("[uncertainty]\n" + rows("[0, 0, 0, 0, 1e-2, 0.02]", "[0, 0, 0, 0, 0.02, 1e-2]"),
         {"uncertainty.covariance_m_m_s", "not positive semidefinite", "0.71 vT"});
  refuse("[uncertainty]\n" + rows("[0, 0, 0, 0, -1e-2, 0]"),
         {"uncertainty.covariance_m_m_s", "variance -0.01 of vT"});
  refuse("[uncertainty]\nframe = \"inertial\"\n" + rows("[0, 0, 0, 0, -1e-2, 0]"),
         {"variance -0.01 of vy"});
  refuse("[uncertainty]\ncovariance_m_m_s = [[1, 0], [0, 1]]\n",
         {"uncertainty.covariance_m_m_s", "6"});
  refuse("[uncertainty]\n" + rows("[0, 0, 0, 0, 0.02]"), {"uncertainty.covariance_m_m_s", "6"});
  refuse("[uncertainty]\nposition_m = [1, -1, 1]\n",
         {"uncertainty.position_m.1", "no standard deviation", "-1"});
  refuse("[uncertainty]\nposition_m = [1, 1]\n", {"uncertainty.position_m", "3"});
  refuse("[uncertainty]\nposition_m = 1\n", {"uncertainty.position_m"});
  // The deviation is as large as the orbit, which indicates a wrong unit.
  refuse("[uncertainty]\nposition_m = [1e7, 1, 1]\n", {"uncertainty.position_m.0", "7e+06"});
  refuse("[uncertainty]\nposition_km = [1, 1, 1]\n", {"uncertainty.position_km", "unknown"});
  refuse("[uncertainty]\nframe = \"TNW\"\nposition_m = [1, 1, 1]\n", {"uncertainty.frame", "RTN"});
  refuse("[uncertainty]\nframe = \"LVLH\"\nposition_m = [1, 1, 1]\n",
         {"uncertainty.frame", "ambiguous"});
  refuse("[uncertainty]\ncount = 2\n", {"uncertainty.position_m", "missing"});
  refuse("[uncertainty]\nposition_m = [1, 1, 1]\n" + rows(),
         {"uncertainty.position_m", "beside a covariance"});
  refuse("[uncertainty]\nposition_m = [1, 1, 1]\n[uncertainty.deputy]\nposition_m = [1, 1, 1]\n",
         {"uncertainty.deputy", "has no deputy"});
  refuse("[uncertainty.burn]\nvelocity_change_m_s = [1, 0, 0]\n",
         {"uncertainty.burn", "no error of the burn"});
}

// Without the noise a probability of collision would be too low.
TEST(SceneUncertainty, NoiseIsRefusedBesideWhatLeavesItOut) {
  const std::string noisy =
      about_earth +
      "[deputy]\nposition_m = [0, 1000, 0]\n[uncertainty]\nposition_m = [1, 1, 1]\n"
      "acceleration_density_m2_s3 = 1e-6\n";
  EXPECT_NO_THROW(scene_with_tables(noisy.substr(about_earth.size())));
  expect_scene_error(
      noisy + "[uncertainty.collision]\nradius_m = 10\n",
      {"uncertainty.acceleration_density_m2_s3", "not beside [uncertainty.collision]"});
  expect_scene_error(noisy + "[uncertainty.safety]\nkeep_apart_m = 10\n",
                     {"uncertainty.acceleration_density_m2_s3", "not beside [uncertainty.safety]"});
}

}  // namespace
}  // namespace hamjet::io
