#include "hamjet/uncertainty/polynomial_moments.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Covariance independent(std::initializer_list<double> deviations) {
  Vector<double> s(static_cast<Eigen::Index>(deviations.size()));
  std::copy(deviations.begin(), deviations.end(), s.data());
  return Covariance::of_standard_deviations(s);
}

Cumulants moments(const std::vector<Series<double>>& map, const Covariance& covariance) {
  return Cumulants::of_polynomials(in_standard_normals(map, covariance));
}

std::vector<Series<double>> random_map(unsigned seed, std::size_t components, std::size_t variables,
                                       int order, double decay) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const SpacePointer space = SeriesSpace::create(variables, order);
  std::vector<Series<double>> map(components, Series<double>(space));
  for (Series<double>& component : map) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      component[k] = normal(generator) * std::pow(decay, space->degree(k));
    }
  }
  return map;
}

TEST(PolynomialMoments, OfASquareAreThoseOfChiSquare) {
  // The sum of k squares of standard normal variables: mean k, variance 2k, third cumulant 8k,
  // fourth 48k (chi-square with k degrees of freedom).
  for (std::size_t k = 1; k <= 5; ++k) {
    const SpacePointer space = SeriesSpace::create(k, 2);
    Series<double> y(space);
    for (std::size_t i = 0; i < k; ++i) y += square(Series<double>::variable(space, i));
    const Cumulants of = Cumulants::of_polynomials({y});
    const auto n = static_cast<double>(k);
    EXPECT_NEAR(of.mean()[0], n, 8 * n * epsilon);
    EXPECT_NEAR(of.covariance()(0, 0), 2 * n, 16 * n * epsilon);
    EXPECT_NEAR(of.skewness()[0], std::sqrt(8 / n), 1e-14);
    EXPECT_NEAR(of.excess_kurtosis()[0], 12 / n, 1e-13);
    // Of one component Mardia's measures are the square of the skewness, and the excess.
    EXPECT_NEAR(of.mardia_skewness(), 8 / n, 1e-13);
    EXPECT_NEAR(of.mardia_excess_kurtosis(), 12 / n, 1e-13);
    EXPECT_NEAR(of.negentropy(), 8 / n / 12 + 144 / n / n / 48, 1e-12);
  }
}

TEST(PolynomialMoments, OfPowersAreDoubleFactorials) {
  // E[x^(2k)] = (2k-1)!!, of y = x^n with a deviation s: mean, variance and kurtosis by hand.
  const auto moment = [](int n) {
    double product = n % 2 == 0 ? 1 : 0;
    for (int k = n - 1; k > 1; k -= 2) product *= k;
    return product;
  };
  const double s = 0.7;
  for (int n = 1; n <= 10; ++n) {
    const SpacePointer space = SeriesSpace::create(1, n);
    Series<double> y(space);
    y[static_cast<std::size_t>(n)] = 1;
    const Cumulants of = moments({y}, independent({s}));
    const double m1 = moment(n);
    const double m2 = moment(2 * n) - m1 * m1;
    const double m3 = moment(3 * n) - 3 * m1 * moment(2 * n) + 2 * m1 * m1 * m1;
    const double m4 = moment(4 * n) - 4 * m1 * moment(3 * n) + 6 * m1 * m1 * moment(2 * n) -
                      3 * m1 * m1 * m1 * m1;
    EXPECT_NEAR(of.mean()[0] / std::pow(s, n), m1, 1e-14 * moment(2 * n)) << n;
    EXPECT_NEAR(of.covariance()(0, 0) / std::pow(s, 2 * n) / m2, 1, 1e-13) << n;
    EXPECT_NEAR(of.skewness()[0], m3 / std::pow(m2, 1.5), 1e-12 * m4 / (m2 * m2)) << n;
    EXPECT_NEAR(of.excess_kurtosis()[0], m4 / (m2 * m2) - 3, 1e-12 * m4 / (m2 * m2)) << n;
  }
}

