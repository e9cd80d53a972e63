#include "hamjet/algebra/composition.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "support/errors.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

using test::RandomNumbers;

template <class T>
using Map = std::vector<Series<T>>;

template <class T>
Map<T> composed(const Map<T>& outer, const Map<T>& inner) {
  return compose(outer, inner);
}
template <class T>
Map<T> inverted(const Map<T>& map) {
  return inverse(map);
}

/// Components with whole-number coefficients and no constant term.
Map<double> random_integer_map(const SpacePointer& space, std::size_t components,
                               RandomNumbers& random) {
  Map<double> map;
  for (std::size_t i = 0; i < components; ++i) {
    map.push_back(test::random_integer_series<double>(space, random, 2));
    map.back()[0] = 0;
  }
  return map;
}

TEST(Compose, IsAssociative) {
  RandomNumbers random(31);
  // The maps are between spaces of different numbers of variables. Whole numbers below 2^53 are not
  // rounded.
  const auto three = SeriesSpace::create(3, 4);
  const auto two = SeriesSpace::create(2, 4);
  const auto four = SeriesSpace::create(4, 4);
  const Map<double> f = random_integer_map(three, 2, random);
  const Map<double> g = random_integer_map(two, 3, random);
  const Map<double> h = random_integer_map(four, 2, random);
  EXPECT_EQ(test::largest_difference(composed(composed(f, g), h), composed(f, composed(g, h))), 0);
  EXPECT_GT(test::largest_coefficient(composed(f, composed(g, h))[0]), 100);
}

TEST(Compose, IsLinearAndMultiplicativeInTheOuterMap) {
  RandomNumbers random(32);
  const auto space = SeriesSpace::create(3, 5);
  const Map<double> u = random_integer_map(space, 1, random);
  const Map<double> v = random_integer_map(space, 1, random);
  const Map<double> inner = random_integer_map(space, 3, random);
  const auto cu = composed(u, inner)[0];
  const auto cv = composed(v, inner)[0];
  EXPECT_EQ(test::largest_difference(composed({u[0] * v[0]}, inner), {cu * cv}), 0);
  EXPECT_EQ(test::largest_difference(composed({u[0] + v[0]}, inner), {cu + cv}), 0);
}

/// Linear inner series are composed by another algorithm. A composition is the map that takes
/// single variables to the inner series, and products to products.
TEST(Compose, TakesLinearInnerSeriesForWhatTheyAre) {
  RandomNumbers random(33);
  const auto space = SeriesSpace::create(3, 5);
  const Map<double> u = random_integer_map(space, 1, random);
  const Map<double> v = random_integer_map(space, 1, random);
  const auto of_inner = SeriesSpace::create(4, 5);
  const Map<double> linear = random_integer_map(SeriesSpace::create(4, 1), 3, random);
  for (std::size_t count = 1; count <= 3; ++count) {
    Map<double> inner = random_integer_map(of_inner, 3, random);
    inner[0] = Series<double>::variable(of_inner, 2);
    for (std::size_t i = 1; i < count; ++i) {
      inner[i] = Series<double>(of_inner);
      std::copy_n(linear[i].coefficients().begin(), linear[i].size(),
                  inner[i].coefficients().begin());
    }
    const auto cu = composed(u, inner)[0];
    const auto cv = composed(v, inner)[0];
    EXPECT_EQ(test::largest_difference(composed({u[0] * v[0]}, inner), {cu * cv}), 0);
    EXPECT_EQ(test::largest_difference(composed(test::identity_map<double>(space), inner), inner),
              0);
  }
}

TEST(Compose, GivesKnownSeries) {
  // 1 / (1 - y / (1 + y)) = 1 + y, exactly; the constant term of the outer map stays.
  const auto space = SeriesSpace::create(1, 9);
  const auto x = Series<double>::variable(space, 0);
  const Map<double> result = composed<double>({1.0 / (1.0 - x)}, {x / (1.0 + x)});
  EXPECT_EQ(test::largest_difference(result, {1.0 + x}), 0);
}

TEST(Compose, TruncatesAtTheLowerOfTheOrders) {
  const auto low = SeriesSpace::create(1, 2);
  const auto high = SeriesSpace::create(1, 4);
  const auto x = Series<double>::variable(low, 0);
  const auto y = Series<double>::variable(high, 0);
  // (y + y^2) + (y + y^2)^2 = y + 2 y^2 + 2 y^3 + y^4.
  const auto raised = composed<double>({x + x * x}, {y + y * y});
  EXPECT_EQ(
      test::largest_difference<double>(raised, {y + 2.0 * y * y + 2.0 * y * y * y + y * y * y * y}),
      0);
  const auto lowered = composed<double>({y + y * y + y * y * y}, {x + x * x});
  EXPECT_EQ(test::largest_difference<double>(lowered, {x + 2.0 * x * x}), 0);
}

TEST(Compose, RefusesConstantTermsAndSizesThatDoNotFit) {
  const auto space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  test::expect_error(ErrorKind::usage, "constant term", [&] {
    composed<double>({x, y}, {x, y + 1e-300});
  });
  test::expect_error(ErrorKind::usage, "as many components", [&] { composed<double>({x}, {x}); });
  test::expect_error(ErrorKind::usage, "as many components", [&] { composed<double>({x}, {}); });
  const auto other = Series<double>::variable(SeriesSpace::create(2, 4), 0);
  test::expect_error(ErrorKind::usage, "different spaces", [&] {
    composed<double>({x, other}, {x, y});
  });
}

