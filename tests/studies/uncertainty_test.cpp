#include "studies/uncertainty/uncertainty.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <string>

#include "hamjet/scene/scene_reader.hpp"

namespace hamjet {
namespace {

struct UncertainOrbit {
  const char* name;
  const char* elements;
  const char* duration;
};

// Low, 15 revolutions; Molniya's, 2; geostationary, 3 days; each with 1 km and 1 m/s.
const UncertainOrbit low = {"low",
                            "a_km=6878, e=0.001, i_deg=51.6, raan_deg=0, argp_deg=0, ta_deg=0",
                            "duration_orbits = 15"};
const UncertainOrbit molniya = {
    "Molniya", "a_km=26600, e=0.74, i_deg=63.4, raan_deg=0, argp_deg=270, ta_deg=180",
    "duration_orbits = 2"};
const UncertainOrbit geostationary = {
    "geostationary", "a_km=42166.3, e=0.0002, i_deg=0.05, raan_deg=0, argp_deg=0, ta_deg=0",
    "duration_s = 259200"};

Scene scene_of(const UncertainOrbit& orbit, int order, const std::string& tables,
               const std::string& coordinates = "flow-box") {
  return io::parse_scene(
      fmt::format(
          "[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\nradius_km = "
          "6378.1363\nJ2 = 1.08262668355315e-3\nJ3 = -2.53265648533224e-6\n[nominal]\n"
          "{}\n[jet]\norder = {}\n{}\ncoordinates = \"{}\"\n{}",
          [&] {
            std::string lines = orbit.elements;
            for (std::size_t at; (at = lines.find(", ")) != lines.npos;) {
              lines.replace(at, 2, "\n");
            }
            return lines;
          }(),
          order, orbit.duration, coordinates, tables),
      "file.toml");
}

const std::string kilometre =
    "[uncertainty]\nposition_m = [1000, 1000, 1000]\nvelocity_m_s = [1, 1, 1]\n";

/// Each moment must be within so many standard deviations of the sample's scatter.
void expect_within(const Cumulants& moments, const FlownMoments& flown, double allowed,
                   const std::string& what) {
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto near = [&](double said, double sampled, double scatter, const char* which) {
      EXPECT_NEAR(said, sampled, allowed * scatter) << what << ' ' << which << ' ' << i;
    };
    const Cumulants& sample = flown.cumulants;
    near(moments.mean()[i], sample.mean()[i], flown.mean_error[i], "mean");
    near(moments.standard_deviations()[i], sample.standard_deviations()[i],
         flown.deviation_error[i], "standard deviation");
    near(moments.skewness()[i], sample.skewness()[i], flown.skewness_error[i], "skewness");
    near(moments.excess_kurtosis()[i], sample.excess_kurtosis()[i], flown.kurtosis_error[i],
         "kurtosis");
  }
}

/// The largest miss of mean and standard deviation, in scatters of the sample.
double largest_miss(const Cumulants& moments, const FlownMoments& flown) {
  double largest = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    largest = std::max(
        largest, std::abs(moments.mean()[i] - flown.cumulants.mean()[i]) / flown.mean_error[i]);
    largest = std::max(largest, std::abs(moments.standard_deviations()[i] -
                                         flown.cumulants.standard_deviations()[i]) /
                                    flown.deviation_error[i]);
  }
  return largest;
}

// 24 moments of each of three orbits, by two kinds of polynomials that agree with each other: five
// scatters are left by chance once in a hundred thousand tries of a Gaussian sample; skewness and
// kurtosis of a sample have heavier tails, for which some more are left.
constexpr double allowed_scatter = 6;

TEST(Uncertainty, MomentsAreThoseOfStatesThatWereFlown) {
  for (const UncertainOrbit& orbit : {low, molniya, geostationary}) {
    SCOPED_TRACE(orbit.name);
    const UncertaintyResult result =
        study_uncertainty(scene_of(orbit, 4, kilometre + "samples = 2000\n"));
    const UncertainState& state = result.points.at(0).states.at(0);
    ASSERT_TRUE(state.flown);
    expect_within(state.cartesian.back(), *state.flown, allowed_scatter, "cartesian");
    ASSERT_EQ(state.through.size(), 4u);
    expect_within(state.through.back(), *state.flown, allowed_scatter, "flow box");
    // In flow-box coordinates the linear map is enough.
    expect_within(state.through.front(), *state.flown, allowed_scatter, "flow box, order 1");
    // By what order 4 leaves out both differ: less than a thousandth of what they say.
    for (Eigen::Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(state.cartesian.back().standard_deviations()[i] /
                      state.through.back().standard_deviations()[i],
                  1, 1e-3);
    }
  }
}