TEST(PolynomialMoments, OfAnExponentialSeriesTendToThoseOfTheLognormal) {
  // exp(s x): mean exp(s^2/2), variance (e - 1) e, skewness (e + 2) sqrt(e - 1), excess kurtosis
  // e^4 + 2 e^3 + 3 e^2 - 6 with e = exp(s^2). What order N leaves out of a moment of the fourth
  // power is below its next term, (4 s)^(N+1)/(N+1)! times the moment of x^(N+1).
  const double s = 0.1;
  const double e = std::exp(s * s);
  const double less_one = std::expm1(s * s);
  const int order = 14;
  const SpacePointer space = SeriesSpace::create(1, order);
  const Cumulants of = moments({exp(Series<double>::variable(space, 0))}, independent({s}));
  EXPECT_NEAR(of.mean()[0], std::exp(s * s / 2), 1e-15);
  EXPECT_NEAR(of.covariance()(0, 0) / (less_one * e), 1, 1e-14);
  EXPECT_NEAR(of.skewness()[0], (e + 2) * std::sqrt(less_one), 1e-12);
  EXPECT_NEAR(of.excess_kurtosis()[0], std::pow(e, 4) + 2 * std::pow(e, 3) + 3 * e * e - 6, 1e-12);
}

TEST(PolynomialMoments, OfAQuadraticMapByHand) {
  // y_1 = x, y_2 = x^2 + b z with deviations s of x and t of z: y_2 has the cumulants
  // 2 s^4 + b^2 t^2, 8 s^6, 48 s^8; the mixed third one E[y_1 y_1 (y_2 - s^2)] = 2 s^4.
  const double s = 1.3;
  const double t = 0.4;
  const double b = -2;
  const SpacePointer space = SeriesSpace::create(2, 3);
  const auto x = Series<double>::variable(space, 0);
  const auto z = Series<double>::variable(space, 1);
  const Cumulants of = moments({x + 5.0, square(x) + b * z}, independent({s, t}));
  const double v = 2 * std::pow(s, 4) + b * b * t * t;
  EXPECT_DOUBLE_EQ(of.mean()[0], 5);
  EXPECT_NEAR(of.mean()[1], s * s, 1e-15);
  EXPECT_NEAR(of.covariance()(0, 0), s * s, 1e-15);
  EXPECT_NEAR(of.covariance()(0, 1), 0, 1e-15);
  EXPECT_NEAR(of.covariance()(1, 1), v, 1e-14);
  EXPECT_NEAR(of.skewness()[0], 0, 1e-14);
  EXPECT_NEAR(of.skewness()[1], 8 * std::pow(s, 6) / std::pow(v, 1.5), 1e-13);
  EXPECT_NEAR(of.excess_kurtosis()[1], 48 * std::pow(s, 8) / (v * v), 1e-13);
  // Of w = (y_1/s, (y_2 - s^2)/sqrt(v)), uncorrelated: k_112 three times, and k_222; of the fourth
  // k_1122 = E[x^2 (x^2 - s^2)^2]/(s^2 v) + ... - 1, by the moments 15, 3 and 1 of x.
  const double k112 = 2 * s * s / std::sqrt(v);
  const double k222 = 8 * std::pow(s, 6) / std::pow(v, 1.5);
  EXPECT_NEAR(of.mardia_skewness(), 3 * k112 * k112 + k222 * k222, 1e-12);
  const double k1122 = (10 * std::pow(s, 4) + b * b * t * t) / v - 1;
  EXPECT_NEAR(of.mardia_excess_kurtosis(), 48 * std::pow(s, 8) / (v * v) + 2 * k1122, 1e-12);
}

