#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"
#include "support/errors.hpp"
#include "support/random_series.hpp"

// Products along the schedule against products formed term by term. The coefficients are small
// whole numbers, so both are exact whatever the order of summation, and the comparison needs no
// tolerance.

namespace hamjet {
namespace {

using test::Coefficient;
using test::RandomNumbers;

/// The product by definition: every pair of monomials, added to the monomial of the summed
/// exponents.
template <class T>
Series<T> product_by_definition(const Series<T>& a, const Series<T>& b) {
  const SeriesSpace& space = a.space();
  Series<T> c(a.space_pointer());
  std::vector<std::uint8_t> exponents(space.variables());
  for (std::size_t i = 0; i < space.size(); ++i) {
    for (std::size_t j = 0; j < space.first(space.order() - space.degree(i) + 1); ++j) {
      for (std::size_t v = 0; v < exponents.size(); ++v) {
        exponents[v] = static_cast<std::uint8_t>(space.exponents(i)[v] + space.exponents(j)[v]);
      }
      c[space.index(exponents)] += a[i] * b[j];
    }
  }
  return c;
}

template <class T>
void expect_equal(const Series<T>& a, const Series<T>& b, const char* what) {
  using C = Coefficient<T>;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int lane = 0; lane < C::lanes; ++lane) {
      ASSERT_EQ(C::get(a[k], lane), C::get(b[k], lane))
          << what << ": monomial " << k << " of degree " << a.space().degree(k) << ", lane " << lane
          << ", " << a.space().variables() << " variables, order " << a.order();
    }
  }
}

/// Orders per number of variables; for three and more they pass the largest block that is unrolled.
struct Shape {
  std::size_t variables;
  int order;
};
constexpr Shape shapes[] = {{1, 0}, {1, 1}, {1, 12}, {2, 1}, {2, 2}, {2, 9}, {3, 1},
                            {3, 2}, {3, 9}, {4, 3},  {4, 8}, {5, 4}, {5, 7}, {6, 1},
                            {6, 3}, {6, 4}, {6, 7},  {7, 2}, {7, 5}};

template <class T>
class SeriesProduct : public testing::Test {};
using ProductCoefficients =
    testing::Types<double, Pack<double, 1>, Pack<double, 2>, Pack<double, 4>, Pack<double, 8>,
                   Pack<double, 16>, Extended>;
TYPED_TEST_SUITE(SeriesProduct, ProductCoefficients);

TYPED_TEST(SeriesProduct, EqualsTheSumOverAllPairsOfMonomials) {
  using T = TypeParam;
  RandomNumbers random(1);
  for (const Shape& shape : shapes) {
    const auto space = SeriesSpace::create(shape.variables, shape.order);
    const auto a = test::random_integer_series<T>(space, random);
    const auto b = test::random_integer_series<T>(space, random);
    expect_equal(a * b, product_by_definition(a, b), "product");
    expect_equal(b * a, a * b, "commuted product");
    expect_equal(square(a), product_by_definition(a, a), "square");
  }
}

TYPED_TEST(SeriesProduct, IsARingProduct) {
  using T = TypeParam;
  RandomNumbers random(2);
  for (const Shape& shape : {Shape{2, 6}, Shape{3, 5}, Shape{6, 4}}) {
    const auto space = SeriesSpace::create(shape.variables, shape.order);
    const auto a = test::random_integer_series<T>(space, random);
    const auto b = test::random_integer_series<T>(space, random);
    const auto c = test::random_integer_series<T>(space, random);
    expect_equal((a * b) * c, a * (b * c), "associativity");
    expect_equal(a * (b + c), a * b + a * c, "distributivity");
    expect_equal(a * Series<T>(space, T(1)), a, "unit");
    expect_equal((a + b) * (a - b), square(a) - square(b), "difference of squares");
    expect_equal(-(T(3) - a) + T(3), a, "sign");
    expect_equal(T(2) * a - a, a, "scalar product");
  }
}

