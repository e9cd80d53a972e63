#include "hamjet/algebra/elementary_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

using test::Coefficient;
using test::RandomNumbers;

template <class T>
class ElementaryFunctions : public testing::Test {};
using FunctionCoefficients = testing::Types<double, Pack<double, 2>, Pack<double, 16>, Extended>;
TYPED_TEST_SUITE(ElementaryFunctions, FunctionCoefficients);

/// Whether |a - b| is within the round-off of the products whose sum is a, degree by degree.
template <class T>
void expect_near(const Series<T>& a, const Series<T>& b,
                 const std::vector<const Series<T>*>& factors, const char* what) {
  const Series<T> difference = a - b;
  for (int d = 0; d <= a.order(); ++d) {
    // The scale is the sum of the terms that cancel: products of the factors' slices, at most
    // `count` products for each monomial, each rounded a few times. The factor 8 covers the
    // round-off of the recurrences of the factors.
    double scale = 0;
    for (int i = 0; i <= d; ++i) {
      scale +=
          test::largest_of_degree(*factors[0], i) * test::largest_of_degree(*factors[1], d - i);
    }
    EXPECT_LE(test::largest_of_degree(difference, d),
              8 * test::epsilon_of<T>() * scale * std::pow(a.space().variables(), d))
        << what << ", degree " << d;
  }
}

/// Series of order 6 in three variables with a constant term of the order of one.
template <class T>
struct Sample {
  SpacePointer space = SeriesSpace::create(3, 6);
  RandomNumbers random{11};
  Series<T> u = test::random_series<T>(space, random, {0.7, 1.5}, 0.3);
  Series<T> v = test::random_series<T>(space, random, {0.7, 1.5}, 0.3);
  Series<T> one = Series<T>(space, T(1));
};

TYPED_TEST(ElementaryFunctions, QuotientTimesDivisorIsTheDividend) {
  Sample<TypeParam> s;
  const auto w = s.u / s.v;
  expect_near(w * s.v, s.u, {&w, &s.v}, "(u / v) v = u");
  const auto r = TypeParam(1) / s.v;
  expect_near(r * s.v, s.one, {&r, &s.v}, "(1 / v) v = 1");
  expect_near(s.u * r, w, {&s.u, &r}, "u (1 / v) = u / v");
}

TYPED_TEST(ElementaryFunctions, SquareRootSquaredIsTheArgument) {
  Sample<TypeParam> s;
  const auto w = sqrt(s.u);
  expect_near(square(w), s.u, {&w, &w}, "sqrt(u)^2 = u");
}

TYPED_TEST(ElementaryFunctions, PowersObeyTheLawsOfExponents) {
  Sample<TypeParam> s;
  using Real = typename Coefficient<TypeParam>::Real;
  for (const double exponent : {-1.5, 0.5, -1.0, 3.0, 0.3, -2.7}) {
    const Real a(exponent);
    const auto w = pow(s.u, a);
    const auto inverse = pow(s.u, Real(-a));
    expect_near(w * inverse, s.one, {&w, &inverse}, "u^a u^-a = 1");
    const auto next = pow(s.u, Real(a + 1));
    expect_near(w * s.u, next, {&w, &s.u}, "u^a u = u^(a+1)");
  }
  const auto root = sqrt(s.u);
  expect_near(pow(s.u, Real(0.5)), root, {&root, &s.one}, "u^(1/2) = sqrt(u)");
  const auto cube = s.u * s.u * s.u;
  expect_near(pow(s.u, Real(3)), cube, {&cube, &s.one}, "u^3 = u u u");
}

TYPED_TEST(ElementaryFunctions, ExponentialAndLogarithmAreInverse) {
  Sample<TypeParam> s;
  const auto l = log(s.u);
  const auto e = exp(s.u);
  // The scales are those of the derivatives: exp(log u) has the derivatives u (log u)', log(exp u)
  // has those of e^-u e^u.
  const auto inverse = TypeParam(1) / s.u;
  expect_near(exp(l), s.u, {&s.u, &inverse}, "exp(log u) = u");
  const auto decay = exp(-s.u);
  expect_near(log(e), s.u, {&e, &decay}, "log(exp u) = u");
  expect_near(e * decay, s.one, {&e, &decay}, "e^u e^-u = 1");
  expect_near(e * exp(s.v), exp(s.u + s.v), {&e, &e}, "e^u e^v = e^(u+v)");
}

