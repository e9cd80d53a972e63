#include "hamjet/maps/map_evaluator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "hamjet/algebra/calculus.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

// The expected values come from evaluate() in extended precision. Round-off is measured by the sum
// of the magnitudes of the terms, in units of 2^-52.

namespace hamjet {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using Map = std::vector<Series<double>>;

Map random_map(std::size_t components, std::size_t variables, int order, unsigned seed) {
  test::RandomNumbers random(seed);
  const SpacePointer space = SeriesSpace::create(variables, order);
  Map map;
  for (std::size_t c = 0; c < components; ++c) {
    map.push_back(test::random_series<double>(space, random, {-1, 1}));
  }
  return map;
}

std::vector<double> random_points(std::size_t variables, std::size_t count) {
  test::RandomNumbers random(7);
  std::vector<double> points(variables * count);
  for (double& x : points) x = random.uniform(-1.2, 1.2);
  return points;
}

std::vector<double> values_at(const std::vector<double>& points, const MapEvaluator& evaluator) {
  std::vector<double> values(evaluator.components() * points.size() / evaluator.variables());
  evaluator.evaluate(points, {values, {}, {}});
  return values;
}

/// The terms of degree `from` to `to` in extended precision, or the sum of their magnitudes.
Extended expected(const Series<double>& u, const std::vector<double>& points, std::size_t count,
                  std::size_t j, int from, int to, bool of_magnitudes = false) {
  Series<Extended> part(u.space_pointer());
  std::vector<Extended> point;
  for (std::size_t i = 0; i < u.space().variables(); ++i) {
    const double x = points[i * count + j];
    point.emplace_back(of_magnitudes ? std::abs(x) : x);
  }
  for (std::size_t k = u.space().first(from); k < u.space().first(to + 1); ++k) {
    part[k] = of_magnitudes ? std::abs(u[k]) : u[k];
  }
  return evaluate<Extended>(part, point);
}

void expect_agreement(const Map& map, std::size_t count, std::optional<int> truncation = {}) {
  const MapEvaluator evaluator(map, truncation);
  const int n = evaluator.degree();
  const std::vector<double> points = random_points(evaluator.variables(), count);
  std::vector<double> values(map.size() * count, -1);
  std::vector<double> last = values;
  std::vector<double> last_but_one = values;
  std::vector<double> last_but_two = values;
  evaluator.evaluate(points, {values, last, last_but_one, last_but_two});
  const std::size_t stride = count > 100 ? 97 : 1;  // extended precision takes its time
  double worst = 0;
  for (std::size_t j = 0; j < count; j += stride) {
    for (std::size_t c = 0; c < map.size(); ++c) {
      const auto error = [&](double value, int from, int to) {
        if (to < 0) return value == 0 ? 0.0 : 1e300;
        const Extended exact = expected(map[c], points, count, j, from, to);
        const Extended size = expected(map[c], points, count, j, from, to, true);
        return static_cast<double>(abs(exact - value) / size) / epsilon;
      };
      for (const double e : {error(values[c * count + j], 0, n), error(last[c * count + j], n, n),
                             error(last_but_one[c * count + j], n - 1, n - 1),
                             error(last_but_two[c * count + j], n - 2, n - 2)}) {
        worst = test::larger(worst, e);
      }
    }
  }
  EXPECT_LT(worst, 8) << "order " << map[0].order() << ", degree " << n << ", "
                      << evaluator.variables() << " variables, " << count << " points";
}

TEST(MapEvaluator, AgreesWithExtendedPrecisionToRoundOff) {
  for (int order = 1; order <= 6; ++order) {
    for (std::size_t variables = 2; variables <= 6; ++variables) {
      const Map map = random_map(variables, variables, order, 1);
      expect_agreement(map, variables % 2 == 0 ? 7 : 33);
    }
  }
}

TEST(MapEvaluator, AnyNumberOfPointsAndComponents) {
  for (const std::size_t count : {0, 1, 7, 33, 1000}) {
    expect_agreement(random_map(6, 6, 4, 2), count);
    expect_agreement(random_map(2, 2, 5, 3), count);
  }
  for (const std::size_t components : {1, 3, 5, 7, 12, 13}) {
    expect_agreement(random_map(components, 3, 3, 4), 9);
  }
  expect_agreement(random_map(1, 1, 7, 5), 9);
  expect_agreement(random_map(2, 9, 2, 5), 9);
  expect_agreement(random_map(2, 2, 0, 5), 9);
}

TEST(MapEvaluator, Truncates) {
  const Map map = random_map(6, 6, 5, 6);
  for (int degree = 0; degree <= 5; ++degree) expect_agreement(map, 10, degree);
  for (const int degree : {-1, 6}) {
    test::expect_error(ErrorKind::usage, "degree must be 0 to the order",
                       [&] { MapEvaluator(map, degree); });
  }
}

TEST(MapEvaluator, APointThatIsNotFiniteHarmsNoOther) {
  const Map map = random_map(6, 6, 4, 8);
  const MapEvaluator evaluator(map);
  constexpr std::size_t count = 77;
  const std::vector<double> good = random_points(6, count);
  const std::vector<double> expected_values = values_at(good, evaluator);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    for (const std::size_t place : {std::size_t{0}, std::size_t{13}, count - 1}) {
      std::vector<double> points = good;
      points[3 * count + place] = bad;
      const std::vector<double> values = values_at(points, evaluator);
      for (std::size_t c = 0; c < 6; ++c) {
        for (std::size_t j = 0; j < count; ++j) {
          if (j == place) {
            EXPECT_FALSE(std::isfinite(values[c * count + j])) << bad;
          } else {
            EXPECT_EQ(values[c * count + j], expected_values[c * count + j]);
          }
        }
      }
    }
  }
}

