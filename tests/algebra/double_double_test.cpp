#include "hamjet/detail/algebra/double_double.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

/// Numbers of all sizes and signs, of at most 106 significant bits.
std::vector<DoubleDouble> some_numbers() {
  test::RandomNumbers random(7);
  std::vector<DoubleDouble> result;
  for (int i = 0; i < 400; ++i) {
    const double high =
        std::ldexp(random.uniform(1, 2), random.integer(-30, 30)) * (i % 3 == 0 ? -1 : 1);
    const double unit = std::ldexp(1.0, std::ilogb(high) - 105);
    // The low part is a whole number of units of the 106th bit.
    const double low = std::floor(random.uniform(-1, 1) * 0x1p52) * unit;
    result.push_back(DoubleDouble::exact_sum(high, low));
  }
  return result;
}

double relative_difference(const DoubleDouble& found, const Extended& expected) {
  const Extended difference(static_cast<Extended>(found) - expected);
  return std::abs(static_cast<double>(Extended(difference / expected)));
}

/// The error of a sum or product in double-double arithmetic is at most so many units of u^2 =
/// 2^-106, see the header; extended precision adds 2^-113 for each of its operations.
constexpr double u2 = 0x1p-106;
constexpr double of_extended = 4 * 0x1p-113;

TEST(DoubleDouble, ErrsAtMostAsItsSourceProves) {
  const auto numbers = some_numbers();
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const DoubleDouble a = numbers[i];
    const DoubleDouble b = numbers[i - 1];
    const Extended x(static_cast<Extended>(a));
    const Extended y(static_cast<Extended>(b));
    EXPECT_LE(relative_difference(a + b, x + y), 3 * u2 + of_extended);
    EXPECT_LE(relative_difference(a - b, x - y), 3 * u2 + of_extended);
    EXPECT_LE(relative_difference(a * b, x * y), 5 * u2 + of_extended);
    EXPECT_LE(relative_difference(a / b, x / y), 10 * u2 + of_extended);
    // One step of Newton's method from 53 digits leaves an error of half the square of their error.
    const DoubleDouble c = abs(a);
    EXPECT_LE(relative_difference(sqrt(c), sqrt(Extended(abs(x)))), 4 * u2 + of_extended);
  }
}

TEST(DoubleDouble, KeepsWhatADoubleLoses) {
  const DoubleDouble third = DoubleDouble(1) / 3;
  EXPECT_NE(third.low, 0);
  EXPECT_LE(relative_difference(third, Extended(Extended(1) / 3)), 10 * u2);
  // The expected value is exact: (1 + 2^-60)^2 - 1 - 2^-59 = 2^-120 is below what 106 bits hold
  // beside 1, but the sum is not lost before it is rounded.
  const DoubleDouble x = DoubleDouble(1) + 0x1p-60;
  EXPECT_EQ(x - 1, DoubleDouble(0x1p-60));
  EXPECT_EQ(x * x - 1, DoubleDouble(0x1p-59));
  EXPECT_EQ(sqrt(DoubleDouble(0)), DoubleDouble(0));
  EXPECT_EQ(sqrt(DoubleDouble(9)), DoubleDouble(3));
}

TEST(DoubleDouble, IsOrderedByBothParts) {
  const DoubleDouble one(1);
  EXPECT_LT(one, one + 0x1p-80);
  EXPECT_GT(one, one - 0x1p-80);
  EXPECT_EQ(one + 0x1p-80 - 0x1p-80, one);
  EXPECT_FALSE(isfinite(DoubleDouble(1) / DoubleDouble(0)));
  EXPECT_FALSE(isfinite(std::numeric_limits<DoubleDouble>::quiet_NaN()));
  EXPECT_TRUE(isfinite(std::numeric_limits<DoubleDouble>::max()));
}

TEST(DoubleDouble, GoesToExtendedAndBackWithoutLoss) {
  for (const DoubleDouble& x : some_numbers()) {
    EXPECT_EQ(DoubleDouble(static_cast<Extended>(x)), x);
  }
}

/// The lanes of a pack are independent numbers.
template <int Lanes>
void expect_lanes_alike() {
  using P = Pack<DoubleDouble, Lanes>;
  const auto numbers = some_numbers();
  const auto pack = [&](std::size_t from) {
    return P::of_lanes([&](std::size_t i) { return numbers[from + i]; });
  };
  for (std::size_t from = 0; from + std::size_t{2} * Lanes <= numbers.size(); from += Lanes) {
    const P a = pack(from);
    const P b = pack(from + Lanes);
    const P sum = a + b;
    const P product = a * b;
    const P quotient = a / b;
    const P root = sqrt(a * a);
    const P larger = larger_magnitude(a, b);
    DoubleDouble largest = 0;
    Extended dot_product = 0;
    Extended size = 0;
    for (int i = 0; i < Lanes; ++i) {
      const DoubleDouble x = numbers[from + static_cast<std::size_t>(i)];
      const DoubleDouble y = numbers[from + static_cast<std::size_t>(i) + Lanes];
      ASSERT_EQ(a.lane(i), x);
      EXPECT_EQ(sum.lane(i), x + y);
      EXPECT_EQ(product.lane(i), x * y);
      EXPECT_EQ(quotient.lane(i), x / y);
      EXPECT_EQ(root.lane(i), sqrt(x * x));
      EXPECT_EQ(larger.lane(i), x < abs(y) ? abs(y) : x);
      largest = std::max(largest, abs(x));
      dot_product += static_cast<Extended>(x) * static_cast<Extended>(y);
      size += abs(Extended(static_cast<Extended>(x) * static_cast<Extended>(y)));
    }
    EXPECT_EQ(largest_magnitude(a), largest);
    const Extended miss(static_cast<Extended>(dot(a, b)) - dot_product);
    // The error is that of a product and of at most as many sums as there are lanes.
    EXPECT_LE(std::abs(static_cast<double>(miss)),
              (5 + 3 * Lanes) * u2 * static_cast<double>(size));
  }
  P holed = pack(0);
  holed.set_lane(Lanes - 1, std::numeric_limits<DoubleDouble>::quiet_NaN());
  EXPECT_FALSE(isfinite(largest_magnitude(holed)));
}

TEST(DoubleDouble, PacksAreLanesOfIt) {
  expect_lanes_alike<1>();
  expect_lanes_alike<2>();
  expect_lanes_alike<8>();
  expect_lanes_alike<16>();
}

}  // namespace
}  // namespace hamjet
