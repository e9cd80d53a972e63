#include "hamjet/uncertainty/covariance.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

const auto rtn = component_names(RelativeFrame::rtn_inertial);

/// A A^T of a random matrix whose columns are scaled.
Matrix<double> random_covariance(unsigned seed, const Vector<double>& scales) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Matrix<double> a(6, 6);
  for (Eigen::Index i = 0; i < a.size(); ++i) a.data()[i] = normal(generator);
  a = scales.asDiagonal() * a;
  return a * a.transpose();
}

/// The matrix with each number rounded to so many decimal digits.
Matrix<double> rounded_to_digits(Matrix<double> matrix, int digits) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    matrix.data()[i] = std::stod(fmt::format("{:.{}e}", matrix.data()[i], digits - 1));
  }
  return matrix;
}

std::string fault(const Matrix<double>& matrix) {
  return Covariance::fault_of(matrix, rtn).value_or("");
}

TEST(Covariance, FactorTimesItsTransposeIsTheMatrix) {
  // Positions in metres and velocities in m/s: variances twelve decades apart.
  Vector<double> scales(6);
  scales << 1e3, 1e4, 1e2, 1e-2, 1e-3, 1e-2;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Matrix<double> matrix = random_covariance(seed, scales);
    const Covariance covariance(matrix, rtn);
    EXPECT_EQ(covariance.rank(), 6);
    EXPECT_EQ(covariance.taken_as_zero(), 0);
    const Matrix<double> back = covariance.matrix();
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        // The decomposition of the correlations is right to some n units of their largest
        // eigenvalue, which is below n.
        EXPECT_NEAR(
            back(i, j), matrix(i, j),
            100 * std::numeric_limits<double>::epsilon() * std::sqrt(matrix(i, i) * matrix(j, j)));
      }
      EXPECT_NEAR(covariance.standard_deviations()[i] / std::sqrt(matrix(i, i)), 1, 1e-13);
    }
  }
}

TEST(Covariance, OfFewerDirectionsHasAFactorOfFewerColumns) {
  // v v^T + w w^T has rank 2; written with 16 digits its other eigenvalues are rounding of either
  // sign.
  for (int digits : {16, 12, 8, 5}) {
    Vector<double> v(6);
    v << 1000.0 / 3, 2000.0 / 7, -300.0 / 11, 1.0 / 13, -2.0 / 17, 0.5 / 19;
    Vector<double> w(6);
    w << -100.0 / 23, 700.0 / 29, 400.0 / 31, 0.3 / 37, 1.0 / 41, -0.7 / 43;
    const Matrix<double> exact = v * v.transpose() + w * w.transpose();
    const Matrix<double> matrix = rounded_to_digits(exact, digits);
    const Covariance covariance(matrix, rtn);
    const Matrix<double> back = covariance.matrix();
    if (digits < 16) {
      EXPECT_LT(covariance.rank(), 6) << digits;
      EXPECT_GT(covariance.taken_as_zero(), 0) << digits;
    }
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < 6; ++j) {
        // The change is below the allowance 2 n 5 10^-p of correlations.
        EXPECT_NEAR(
            back(i, j), exact(i, j),
            12 * 5 * std::pow(10.0, -std::min(digits, 15)) * std::sqrt(exact(i, i) * exact(j, j)));
      }
    }
  }
}

TEST(Covariance, ComponentsWithoutVarianceAreAllowed) {
  Matrix<double> matrix = Matrix<double>::Zero(6, 6);
  matrix(0, 0) = 4;
  matrix(4, 4) = 9;
  matrix(0, 4) = matrix(4, 0) = 6;  // fully correlated: one direction, (2, 3)
  const Covariance covariance(matrix, rtn);
  EXPECT_EQ(covariance.rank(), 1);
  EXPECT_NEAR(covariance.factor()(0, 0) / covariance.factor()(4, 0), 2.0 / 3, 1e-15);
  EXPECT_EQ(Covariance(Matrix<double>::Zero(6, 6)).rank(), 0);
}

