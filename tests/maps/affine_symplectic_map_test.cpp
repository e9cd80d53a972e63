#include "maps/affine_symplectic_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "maps/symplectic_powers.hpp"
#include "support/errors.hpp"
#include "support/symplectic.hpp"

namespace hamjet::test {
namespace {

Matrix<double> matrix2(double a, double b, double c, double d) {
  Matrix<double> m(2, 2);
  m << a, b, c, d;
  return m;
}

// Expected: for one degree of freedom A J A^T = (det A) J.
TEST(AffineSymplecticMap, DefectIsTheDeterminantMinusOneInThePlane) {
  const auto defect = symplecticity_defect(matrix2(2, 1, 1, 1.5));
  EXPECT_NEAR(defect.absolute, 2 * 1.5 - 1 - 1, 1e-15);
  // The sum of the terms that cancel is 2*1.5 + 1*1.
  EXPECT_NEAR(defect.relative, 1.0 / 5, 0.06);
  EXPECT_EQ(symplecticity_defect(matrix2(2, 3, 1, 2)).absolute, 0);
  EXPECT_EQ(symplecticity_defect(matrix2(0, 0, 0, 0)).absolute, 1);
}

// For a hundred times the identity, Newton's step brings the matrix no nearer, and the remaining
// defect is refused.
TEST(AffineSymplecticMap, TheNearestOfWhatIsFarIsRefused) {
  const Matrix<double> far = 100 * Matrix<double>::Identity(4, 4);
  test::expect_error(ErrorKind::usage, "not symplectic",
                     [&] { AffineSymplecticMap<double> map(nearest_symplectic(far)); });
}

// A reflection of the momentum preserves volume up to sign but is not symplectic: A J A^T = -J.
TEST(AffineSymplecticMap, RefusesWhatIsNotSymplectic) {
  expect_error(ErrorKind::usage, "the largest entry of A J A^T - J is 2",
               [] { AffineSymplecticMap<double> map(matrix2(1, 0, 0, -1)); });
  expect_error(ErrorKind::usage, "not symplectic",
               [] { AffineSymplecticMap<double> map(matrix2(1, 0, 0, 1 + 1e-11)); });
  // Determinant 1, but rotating q1 into q2 alone is not canonical.
  Matrix<double> four = Matrix<double>::Identity(4, 4);
  four.topLeftCorner(2, 2) = matrix2(0.8, -0.6, 0.6, 0.8);
  expect_error(ErrorKind::usage, "not symplectic", [&] { AffineSymplecticMap<double> map(four); });
  expect_error(ErrorKind::usage, "2n x 2n, got 3 x 3", [] {
    AffineSymplecticMap<double> map(Matrix<double>(Matrix<double>::Identity(3, 3)));
  });
  expect_error(ErrorKind::usage, "shift", [] {
    AffineSymplecticMap<double> map(matrix2(1, 0, 0, 1), Vector<double>::Zero(4));
  });
  expect_error(ErrorKind::usage, "not finite",
               [] { AffineSymplecticMap<double> map(matrix2(1, std::nan(""), 0, 1)); });
}

TEST(AffineSymplecticMap, InverseAndComposition) {
  RandomNumbers random(31);
  for (const Eigen::Index n : {1, 2, 3}) {
    const auto f = random_affine_map<double>(n, random);
    const auto g = random_affine_map<double>(n, random);
    const Vector<double> z = random_vector<double>(2 * n, random);
    const double scale = f.condition() * g.condition();
    EXPECT_LE(largest_entry(f.inverse()(f(z)) - z), 1e-15 * scale);
    EXPECT_LE(largest_entry(f.inverse_matrix() - f.matrix().inverse()), 1e-14 * scale);
    EXPECT_LE(largest_entry(g.after(f)(z) - g(f(z))), 1e-15 * scale);
  }
  expect_error(ErrorKind::usage, "different dimension", [] {
    AffineSymplecticMap<double>::identity(1).after(AffineSymplecticMap<double>::identity(2));
  });
}

// Source of the numbers: the paper's A_k at k = 1.
TEST(AffineSymplecticMap, RotationIsThatOfThePaper) {
  const auto rotation = phase_plane_rotation<double>(std::acos(0.99));
  const double sine = std::sqrt(1 - 0.99 * 0.99);
  EXPECT_LE(largest_entry(rotation.matrix() - matrix2(0.99, -sine, sine, 0.99)), 1e-15);
}

// A matrix rounded to double is symplectic to 1e-16. The correction makes it symplectic to 1e-33
// and changes it by no more than its rounding.
TEST(AffineSymplecticMap, NearestSymplecticMatrix) {
  RandomNumbers random(32);
  for (const Eigen::Index n : {1, 2, 3}) {
    const auto rounded = random_symplectic_matrix<double>(n, random).cast<Extended>().eval();
    EXPECT_GT(symplecticity_defect<Extended>(rounded).relative, 1e-20);
    const Matrix<Extended> nearest = nearest_symplectic<Extended>(rounded);
    EXPECT_LE(symplecticity_defect(nearest).relative, 1e-32);
    EXPECT_LE(largest_entry(nearest - rounded), 1e-13);
  }
}

// f^k of a rotation in closed form; f^k of a shear with a shift likewise:
// A^k = [[1, k s], [0, 1]], and B_k = sum over j < k of A^j B.
TEST(SymplecticPowers, InClosedForm) {
  const Extended angle = acos(Extended(0.99));
  SymplecticPowers rotations(phase_plane_rotation<Extended>(angle));
  for (const long k : {0, 1, 2, 1000, 3}) {
    const Matrix<double> power = rotations(k).matrix();
    const Extended turned = angle * k;
    EXPECT_NEAR(power(0, 0), static_cast<double>(Extended(cos(turned))), 2e-16) << k;
    EXPECT_NEAR(power(1, 0), static_cast<double>(Extended(sin(turned))), 2e-16) << k;
    EXPECT_EQ(power(0, 1), -power(1, 0));
  }
  const AffineSymplecticMap<Extended> shear(matrix2(1, 0.5, 0, 1).cast<Extended>(),
                                            Vector<double>{{1, 0.25}}.cast<Extended>());
  const auto power = SymplecticPowers(shear)(8);
  EXPECT_EQ(power.matrix(), matrix2(1, 4, 0, 1));
  EXPECT_EQ(power.shift(), (Vector<double>{{8 + 0.25 * 0.5 * 28, 2}}));
}

TEST(SymplecticPowers, SaysWhereItOverflows) {
  SymplecticPowers powers(AffineSymplecticMap<Extended>(matrix2(2, 0, 0, 0.5).cast<Extended>()));
  EXPECT_EQ(powers(10).matrix()(0, 0), 1024);
  expect_error(ErrorKind::numerical, "the one of exponent 600 overflows", [&] { powers(600); });
  expect_error(ErrorKind::usage, "must not be negative", [&] { powers(-1); });
}

// The measures of the tests must not lose an entry that is not a number.
TEST(LargestEntry, KeepsANaN) {
  Matrix<double> values = matrix2(1, -3, 2, 0);
  EXPECT_EQ(largest_entry(values), 3);
  for (double& x : values.reshaped()) {
    const double kept = std::exchange(x, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(std::isnan(largest_entry(values)));
    EXPECT_TRUE(std::isnan(largest_entry(values.cast<Extended>())));
    x = kept;
  }
}

}  // namespace
}  // namespace hamjet::test