/// Products of packs and of numbers are added to existing values; orders go past the largest
/// unrolled block.
TEST(AddedProduct, EqualsTheProductWithTheNumberInAllLanes) {
  using P = Pack<double, 8>;
  RandomNumbers random(4);
  for (const Shape& shape : {Shape{2, 5}, Shape{3, 9}, Shape{4, 8}, Shape{5, 4}}) {
    const auto space = SeriesSpace::create(shape.variables, shape.order);
    const auto a = test::random_integer_series<P>(space, random);
    const auto before = test::random_integer_series<P>(space, random);
    const auto numbers = test::random_integer_series<double>(space, random);
    Series<P> b(space);
    for (std::size_t k = 0; k < space->size(); ++k) b[k] = P(numbers[k]);
    for (int d = 1; d <= space->order(); ++d) {
      auto added = before;
      add_interior_product(*space, d, a.coefficients().data(), numbers.coefficients().data(),
                           added.coefficients().data());
      Series<P> product(space);
      interior_product(*space, d, a.coefficients().data(), b.coefficients().data(),
                       product.coefficients().data());
      expect_equal(added, before + product, "added product");
    }
  }
}

TYPED_TEST(SeriesProduct, InteriorProductLeavesConstantTermsAndOtherSlicesAlone) {
  using T = TypeParam;
  RandomNumbers random(3);
  const auto space = SeriesSpace::create(4, 8);
  auto a = test::random_integer_series<T>(space, random);
  auto b = test::random_integer_series<T>(space, random);
  for (int d = 1; d <= space->order(); ++d) {
    auto a_inner = a;
    auto b_inner = b;
    a_inner[0] = T(0);
    b_inner[0] = T(0);
    const auto product = product_by_definition(a_inner, b_inner);
    const auto squared = product_by_definition(a_inner, a_inner);
    auto expected = a;
    std::copy_n(product.slice(d).begin(), space->count(d), expected.slice(d).begin());
    auto in_place = a;  // the result replaces the degree-d slice of a factor
    interior_product(*space, d, in_place.coefficients().data(), b.coefficients().data(),
                     in_place.coefficients().data());
    expect_equal(in_place, expected, "interior product");

    expected = a;
    std::copy_n(squared.slice(d).begin(), space->count(d), expected.slice(d).begin());
    in_place = a;
    interior_square(*space, d, in_place.coefficients().data(), in_place.coefficients().data());
    expect_equal(in_place, expected, "interior square");
  }
}

TEST(SeriesOfTwoSpaces, LiveSideBySideAndRefuseToMix) {
  const auto small = SeriesSpace::create(2, 3);
  const auto large = SeriesSpace::create(2, 4);
  const auto x = Series<double>::variable(small, 0, 1.0);
  const auto y = Series<double>::variable(large, 0, 1.0);
  // (1 + x)^2 in both spaces at once.
  EXPECT_EQ(square(x)[3], 1);
  EXPECT_EQ(square(y)[3], 1);
  auto target = x;
  const auto refused = [](auto action) {
    test::expect_error(ErrorKind::usage, "different spaces", action);
  };
  refused([&] { (void)(x + y); });
  refused([&] { (void)(x - y); });
  refused([&] { (void)(x * y); });
  refused([&] { (void)(x / y); });
  refused([&] { target += y; });
  refused([&] { target -= y; });
  refused([&] { target *= y; });
  refused([&] { target /= y; });
  const Series<Pack<double, 4>> p(small);
  const Series<Pack<double, 4>> q(SeriesSpace::create(3, 3));
  refused([&] { (void)(p * q); });
}

TEST(Series, RefusesCoefficientsAndVariablesThatDoNotFit) {
  const auto space = SeriesSpace::create(2, 2);
  test::expect_error(ErrorKind::usage, "number of coefficients",
                     [&] { Series<double>(space, std::vector<double>(5)); });
  test::expect_error(ErrorKind::usage, "no such variable",
                     [&] { Series<double>::variable(space, 2); });
}

TEST(Series, VariableOfOrderZeroIsItsConstant) {
  const auto space = SeriesSpace::create(2, 0);
  const auto x = Series<double>::variable(space, 1, 3.0);
  EXPECT_EQ(x.size(), 1u);
  EXPECT_EQ((x * x)[0], 9);
  EXPECT_EQ(sqrt(x * x)[0], 3);
}

}  // namespace
}  // namespace hamjet