// 40 km along the track bend the orbit by 116 m in the mean, more than the 100 m across it. The
// flown samples begin at exact states of elements.
TEST(Uncertainty, MomentsOfAStartInElementsAreThoseOfItsFlights) {
  const std::string long_track =
      "[uncertainty]\nposition_m = [100, 40000, 100]\nvelocity_m_s = [0.1, 0.1, 0.1]\n";
  UncertainOrbit half = low;
  half.duration = "duration_orbits = 0.5";
  const auto state_of = [&](const std::string& keys, const std::string& coordinates) {
    return study_uncertainty(scene_of(half, 4, long_track + keys, coordinates));
  };
  for (const std::string coordinates : {"cartesian", "flow-box"}) {
    const UncertaintyResult result = state_of("samples = 4000\n", coordinates);
    ASSERT_EQ(result.start_notes.size(), 1U);
    const UncertainState& state = result.points.at(0).states.at(0);
    expect_within(state.cartesian.back(), *state.flown, allowed_scatter, "in elements");
    if (coordinates == "cartesian") continue;
    ASSERT_EQ(state.through.size(), 4U);
    expect_within(state.through.back(), *state.flown, allowed_scatter, "flow box");
  }
  const UncertaintyResult straight =
      state_of("samples = 0\ngaussian_in = \"positions\"\n", "cartesian");
  EXPECT_TRUE(straight.start_notes.empty());
}

// Small negentropies are leading terms, of the square of the deviations; larger ones are told by
// volumes, of which the period's coordinate changes its own. Between 5.6e-5 and 1e-4 one takes the
// other's place: they differ by their squares and what the order leaves out.
TEST(Uncertainty, NegentropiesOfBothKindsMeetInEveryChart) {
  const std::string orbit = "a_km=9000, e=0.1, i_deg=51.6, raan_deg=0, argp_deg=0, ta_deg=0";
  const auto negentropy = [&](const char* coordinates, double size, double orbits) {
    const UncertaintyResult result = study_uncertainty(scene_of(
        {"", orbit.c_str(), fmt::format("duration_orbits = {}", orbits).c_str()}, 4,
        fmt::format("[uncertainty]\nposition_m = [{0}, {0}, {0}]\nvelocity_m_s = [{1}, {1}, {1}]\n"
                    "samples = 0\n",
                    500 * size, size),
        coordinates));
    return result.points[0].states[0].charted.back().negentropy();
  };
  const double small = negentropy("flow-box", 3, 2), large = negentropy("flow-box", 12, 2);
  EXPECT_LT(small, 1e-4);
  EXPECT_GT(large, 5e-4);
  EXPECT_NEAR(large / small, 16, 16 * 2e-3);
  const double few = negentropy("poincare", 0.5, 2), many = negentropy("poincare", 1.5, 2);
  EXPECT_LT(few, 1e-4);
  EXPECT_GT(many, 2e-4);
  EXPECT_NEAR(many / few, 9, 9 * 5e-3);
}

TEST(Uncertainty, TheLinearCovarianceMisleadsInCartesianCoordinatesAlone) {
  for (const UncertainOrbit& orbit : {low, geostationary}) {
    SCOPED_TRACE(orbit.name);
    const UncertaintyResult result =
        study_uncertainty(scene_of(orbit, 3, kilometre + "samples = 2000\n"));
    const UncertainState& state = result.points[0].states[0];
    // The mean of one degree of chi-square is its standard deviation over sqrt(2) from zero.
    EXPECT_GT(largest_miss(state.cartesian.front(), *state.flown),
              0.9 * std::sqrt(state.flown->count / 2.0));
    EXPECT_EQ(largest_error_of_probability(divergence_from_linear(state.cartesian)), 1);
    EXPECT_LT(largest_error_of_probability(divergence_from_linear(state.charted)),
              misleading_probability);
    EXPECT_LT(state.charted.back().negentropy(), 1e-3 * state.cartesian.back().negentropy());
    // No flow changes the volume of 1 km and 1 m/s along three axes. A sample's log of a volume of
    // six variables scatters by sqrt(6 / (2 n)).
    const Matrix<double>& flown = state.flown_states;
    const Matrix<double> centred = flown.colwise() - Vector<double>(flown.rowwise().mean());
    const Eigen::HouseholderQR<Matrix<double>> parts(centred.transpose() /
                                                     std::sqrt(state.flown->count - 1.0));
    const double volume = parts.matrixQR().diagonal().cwiseAbs().array().log().sum();
    EXPECT_NEAR(state.cartesian.back().negentropy(), volume - 3 * std::log(1000),
                4 * std::sqrt(3.0 / state.flown->count));
    // The bend of the orbit: along R the mean is lower by s_T^2 / (2 r), in second order of the
    // angle, with which the radial skewness of -chi^2 of one degree comes, -sqrt(8).
    const double s = state.through.front().standard_deviations()[1];
    const double r =
        1000 * result.scene.units.length_km * Eigen::Vector3d(result.scene.nominal.data()).norm();
    EXPECT_NEAR(state.cartesian[1].mean()[0] / (-s * s / (2 * r)), 1, 0.05);
    EXPECT_NEAR(state.cartesian[1].skewness()[0], -std::sqrt(8.0), 0.1);
  }
}

