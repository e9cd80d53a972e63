#include "hamjet/maps/exactness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"

namespace hamjet {
namespace {

/// The largest coefficient, of degree below the order, of d sigma_i / d w_j - d sigma_j / d w_i.
template <class T>
double pair_residual(const std::vector<Series<T>>& sigma, std::size_t i, std::size_t j) {
  const Series<T> residual = derivative(sigma[i], j) - derivative(sigma[j], i);
  double result = 0;
  for (std::size_t k = 0; k < residual.space().first(residual.order()); ++k) {
    result = test::larger(result, std::abs(static_cast<double>(residual[k])));
  }
  return result;
}

TEST(Exactness, ConditionHasTheSignOfOneGeneratingFunction) {
  // The paper prints dS1/dq = dS2/dq0 for p0 = S1, p = S2. For the oscillator dp0/dq = 1/sin t and
  // dp/dq0 = -1/sin t: closed is p dq - p0 dq0 (data/paper/README.md).
  const double t = 0.7;
  const test::Flow<double> flow{harmonic_oscillator(), {0.2, 0.1}, t, 1, {}};
  const auto inversion = test::inverted_jet(test::run_gauss(flow), "F1");
  EXPECT_NEAR(inversion.remaining_initial[0][1], 1 / std::sin(t), 1e-14);
  EXPECT_NEAR(inversion.remaining_final[0][2], -1 / std::sin(t), 1e-14);
  EXPECT_LE(exactness_residual(one_form(inversion))[0].absolute, 1e-14);
  const std::vector<Series<double>> as_printed{inversion.remaining_final[0],
                                               inversion.remaining_initial[0]};
  EXPECT_NEAR(exactness_residual(as_printed)[0].absolute, 2 / std::sin(t), 1e-13);
}

TEST(Exactness, OfAnExactFormVanishesAndOfOthersIsKnown) {
  const auto space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  // d(x^2 y) = 2 x y dx + x^2 dy.
  for (const auto& entry : exactness_residual<double>({2.0 * x * y, x * x})) {
    EXPECT_EQ(entry.absolute, 0);
    EXPECT_EQ(entry.scaled, 0);
    EXPECT_FALSE(entry.at_formation_scale.has_value());
  }
  // (3 x y) dx + x^2 dy: d/dy - d/dx = 3 x - 2 x = x, at degree 1; the largest derivative is 3.
  const std::vector<double> scales{0.5, 0.25};
  const auto residual = exactness_residual<double>({3.0 * x * y, x * x}, scales);
  ASSERT_EQ(residual.size(), 3u);
  EXPECT_EQ(residual[0].absolute, 0);
  EXPECT_EQ(residual[1].degree, 1);
  EXPECT_EQ(residual[1].absolute, 1);
  EXPECT_EQ(residual[1].scaled, 1.0 / 3);
  EXPECT_EQ(residual[1].at_formation_scale, 0.5 * 0.25 * 0.5);
  EXPECT_EQ(residual[2].absolute, 0);
  test::expect_error(ErrorKind::usage, "scale", [&] {
    exactness_residual<double>({x, y}, std::vector<double>{1});
  });
}

TEST(Exactness, OfMidpointAndGaussOnThePaperOrbitMeetsTheStatedBounds) {
  // The stated bounds for F1 are 1e-11 at degree 0 and 1e-10 at degree 1, both absolute. The jet is
  // inverted in extended precision, so that the residual is the integrator's.
  const double t = test::paper_orbit().duration;
  for (const auto& settings :
       {test::fixed_step(1, 0.01), test::fixed_step(2, 0.01), test::adaptive()}) {
    const auto jet = test::paper_jet<double>(t, 2, settings);
    const auto wide = convert_map<Extended>(jet);
    const auto residual = exactness_residual(one_form(test::inverted_jet(wide, "F1")));
    EXPECT_LE(residual[0].absolute, 1e-11) << settings.stages << " stages";
    EXPECT_LE(residual[1].absolute, 1e-10) << settings.stages << " stages";
  }
}

TEST(Exactness, IsNoAccuracy) {
  // The midpoint run of the paper is wrong by 1.8e-3 in position (12.5 km) all the same; the run of
  // eight stages is right to 1e-12.
  const auto position_error = [](const GaussSettings& settings) {
    const auto jet = test::paper_jet<double>(test::paper_orbit().duration, 1, settings);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += std::pow(jet[i][0] - static_cast<double>(test::paper_orbit().state[i]), 2);
    }
    return std::sqrt(sum);
  };
  EXPECT_NEAR(position_error(test::fixed_step(1, 0.01)), 1.8e-3, 0.1e-3);
  EXPECT_LE(position_error(test::adaptive()), 1e-12);
}

TEST(Exactness, FallsWithThePrecisionOfTheChain) {
  // Two stages and a step of 0.2 give a map that is far from right, yet exact to extended
  // round-off.
  const auto jet =
      test::paper_jet<Extended>(test::paper_orbit().duration, 4, test::fixed_step(2, 0.2));
  const auto residual = exactness_residual(one_form(test::inverted_jet(jet, "F1")));
  ASSERT_EQ(residual.size(), 4u);
  EXPECT_LE(residual[3].scaled, 1e-16);
  EXPECT_GT(residual[3].scaled, 0);
}

TEST(Exactness, EveryPairSeesAChangeOfOneCoefficient) {
  const auto jet = test::paper_jet<double>(test::paper_orbit().duration, 2);
  const auto base = one_form(test::inverted_jet(jet, "F1"));
  std::set<std::pair<std::size_t, std::size_t>> seen;
  double overall = 0;
  for (const auto& entry : exactness_residual(base))
    overall = test::larger(overall, entry.absolute);
  double background = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      background = test::larger(background, pair_residual(base, i, j));
    }
  }
  EXPECT_EQ(overall,
            background);  // the reported residual consists of all pairs and of nothing else
  for (std::size_t component = 0; component < 6; ++component) {
    for (std::size_t k = 1; k < 7; ++k) {
      auto changed = jet;
      changed[component][k] += 1e-6;
      const auto sigma = one_form(test::inverted_jet(changed, "F1"));
      double largest = 0;
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j) {
          const double value = pair_residual(sigma, i, j);
          largest = test::larger(largest, value);
          if (value > 100 * background) seen.emplace(i, j);
        }
      }
      // The reported residual shows each change by the same amount.
      double reported = 0;
      for (const auto& entry : exactness_residual(sigma)) {
        reported = test::larger(reported, entry.absolute);
      }
      EXPECT_EQ(reported, largest);
      EXPECT_GT(reported, 100 * background) << "component " << component << ", variable " << k - 1;
    }
  }
  EXPECT_EQ(seen.size(), 15u);
}

