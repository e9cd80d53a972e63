#include "smallest_singular_value.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

double by_decomposition(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> decomposition(matrix,
                                                        Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = decomposition.matrixU().determinant() * decomposition.matrixV().determinant();
  return std::copysign(decomposition.singularValues()[2], sign);
}

/// The least root of x^3 - a x^2 + b x - c, whose roots are real and not negative; negative where
/// it is nearly a double root, which rounding would move far, or is not found.
double least_root(double a, double b, double c) {
  constexpr int most_iterations = 20;
  constexpr double least_slope = 0.01;  // the least slope of the polynomial, as a fraction of b
  constexpr double rounding = 1e-15;
  double x = c / b;
  for (int i = 0; i < most_iterations; ++i) {
    const double slope = (3 * x - 2 * a) * x + b;
    if (!(slope > least_slope * b)) return -1;
    const double change = (c - ((x - a) * x + b) * x) / slope;
    x += change;
    if (!(std::abs(change) > rounding * x)) return x;
  }
  return -1;
}

}  // namespace

double signed_smallest_singular_value(const Eigen::Matrix3d& matrix) {
  Eigen::Vector3d first = matrix.col(0);
  Eigen::Vector3d second = matrix.col(1);
  Eigen::Vector3d third = matrix.col(2);
  double sign = 1;
  const auto exchange = [&](Eigen::Vector3d& a, Eigen::Vector3d& b) {
    std::swap(a, b);
    sign = -sign;
  };
  if (second.squaredNorm() > first.squaredNorm()) exchange(first, second);
  if (third.squaredNorm() > first.squaredNorm()) exchange(first, third);
  // All that follows is relative to the largest column.
  const double unit = first.norm();
  if (!matrix.allFinite()) {
    throw Error(ErrorKind::numerical, "singular values: an entry of the matrix is no number");
  }
  if (!(unit > 0)) return 0;
  first /= unit;
  second /= unit;
  third /= unit;
  double r12 = first.dot(second);
  double r13 = first.dot(third);
  second -= r12 * first;
  third -= r13 * first;
  if (third.squaredNorm() > second.squaredNorm()) {
    exchange(second, third);
    std::swap(r12, r13);
  }
  const double r22 = second.norm();
  if (!(r22 > 0)) return 0;
  second /= r22;
  const double r23 = second.dot(third);
  const double r33 = sign * first.cross(second).dot(third);
  // The sum of the squares of the entries, and of the cofactors, of R / unit.
  const double a = 1 + r12 * r12 + r13 * r13 + r22 * r22 + r23 * r23 + r33 * r33;
  const double r12_r23 = r12 * r23 - r13 * r22;
  const double b =
      r22 * r22 * (1 + r33 * r33) + r23 * r23 + r33 * r33 * (1 + r12 * r12) + r12_r23 * r12_r23;
  const double square = least_root(a, b, r22 * r22 * r33 * r33);
  if (!(square >= 0)) return by_decomposition(matrix);
  return std::copysign(unit * std::sqrt(square), r33);
}

}  // namespace hamjet
