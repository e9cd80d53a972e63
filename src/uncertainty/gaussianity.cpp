#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"

// How far a random vector is from a Gaussian one.

namespace hamjet {
namespace {

double sum_of_squares(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return sum;
}

/// 0 where rounding has made the number negative; NaN stays.
double not_negative(double number) { return number < 0 ? 0 : number; }

}  // namespace

double Cumulants::mardia_skewness() const { return sum_of_squares(third_); }

double Cumulants::mardia_excess_kurtosis() const {
  const auto r = static_cast<std::size_t>(rank());
  double sum = 0;
  for (std::size_t i = 0; i < r; ++i) {
    for (std::size_t j = 0; j < r; ++j) sum += fourth_[((i * r + i) * r + j) * r + j];
  }
  return sum;
}

std::optional<double> Cumulants::log_volume() const {
  if (rank() < size()) return std::nullopt;
  // The axes are orthogonal in units of the standard deviations.
  double sum = 0;
  Matrix<double> scaled = axes_;
  const Vector<double> deviations = standard_deviations();
  for (Eigen::Index i = 0; i < size(); ++i) {
    scaled.row(i) /= deviations[i];
    sum += std::log(deviations[i]);
  }
  for (Eigen::Index j = 0; j < rank(); ++j) sum += std::log(scaled.col(j).norm());
  return sum;
}

double Cumulants::negentropy() const {
  // The terms after the leading ones are about the square of these. Below this limit the leading
  // terms are right to a thousandth, and unlike the difference of two logarithms they lose no
  // digits.
  constexpr double small = 1e-4;
  const double leading = sum_of_squares(third_) / 12 + sum_of_squares(fourth_) / 48;
  if (leading < small || !gaussian_log_volume_) return leading;
  const std::optional<double> volume = log_volume();
  return volume ? not_negative(*volume - *gaussian_log_volume_) : leading;
}

double divergence_from_gaussian(const Cumulants& distribution, const Cumulants& gaussian) {
  if (distribution.size() != gaussian.size()) {
    throw Error(ErrorKind::usage, "moments: the two vectors are of different sizes");
  }
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (distribution.rank() != gaussian.rank()) return infinite;
  if (gaussian.rank() == 0) return distribution.mean() == gaussian.mean() ? 0 : infinite;
  // The difference is measured in the Gaussian's own standard deviations.
  const Vector<double> deviations = gaussian.standard_deviations();
  const Vector<double> shift = distribution.mean() - gaussian.mean();
  Matrix<double> rows(gaussian.size(), gaussian.rank());
  Matrix<double> others(gaussian.size(), 1 + distribution.rank());
  for (Eigen::Index i = 0; i < gaussian.size(); ++i) {
    const bool is_still = deviations[i] == 0;
    if (is_still && (shift[i] != 0 || distribution.axes().row(i).norm() != 0)) return infinite;
    rows.row(i) = gaussian.axes().row(i) / (is_still ? 1 : deviations[i]);
    others.row(i) << shift[i], distribution.axes().row(i);
    others.row(i) /= is_still ? 1 : deviations[i];
  }
  // The rows are orthogonal, so that the left inverse needs no linear system.
  const Vector<double> squares = rows.colwise().squaredNorm();
  const Matrix<double> inside = squares.cwiseInverse().asDiagonal() * (rows.transpose() * others);
  const double outside = (others - rows * inside).norm();
  if (outside > 1e-6 * others.norm()) return infinite;
  const Matrix<double> spread = inside.rightCols(distribution.rank());
  const double between =
      0.5 * (spread.squaredNorm() + inside.col(0).squaredNorm() -
             static_cast<double>(gaussian.rank())) -
      std::log(std::abs(Eigen::PartialPivLU<Matrix<double>>(spread).determinant()));
  return not_negative(between) + distribution.negentropy();
}

double largest_error_of_probability(double divergence) {
  return std::min(1.0, std::sqrt(divergence / 2));
}

}  // namespace hamjet
