#include "uncertainty/real_encounters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "../src/uncertainty/entry_sampler.hpp"
#include "../src/uncertainty/flown_separations.hpp"
#include "hamjet/uncertainty/collision_probability.hpp"

// Probabilities of real conjunctions, whose states are Gaussian in elements: against published
// samples and against flights.

namespace hamjet {
namespace {

test::RealEncounter real_encounter_of_case(int number) {
  for (const test::RealEncounter& e : test::real_encounters()) {
    if (e.number == number) return e;
  }
  throw std::runtime_error("no such conjunction");
}

CollisionSettings samples_of_real(long samples) {
  CollisionSettings s;
  s.samples = samples;
  s.threads = 2;
  return s;
}

/// Published are samples in equinoctial elements, in two-body motion. Poincaré's elements depart
/// from these by the second order of deviations of their sizes, not of the longitude.
void expect_published_of_real(const std::vector<test::RealEncounter>& encounters, long samples) {
  for (const test::RealEncounter& e : encounters) {
    const CollisionProbability result = collision_probability(e.problem, samples_of_real(samples));
    const std::string name = "conjunction " + std::to_string(e.number);
    EXPECT_EQ(result.sampling, CollisionSampling::entries) << name;
    EXPECT_LE(result.standard_error, 0.05 * result.probability) << name;
    const bool is_inside = result.probability >= e.lower && result.probability <= e.upper;
    EXPECT_TRUE(is_inside || std::abs(result.probability - e.probability) < 0.1 * e.probability)
        << name << ": " << result.probability << ", published " << e.probability;
    EXPECT_LE(result.lower, e.upper) << name;
    EXPECT_GE(result.upper, e.lower) << name;
  }
}

TEST(RealEncounters, AgreeWithPublishedSamples) {
  // The formula for short encounters gives 2.9e-7 of the first, 4.5e-23 of the second.
  expect_published_of_real({real_encounter_of_case(29), real_encounter_of_case(25)}, 20'000);
}

TEST(RealEncountersAtLength, AgreeWithPublishedSamples) {
  expect_published_of_real(test::real_encounters(), 200'000);
}

TEST(RealEncounters, AgreeWithFlightsOfPlainDeviations) {
  // With a hundred times the radius plain deviations collide often enough to be flown.
  test::RealEncounter e = real_encounter_of_case(29);
  e.problem.radius *= 100;
  constexpr std::size_t count = 4000;
  RandomStream random(3, 0);
  std::vector<EncounterDeviation> deviations(count);
  for (EncounterDeviation& deviation : deviations) {
    for (double& x : deviation) x = random.normal();
  }
  double hits = 0;
  for (const double separation : flown_separations(e.problem, deviations)) {
    hits += separation < e.problem.radius;
  }
  ASSERT_GT(hits, 25);
  const double flown = hits / count;
  const CollisionProbability result = collision_probability(e.problem, samples_of_real(20'000));
  EXPECT_NEAR(result.probability, flown,
              4 * std::hypot(result.standard_error, std::sqrt(flown / count)));
}

TEST(RealEncounters, DeviateAlongTheirElements) {
  const test::RealEncounter e = real_encounter_of_case(48);
  const UncertainSpacecraft& craft = e.problem.spacecraft[1];
  Eigen::Matrix<double, 6, 1> xi;
  xi << 1, -1, 0.5, 0.2, -0.3, 0.4;
  const Eigen::Matrix<double, 6, 1> b = (*craft.straight)(craft.factor * xi);
  const auto deviated = craft.deviated(xi);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(deviated[k], craft.state[k] + b[static_cast<Eigen::Index>(k)]);
  }
}

}  // namespace
}  // namespace hamjet
