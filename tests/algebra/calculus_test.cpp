#include "hamjet/algebra/calculus.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/algebra/extended.hpp"
#include "support/errors.hpp"
#include "support/random_series.hpp"

// Whole-number coefficients make the identities exact, so most comparisons have no tolerance.

namespace hamjet {
namespace {

using test::RandomNumbers;

/// Whether the slices of degree 0 to `highest` are equal, bit for bit.
template <class T>
void expect_equal_up_to(const Series<T>& a, const Series<T>& b, int highest, const char* what) {
  for (std::size_t k = 0; k < a.space().first(highest + 1); ++k) {
    EXPECT_EQ(a[k], b[k]) << what << ", monomial " << k << " of degree " << a.space().degree(k);
  }
}

TEST(Derivative, OfAPolynomialIsKnown) {
  // d/dx (x^3 y) = 3 x^2 y, d/dy (x^3 y) = x^3.
  const auto space = SeriesSpace::create(2, 4);
  const auto x = Series<double>::variable(space, 0);
  const auto y = Series<double>::variable(space, 1);
  const auto u = x * x * x * y;
  expect_equal_up_to(derivative(u, 0), 3.0 * x * x * y, 4, "d/dx");
  expect_equal_up_to(derivative(u, 1), x * x * x, 4, "d/dy");
}

TEST(Derivative, UndoesTheIntegral) {
  RandomNumbers random(21);
  for (const std::size_t variables : {1u, 2u, 4u, 6u}) {
    const auto space = SeriesSpace::create(variables, 5);
    const auto u = test::random_integer_series<double>(space, random);
    for (std::size_t i = 0; i < variables; ++i) {
      const auto back = derivative(integral(u, i), i);
      for (std::size_t k = 0; k < space->size(); ++k) {
        // A quotient by a whole number and a product with it round at most once each; the last
        // degree is lost.
        if (space->degree(k) == 5) {
          EXPECT_EQ(back[k], 0);
        } else {
          EXPECT_NEAR(back[k], u[k], 2 * test::epsilon_of<double>() * std::abs(u[k]));
        }
      }
      // The integral has no terms that are free of x_i, and it differs from the primitive of u by
      // such terms alone.
      const auto forward = integral(derivative(u, i), i);
      for (std::size_t k = 0; k < space->size(); ++k) {
        if (space->exponents(k)[i] == 0) {
          EXPECT_EQ(forward[k], 0);
        } else {
          EXPECT_NEAR(forward[k], u[k], 2 * test::epsilon_of<double>() * std::abs(u[k]));
        }
      }
    }
  }
}

TEST(Derivative, ObeysTheProductRuleAndCommutes) {
  RandomNumbers random(22);
  const auto space = SeriesSpace::create(4, 5);
  const auto u = test::random_integer_series<double>(space, random);
  const auto v = test::random_integer_series<double>(space, random);
  for (std::size_t i = 0; i < 4; ++i) {
    expect_equal_up_to(derivative(u * v, i), derivative(u, i) * v + u * derivative(v, i), 4,
                       "product rule");
    for (std::size_t j = 0; j < i; ++j) {
      expect_equal_up_to(derivative(derivative(u, i), j), derivative(derivative(u, j), i), 5,
                         "mixed derivatives");
    }
  }
}

TEST(Derivative, OfTheSineIsTheCosine) {
  const auto space = SeriesSpace::create(1, 12);
  const auto x = Series<Extended>::variable(space, 0, Extended(0.5));
  const auto difference = derivative(sin(x), 0) - cos(x);
  EXPECT_LE(test::largest_coefficient(difference, 11), 16 * test::epsilon_of<Extended>());
}

TEST(PoissonBracket, IsCanonical) {
  for (const std::size_t n : {1u, 2u, 3u}) {
    const auto space = SeriesSpace::create(2 * n, 3);
    const auto z = test::identity_map<double>(space);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      for (std::size_t j = 0; j < 2 * n; ++j) {
        const double expected = j == i + n ? 1 : (i == j + n ? -1 : 0);
        expect_equal_up_to(poisson_bracket(z[i], z[j]), Series<double>(space, expected), 3,
                           "{z_i, z_j} = J_ij");
      }
    }
  }
}

TEST(PoissonBracket, WithTheHamiltonianIsTheTimeDerivative) {
  // H = (p^2 + 4 q^2) / 2: {q, H} = p, {p, H} = -4 q.
  const auto space = SeriesSpace::create(2, 3);
  const auto q = Series<double>::variable(space, 0);
  const auto p = Series<double>::variable(space, 1);
  const auto h = 0.5 * (p * p + 4.0 * q * q);
  expect_equal_up_to(poisson_bracket(q, h), p, 2, "{q, H}");
  expect_equal_up_to(poisson_bracket(p, h), -4.0 * q, 2, "{p, H}");
}

TEST(PoissonBracket, IsALieBracketAndADerivation) {
  RandomNumbers random(23);
  constexpr int order = 5;
  for (const std::size_t n : {1u, 2u, 3u}) {
    const auto space = SeriesSpace::create(2 * n, order);
    const auto f = test::random_integer_series<double>(space, random, 5);
    const auto g = test::random_integer_series<double>(space, random, 5);
    const auto h = test::random_integer_series<double>(space, random, 5);
    expect_equal_up_to(poisson_bracket(f, g), -poisson_bracket(g, f), order, "antisymmetry");
    expect_equal_up_to(poisson_bracket(f, g * h),
                       poisson_bracket(f, g) * h + g * poisson_bracket(f, h), order - 1, "Leibniz");
    // Each bracket loses a degree.
    const auto jacobi = poisson_bracket(f, poisson_bracket(g, h)) +
                        poisson_bracket(g, poisson_bracket(h, f)) +
                        poisson_bracket(h, poisson_bracket(f, g));
    expect_equal_up_to(jacobi, Series<double>(space), order - 2, "Jacobi");
    EXPECT_GT(test::largest_coefficient(poisson_bracket(f, poisson_bracket(g, h)), order - 2), 100);
  }
}

TEST(PoissonBracket, RefusesAnOddNumberOfVariablesAndTwoSpaces) {
  const Series<double> odd(SeriesSpace::create(3, 2));
  const Series<double> even(SeriesSpace::create(4, 2));
  test::expect_error(ErrorKind::usage, "odd", [&] { (void)poisson_bracket(odd, odd); });
  test::expect_error(ErrorKind::usage, "different", [&] { (void)poisson_bracket(odd, even); });
}

TEST(Evaluate, GivesPowersOfSums) {
  // (1 + x + y)^N at (2, 3) is 6^N, exactly.
  const auto space = SeriesSpace::create(2, 8);
  const auto sum = 1.0 + Series<double>::variable(space, 0) + Series<double>::variable(space, 1);
  auto u = sum;
  for (int i = 1; i < 8; ++i) u = u * sum;
  const std::vector<double> point{2, 3};
  EXPECT_EQ(evaluate(u, std::span<const double>(point)), 1679616);
}

TEST(Evaluate, ApproachesTheFunction) {
  // exp(x + 2y) at (0.01, -0.02) with order 10: the remainder is 0.03^11 / 11! < 1e-24.
  const auto space = SeriesSpace::create(2, 10);
  const auto x = Series<Extended>::variable(space, 0);
  const auto y = Series<Extended>::variable(space, 1);
  const std::vector<Extended> point{Extended(1) / 100, Extended(-2) / 100};
  const Extended value = evaluate(exp(x + Extended(2) * y), std::span<const Extended>(point));
  EXPECT_LE(static_cast<double>(abs(value - exp(Extended(-3) / 100))), 1e-24);
}

TEST(Evaluate, RefusesAPointOfAnotherSize) {
  const Series<double> u(SeriesSpace::create(2, 2));
  const std::vector<double> point{1};
  test::expect_error(ErrorKind::usage, "one number per variable",
                     [&] { (void)evaluate(u, std::span<const double>(point)); });
}

TEST(InSpace, KeepsEveryCoefficientThatBothSpacesHave) {
  test::RandomNumbers random(7);
  const auto high = SeriesSpace::create(3, 4);
  const auto low = SeriesSpace::create(3, 2);
  const auto u = test::random_series<double>(high, random);
  const auto cut = in_space(u, low);
  for (std::size_t k = 0; k < low->size(); ++k) {
    EXPECT_EQ(cut[k], u[high->index(low->exponents(k))]);
  }
  const auto lifted = in_space(cut, high);
  for (std::size_t k = 0; k < high->size(); ++k) {
    EXPECT_EQ(lifted[k], high->degree(k) <= 2 ? u[k] : 0);
  }
  test::expect_error(ErrorKind::usage, "number of variables",
                     [&] { in_space(u, SeriesSpace::create(2, 4)); });
}

}  // namespace
}  // namespace hamjet
