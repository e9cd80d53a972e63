#include "studies/stability/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "support/scenes.hpp"
#include "support/text.hpp"

// How a case comes out is decided on the harmonic oscillator, whose flow is the rotation (q, p) ->
// (c q + s p, c p - s q), and on Kepler's problem, whose coefficients of degree k grow as t^k.

namespace hamjet {
namespace {

const std::string oscillator = R"(schema = 1
title = "oscillator"
)" + test::changed(test::oscillator_tables, "[0]", "[0.5]") +
                               R"([jet]
order = 2
duration_canonical = 2
)" + test::gauss8("tolerance = 1e-15");

const std::string kepler_orbit = R"(schema = 1
title = "Kepler"
[system]
model = "kepler"
mu_km3_s2 = 1
[nominal]
position_km = [1, 0, 0]
velocity_km_s = [0, 1.1, 0.2]
[jet]
order = 3
duration_canonical = 400
)" + test::gauss8("step_canonical = 0.5");

StabilityCase case_of(const std::string& text, const std::vector<io::Override>& changes = {}) {
  StabilityCase subject{"case", "title", "group", "why", {}, Scene{}};
  subject.expected.source = "closed form";
  try {
    subject.scene = io::parse_scene(text, "case.toml", changes);
  } catch (const Error& error) {
    subject.scene = error;
  }
  return subject;
}

/// The oscillator's exact state at t = 2.
StabilityCase exact_oscillator() {
  StabilityCase subject = case_of(oscillator);
  const Extended c = cos(Extended(2));
  const Extended s = sin(Extended(2));
  subject.expected.state = {c + s / 2, c / 2 - s};
  subject.expected.matrix = {c, s, -s, c};
  return subject;
}

TEST(Stability, AnExactStateAndMatrixAreRight) {
  const StabilityCase subject = exact_oscillator();
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::right) << result.text;
  ASSERT_EQ(result.measured.size(), 2U);
  EXPECT_LE(result.error->ratio(), 1);
  EXPECT_GT(*result.steps, 0);
}

TEST(Stability, AWrongReferenceIsWrong) {
  StabilityCase subject = exact_oscillator();
  subject.expected.matrix[2] += Extended(1e-13);
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::wrong);
  EXPECT_EQ(result.error->quantity, "matrix");
  EXPECT_NEAR(result.error->error, 1e-13, 2e-15);
  EXPECT_NE(result.text.find("exceeds"), std::string::npos) << result.text;
}

TEST(Stability, ATolerancePassesWhatItSays) {
  StabilityCase subject = exact_oscillator();
  subject.expected.state[0] += Extended(1e-10);
  subject.expected.tolerance = 1.1e-10;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::right);
  subject.expected.tolerance = 0.9e-10;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, NothingComparedIsWrong) {
  const StabilityResult result = run_stability_case(case_of(oscillator));
  EXPECT_EQ(result.outcome, CaseOutcome::wrong);
  EXPECT_NE(result.text.find("nothing was compared"), std::string::npos) << result.text;
}

TEST(Stability, ARefusalMustBeTheRightOne) {
  StabilityCase subject = case_of(oscillator, {{"jet.duration_canonical", "nan"}});
  subject.expected.outcome = CaseOutcome::refused;
  subject.expected.exit_code = 3;
  subject.expected.message = "duration_canonical";
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::refused);
  subject.expected.exit_code = 4;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
  subject.expected.exit_code = 3;
  subject.expected.message = "collision";
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, AResultWhereARefusalIsRightIsWrong) {
  StabilityCase subject = exact_oscillator();
  subject.expected.outcome = CaseOutcome::refused;
  subject.expected.exit_code = 4;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, ARefusalWhereAResultIsRightIsWrong) {
  StabilityCase subject = case_of(oscillator, {{"system.mass_kg", "0"}});
  subject.expected.state = {0, 0};
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::wrong);
  EXPECT_NE(result.text.find("mass_kg"), std::string::npos) << result.text;
}

TEST(Stability, AFailedCheckMarksTheResult) {
  // The explicit method jumps over the centre, and its energy shows it.
  StabilityCase subject = case_of(kepler_orbit, {{"nominal.velocity_km_s", "[0, 0, 0]"},
                                                 {"jet.duration_canonical", "2"},
                                                 {"jet.order", "1"},
                                                 {"integrator.gauss8.stages", "null"},
                                                 {"integrator.gauss8.method", "velocity-verlet"},
                                                 {"integrator.gauss8.step_canonical", "0.01"}});
  subject.expected.outcome = CaseOutcome::marked;
  subject.expected.mark = "energy";
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::marked);
  subject.expected.mark = "surface";
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, ATwinOfAnotherOrderIsEqualToTheBit) {
  StabilityCase subject = case_of(kepler_orbit, {{"jet.duration_canonical", "3"}});
  Scene twin = std::get<Scene>(subject.scene);
  twin.order = 1;
  subject.expected.twin = twin;
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::right) << result.text;
  EXPECT_EQ(result.measured.size(), 2U);  // degrees 0 and 1
  EXPECT_EQ(result.error->error, 0);
  subject.expected.twin->duration = 3.001;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, OutAndBackEndsAtTheStart) {
  StabilityCase subject = case_of(kepler_orbit, {{"jet.duration_canonical", "20"}});
  subject.expected.round_trip = true;
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::right) << result.text;
  EXPECT_LT(result.error->error, 1e-12);
}