TEST(MapEvaluator, AValueDoesNotDependOnTheOtherPoints) {
  // The result does not depend on the place of a point in its block, nor on whether the block is
  // full.
  const Map map = random_map(6, 6, 4, 9);
  const MapEvaluator evaluator(map);
  constexpr std::size_t count = 100;
  const std::vector<double> points = random_points(6, count);
  const std::vector<double> together = values_at(points, evaluator);
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<double> point;
    for (std::size_t i = 0; i < 6; ++i) point.push_back(points[i * count + j]);
    const std::vector<double> alone = values_at(point, evaluator);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(alone[c], together[c * count + j]);
  }
}

TEST(MapEvaluator, ThreadsShareOne) {
  const Map map = random_map(6, 6, 4, 10);
  const MapEvaluator evaluator(map);
  const std::vector<double> points = random_points(6, 1000);
  std::vector<std::vector<double>> values(4, std::vector<double>(6000));
  std::vector<std::thread> threads;
  for (auto& result : values) {
    threads.emplace_back([&] { evaluator.evaluate(points, {result, {}, {}}); });
  }
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_EQ(values[i], values[0]);
}

TEST(MapEvaluator, CountsItsWork) {
  // 210 monomials up to degree 4 in 6 variables, the constant among them; 6 are the variables.
  const MapEvaluator evaluator(random_map(6, 6, 4, 11));
  EXPECT_EQ(evaluator.multiply_adds_per_point(), 6U * 209U);
  EXPECT_EQ(evaluator.products_per_point(), 203U);
  const MapEvaluator constant(random_map(6, 6, 4, 11), 0);
  EXPECT_EQ(constant.multiply_adds_per_point(), 0U);
  EXPECT_EQ(constant.products_per_point(), 0U);
}

TEST(MapEvaluator, RefusesWhatDoesNotFit) {
  const Map map = random_map(2, 2, 2, 12);
  const MapEvaluator evaluator(map);
  std::vector<double> points(6);
  std::vector<double> few(5);
  std::vector<double> good(6);
  for (const MapValues& values :
       {MapValues{few, {}, {}}, MapValues{good, few, {}}, MapValues{good, good, few}}) {
    test::expect_error(ErrorKind::usage, "sizes", [&] { evaluator.evaluate(points, values); });
  }
  test::expect_error(ErrorKind::usage, "sizes", [&] { evaluator.evaluate(few, {good, {}, {}}); });
  test::expect_error(ErrorKind::usage, "no components", [] { MapEvaluator{Map{}}; });
  Map mixed = map;
  mixed.push_back(random_map(1, 2, 3, 13)[0]);
  EXPECT_THROW(MapEvaluator{mixed}, Error);
}

}  // namespace
}  // namespace hamjet
