#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "hamjet/uncertainty/polynomial_moments.hpp"

namespace hamjet {
namespace {

/// Four polynomials of degree 3 in four variables.
std::vector<Series<double>> mixed_map() {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  const SpacePointer space = SeriesSpace::create(4, 3);
  std::vector<Series<double>> map(4, Series<double>(space));
  for (Series<double>& component : map) {
    for (std::size_t k = 0; k < space->size(); ++k) {
      component[k] = normal(generator) * std::pow(0.4, space->degree(k));
    }
  }
  return map;
}

// For given values of one variable the others are those of a polynomial, and over a quadrature of
// that one they are a mixture: together they are the polynomial of all.
TEST(MixtureMoments, AreThoseOfAllVariables) {
  const std::vector<Series<double>> map = mixed_map();
  const Cumulants whole = Cumulants::of_polynomials(map);
  // Nodes and weights of Gauss-Hermite, seven of them, exact to degree 13 (Abramowitz and Stegun,
  // table 25.10, of the weight exp(-x^2)).
  const std::array<double, 4> nodes = {0, 0.816287882858965, 1.673551628767471, 2.651961356835233};
  const std::array<double, 4> weights = {0.8102646175568, 0.4256072526101, 0.05451558281913,
                                         0.0009717812450995};
  std::vector<Cumulants> parts;
  std::vector<double> shares;
  Matrix<double> rest = Matrix<double>::Zero(4, 3);
  rest.bottomRows(3).setIdentity();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      if (k == 0 && sign > 0) continue;
      Vector<double> mean = Vector<double>::Zero(4);
      mean[0] = sign * nodes[k] * std::sqrt(2.0);
      parts.push_back(
          Cumulants::of_polynomials(in_standard_normals(map, Covariance::of_factor(rest), mean)));
      shares.push_back(weights[k] / std::sqrt(std::numbers::pi));
    }
  }
  const Cumulants mixture =
      Cumulants::of_mixture(parts, Eigen::Map<const Vector<double>>(shares.data(), 7));
  constexpr double of_table = 1e-10;  // thirteen digits of the weights, and what sums make of them
  EXPECT_LT((mixture.mean() - whole.mean()).norm(), of_table);
  EXPECT_LT((mixture.covariance() - whole.covariance()).norm(),
            of_table * whole.covariance().norm());
  EXPECT_LT((mixture.skewness() - whole.skewness()).norm(), of_table * 10);
  EXPECT_LT((mixture.excess_kurtosis() - whole.excess_kurtosis()).norm(), of_table * 100);
  EXPECT_NEAR(mixture.mardia_skewness(), whole.mardia_skewness(),
              100 * of_table * whole.mardia_skewness());
  EXPECT_NEAR(mixture.mardia_excess_kurtosis(), whole.mardia_excess_kurtosis(),
              100 * of_table * whole.mardia_excess_kurtosis());
}

}  // namespace
}  // namespace hamjet
