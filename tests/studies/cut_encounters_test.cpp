#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "formation_scenes.hpp"
#include "formats/orbit_messages/encounter_message.hpp"
#include "report/uncertainty/collision_section.hpp"
#include "studies/uncertainty/collision_study.hpp"

// What is told of an encounter whose passage an edge of the window cuts, here in its middle.
// Expected: the probability of a straight passage with a round Gaussian, an integral over the disc.

namespace hamjet {
namespace {

constexpr double passage_radius_m = 10;
constexpr double deviation_m = 20;
constexpr double passage_miss_m = 5;

/// A deputy that crosses the chief's plane at the start, 5 m above the chief.
Scene crossing_at_the_start(double speed_m_s = 3000) {
  Scene scene = kepler_chief(0, 7000, std::sqrt(std::pow(7000.0, 3) / 398600.4415), 2);
  scene.duration = 0.05;
  scene.deputy =
      DeputySettings{RelativeFrame::rtn_inertial, {{passage_miss_m, 0, 0}, {0, 0, speed_m_s}}};
  scene.ephemeris = EphemerisSettings{"2026-03-01T06:00:00", "UTC", "GCRF", "EARTH"};
  StateUncertainty state;
  Vector<double> deviations(6);
  deviations << deviation_m, deviation_m, deviation_m, 1e-3, 1e-3, 1e-3;
  state.covariance = Covariance::of_standard_deviations(deviations);
  UncertaintySettings& uncertainty = scene.uncertainty.emplace();
  uncertainty.deputy = state;
  uncertainty.gaussian_in = GaussianIn::positions;
  uncertainty.times = {0.05};
  uncertainty.samples = 0;
  CollisionWatch& collision = uncertainty.collision.emplace();
  collision.radius_m = passage_radius_m;
  collision.from = 0;
  collision.to = 0.05;
  collision.has_window = true;
  collision.samples = 20000;
  return scene;
}

double straight_probability() {
  const double variance = deviation_m * deviation_m;
  constexpr int steps = 10000;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double r = passage_radius_m * (k + 0.5) / steps;
    sum += r / variance * std::exp(-(r * r + passage_miss_m * passage_miss_m) / (2 * variance)) *
           std::cyl_bessel_i(0.0, r * passage_miss_m / variance);
  }
  return sum * passage_radius_m / steps;
}

class CutEncountersOfSpeed : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(FastAndSlow, CutEncountersOfSpeed, ::testing::Values(3000.0, 20.0));

TEST_P(CutEncountersOfSpeed, TheMessageIsOfTheWholePassageAndTheHeadlineWarns) {
  const Scene scene = crossing_at_the_start(GetParam());
  const CollisionResult result = study_collision(scene, 1);
  ASSERT_TRUE(result.of_whole_passage);
  EXPECT_FALSE(result.is_cut_by_burn);
  ASSERT_FALSE(io::encounter_message_lack(scene, result));
  const double told = *io::encounter_message(scene, result).collision_probability;
  EXPECT_EQ(told, result.of_whole_passage->probability);
  EXPECT_NEAR(told / straight_probability(), 1, 0.02);
  EXPECT_LT(result.probability.probability, 0.8 * told);
  EXPECT_LT(result.whole_from_s, 0);
  const std::string headline = io::collision_section(scene, result).verdict;
  EXPECT_NE(headline.find("an edge of the window lies inside the passage"), std::string::npos)
      << headline;
}

// At 5 cm/s the uncertainty of 20 m takes more than an hour to pass: no straight line tells when
// the encounter begins, so that a window of one's own is told of as what it is.
TEST(CutEncounters, NoMessageStatesTheProbabilityOfAPartOfASlowEncounter) {
  Scene scene = crossing_at_the_start(0.05);
  scene.uncertainty->collision->from = -0.05;
  CollisionResult result = study_collision(scene, 1);
  ASSERT_FALSE(result.of_whole_passage);
  ASSERT_NE(nearest_approach(result), nullptr);
  EXPECT_FALSE(has_whole_passage(result));
  EXPECT_FALSE(io::encounter_message(scene, result).collision_probability);
  const std::string headline = io::collision_section(scene, result).verdict;
  EXPECT_NE(headline.find("a part of a slow encounter"), std::string::npos) << headline;
  result.watch.has_window = false;
  EXPECT_TRUE(io::encounter_message(scene, result).collision_probability);
}

// What was not sampled has no interval, and its 0 is not told as one that was measured.
TEST(CutEncounters, WhatWasNotSampledIsSaidToBe) {
  const Scene scene = crossing_at_the_start();
  CollisionResult result = study_collision(scene, 1);
  result.probability = CollisionProbability{};
  const auto section = io::collision_section(scene, result);
  for (const std::string& text : {section.verdict, section.table}) {
    EXPECT_NE(text.find(" 0, not sampled: no path within 9 standard deviations"), std::string::npos)
        << text;
    EXPECT_EQ(text.find("from 0 to 0"), std::string::npos) << text;
  }
}

TEST(CutEncounters, AfterABurnThatCutsThePassageThereIsNoMessage) {
  Scene scene = crossing_at_the_start();
  BurnUncertainty& burn = scene.uncertainty->burn.emplace();
  burn.velocity_change_m_s = {0, 1, 0};
  burn.magnitude = 0.01;
  const CollisionResult result = study_collision(scene, 1);
  EXPECT_TRUE(result.is_cut_by_burn);
  EXPECT_FALSE(result.of_whole_passage);
  ASSERT_FALSE(result.warnings.empty());
  const auto lack = io::encounter_message_lack(scene, result);
  ASSERT_TRUE(lack);
  EXPECT_NE(lack->find("the burn at the start lies inside the passage"), std::string::npos);
  const auto section = io::collision_section(scene, result);
  EXPECT_NE(section.verdict.find("the burn at the start lies inside the passage"),
            std::string::npos);
  for (const auto& file : section.files) EXPECT_NE(file.path, "encounter.cdm");
}

}  // namespace
}  // namespace hamjet