/// Moments by a product rule of Gauss and Hermite whose degree is that of the fourth power.
struct Rule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// The rule of n nodes from the eigenvalues of the recurrence's matrix (Golub and Welsch 1969).
Rule gauss_hermite(int n) {
  Matrix<double> jacobi = Matrix<double>::Zero(n, n);
  for (int k = 1; k < n; ++k) {
    const double off = std::sqrt(static_cast<double>(k));
    jacobi(k, k - 1) = off;
    jacobi(k - 1, k) = off;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix<double>> solver(jacobi);
  Rule rule;
  for (int k = 0; k < n; ++k) {
    rule.nodes.push_back(solver.eigenvalues()[k]);
    rule.weights.push_back(solver.eigenvectors()(0, k) * solver.eigenvectors()(0, k));
  }
  return rule;
}

TEST(PolynomialMoments, AgreeWithAProductRuleOfTheirDegree) {
  // Order 3 in 3 variables: fourth moments have degree 12, exact with 7 nodes a variable.
  for (unsigned seed = 0; seed < 4; ++seed) {
    const auto map = random_map(seed, 4, 3, 3, 0.4);
    const Cumulants of = Cumulants::of_polynomials(map);
    const Rule rule = gauss_hermite(7);
    Matrix<double> points(4, 343);
    Vector<double> weights(343);
    Eigen::Index column = 0;
    for (std::size_t i = 0; i < 7; ++i) {
      for (std::size_t j = 0; j < 7; ++j) {
        for (std::size_t k = 0; k < 7; ++k, ++column) {
          const std::array<double, 3> x = {rule.nodes[i], rule.nodes[j], rule.nodes[k]};
          for (Eigen::Index c = 0; c < 4; ++c) {
            points(c, column) = evaluate(map[static_cast<std::size_t>(c)], std::span(x).first(3));
          }
          weights[column] = rule.weights[i] * rule.weights[j] * rule.weights[k];
        }
      }
    }
    const Cumulants by_rule = Cumulants::of_points(points, weights);
    EXPECT_LT((of.mean() - by_rule.mean()).norm(), 1e-13);
    EXPECT_LT((of.covariance() - by_rule.covariance()).norm(), 1e-12);
    EXPECT_LT((of.skewness() - by_rule.skewness()).norm(), 1e-11);
    EXPECT_LT((of.excess_kurtosis() - by_rule.excess_kurtosis()).norm(), 1e-10);
    EXPECT_NEAR(of.mardia_skewness() / by_rule.mardia_skewness(), 1, 1e-11);
    EXPECT_NEAR(of.mardia_excess_kurtosis() / by_rule.mardia_excess_kurtosis(), 1, 1e-11);
    EXPECT_NEAR(of.negentropy() / by_rule.negentropy(), 1, 1e-11);
  }
}

TEST(PolynomialMoments, AgreeWithThoseOfNumpy) {
  // Made by numpy 1.24: nodes of hermegauss(9) in 3 variables, x = L xi, and einsum for the
  // cumulants of V (y - mean), V the inverse of numpy's Cholesky factor.
  const SpacePointer space = SeriesSpace::create(3, 3);
  std::vector<Series<double>> map(2, Series<double>(space));
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      const auto a = space->exponents(k);
      const double size = 1.0 + space->degree(k);
      map[c][k] = std::sin(1.0 + static_cast<double>(c) + 2.0 * a[0] + 3.0 * a[1] + 5.0 * a[2]) /
                  (size * size);
    }
  }
  Matrix<double> factor(3, 3);
  factor << 1, 0, 0, 0.5, 0.8, 0, -0.3, 0.2, 0.6;
  const Cumulants of = moments(map, Covariance::of_factor(factor));
  EXPECT_NEAR(of.mean()[0], 0.697404824669306, 1e-14);
  EXPECT_NEAR(of.mean()[1], 0.969031888398308, 1e-14);
  EXPECT_NEAR(of.covariance()(0, 0), 0.269289357021383, 1e-14);
  EXPECT_NEAR(of.covariance()(0, 1), 0.099460558363958, 1e-14);
  EXPECT_NEAR(of.covariance()(1, 1), 0.250531444576963, 1e-14);
  EXPECT_NEAR(of.skewness()[0], -3.843589173386575, 1e-12);
  EXPECT_NEAR(of.skewness()[1], 1.765829630716314, 1e-12);
  EXPECT_NEAR(of.excess_kurtosis()[0], 39.959845094523445, 1e-11);
  EXPECT_NEAR(of.excess_kurtosis()[1], 17.130148354959264, 1e-11);
  EXPECT_NEAR(of.mardia_skewness(), 23.49246890395676, 1e-11);
  EXPECT_NEAR(of.mardia_excess_kurtosis(), 68.62168937206448, 1e-11);
  EXPECT_NEAR(of.negentropy(), 45.834686651797966, 1e-11);
}

