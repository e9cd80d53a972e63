#include "algebra/scalar_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "algebra/matrix_eigenvalues.hpp"
#include "algebra/singular_values.hpp"
#include "algebra/symmetric_eigenvalues.hpp"
#include "hamjet/detail/algebra/matrix.hpp"

namespace hamjet {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int bits = 50;

std::string refusal(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    return error.what();
  }
  return "none";
}

// Closed form: x^2 = 2.
TEST(ScalarSearch, FindsTheRootInEitherDirection) {
  const auto f = [](double x) { return x * x - 2; };
  const double root = std::sqrt(2.0);
  EXPECT_NEAR(root_between("test", f, {1, -1}, {2, 2}, bits), root, 4e-15);
  EXPECT_NEAR(root_between("test", f, {2, 2}, {1, -1}, bits), root, 4e-15);
  EXPECT_EQ(root_between("test", f, {2, 0}, {1, -1}, bits), 2);
}

// The bits of a root at 0 never agree, so that the width of the remaining interval counts.
TEST(ScalarSearch, FindsARootAtZero) {
  const auto f = [](double x) { return std::expm1(x); };
  EXPECT_NEAR(root_between("test", f, {-1, std::expm1(-1.0)}, {3, std::expm1(3.0)}, bits), 0,
              std::ldexp(4.0, -bits));
}

TEST(ScalarSearch, SaysWhyThereIsNoRoot) {
  const auto f = [](double x) { return x * x + 1; };
  EXPECT_NE(refusal([&] {
              root_between("search", f, {-1, 2}, {2, 5}, bits);
            }).find("search: no root is enclosed"),
            std::string::npos);
  const auto broken = [](double x) { return x > 0.2 && x < 0.8 ? nan : x - 0.5; };
  EXPECT_NE(refusal([&] {
              root_between("search", broken, {0, -0.5}, {1, 0.5}, bits);
            }).find("is nan at"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              root_between("search", f, {0, nan}, {1, 2}, bits);
            }).find("is nan at"),
            std::string::npos);
}

TEST(ScalarSearch, SaysThatEvaluationsAreUsedUp) {
  const auto f = [](double x) { return std::cos(x) - x; };
  EXPECT_NE(refusal([&] {
              root_between("search", f, {0, 1}, {1, f(1)}, bits, 3);
            }).find("evaluations leave the root between"),
            std::string::npos);
}

// The least value of (x - 1)^2 + 3 is known in closed form; the search finds its place to the
// square root of rounding.
TEST(ScalarSearch, FindsAMinimum) {
  const auto f = [](double x) { return (x - 1) * (x - 1) + 3; };
  for (const auto& [a, b] : {std::pair(-2.0, 5.0), {5.0, -2.0}}) {
    const PlaceAndValue least = minimum_between("test", f, a, b, 26);
    EXPECT_NEAR(least.place, 1, 1e-7);
    EXPECT_NEAR(least.value, 3, 1e-14);
  }
}

TEST(ScalarSearch, AMinimumOfNoNumberIsNone) {
  const auto f = [](double x) { return x > 0.5 ? nan : x * x; };
  EXPECT_NE(refusal([&] { minimum_between("search", f, -1, 2, 26); }).find("no number at"),
            std::string::npos);
}

TEST(SymmetricEigenvalues, ThoseOfNoNumbersAreNone) {
  const Matrix<double> matrix = Matrix<double>::Constant(2, 2, nan);
  EXPECT_NE(refusal([&] { symmetric_eigenvalues("spread", matrix); }).find("spread: "),
            std::string::npos);
}

/// A matrix of ones with a single entry that is not a number.
Matrix<double> with_no_number() {
  Matrix<double> matrix = Matrix<double>::Constant(4, 4, 1);
  matrix(2, 1) = nan;
  return matrix;
}

TEST(MatrixEigenvalues, ThoseOfNoNumbersAreNone) {
  EXPECT_NE(refusal([&] { matrix_eigenvalues("step", with_no_number()); }).find("step: "),
            std::string::npos);
}

// Closed form: [[0, 1], [-4, 0]] has 2 i and -2 i.
TEST(MatrixEigenvalues, AreThoseOfAnOscillator) {
  Matrix<double> matrix(2, 2);
  matrix << 0, 1, -4, 0;
  const auto values = matrix_eigenvalues("test", matrix);
  EXPECT_NEAR(std::abs(values[0].imag()), 2, 1e-15);
  EXPECT_NEAR(std::abs(values[0] + values[1]), 0, 1e-15);
}

// The eigenvalues of the motion beside a circle are known in closed form: 2^(1/2), -2^(1/2), and
// twice i and -i. For one place out of some thousands Eigen's shifts go round in circles.
TEST(MatrixEigenvalues, AreFoundBesideACircle) {
  for (int k = 0; k < 30000; ++k) {
    const double angle = k / 4700.0;
    const Eigen::Vector3d place(std::cos(angle), std::sin(angle), 0);
    Matrix<double> matrix = Matrix<double>::Zero(6, 6);
    matrix.topRightCorner(3, 3).setIdentity();
    matrix.bottomLeftCorner(3, 3) = 3 * place * place.transpose() - Eigen::Matrix3d::Identity();
    const auto values = matrix_eigenvalues("circle", matrix);
    EXPECT_NEAR(values.cwiseAbs().maxCoeff(), std::sqrt(2.0), 1e-12) << angle;
    EXPECT_NEAR(values.cwiseAbs().minCoeff(), 1, 1e-7)
        << angle;  // double eigenvalues keep half the digits
  }
}

// Eigen's own singular values are then whatever the memory held.
TEST(SingularValues, ThoseOfNoNumbersAreNone) {
  const Vector<double> values = singular_values(with_no_number());
  for (const double value : values) EXPECT_TRUE(std::isnan(value));
}

TEST(SingularValues, ADecompositionOfNoNumbersIsNone) {
  EXPECT_NE(refusal([&] { decompose_by_singular_values(with_no_number()); }).find("no finite"),
            std::string::npos);
}

// Closed form: [[2, 1], [1, 2]] has 1 and 3.
TEST(SymmetricEigenvalues, AreAscending) {
  Matrix<double> matrix(2, 2);
  matrix << 2, 1, 1, 2;
  const auto solver = symmetric_eigenvalues("test", matrix);
  EXPECT_NEAR(solver.eigenvalues()[0], 1, 1e-15);
  EXPECT_NEAR(solver.eigenvalues()[1], 3, 1e-15);
}

}  // namespace
}  // namespace hamjet