TEST(Stability, TheConditionIsThatOfTheInvertedBlock) {
  // F1 of the oscillator inverts dq/dp0 = sin t alone, whose condition is 1.
  StabilityCase subject = case_of(oscillator +
                                  "[generating_function]\nkinds = "
                                  "[\"F1\"]\n");
  subject.expected.condition = {"F1", 1};
  subject.expected.tolerance = 1e-15;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::right);
  subject.expected.condition->value = 1.1;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, CoefficientsOfKeplersProblemGrowAsPowersOfTime) {
  StabilityCase subject = case_of(kepler_orbit, {{"jet.duration_canonical", "1600"}});
  GrowthExpectation growth;
  growth.checkpoints = 8;
  growth.coefficient_exponents = {1, 2, 3};
  growth.exponent_tolerance = 0.2;
  subject.expected.growth = growth;
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::right) << result.text;
  ASSERT_EQ(result.growth.size(), 3U);
  subject.expected.growth->coefficient_exponents = {1, 2, 2};
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, TheErrorOfASymplecticMethodGrowsWithTimeAndItsEnergyErrorDoesNot) {
  // Hairer, Lubich and Wanner, theorem X.3.1: linear growth on integrable systems.
  StabilityCase subject = case_of(kepler_orbit, {{"integrator.gauss8.stages", "2"},
                                                 {"integrator.gauss8.step_canonical", "0.05"},
                                                 {"jet.order", "1"}});
  GrowthExpectation growth;
  growth.checkpoints = 5;
  growth.error_exponent = 1.15;
  growth.energy_exponent = 0.2;
  subject.expected.growth = growth;
  const StabilityResult result = run_stability_case(subject);
  EXPECT_EQ(result.outcome, CaseOutcome::right) << result.text;
  EXPECT_GT(*result.growth[0].exponent, 0.85);
  subject.expected.growth->error_exponent = 0.5;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, GrowthThatCannotBeFollowedIsWrong) {
  const auto outcome = [](const std::vector<io::Override>& changes,
                          const GrowthExpectation& growth) {
    StabilityCase subject = case_of(kepler_orbit, changes);
    subject.expected.growth = growth;
    return run_stability_case(subject).outcome;
  };
  GrowthExpectation growth;
  growth.error_exponent = 3;
  growth.checkpoints = 3;
  const std::vector<io::Override> small = {{"jet.order", "1"}, {"jet.duration_canonical", "16"}};
  EXPECT_EQ(outcome(small, growth), CaseOutcome::right);
  EXPECT_EQ(outcome({{"jet.order", "1"}, {"jet.duration_canonical", "0"}}, growth),
            CaseOutcome::wrong);
  GrowthExpectation beyond = growth;
  beyond.coefficient_exponents = {1, 2};
  EXPECT_EQ(outcome(small, beyond), CaseOutcome::wrong);
  GrowthExpectation elsewhere = growth;
  elsewhere.times = {1, 2, 3.3};
  EXPECT_EQ(outcome(small, elsewhere), CaseOutcome::wrong);
}

TEST(Stability, AnEntryThatIsZeroStaysZero) {
  StabilityCase subject =
      case_of(kepler_orbit, {{"jet.order", "1"}, {"jet.duration_canonical", "0"}});
  for (int i = 0; i < 36; ++i) subject.expected.matrix.emplace_back(i % 7 == 0 ? 1 : 0);
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::right);
  subject.expected.matrix[1] = Extended(1e-20);
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);  // no step rounds nothing
  subject = case_of(kepler_orbit, {{"jet.order", "1"}, {"jet.duration_canonical", "1"}});
  subject.expected.matrix.assign(36, Extended(0));
  subject.expected.tolerance = 100;
  EXPECT_EQ(run_stability_case(subject).outcome, CaseOutcome::wrong);
}

TEST(Stability, WhatProgressThrowsIsPassedOn) {
  struct Stop {};
  EXPECT_THROW(
      run_stability_case(exact_oscillator(), [](const std::string&, double) { throw Stop{}; }),
      Stop);
}

}  // namespace
}  // namespace hamjet