// A shear y = (x_1, x_2 + k x_1^2) keeps areas; the variance of k x_1^2 is 2 k^2, and nothing is
// correlated.
TEST(PolynomialMoments, NegentropyOfAShearIsThatOfItsCovariance) {
  for (const double k : {0.003, 0.1, 1.0, 1e3, 1e6}) {
    const SpacePointer space = SeriesSpace::create(2, 2);
    const Series<double> x = Series<double>::variable(space, 0);
    Cumulants of = moments({x, Series<double>::variable(space, 1) + k * x * x},
                           Covariance::of_standard_deviations(Vector<double>::Ones(2)));
    of.carried_without_compression(0);
    const double exact = std::log(1 + 2 * k * k) / 2;
    // The leading terms, which stand where they are small, come to k^2 + 6 k^4, exactly it is
    // k^2 - k^4.
    EXPECT_NEAR(of.negentropy() / exact, 1, k < 0.1 ? 8 * exact : 1e-9) << k;
    // Along other axes, in other units and elsewhere it is the same.
    Matrix<double> map(2, 2);
    map << 3, 1, -2, 500;
    const Cumulants shifted = Cumulants::of_sum(
        of.mapped(map),
        Cumulants(Vector<double>::Ones(2), Covariance::of_factor(Matrix<double>(2, 0))));
    EXPECT_NEAR(shifted.negentropy() / of.negentropy(), 1, 1e-6) << k;
    // Of a part of it nothing is known but the cumulants: those of chi-square in the limit.
    const Cumulants part = of.mapped(Matrix<double>::Identity(2, 2).bottomRows(1));
    EXPECT_EQ(part.gaussian_log_volume(), std::nullopt);
    if (k >= 1e3) {
      EXPECT_NEAR(part.negentropy(), 8.0 / 12 + 144.0 / 48, 1e-4);
    }
  }
}

TEST(PolynomialMoments, OfALinearMapAreGaussian) {
  const auto map = random_map(1, 6, 6, 1, 1);
  Matrix<double> factor = Matrix<double>::Random(6, 6);
  const Covariance covariance = Covariance::of_factor(factor);
  const Cumulants of = moments(map, covariance);
  const Matrix<double> a = linear_part(map);
  const Matrix<double> expected = a * covariance.matrix() * a.transpose();
  EXPECT_LT((of.covariance() - expected).norm(), 1e-13 * expected.norm());
  // Products of two of the uncorrelated variables are right to some roundings of the largest
  // coefficient over the smallest spread.
  EXPECT_LT(of.mardia_skewness(), 1e-18);
  EXPECT_LT(std::abs(of.mardia_excess_kurtosis()), 1e-10);
  EXPECT_LT(of.negentropy(), 1e-18);
  EXPECT_LT(divergence_from_gaussian(of, Cumulants(of.mean(), covariance.mapped(a))), 1e-12);
}

