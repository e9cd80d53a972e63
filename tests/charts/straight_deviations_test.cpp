#include "hamjet/charts/straight_deviations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamjet/algebra/calculus.hpp"

// Deviations along which the coordinates of a chart change linearly.

namespace hamjet {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

const SixNumbers<double> bent_state = {0.9, 0.3, -0.2, -0.3, 0.8, 0.55};

StraightDeviations straight_about(const SixNumbers<double>& about) {
  return {CanonicalChart<double>(ChartName::poincare, about, 1.0), about};
}

Vector6 random_deviation(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  Vector6 d;
  for (double& x : d) x = size * normal(random);
  return d;
}

TEST(StraightDeviations, ChangeTheElementsLinearly) {
  const StraightDeviations straight = straight_about(bent_state);
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const Vector6 d = random_deviation(random, 0.02);
    const Vector6 b = straight(d);
    SixNumbers<double> moved = bent_state;
    for (std::size_t k = 0; k < 6; ++k) moved[k] += b[static_cast<Eigen::Index>(k)];
    const auto from = straight.chart().coordinates(bent_state);
    const auto to = straight.chart().coordinates(moved);
    const Vector6 expected = straight.slope() * d;
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(to[k] - from[k], expected[static_cast<Eigen::Index>(k)], 1e-13);
    }
  }
}

TEST(StraightDeviations, AreTheirOwnLinearPartForSmallOnes) {
  const StraightDeviations straight = straight_about(bent_state);
  std::mt19937 random(2);
  const Vector6 d = random_deviation(random, 1e-5);
  EXPECT_LT((straight(d) - d).norm(), 1e-9);
  EXPECT_EQ(straight(Vector6::Zero()).norm(), 0);
}

TEST(StraightDeviations, SeriesAgreeToTheirOrder) {
  const StraightDeviations straight = straight_about(bent_state);
  std::mt19937 random(3);
  const Vector6 direction = random_deviation(random, 1.0);
  for (const int order : {1, 2, 3, 4}) {
    const auto series = straight.series(SeriesSpace::create(6, order));
    const auto miss = [&](double size) {
      const Vector6 d = size * direction;
      const Vector6 b = straight(d);
      double square = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        square += std::pow(evaluate(series[k], {d.data(), 6}) - b[static_cast<Eigen::Index>(k)], 2);
      }
      return std::sqrt(square);
    };
    // The miss falls as the power order + 1 of the size.
    const double ratio = std::log2(miss(4e-3) / miss(2e-3));
    EXPECT_NEAR(ratio, order + 1, 0.15) << order;
  }
}

TEST(StraightDeviations, OfACircleAlongTheTrackStayOnIt) {
  // A change of the mean longitude alone turns the state of a circular orbit about the centre: the
  // linear deviation is along the track, position and velocity, and the end is on the circle.
  const SixNumbers<double> circular = {1, 0, 0, 0, 1, 0};
  const StraightDeviations straight = straight_about(circular);
  for (const double angle : {0.01, 0.1, 1.0}) {
    Vector6 d = Vector6::Zero();
    d[1] = angle;
    d[3] = -angle;
    const Vector6 b = straight(d);
    EXPECT_NEAR(1 + b[0], std::cos(angle), 1e-13);
    EXPECT_NEAR(b[1], std::sin(angle), 1e-13);
    EXPECT_NEAR(b[3], -std::sin(angle), 1e-13);
    EXPECT_NEAR(1 + b[4], std::cos(angle), 1e-13);
  }
}

}  // namespace
}  // namespace hamjet