TEST(Exactness, SurvivesAdaptiveStepsOnEccentricOrbits) {
  // Kepler from perigee with e = 0.74 and 0.9 over 0.9 periods: the symplecticity is at round-off
  // with steps that vary by a factor of a hundred, and the nominal is as right as its tolerance
  // says.
  for (const double e : {0.74, 0.9}) {
    test::Flow<double> flow{
        kepler(), {1 - e, 0, 0, 0, std::sqrt((1 + e) / (1 - e)), 0}, 5.6, 4, {}};
    const auto coarse = test::run_gauss(flow, test::adaptive(8, 1e-10));
    const auto fine = test::run_gauss(flow, test::adaptive(8, 1e-17));
    for (const auto* jet : {&coarse, &fine}) {
      for (const auto& entry : test::symplecticity(*jet)) {
        EXPECT_LE(entry.scaled, 1e-13) << "e = " << e << ", degree " << entry.degree;
      }
    }
    // The matrix, whose norm is the condition, amplifies the errors of the steps.
    double norm = 0;
    for (const auto& u : fine) {
      for (const double c : u.slice(1)) norm = std::max(norm, std::abs(c));
    }
    const double error = test::relative_error(coarse, fine, 0);
    EXPECT_LE(error, 1e-10 * norm) << "e = " << e;
    EXPECT_GT(error, 1e-14) << "e = " << e;
  }
}

}  // namespace
}  // namespace hamjet
