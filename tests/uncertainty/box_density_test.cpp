#include "uncertainty/box_density.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "uncertainty/cubic_arc.hpp"

namespace hamjet {
namespace {

TEST(BoxDensity, SamplesHaveTheIntegralOfANarrowPeak) {
  // A normal density within the unit cube, flat across a slanted direction: a sheet that points of
  // the cube miss. Its integral is 1 but for what is beyond eight standard deviations.
  const std::array<double, 3> axis = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  const double narrow = 4e-3;
  const auto density = [&](const std::array<double, 3>& x) {
    std::array<double, 3> white{};
    double along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += axis[i] * (x[i] - 0.51);
    for (std::size_t i = 0; i < 3; ++i) {
      const double across = x[i] - 0.51 - along * axis[i];
      white[i] = across / 0.06 + along * axis[i] / narrow;
    }
    const double volume = 0.06 * 0.06 * narrow;
    return NormalFactor{-std::log(volume) - 1.5 * std::log(2 * std::numbers::pi), white, {}};
  };
  const BoxDensity boxes({{{0, 0, 0}, {1, 1, 1}}}, density, 100000);
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double sum = 0, squares = 0;
  const int count = 20000;
  for (int k = 0; k < count; ++k) {
    std::array<double, 5> u{};
    for (double& x : u) x = uniform(generator);
    const auto point = boxes.point(u);
    const auto log_density = boxes.log_density(point);
    ASSERT_TRUE(log_density);
    const double weight = std::exp(density(point).log_value() - *log_density);
    sum += weight;
    squares += weight * weight;
  }
  const double mean = sum / count;
  const double error = std::sqrt((squares / count - mean * mean) / count);
  EXPECT_LE(std::abs(mean - 1), 4 * error);
  EXPECT_LT(error, 0.02);  // uniform points: 0.15
  EXPECT_FALSE(boxes.log_density({2, 0.5, 0.5}));
}

TEST(BoxDensity, MeanOfThePositivePartIsContinuousAcrossItsSeries) {
  // log(phi(a) + a Phi(a)) in 50 digits (mpmath). Above -6 the sum cancels to 1e-14 of itself at
  // worst; below, the series leaves out 945 / a^8.
  EXPECT_NEAR(log_mean_positive(3), 1.098739665327708, 1e-14);
  EXPECT_NEAR(log_mean_positive(-5), -16.74430116266099, 1e-12);
  EXPECT_NEAR(log_mean_positive(-6.5), -25.85342420977789, 945 / std::pow(6.5, 8));
  EXPECT_NEAR(log_mean_positive(-20), -206.9178385094251, 945 / std::pow(20.0, 8));
  EXPECT_NEAR(log_mean_positive(-6 - 1e-9), log_mean_positive(-6 + 1e-9), 945 / std::pow(6.0, 8));
}

TEST(SquaredDistance, FindsEntriesAndLeastDistanceOfRandomArcs) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  int entering = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::array<double, 6> start{}, end{};
    for (double& x : start) x = normal(generator);
    for (double& x : end) x = normal(generator);
    const double length = 3;
    const SquaredDistance arc(start, end, length);
    const double square = 0.5;
    std::vector<double> parts;
    arc.entries(square, parts);
    // The cubic itself at 20000 points.
    std::size_t count = 0;
    double least = 1e300, before = 0;
    for (int k = 0; k <= 20000; ++k) {
      const HermiteWeights w = hermite_weights(length, k / 20000.0);
      double d = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        d += std::pow(w.position[0] * start[i] + w.position[1] * start[i + 3] +
                          w.position[2] * end[i] + w.position[3] * end[i + 3],
                      2);
      }
      count += k > 0 && before >= square && d < square;
      least = std::min(least, d);
      before = d;
    }
    EXPECT_EQ(parts.size(), count) << trial;
    for (const double part : parts) EXPECT_NEAR(arc.at(part), square, 1e-9);
    EXPECT_LE(arc.least(1e300), least * (1 + 1e-11));
    EXPECT_GE(arc.least(1e300), least - 1e-4);  // the extremes between two of the points
    entering += static_cast<int>(count);
  }
  EXPECT_GT(entering, 30);
}

}  // namespace
}  // namespace hamjet
