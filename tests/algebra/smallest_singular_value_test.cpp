#include "algebra/smallest_singular_value.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// A matrix U S V of two rotations has the singular values S, whose smallest may have a sign.
TEST(SmallestSingularValue, HasItsSignAtDoubleZerosToo) {
  const Eigen::Matrix3d U = turn(0.7, {1, 2, 3});
  const Eigen::Matrix3d V = turn(2.1, {3, -1, 1});
  const std::array<std::array<double, 3>, 9> cases = {{{1, 0.5, 0.1},
                                                       {1, 0.5, -1e-9},
                                                       {1, 1e-3, 1e-12},
                                                       {1, 1e-10, -1e-11},
                                                       {1, 1e-12, 1e-12},
                                                       {1, 0.3, -0.3},
                                                       {1, 1, 1},
                                                       {1e6, 40, -1e-3},
                                                       {1e-7, 1e-9, 1e-12}}};
  for (const auto& s : cases) {
    SCOPED_TRACE(::testing::PrintToString(s));
    const Eigen::Matrix3d matrix = U * Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal() * V;
    const double rounding = 32 * std::numeric_limits<double>::epsilon() * s[0];
    EXPECT_NEAR(signed_smallest_singular_value(matrix), s[2], rounding);
    EXPECT_NEAR(signed_smallest_singular_value(matrix.rowwise().reverse()), -s[2], rounding);
  }
}

TEST(SmallestSingularValue, OfASingularMatrixIsZero) {
  EXPECT_EQ(signed_smallest_singular_value(Eigen::Matrix3d::Zero()), 0);
  EXPECT_EQ(signed_smallest_singular_value(Eigen::Vector3d(3, 0, 0).asDiagonal()), 0);
  EXPECT_EQ(signed_smallest_singular_value(Eigen::Vector3d(3, 0, 2).asDiagonal()), 0);
}

TEST(SmallestSingularValue, OfNoNumbersIsRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    matrix(1, 2) = bad;
    EXPECT_THROW(signed_smallest_singular_value(matrix), Error);
  }
}

}  // namespace
}  // namespace hamjet