TEST(Inverse, OfTheSineIsTheArcSine) {
  // asin x = sum of C(2k, k) / (4^k (2k + 1)) x^(2k+1).
  const auto space = SeriesSpace::create(1, 15);
  const auto inverse_sine = inverted<Extended>({sin(Series<Extended>::variable(space, 0))})[0];
  Extended ratio = 1;
  for (int k = 0; 2 * k + 1 <= 15; ++k) {
    if (k > 0) ratio *= Extended(2 * k - 1) / (2 * k);
    const Extended error = inverse_sine[static_cast<std::size_t>(2 * k + 1)] - ratio / (2 * k + 1);
    EXPECT_LE(static_cast<double>(abs(error)), 64 * test::epsilon_of<Extended>()) << "k = " << k;
    EXPECT_EQ(inverse_sine[static_cast<std::size_t>(2 * k)], 0);
  }
}

TEST(Inverse, OfAQuadraticHasCatalanCoefficients) {
  // The inverse of x - x^2 is sum of C_(k-1) x^k, C the Catalan numbers; exact.
  const auto space = SeriesSpace::create(1, 10);
  const auto x = Series<double>::variable(space, 0);
  const auto w = inverted<double>({x - x * x})[0];
  const double catalan[] = {1, 1, 2, 5, 14, 42, 132, 429, 1430, 4862};
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(w[k + 1], catalan[k]);
}

TEST(Inverse, ComposesToTheIdentityBothWays) {
  RandomNumbers random(33);
  for (const std::size_t n : {1u, 2u, 4u, 6u}) {
    const auto space = SeriesSpace::create(n, 5);
    Map<double> map;
    for (std::size_t i = 0; i < n; ++i) {
      map.push_back(test::random_series<double>(space, random, {0, 0}, 0.5));
      map.back()[space->linear_index(i)] += 2;
    }
    const Map<double> back = inverted(map);
    const auto identity = test::identity_map<double>(space);
    // Coefficients of degree d of the composition are sums of products of one coefficient of the
    // outer map and d coefficients of the inner map. The round-off is epsilon times the sum of the
    // magnitudes of the products, and the same composition of the maps of absolute values gives
    // this sum.
    const auto bound = [](Map<double> outer, Map<double> inner) {
      for (auto* m : {&outer, &inner}) {
        for (auto& u : *m) {
          for (auto& c : u.coefficients()) c = std::abs(c);
        }
      }
      return composed(outer, inner);
    };
    for (const auto& [outer, inner] : {std::pair{map, back}, std::pair{back, map}}) {
      const auto result = composed(outer, inner);
      const auto scale = bound(outer, inner);
      // The inverse is itself rounded, which adds the condition number of the linear part.
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(linear_part(map));
      const auto& values = svd.singularValues();
      const double condition = values(0) / values(values.size() - 1);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < space->size(); ++k) {
          ASSERT_NEAR(result[i][k], identity[i][k],
                      4 * test::epsilon_of<double>() * condition * scale[i][k]);
        }
      }
    }
  }
}

TEST(Inverse, RefusesASingularLinearPart) {
  const auto space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  const auto refused = [](const Map<double>& map) {
    test::expect_error(ErrorKind::numerical, "singular", [&] { inverted(map); });
  };
  refused({x, x * y});                        // a row without linear terms
  refused({x + 2.0 * y, 2.0 * x + 4.0 * y});  // equal directions
  refused({x * x, y});
}

TEST(Inverse, RefusesConstantTermsAndMapsThatAreNotSquare) {
  const auto space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  test::expect_error(ErrorKind::usage, "constant term", [&] { inverted<double>({x + 1.0, y}); });
  test::expect_error(ErrorKind::usage, "components", [&] { inverted<double>({x}); });
}

TEST(ConvertMap, RoundsCoefficientsAndKeepsTheSpace) {
  const auto space = SeriesSpace::create(2, 3);
  RandomNumbers random(34);
  const Map<double> map{test::random_series<double>(space, random)};
  const auto wide = convert_map<Extended>(map);
  EXPECT_EQ(test::largest_difference(convert_map<double>(wide), map), 0);
  EXPECT_EQ(wide[0].space_pointer(), space);
  EXPECT_EQ(without_constants(map)[0][0], 0);
  EXPECT_EQ(without_constants(map)[0][1], map[0][1]);
}

TEST(LinearPart, HasARowPerComponent) {
  const auto space = SeriesSpace::create(3, 2);
  const auto x = Series<double>::variable(space, 0);
  const auto z = Series<double>::variable(space, 2);
  const Map<double> map{2.0 * x + 3.0 * z + x * z, z};
  const Matrix<double> a = linear_part(map);
  ASSERT_EQ(a.rows(), 2);
  ASSERT_EQ(a.cols(), 3);
  EXPECT_EQ(a, (Matrix<double>(2, 3) << 2, 0, 3, 0, 0, 1).finished());
}

}  // namespace
}  // namespace hamjet