TYPED_TEST(ElementaryFunctions, SineAndCosineObeyTheAdditionTheorem) {
  Sample<TypeParam> s;
  const auto [su, cu] = sin_cos(s.u);
  const auto [sv, cv] = sin_cos(s.v);
  expect_near(square(su) + square(cu), s.one, {&s.u, &s.u}, "sin^2 + cos^2 = 1");
  expect_near(su * cv + cu * sv, sin(s.u + s.v), {&s.u, &s.v}, "sin(u + v)");
  expect_near(cu * cv - su * sv, cos(s.u + s.v), {&s.u, &s.v}, "cos(u + v)");
}

/// Taylor coefficients of f(c + x) in one variable are compared with closed forms, to a few units
/// in the last place for each step of the recurrence.
template <class T>
void expect_coefficients(const Series<T>& w, const std::vector<Extended>& expected,
                         const char* what) {
  using C = Coefficient<T>;
  for (std::size_t k = 0; k < w.size(); ++k) {
    for (int lane = 0; lane < C::lanes; ++lane) {
      const double error =
          static_cast<double>(Extended(Extended(C::get(w[k], lane)) - expected[k]));
      const double scale = std::abs(static_cast<double>(expected[k]));
      EXPECT_LE(std::abs(error),
                8 * (static_cast<double>(k) + 1) * test::epsilon_of<T>() * std::max(scale, 0x1p-30))
          << what << ", coefficient " << k << ", lane " << lane;
    }
  }
}

TYPED_TEST(ElementaryFunctions, HaveTheirClosedFormCoefficients) {
  using T = TypeParam;
  using Real = typename Coefficient<T>::Real;
  constexpr int order = 12;
  const auto space = SeriesSpace::create(1, order);
  const auto x = Series<T>::variable(space, 0);
  const auto one_plus_x = Series<T>::variable(space, 0, T(1));
  const auto coefficients = [&](auto next) {
    std::vector<Extended> result;
    for (int k = 0; k <= order; ++k) result.push_back(next(k));
    return result;
  };
  std::vector<Extended> factorial{1};
  for (int k = 1; k <= order; ++k) factorial.push_back(factorial.back() * k);
  const auto f = [&](int k) { return factorial[static_cast<std::size_t>(k)]; };
  const auto binomial = [](const Extended& a, int k) {
    Extended c = 1;
    for (int i = 0; i < k; ++i) c *= (a - i) / (i + 1);
    return c;
  };
  const auto sign = [](int k) { return k % 2 == 0 ? 1 : -1; };

  expect_coefficients(exp(x), coefficients([&](int k) { return Extended(1 / f(k)); }), "exp x");
  expect_coefficients(log(one_plus_x), coefficients([&](int k) {
                        return k == 0 ? Extended(0) : Extended(Extended(-sign(k)) / k);
                      }),
                      "log(1 + x)");
  for (const double a : {0.5, -0.5, -1.5, 2.5, -3.0, 0.375, 5.0}) {
    expect_coefficients(pow(one_plus_x, Real(a)),
                        coefficients([&](int k) { return binomial(a, k); }), "(1 + x)^a");
  }
  expect_coefficients(sqrt(one_plus_x), coefficients([&](int k) { return binomial(0.5, k); }),
                      "sqrt(1 + x)");
  const auto sine =
      coefficients([&](int k) { return k % 2 == 1 ? Extended(sign(k / 2) / f(k)) : Extended(0); });
  const auto cosine =
      coefficients([&](int k) { return k % 2 == 0 ? Extended(sign(k / 2) / f(k)) : Extended(0); });
  expect_coefficients(sin(x), sine, "sin x");
  expect_coefficients(cos(x), cosine, "cos x");
  expect_coefficients(T(1) / (T(1) - x), coefficients([](int) { return Extended(1); }),
                      "1 / (1 - x)");
  expect_coefficients((T(1) + x) / (T(1) - x),
                      coefficients([](int k) { return Extended(k == 0 ? 1 : 2); }),
                      "(1 + x) / (1 - x)");
}