TEST(Uncertainty, NothingIsFlownWhereNoSamplesAreAskedFor) {
  const UncertaintyResult result =
      study_uncertainty(scene_of(low, 2, kilometre + "samples = 0\n", "cartesian"));
  EXPECT_FALSE(result.points[0].states[0].flown);
  EXPECT_TRUE(result.points[0].states[0].charted.empty());
}

TEST(Uncertainty, CovariancesOfTwoSpacecraftAddInTheirDifference) {
  const std::string tables = "[deputy]\nposition_m = [0, 5000, 0]\n" + kilometre +
                             "samples = 2000\n[uncertainty.deputy]\nposition_m = [300, 300, 300]\n"
                             "velocity_m_s = [0.3, 0.3, 0.3]\n";
  const UncertaintyResult result = study_uncertainty(scene_of(molniya, 3, tables));
  const auto& states = result.points[0].states;
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states[2].name, "relative");
  for (std::size_t n = 0; n < 3; ++n) {
    const Matrix<double> sum =
        states[0].cartesian[n].covariance() + states[1].cartesian[n].covariance();
    const Vector<double> s = states[2].cartesian[n].standard_deviations();
    const Matrix<double> difference = states[2].cartesian[n].covariance() - sum;
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) EXPECT_NEAR(difference(i, j), 0, 1e-12 * s[i] * s[j]);
    }
    EXPECT_LT((states[2].cartesian[n].mean() - states[1].cartesian[n].mean() +
               states[0].cartesian[n].mean())
                  .cwiseQuotient(s)
                  .norm(),
              1e-12);
  }
  expect_within(states[1].cartesian.back(), *states[1].flown, allowed_scatter, "deputy");
  expect_within(states[2].cartesian.back(), *states[2].flown, allowed_scatter, "relative");
}

TEST(Uncertainty, NoiseOfTheAccelerationGrowsAsOnARelativeOrbit) {
  // Clohessy and Wiltshire across the orbital plane: a kick at s moves z by sin(n (t - s))/n and z'
  // by cos(n (t - s)), so that the variances of N and vN are
  //
  //   q (t/2 - sin(2 n t)/(4 n)) / n^2   and   q (t/2 + sin(2 n t)/(4 n)) .
  const double q = 1e-8;
  const double t = 7000;
  const std::string scene_text = fmt::format(
      "[system]\nmodel = \"kepler\"\nmu_km3_s2 = 398600.4415\n[nominal]\na_km = 7000\ne = 0\n"
      "i_deg = 50\nraan_deg = 0\nargp_deg = 0\nta_deg = 0\n[jet]\norder = 1\nduration_s = {}\n"
      "[uncertainty]\nposition_m = [0, 0, 0]\nacceleration_density_m2_s3 = {}\nsamples = 0\n",
      t, q);
  const UncertaintyResult result = study_uncertainty(io::parse_scene(scene_text, "file.toml"));
  const double n = std::sqrt(398600.4415 / std::pow(7000.0, 3));
  const Vector<double> s = result.points[0].states[0].cartesian[0].standard_deviations();
  // Simpson's rule was refined until it changes by 1e-4 at most.
  EXPECT_NEAR(s[2] * s[2] / (q * (t / 2 - std::sin(2 * n * t) / (4 * n)) / (n * n)), 1, 1e-4);
  EXPECT_NEAR(s[5] * s[5] / (q * (t / 2 + std::sin(2 * n * t) / (4 * n))), 1, 1e-4);
}

TEST(Uncertainty, ScattersAreThoseOfGaussianSamples) {
  // The scatters of a Gaussian sample are s/sqrt(n), s/sqrt(2 n), sqrt(6/n), sqrt(24/n).
  const UncertaintyResult result = study_uncertainty(
      scene_of(low, 1, "[uncertainty]\nposition_m = [1, 1, 1]\nsamples = 20000\ntimes_s = 1\n",
               "cartesian"));
  const FlownMoments& flown = *result.points[0].states[0].flown;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double s = flown.cumulants.standard_deviations()[i];
    EXPECT_NEAR(flown.mean_error[i] / s, 1 / std::sqrt(20000.0), 1e-12);
    EXPECT_NEAR(flown.deviation_error[i] / s, 1 / std::sqrt(40000.0), 0.03 / std::sqrt(40000.0));
    EXPECT_NEAR(flown.skewness_error[i], std::sqrt(6 / 20000.0), 0.1 * std::sqrt(6 / 20000.0));
    EXPECT_NEAR(flown.kurtosis_error[i], std::sqrt(24 / 20000.0), 0.2 * std::sqrt(24 / 20000.0));
  }
  expect_within(result.points[0].states[0].cartesian[0], flown, 5, "short flight");
}

}  // namespace
}  // namespace hamjet
