#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hamjet/error.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "studies/uncertainty/uncertainty.hpp"

// Moments where parameters of the forces are uncertain, and of deputies unlike their chief.

namespace hamjet::uncertain_parameters_tests {
namespace {

/// A polar orbit in air that has one density at all heights.
Scene scene_in_even_air(const std::string& uncertainty, int order = 3, double hours = 6,
                        const std::string& deputy = "", double drag = 0.02) {
  return io::parse_scene(
      "[system]\nmodel = \"earth\"\ngravity_degree = 2\nsun = false\nmoon = false\n"
      "atmosphere = \"table\"\nheights_km = [100, 300, 600, 900]\n"
      "densities_kg_m3 = [1e-12, 1e-12, 1e-12, 1e-12]\n[spacecraft]\ndrag_m2_kg = " +
          std::to_string(drag) +
          "\n[nominal]\nepoch_utc = \"2026-03-01T06:00:00\"\nheight_km = 500\ni_deg = 90\n"
          "raan_deg = 30\nu_deg = 0\n" +
          deputy + "[jet]\norder = " + std::to_string(order) +
          "\nduration_s = " + std::to_string(3600 * hours) + "\n[uncertainty]\n" + uncertainty,
      "file.toml");
}

const UncertainState& state_named(const UncertaintyResult& result, const std::string& name) {
  for (const UncertainState& state : result.points.back().states) {
    if (state.name == name) return state;
  }
  throw std::out_of_range(name);
}

double along_track(const UncertainState& state) {
  return state.cartesian.front().standard_deviations()[1];
}

/// Each moment must be within so many standard deviations of the sample's scatter.
void expect_flown(const UncertainState& state) {
  constexpr double allowed = 6;
  ASSERT_TRUE(state.flown);
  const Cumulants& moments = state.cartesian.back();
  const Cumulants& sample = state.flown->cumulants;
  for (Eigen::Index i = 0; i < 6; ++i) {
    SCOPED_TRACE(state.name + ' ' + std::to_string(i));
    EXPECT_NEAR(moments.mean()[i], sample.mean()[i], allowed * state.flown->mean_error[i]);
    EXPECT_NEAR(moments.standard_deviations()[i], sample.standard_deviations()[i],
                allowed * state.flown->deviation_error[i]);
    EXPECT_NEAR(moments.skewness()[i], sample.skewness()[i],
                allowed * state.flown->skewness_error[i]);
    EXPECT_NEAR(moments.excess_kurtosis()[i], sample.excess_kurtosis()[i],
                allowed * state.flown->kurtosis_error[i]);
  }
}

// A deceleration f leads 3/2 f t^2 forwards (Clohessy-Wiltshire, without the terms that repeat each
// revolution, 4 f / n^2). Here f = B rho v^2 / 2 with the speed against air that turns with the
// Earth: across it on a polar orbit, 6 % of the speed at most, which adds up to 0.2 % to v^2.
TEST(UncertainParameters, DragLeadsAlongTheTrackWithTheSquareOfTheTime) {
  for (const double hours : {6.0, 12.0}) {
    const UncertaintyResult result = study_uncertainty(
        scene_in_even_air("samples = 0\nparameters = {density_factor = 0.1}\n", 2, hours));
    const double speed_squared = 398600.4415e9 / 6878.1363e3;
    const double t = 3600 * hours;
    const double f = 0.1 * 0.02 * 1e-12 * speed_squared / 2;
    EXPECT_NEAR(along_track(state_named(result, "chief")) / (1.5 * f * t * t), 1, 0.02);
  }
}

// The force has the product of density and coefficient alone.
TEST(UncertainParameters, DensityAndCoefficientActAlike) {
  const UncertaintyResult by_density =
      study_uncertainty(scene_in_even_air("samples = 0\nparameters = {density_factor = 0.1}\n"));
  const UncertaintyResult by_coefficient =
      study_uncertainty(scene_in_even_air("samples = 0\nparameters = {drag_m2_kg = 0.002}\n"));
  const UncertainState& one = state_named(by_density, "chief");
  const UncertainState& other = state_named(by_coefficient, "chief");
  for (std::size_t n = 0; n < 3; ++n) {
    const Vector<double> s = one.cartesian[n].standard_deviations();
    for (Eigen::Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(other.cartesian[n].standard_deviations()[i], s[i], 1e-8 * s.maxCoeff());
      EXPECT_NEAR(other.cartesian[n].mean()[i], one.cartesian[n].mean()[i], 1e-8 * s.maxCoeff());
    }
  }
  ASSERT_EQ(by_density.parameter_effects.size(), 1U);
  EXPECT_EQ(by_density.parameter_effects[0].spacecraft, "all");
  EXPECT_NEAR(by_density.parameter_effects[0].along[0].deviations[1], along_track(one),
              1e-9 * along_track(one));
  EXPECT_EQ(by_coefficient.parameter_effects[0].spacecraft, "chief");
}

TEST(UncertainParameters, AVarianceOfZeroIsNoParameter) {
  const std::string state = "position_m = [10, 10, 10]\nvelocity_m_s = [0.01, 0.01, 0.01]\n";
  const UncertaintyResult known = study_uncertainty(scene_in_even_air(state + "samples = 16\n"));
  const UncertaintyResult zero = study_uncertainty(scene_in_even_air(
      state + "samples = 16\nparameters = {density_factor = 0, drag_m2_kg = 0}\n"));
  const UncertaintyResult small = study_uncertainty(scene_in_even_air(
      state + "samples = 16\nparameters = {density_factor = 1e-9, drag_m2_kg = 1e-11}\n"));
  const Matrix<double> exact = state_named(known, "chief").cartesian.back().covariance();
  EXPECT_EQ(state_named(zero, "chief").cartesian.back().covariance(), exact);
  EXPECT_EQ(state_named(zero, "chief").flown_states, state_named(known, "chief").flown_states);
  EXPECT_LT((state_named(small, "chief").cartesian.back().covariance() - exact).norm(),
            1e-8 * exact.norm());
}

// Along one line of states and coefficients, standard deviations of both add up or cancel.
TEST(UncertainParameters, CovariancesWithTheStateAddUpOrCancel) {
  const auto scene_with = [](double deviation, double correlation) {
    // 1 mm/s along T and 1e-4 m^2/kg, whose effects are of one size.
    return scene_in_even_air(
        "samples = 0\nvelocity_m_s = [0, 0.001, 0]\nparameters = {drag_m2_kg = " +
            std::to_string(deviation) + "}\n" +
            (correlation == 0 ? std::string()
                              : "parameter_covariances = {drag_m2_kg = [0, 0, 0, 0, " +
                                    std::to_string(correlation * deviation * 0.001) + ", 0]}\n"),
        1);
  };
  const double speed = along_track(state_named(study_uncertainty(scene_with(0, 0)), "chief"));
  const auto with = [&](double correlation) {
    return along_track(state_named(study_uncertainty(scene_with(0.003, correlation)), "chief"));
  };
  const double both = with(0);
  const double drag = std::sqrt(both * both - speed * speed);
  // Faster falls behind, more drag leads.
  EXPECT_NEAR(with(1), std::abs(speed - drag), 1e-4 * both);
  EXPECT_NEAR(with(-1), speed + drag, 1e-4 * both);
}

TEST(UncertainParameters, MomentsAreThoseOfStatesThatWereFlown) {
  const std::string deputy = "[deputy]\nposition_m = [0, -300, 0]\n";
  const UncertaintyResult result = study_uncertainty(scene_in_even_air(
      "position_m = [0.1, 0.1, 0.1]\nsamples = 600\n"
      "parameters = {density_factor = 0.3, drag_m2_kg = 0.002}\n"
      "[uncertainty.deputy]\nposition_m = [0.1, 0.1, 0.1]\nparameters = {drag_m2_kg = 0.004}\n",
      3, 6, deputy));
  for (const std::string name : {"chief", "deputy", "relative"}) {
    expect_flown(state_named(result, name));
  }
  // Of 30 % that both share and 10 and 20 % of their own the difference has the latter alone; one
  // that drew the density for each spacecraft by itself would have it too.
  const UncertainState& relative = state_named(result, "relative");
  const double shares = std::sqrt((0.01 + 0.04) / (0.09 + 0.04));
  EXPECT_NEAR(along_track(relative) / along_track(state_named(result, "deputy")), shares, 0.02);
  // The product of density and coefficient has a kurtosis that Gaussian deviations have not.
  EXPECT_GT(relative.cartesian.back().excess_kurtosis()[1], 0.1);
}

// The mean of a deputy with another coefficient is its own flight, and the difference of two
// spacecraft that are known but for the air is a deviation along one line.
TEST(UncertainParameters, UnlikeDeputiesFlyWithTheirOwnCoefficients) {
  const std::string deputy =
      "[deputy]\nposition_m = [0, -300, 0]\nspacecraft = {drag_m2_kg = 0.03}\n";
  const std::string uncertainty =
      "samples = 400\nparameters = {density_factor = 0.1}\n"
      "[uncertainty.deputy]\nposition_m = [1, 1, 1]\n";
  const UncertaintyResult result = study_uncertainty(scene_in_even_air(uncertainty, 3, 6, deputy));
  for (const std::string name : {"deputy", "relative"}) expect_flown(state_named(result, name));
  const double t = 6 * 3600;
  const double lead = 1.5 * 0.01 * 1e-12 * (398600.4415e9 / 6878.1363e3) / 2 * t * t;
  EXPECT_NEAR(state_named(result, "deputy").cartesian.back().mean()[1], lead - 300, 0.03 * lead);
  ASSERT_EQ(result.parameter_effects.size(), 1U);
  for (const ParameterEffect::Along& along : result.parameter_effects[0].along) {
    if (along.state == "relative") {
      EXPECT_NEAR(along.deviations[1], 0.1 * lead, 0.03 * lead);
    }
  }
}

TEST(UncertainParameters, WhatMakesNoSenseIsRefused) {
  const std::string deputy =
      "[deputy]\nposition_m = [0, -300, 0]\nspacecraft = {drag_m2_kg = 0.03}\n";
  const auto refusal = [&](const std::string& uncertainty, const std::string& more = "") {
    try {
      study_uncertainty(scene_in_even_air(uncertainty, 2, 1, more));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto expect_says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), text.npos) << text;
  };
  expect_says(refusal("parameters = {radiation_m2_kg = 0.1}\n"), "of no effect without light");
  expect_says(refusal("parameters = {drag = 0.1}\n"), "no parameter of the forces");
  expect_says(refusal("parameters = {drag_m2_kg = -0.1}\n"), "no standard deviation, got -0.1");
  expect_says(refusal("parameters = {mu_km3_s2 = 1, J2 = 1, J3 = 1, density_factor = 1}\n"),
              "beyond the field");
  expect_says(refusal("parameters = {density_factor = 1}\n"
                      "parameter_covariances = {density_factor = [0, 0, 0, 0, 0, 0]}\n"),
              "that all spacecraft share");
  expect_says(refusal("position_m = [1, 1, 1]\nparameters = {drag_m2_kg = 1e-3}\n"
                      "parameter_covariances = {drag_m2_kg = [0, 2e-3, 0, 0, 0, 0]}\n"),
              "not positive semidefinite");
  expect_says(refusal("position_m = [1, 1, 1]\n[uncertainty.deputy]\n"
                      "parameters = {density_factor = 0.1}\n",
                      deputy),
              "must stand in uncertainty.parameters");
  expect_says(refusal("parameters = {drag_m2_kg = 1e-3}\ncollision = {radius_m = 10}\n",
                      "[deputy]\nposition_m = [0, -300, 0]\n"),
              "is of states alone");
  expect_says(refusal("parameters = {drag_m2_kg = 1e-3}\ncoordinates = [\"poincare\"]\n"),
              "must be left out");
}

// A standard deviation beyond the value itself: of the chief, of all, and of a deputy with a
// coefficient of its own.
TEST(UncertainParameters, DeviationsBeyondTheValueAreWarnedOf) {
  const auto warnings = [](const std::string& uncertainty, const std::string& deputy = "") {
    std::string all;
    for (const std::string& one : scene_in_even_air(uncertainty, 2, 1, deputy).warnings) {
      all += one + "\n";
    }
    return all;
  };
  const std::string state = "position_m = [1, 1, 1]\n";
  EXPECT_EQ(warnings("parameters = {density_factor = 0.9, drag_m2_kg = 0.02}\n").find("more than"),
            std::string::npos);
  const std::string both = warnings("parameters = {density_factor = 4, drag_m2_kg = 0.04}\n");
  EXPECT_NE(
      both.find("uncertainty.parameters.density_factor: more than the parameter itself, got a "
                "standard deviation of 4 beside a value of 1, should be at most 1"),
      std::string::npos)
      << both;
  EXPECT_NE(
      both.find("drag_m2_kg: more than the parameter itself, got a standard deviation of 0.04 "
                "beside a value of 0.02"),
      std::string::npos)
      << both;
  const std::string deputy =
      "[deputy]\nposition_m = [0, -300, 0]\nspacecraft = {drag_m2_kg = 0.03}\n";
  const std::string of_deputy = "[uncertainty.deputy]\nposition_m = [1, 1, 1]\nparameters = ";
  EXPECT_EQ(warnings(state + of_deputy + "{drag_m2_kg = 0.025}\n", deputy).find("more than"),
            std::string::npos);
  EXPECT_NE(warnings(state + of_deputy + "{drag_m2_kg = 0.035}\n", deputy)
                .find("beside a value of 0.03, should be at most 0.03"),
            std::string::npos);
}

TEST(UncertainParameters, DeputiesFarFromTheirChiefsCoefficientAreWarnedOf) {
  const auto warnings = [](const std::string& drag) {
    std::string all;
    const Scene scene = scene_in_even_air(
        "position_m = [1, 1, 1]\n", 2, 1,
        "[deputy]\nposition_m = [0, -300, 0]\nspacecraft = {drag_m2_kg = " + drag + "}\n");
    for (const std::string& one : scene.warnings) all += one + "\n";
    return all;
  };
  EXPECT_EQ(warnings("0.04").find("far from that of its chief"), std::string::npos);
  EXPECT_NE(warnings("0.09").find("deputy.spacecraft: far from that of its chief, got drag_m2_kg = "
                                  "0.09 beside 0.02, should be up to 0.04"),
            std::string::npos)
      << warnings("0.09");
}

}  // namespace
}  // namespace hamjet::uncertain_parameters_tests