TEST(PolynomialMoments, OfASumOfIndependentVectorsAreThoseOfOneMapInAllVariables) {
  // y(x) - z(v), as one map of (x, v), and as the sum of two.
  const auto y = random_map(3, 3, 2, 3, 0.5);
  const auto z = random_map(4, 3, 3, 2, 0.5);
  const SpacePointer space = SeriesSpace::create(5, 3);
  std::vector<Series<double>> both(3, Series<double>(space));
  const auto place = [&](const Series<double>& part, std::size_t from, std::size_t c, double sign) {
    for (std::size_t k = 0; k < part.size(); ++k) {
      std::array<std::uint8_t, 5> exponents{};
      const auto own = part.space().exponents(k);
      std::copy(own.begin(), own.end(), exponents.begin() + static_cast<std::ptrdiff_t>(from));
      both[c][space->index(exponents)] += sign * part[k];
    }
  };
  for (std::size_t c = 0; c < 3; ++c) {
    place(y[c], 0, c, 1);
    place(z[c], 2, c, -1);
  }
  const Cumulants whole = Cumulants::of_polynomials(both);
  const Cumulants sum =
      Cumulants::of_sum(Cumulants::of_polynomials(y),
                        Cumulants::of_polynomials(z).mapped(-Matrix<double>::Identity(3, 3)));
  EXPECT_LT((whole.mean() - sum.mean()).norm(), 1e-14);
  EXPECT_LT((whole.covariance() - sum.covariance()).norm(), 1e-13);
  EXPECT_LT((whole.skewness() - sum.skewness()).norm(), 1e-12);
  EXPECT_LT((whole.excess_kurtosis() - sum.excess_kurtosis()).norm(), 1e-11);
  EXPECT_NEAR(whole.mardia_skewness() / sum.mardia_skewness(), 1, 1e-11);
  EXPECT_NEAR(whole.mardia_excess_kurtosis() / sum.mardia_excess_kurtosis(), 1, 1e-11);
  EXPECT_NEAR(whole.negentropy() / sum.negentropy(), 1, 1e-11);
}

TEST(PolynomialMoments, GoThroughAMatrixAsThePolynomialsDo) {
  const auto map = random_map(5, 5, 3, 3, 0.4);
  for (const Eigen::Index rows : {1, 3, 5, 7}) {
    const Matrix<double> a = Matrix<double>::Random(rows, 5);
    std::vector<Series<double>> mapped(static_cast<std::size_t>(rows),
                                       Series<double>(map[0].space_pointer()));
    for (Eigen::Index i = 0; i < rows; ++i) {
      for (Eigen::Index j = 0; j < 5; ++j) {
        mapped[static_cast<std::size_t>(i)] += map[static_cast<std::size_t>(j)] * a(i, j);
      }
    }
    const Cumulants one = Cumulants::of_polynomials(map).mapped(a);
    const Cumulants other = Cumulants::of_polynomials(mapped);
    ASSERT_EQ(one.rank(), other.rank());
    EXPECT_LT((one.covariance() - other.covariance()).norm(), 1e-12);
    EXPECT_LT((one.skewness() - other.skewness()).norm(), 1e-11);
    EXPECT_NEAR(one.mardia_excess_kurtosis() / other.mardia_excess_kurtosis(), 1, 1e-9) << rows;
    EXPECT_NEAR(one.negentropy() / other.negentropy(), 1, 1e-9) << rows;
  }
}

TEST(PolynomialMoments, OfFewerDirectionsThanComponents) {
  // (x, 2x + 1, -x) has one direction; (x, x^2, x) two.
  const SpacePointer space = SeriesSpace::create(1, 2);
  const auto x = Series<double>::variable(space, 0);
  const Cumulants line = moments({x, 2.0 * x + 1.0, -1.0 * x}, independent({1e-3}));
  EXPECT_EQ(line.rank(), 1);
  EXPECT_NEAR(line.covariance()(1, 2) / -2e-6, 1, 1e-14);
  const Cumulants curve = moments({x, square(x), x}, independent({2}));
  EXPECT_EQ(curve.rank(), 2);
  EXPECT_NEAR(curve.skewness()[1], std::sqrt(8.0), 1e-13);
  const Cumulants still = moments({x, x}, independent({0}));
  EXPECT_EQ(still.rank(), 0);
  EXPECT_EQ(still.covariance().norm(), 0);
  EXPECT_EQ(still.negentropy(), 0);
  EXPECT_TRUE(std::isinf(divergence_from_gaussian(
      curve, Cumulants(curve.mean(), Covariance::of_factor(Matrix<double>::Ones(3, 1))))));
}