TYPED_TEST(ElementaryFunctions, ExpandAboutAnyPoint) {
  using T = TypeParam;
  using Real = typename Coefficient<T>::Real;
  constexpr int order = 8;
  const auto space = SeriesSpace::create(1, order);
  const Extended c = 0.75;  // a binary fraction, the same number in every precision
  const auto u = Series<T>::variable(space, 0, T(0.75));
  std::vector<Extended> e, l, s, r;
  Extended factorial = 1;
  for (int k = 0; k <= order; ++k) {
    if (k > 0) factorial *= k;
    e.push_back(exp(c) / factorial);
    l.push_back(k == 0 ? Extended(log(c)) : Extended((k % 2 == 1 ? 1 : -1) / (k * pow(c, k))));
    const Extended derivatives[] = {sin(c), cos(c), -sin(c), -cos(c)};
    s.push_back(derivatives[k % 4] / factorial);
    r.push_back((k % 2 == 0 ? 1 : -1) / pow(c, k + 1));
  }
  expect_coefficients(exp(u), e, "exp");
  expect_coefficients(log(u), l, "log");
  expect_coefficients(sin(u), s, "sin");
  expect_coefficients(T(1) / u, r, "1 / u");
  expect_coefficients(pow(u, Real(-1)), r, "u^-1");
}

TEST(ElementaryFunctionsOfSeveralVariables, GiveMultinomialCoefficients) {
  // 1 / (1 - x - y): the coefficient of x^i y^j is C(i + j, i); exact in whole numbers.
  const auto space = SeriesSpace::create(2, 10);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  const auto w = 1.0 / (1.0 - x - y);
  for (std::size_t k = 0; k < space->size(); ++k) {
    const int i = space->exponents(k)[0];
    const int j = space->exponents(k)[1];
    double binomial = 1;
    for (int m = 1; m <= i; ++m) binomial = binomial * (j + m) / m;
    EXPECT_EQ(w[k], binomial) << "x^" << i << " y^" << j;
  }
}

// In polar form, the point at the angle and at the distance is the point itself.
TEST(ElementaryFunctionsOfTwo, AngleIsThatOfThePoint) {
  RandomNumbers numbers(7);
  const auto space = SeriesSpace::create(3, 6);
  for (const auto& [x0, y0] : {std::pair{1.0, 0.5}, {-1.0, 0.5}, {-0.5, -1.0}, {0.2, -1.0}}) {
    Series<double> x = test::random_series<double>(space, numbers);
    Series<double> y = test::random_series<double>(space, numbers);
    x[0] = x0;
    y[0] = y0;
    const Series<double> angle = atan2(y, x);
    EXPECT_EQ(angle[0], std::atan2(y0, x0));
    const auto [s, c] = sin_cos(angle);
    const Series<double> r = sqrt(square(x) + square(y));
    expect_near<double>(r * s, y, {&r, &s}, "sine");
    expect_near<double>(r * c, x, {&r, &c}, "cosine");
  }
}

TEST(PowerOfANumber, IsExactForWholeAndHalfExponents) {
  EXPECT_EQ(power(4.0, -1.5), 0.125);
  EXPECT_EQ(power(4.0, 2.5), 32.0);
  EXPECT_EQ(power(-2.0, 3.0), -8.0);
  EXPECT_EQ(power(5.0, 0.0), 1.0);
  EXPECT_EQ(power(2.0, -20.0), 0x1p-20);
  EXPECT_EQ(power(Extended(9), Extended(-0.5)), Extended(1) / 3);
  EXPECT_EQ(power(2.0, 0.3), std::pow(2.0, 0.3));
}

TEST(ElementaryFunctionsOutsideTheirDomain, GiveValuesThatAreNotFinite) {
  const auto space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  EXPECT_FALSE(std::isfinite((1.0 / x)[0]));
  EXPECT_FALSE(std::isfinite(log(x - 1.0)[0]));
  EXPECT_FALSE(std::isfinite(sqrt(x - 1.0)[0]));
  EXPECT_FALSE(std::isfinite(pow(x, -1.5)[0]));
}

}  // namespace
}  // namespace hamjet
