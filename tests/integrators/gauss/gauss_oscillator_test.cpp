#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/flow.hpp"

// On the harmonic oscillator a Gauss method is an exact rotation by a known angle a step.

namespace hamjet {
namespace {

/// The angle of a step of size y = omega h: the argument of the diagonal Pade approximant of
/// exp(i y); 2 atan(y/2) for one stage (Hairer, Lubich and Wanner, section II.1).
Extended rotation(int stages, const Extended& y) {
  const Extended y2 = y * y;
  switch (stages) {
    case 1:
      return 2 * atan(y / 2);
    case 2:
      return 2 * atan2(Extended(y / 2), Extended(1 - y2 / 12));
    case 3:
      return 2 * atan2(Extended(y / 2 - y2 * y / 120), Extended(1 - y2 / 10));
    default:
      return 2 * atan2(Extended(y / 2 - y2 * y / 84), Extended(1 - 3 * y2 / 28 + y2 * y2 / 1680));
  }
}

/// State after `count` steps of size h from (1, 0).
void expect_rotation(double omega, double h, long count, int stages, double mass = 1) {
  const double stiffness = omega * omega * mass;
  const test::Flow<double> flow{
      harmonic_oscillator(mass, stiffness), {1, 0}, h * static_cast<double>(count), 3, {}};
  IntegrationStatistics statistics;
  const auto jet = test::run_gauss(flow, test::fixed_step(stages, h), &statistics);
  ASSERT_EQ(statistics.steps, count);
  const Extended step = Extended(flow.duration) / count;
  const Extended angle = count * rotation(stages, omega * step);
  const double c = static_cast<double>(cos(angle));
  const double s = static_cast<double>(sin(angle));
  // Each step rounds a few times; the eliminated momentum enters by h^2 A^2 k/m, whose size is the
  // condition number of a step.
  const double condition =
      1 + static_cast<double>(omega * step) * static_cast<double>(omega * step);
  const double bound = 0x1p-52 * condition * (8 + static_cast<double>(count));
  const double w = omega * mass;
  const double expected[2][2] = {{c, s / w}, {-w * s, c}};
  const double scale[2][2] = {{1, 1 / w}, {w, 1}};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(jet[i][0], expected[i][0], bound * scale[i][0]) << stages << " stages, h = " << h;
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(jet[i][1 + j], expected[i][j], bound * scale[i][j]) << stages << " stages";
    }
    for (std::size_t k = 3; k < jet[i].size(); ++k) EXPECT_EQ(jet[i][k], 0);
  }
}

TEST(GaussOscillator, IsTheExactDiscreteRotation) {
  for (int stages = 1; stages <= 4; ++stages) {
    expect_rotation(1, 0.0625, 100, stages);
    expect_rotation(1, 1, 50, stages, 2.5);
    expect_rotation(1e4, 0.0009765625, 100, stages);  // omega h = 9.8: unresolved, not unstable
    expect_rotation(1e4, 0x1p-17, 1000, stages);
  }
}

TEST(GaussOscillator, HasASolutionHoweverStiff) {
  // The stage equations of a linear system always have one: k/m = 1e12, omega h = 977.
  for (int stages = 1; stages <= 4; ++stages) expect_rotation(1e6, 0.0009765625, 100, stages);
}

/// reference_cases.json, "linear": 10^2 to 10^4 steps of one to four stages. Their durations are
/// whole multiples of the step to within the rounding of n h, which shifts the phase by 2^-53 omega
/// n h; each step rounds the phase by no more.
void expect_printed_answers(double lowest_omega, double highest_omega) {
  for (const auto& entry : test::reference_cases()["linear"]["oscillators"]) {
    const double h = test::from_hex(entry["h_hex"]);
    const long count = entry["n"].get<long>();
    if (count > 10000) continue;  // each run takes a second
    const double omega = entry["omega"].get<double>();
    if (omega < lowest_omega || omega > highest_omega) continue;
    const test::Flow<double> flow{
        harmonic_oscillator(1, omega * omega), {1, 0}, h * static_cast<double>(count), 1, {}};
    for (int stages = 1; stages <= 4; ++stages) {
      const std::string key =
          "GL" + std::to_string(stages) + "(order " + std::to_string(2 * stages) + ")";
      const double q = static_cast<double>(test::from_decimal(entry[key][0]));
      const double p = static_cast<double>(test::from_decimal(entry[key][1]));
      IntegrationStatistics statistics;
      const auto jet = test::run_gauss(flow, test::fixed_step(stages, h), &statistics);
      EXPECT_EQ(statistics.steps, count);
      const double y = omega * h;
      const double phase = 0x1p-52 * (1 + y) * static_cast<double>(count);
      EXPECT_NEAR(jet[0][0], q, phase) << key << ", omega " << omega << ", h " << h;
      EXPECT_NEAR(jet[1][0], p, phase * omega) << key << ", omega " << omega << ", h " << h;
    }
  }
}

TEST(GaussOscillator, MatchesThePrintedDiscreteAnswers) { expect_printed_answers(1, 1e4); }
TEST(GaussOscillator, MatchesThePrintedStiffestAnswers) { expect_printed_answers(1e6, 1e6); }

TEST(GaussOscillator, HighOrderGivesTheContinuousRotation) {
  // q(t) = cos t, p(t) = -sin t; ten time units in adaptive steps.
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, 10, 2, {}};
  const auto jet = test::run_gauss(flow, test::adaptive(8, 1e-16));
  const double expected[2][2] = {{std::cos(10.0), std::sin(10.0)},
                                 {-std::sin(10.0), std::cos(10.0)}};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(jet[i][0], expected[i][0], 1e-14);
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(jet[i][1 + j], expected[i][j], 1e-14);
    for (std::size_t k = 3; k < jet[i].size(); ++k) EXPECT_EQ(jet[i][k], 0);
  }
}

TEST(GaussOscillator, FallsWhereTheForceIsAttractive) {
  // p' = -k q: the paper prints +k in the equations of the state transition matrix, which would
  // grow as cosh (data/paper/README.md). dq/dq0 = cos t.
  const test::Flow<double> flow{harmonic_oscillator(), {0, 0}, 1, 1, {}};
  EXPECT_NEAR(test::run_gauss(flow)[0][1], std::cos(1.0), 1e-14);
}

}  // namespace
}  // namespace hamjet