TEST(PolynomialMoments, OfANeedleAreRightAcrossItToo) {
  // Two components that differ by 1e-6 of themselves: (x, x + 1e-6 (z + z^2)). Across the needle
  // the distribution is z + z^2, of skewness (6 + 8)/3^(3/2) and excess kurtosis (48 + 48)/9.
  const SpacePointer space = SeriesSpace::create(2, 2);
  const auto x = Series<double>::variable(space, 0);
  const auto z = Series<double>::variable(space, 1);
  const Cumulants of = Cumulants::of_polynomials({x, x + 1e-6 * (z + square(z))});
  EXPECT_EQ(of.rank(), 2);
  // The difference has lost six digits of sixteen, and its moments as many.
  EXPECT_NEAR(of.mardia_skewness(), 14.0 * 14.0 / 27, 1e-8);
  EXPECT_NEAR(of.mardia_excess_kurtosis(), 96.0 / 9, 1e-8);
}

TEST(PolynomialMoments, DivergenceOfTwoGaussiansIsTheClosedForm) {
  // In one dimension ln(s1/s) + (s^2 + d^2)/(2 s1^2) - 1/2, and a sum of such for independent ones.
  Vector<double> mean(2);
  mean << 1, 2;
  Vector<double> other(2);
  other << 1.5, 1;
  const Cumulants one(mean, independent({2, 3}));
  const Cumulants two(other, independent({4, 1}));
  const auto single = [](double s, double s1, double d) {
    return std::log(s1 / s) + (s * s + d * d) / (2 * s1 * s1) - 0.5;
  };
  EXPECT_NEAR(divergence_from_gaussian(one, two), single(2, 4, 0.5) + single(3, 1, 1), 1e-14);
  EXPECT_NEAR(divergence_from_gaussian(two, one), single(4, 2, 0.5) + single(1, 3, 1), 1e-14);
  EXPECT_NEAR(divergence_from_gaussian(one, one), 0, 1e-15);
  // No linear change of coordinates alters it.
  Matrix<double> a(2, 2);
  a << 1, 3, -2, 0.5;
  EXPECT_NEAR(divergence_from_gaussian(one.mapped(a), two.mapped(a)),
              single(2, 4, 0.5) + single(3, 1, 1), 1e-13);
}

TEST(PolynomialMoments, PinskersBoundHoldsOfTwoGaussians) {
  // Of N(0, s^2) and N(0, 1) the largest difference of probabilities is that of the interval within
  // x^2 = 2 s^2 ln s / (s^2 - 1): erf(x/sqrt 2) - erf(x/(s sqrt 2)).
  for (const double s : {1.01, 1.1, 1.5, 3.0}) {
    const Cumulants wide(Vector<double>::Zero(1), independent({s}));
    const Cumulants narrow(Vector<double>::Zero(1), independent({1}));
    const double x = std::sqrt(2 * s * s * std::log(s) / (s * s - 1));
    const double difference = std::erf(x / std::sqrt(2)) - std::erf(x / (s * std::sqrt(2)));
    const double bound = largest_error_of_probability(divergence_from_gaussian(wide, narrow));
    EXPECT_GE(bound, difference) << s;
    // The bound is sharp to a factor: bound and difference are both of the first order in s - 1.
    if (s < 2) {
      EXPECT_LE(bound, 2 * difference) << s;
    }
  }
}

TEST(PolynomialMoments, RefuseWhatDoesNotFit) {
  const SpacePointer space = SeriesSpace::create(2, 1);
  Series<double> y(space);
  EXPECT_THROW(in_standard_normals({y}, independent({1})), Error);
  EXPECT_THROW(Cumulants::of_polynomials({}), Error);
  y[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Cumulants::of_polynomials({y}), Error);
  const Matrix<double> points = Matrix<double>::Ones(1, 2);
  EXPECT_THROW(Cumulants::of_points(points, Vector<double>::Ones(2)), Error);
}

}  // namespace
}  // namespace hamjet