TEST(Covariance, RefusesWhatIsNoneByName) {
  Vector<double> scales = Vector<double>::Constant(6, 1.0);
  const Matrix<double> good = random_covariance(7, scales);
  ASSERT_EQ(fault(good), "");
  Matrix<double> bad = good;
  bad(0, 1) *= 1.001;
  EXPECT_NE(fault(bad).find("not symmetric"), std::string::npos) << fault(bad);
  EXPECT_NE(fault(bad).find("for R with T"), std::string::npos) << fault(bad);
  bad = good;
  bad(2, 2) = -1;
  EXPECT_NE(fault(bad).find("variance -1 of N"), std::string::npos) << fault(bad);
  bad = good;
  bad(5, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(fault(bad).find("for vN with vR"), std::string::npos) << fault(bad);
  bad = good;
  bad(1, 1) = 0;
  EXPECT_NE(fault(bad).find("the variance of T is 0"), std::string::npos) << fault(bad);
  EXPECT_NE(fault(Matrix<double>::Zero(6, 5)).find("not square"), std::string::npos);
  EXPECT_THROW(Covariance{bad}, Error);
}

TEST(Covariance, RefusesACorrelationAboveOneWithItsDirection) {
  // Correlation 1.2 of R and vT: the eigenvalue 1 - 1.2 along (R - vT)/sqrt(2).
  Matrix<double> matrix = Matrix<double>::Identity(6, 6);
  matrix(0, 0) = 1e6;
  matrix(4, 4) = 1e-2;
  matrix(0, 4) = matrix(4, 0) = 1.2 * 1e3 * 0.1;
  EXPECT_NE(fault(matrix).find("eigenvalue -0.2"), std::string::npos) << fault(matrix);
  EXPECT_TRUE(fault(matrix).find("0.71 R - 0.71 vT") != std::string::npos ||
              fault(matrix).find("0.71 vT - 0.71 R") != std::string::npos)
      << fault(matrix);
}

TEST(Covariance, OneThatWasPrintedWithFewDigitsIsStillOne) {
  // Nearly singular, as covariances of orbits are: the along-track position follows from the
  // energy. Rounded to 4 digits, an eigenvalue of the correlations may be below zero.
  Vector<double> scales(6);
  scales << 10, 1000, 10, 1, 0.01, 0.01;
  int mended = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    Matrix<double> matrix = random_covariance(seed, scales);
    const Vector<double> v = matrix.col(0);
    matrix = 1e-9 * matrix + v * v.transpose();
    for (const int digits : {4, 7, 10, 14}) {
      const Matrix<double> printed = rounded_to_digits(matrix, digits);
      ASSERT_EQ(fault(printed), "") << seed << " " << digits;
      mended += Covariance(printed, rtn).taken_as_zero() > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(mended, 50);
}

TEST(Covariance, GoesFromAxesOfTheChiefToInertialOnesAndBack) {
  const MetricUnits units{7e6, 927.5};
  const std::vector<double> chief = {0.9, 0.3, -0.2, -0.3, 0.8, 0.6};
  Vector<double> scales(6);
  scales << 100, 200, 50, 0.1, 0.2, 0.3;
  const Covariance relative(random_covariance(3, scales), rtn);
  for (const RelativeFrame axes :
       {RelativeFrame::rtn_inertial, RelativeFrame::rtn_rotating, RelativeFrame::inertial}) {
    const ChiefFrame frame(chief, units, axes);
    const Covariance canonical = relative.mapped(deviations_of_relative_states(frame));
    const Covariance back = canonical.mapped(relative_states_of_deviations(frame));
    const Vector<double> deviations = relative.standard_deviations();
    const Matrix<double> difference = back.matrix() - relative.matrix();
    for (Eigen::Index i = 0; i < 6; ++i) {
      // Velocities in turning axes are differences of parts that the turn of the axes makes
      // larger, 1e-3/s times hundreds of metres.
      for (Eigen::Index j = 0; j < 6; ++j) {
        EXPECT_NEAR(difference(i, j), 0, 1e-12 * deviations[i] * deviations[j]) << i << j;
      }
    }
    // A turn keeps the trace of positions.
    EXPECT_NEAR(canonical.matrix().topLeftCorner(3, 3).trace() * units.length_m * units.length_m,
                relative.matrix().topLeftCorner(3, 3).trace(), 1e-9);
  }
}

TEST(Covariance, AlongRtnOnACircularEquatorialOrbit) {
  // At the y axis, moving along -x: R = y, T = -x, N = z.
  const ChiefFrame frame(std::vector<double>{0, 1, 0, -1, 0, 0}, {1e6, 1e3},
                         RelativeFrame::rtn_inertial);
  Vector<double> deviations(6);
  deviations << 10, 20, 30, 0.1, 0.2, 0.3;
  const Matrix<double> inertial = Covariance::of_standard_deviations(deviations)
                                      .mapped(deviations_of_relative_states(frame))
                                      .matrix();
  Vector<double> expected(6);
  expected << 20e-6, 10e-6, 30e-6, 0.2e-3, 0.1e-3, 0.3e-3;
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_NEAR(std::sqrt(inertial(i, i)), expected[i], 1e-18);
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_NEAR(inertial(i, j), 0, 1e-24);
  }
}

TEST(Covariance, OfTwoSpacecraftHasNoCorrelationsBetweenThem) {
  const Covariance one(random_covariance(1, Vector<double>::Constant(6, 2.0)));
  const Covariance other(random_covariance(2, Vector<double>::Constant(6, 3.0)));
  const Covariance both = Covariance::of_independent(one, other);
  EXPECT_EQ(both.size(), 12);
  EXPECT_EQ(both.rank(), 12);
  EXPECT_EQ(both.matrix().topRightCorner(6, 6).norm(), 0);
  EXPECT_LT((both.matrix().bottomRightCorner(6, 6) - other.matrix()).norm(),
            1e-15 * other.matrix().norm());
}

}  // namespace
}  // namespace hamjet
