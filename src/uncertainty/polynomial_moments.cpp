#include "hamjet/uncertainty/polynomial_moments.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "../algebra/singular_values.hpp"
#include "hamjet/error.hpp"
#include "hermite_coefficients.hpp"
#include "turned_tensor.hpp"

namespace hamjet {
namespace {

/// Directions whose spread, in units of the components' standard deviations, is below this fraction
/// of the largest spread come from rounding of the polynomials' coefficients.
constexpr double resolved_spread = 1e-11;

/// F = D U S V^T with D the lengths of the rows: the axes D U S and the rotation V, without
/// directions that are rounding.
struct PrincipalAxes {
  Matrix<double> axes;
  Matrix<double> turn;  ///< V^T, r x columns of F
};

PrincipalAxes principal_axes(const Matrix<double>& factor) {
  const Eigen::Index m = factor.rows();
  const Vector<double> lengths = factor.rowwise().norm();
  Matrix<double> rows = factor;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (lengths[i] > 0) rows.row(i) /= lengths[i];
  }
  // A factor with more columns than rows is first rotated to a square one; a factor with fewer
  // columns is filled up with zeros.
  Matrix<double> basis;
  Matrix<double> square = Matrix<double>::Zero(m, m);
  if (factor.cols() > m) {
    const Eigen::HouseholderQR<Matrix<double>> qr(rows.transpose());
    basis = qr.householderQ() * Matrix<double>::Identity(factor.cols(), m);
    square = basis.transpose() * rows.transpose();
    square.transposeInPlace();
  } else {
    basis = Matrix<double>::Identity(factor.cols(), factor.cols());
    square.leftCols(factor.cols()) = rows;
  }
  const SingularValueDecomposition parts = decompose_by_singular_values(square);
  Eigen::Index rank = 0;
  while (rank < m && parts.values[rank] > resolved_spread * parts.values[0]) ++rank;
  PrincipalAxes result;
  result.axes =
      lengths.asDiagonal() * parts.left.leftCols(rank) * parts.values.head(rank).asDiagonal();
  result.turn = parts.right.topLeftCorner(basis.cols(), rank).transpose() * basis.transpose();
  return result;
}

std::size_t power(Eigen::Index base, int exponent) {
  std::size_t result = 1;
  for (int i = 0; i < exponent; ++i) result *= static_cast<std::size_t>(base);
  return result;
}

/// Third and fourth moments of the uncorrelated w, from the moments of products of two components.
struct Moments {
  std::vector<double> third;
  std::vector<double> fourth;
};

/// The cumulants of r = rank variables w. `pairs(i, j)` is the number of the product of w_i and
/// w_j, i <= j; `with_one` has the moments of these products with single variables, `with_pair`
/// those of two products.
Moments cumulants_of(Eigen::Index rank, const Matrix<double>& with_one,
                     const Matrix<double>& with_pair) {
  const auto pair = [&](Eigen::Index i, Eigen::Index j) {
    if (i > j) std::swap(i, j);
    return i * rank - i * (i - 1) / 2 + j - i;
  };
  Moments result{std::vector<double>(power(rank, 3)), std::vector<double>(power(rank, 4))};
  std::size_t place = 0;
  for (Eigen::Index i = 0; i < rank; ++i) {
    for (Eigen::Index j = 0; j < rank; ++j) {
      for (Eigen::Index k = 0; k < rank; ++k) {
        result.third[place++] = with_one(pair(i, j), k);
      }
    }
  }
  place = 0;
  const auto same = [](Eigen::Index a, Eigen::Index b) { return a == b ? 1.0 : 0.0; };
  for (Eigen::Index i = 0; i < rank; ++i) {
    for (Eigen::Index j = 0; j < rank; ++j) {
      for (Eigen::Index k = 0; k < rank; ++k) {
        for (Eigen::Index l = 0; l < rank; ++l) {
          result.fourth[place++] = with_pair(pair(i, j), pair(k, l)) - same(i, j) * same(k, l) -
                                   same(i, k) * same(j, l) - same(i, l) * same(j, k);
        }
      }
    }
  }
  return result;
}

}  // namespace

Cumulants Cumulants::turned(const Vector<double>& mean, const Matrix<double>& factor,
                            Matrix<double>& turn) {
  PrincipalAxes principal = principal_axes(factor);
  Cumulants result;
  result.mean_ = mean;
  result.axes_ = std::move(principal.axes);
  turn = std::move(principal.turn);
  result.third_.assign(power(result.rank(), 3), 0.0);
  result.fourth_.assign(power(result.rank(), 4), 0.0);
  return result;
}

void Cumulants::add_turned(const Cumulants& other, const Matrix<double>& turn) {
  const std::vector<double> third = turned_tensor(other.third_, turn, 3);
  const std::vector<double> fourth = turned_tensor(other.fourth_, turn, 4);
  for (std::size_t i = 0; i < third.size(); ++i) third_[i] += third[i];
  for (std::size_t i = 0; i < fourth.size(); ++i) fourth_[i] += fourth[i];
}

Cumulants::Cumulants(const Vector<double>& mean, const Covariance& covariance) {
  if (mean.size() != covariance.size()) {
    throw Error(ErrorKind::usage, "moments: mean and covariance are of different sizes");
  }
  Matrix<double> turn;
  *this = turned(mean, covariance.factor(), turn);
}

Cumulants Cumulants::of_polynomials(const std::vector<Series<double>>& map,
                                    std::optional<int> degree) {
  if (map.empty()) throw Error(ErrorKind::usage, "moments: no polynomials");
  const SeriesSpace& space = map.front().space();
  for (const auto& component : map) require_same_space(component.space(), space);
  const int order = std::min(degree.value_or(space.order()), space.order());
  const std::size_t variables = space.variables();
  const std::size_t terms = space.first(order + 1);
  const auto m = static_cast<Eigen::Index>(map.size());

  // The partial sums of the exponents of the map's own monomials, in their order.
  std::vector<std::uint8_t> sums(terms * variables);
  RowMatrix coefficients(static_cast<Eigen::Index>(terms), m);
  for (std::size_t k = 0; k < terms; ++k) {
    std::uint8_t sum = 0;
    for (std::size_t i = 0; i < variables; ++i) {
      sum = static_cast<std::uint8_t>(sum + space.exponents(k)[i]);
      sums[k * variables + i] = sum;
    }
    for (Eigen::Index c = 0; c < m; ++c) {
      coefficients(static_cast<Eigen::Index>(k), c) = map[static_cast<std::size_t>(c)][k];
    }
  }
  if (!coefficients.allFinite()) {
    throw Error(ErrorKind::numerical, "moments: a coefficient of the polynomials is not finite");
  }

  const MonomialPlaces places(variables, 2 * order);
  const Monomials monomials = all_monomials(places, variables, 2 * order);
  const auto count = static_cast<Eigen::Index>(places.count());
  const std::vector<std::uint8_t> zero(variables, 0);
  const auto place_of = [&](std::size_t k) {
    return static_cast<Eigen::Index>(places(&sums[k * variables], zero.data()));
  };

  // Coefficients of Hermite polynomials: the first is the mean, the others are a factor of the
  // covariance.
  const MonomialPlaces single_places(variables, order);
  const Monomials single = all_monomials(single_places, variables, order);
  RowMatrix hermite = RowMatrix::Zero(static_cast<Eigen::Index>(single_places.count()), m);
  for (std::size_t k = 0; k < terms; ++k) {
    hermite.row(place_of(k)) = coefficients.row(static_cast<Eigen::Index>(k));
  }
  to_hermite(single_places, single, order, hermite);
  const Vector<double> mean = hermite.row(0).transpose();
  hermite.row(0).setZero();
  Matrix<double> turn;
  Cumulants result = turned(mean, hermite.transpose(), turn);
  const Eigen::Index rank = result.rank();
  if (rank == 0) return result;

  // The uncorrelated variables as polynomials. `turn` has their Hermite coefficients; their
  // coefficients of monomials are linear combinations of those of y - mean.
  const Vector<double> deviations = result.standard_deviations();
  Matrix<double> scaled = result.axes_;
  for (Eigen::Index i = 0; i < m; ++i) {
    if (deviations[i] > 0) scaled.row(i) /= deviations[i];
  }
  const Matrix<double> back =
      (scaled.transpose() * scaled).diagonal().cwiseInverse().asDiagonal() * scaled.transpose();
  RowMatrix w = RowMatrix::Zero(static_cast<Eigen::Index>(terms), rank);
  {
    RowMatrix centred = coefficients;
    centred.row(0) -= mean.transpose();
    for (Eigen::Index i = 0; i < m; ++i) {
      if (deviations[i] > 0)
        centred.col(i) /= deviations[i];
      else
        centred.col(i).setZero();
    }
    w = centred * back.transpose();
  }

  const Eigen::Index pairs = rank * (rank + 1) / 2;
  RowMatrix products = RowMatrix::Zero(count, pairs);
  for (std::size_t a = 0; a < terms; ++a) {
    const double* const of_a = w.row(static_cast<Eigen::Index>(a)).data();
    for (std::size_t b = a; b < terms; ++b) {
      const double* const of_b = w.row(static_cast<Eigen::Index>(b)).data();
      const auto place =
          static_cast<Eigen::Index>(places(&sums[a * variables], &sums[b * variables]));
      double* product = products.row(place).data();
      const double share = a == b ? 0.5 : 1;
      for (Eigen::Index i = 0; i < rank; ++i) {
        for (Eigen::Index j = i; j < rank; ++j) {
          *product++ += share * (of_a[i] * of_b[j] + of_b[i] * of_a[j]);
        }
      }
    }
  }
  to_hermite(places, monomials, 2 * order, products);
  // The places of lower degrees come first and are the same in both lists.
  const Matrix<double> with_one = products.topRows(turn.cols()).transpose() * turn.transpose();
  const Matrix<double> with_pair = products.transpose() * products;
  Moments moments = cumulants_of(rank, with_one, with_pair);
  result.third_ = std::move(moments.third);
  result.fourth_ = std::move(moments.fourth);
  return result;
}

Cumulants Cumulants::of_sum(const Cumulants& first, const Cumulants& second) {
  if (first.size() != second.size()) {
    throw Error(ErrorKind::usage, "moments: the two vectors are of different sizes");
  }
  Matrix<double> factor(first.size(), first.rank() + second.rank());
  factor << first.axes_, second.axes_;
  Matrix<double> turn;
  Cumulants result = turned(first.mean_ + second.mean_, factor, turn);
  result.add_turned(first, turn.leftCols(first.rank()));
  result.add_turned(second, turn.rightCols(second.rank()));
  if (first.rank() == 0) result.gaussian_log_volume_ = second.gaussian_log_volume_;
  if (second.rank() == 0) result.gaussian_log_volume_ = first.gaussian_log_volume_;
  return result;
}

Cumulants Cumulants::of_points(const Matrix<double>& points, const Vector<double>& weights) {
  if (points.cols() != weights.size() || points.cols() == 0) {
    throw Error(ErrorKind::usage, "moments: a weight for each point is needed");
  }
  if (!points.allFinite()) throw Error(ErrorKind::numerical, "moments: a point is not finite");
  if (!((weights.array() > 0).all() && std::abs(weights.sum() - 1) < 1e-6)) {
    throw Error(ErrorKind::usage, "moments: weights must be above 0 and sum up to 1");
  }
  const Eigen::Index count = points.cols();
  const Vector<double> mean = points * weights;
  const Vector<double> roots = weights.cwiseSqrt();
  Matrix<double> w;
  Cumulants result = turned(mean, (points.colwise() - mean) * roots.asDiagonal(), w);
  w = w * roots.cwiseInverse().asDiagonal();
  const Eigen::Index rank = result.rank();
  const Eigen::Index pairs = rank * (rank + 1) / 2;
  Matrix<double> with_one = Matrix<double>::Zero(pairs, rank);
  Matrix<double> with_pair = Matrix<double>::Zero(pairs, pairs);
  // Of this many points at once sums of products are products of matrices.
  constexpr Eigen::Index most_at_once = 128;
  Matrix<double> products(pairs, std::min(count, most_at_once));
  Matrix<double> weighted(pairs, products.cols());
  for (Eigen::Index first = 0; first < count; first += most_at_once) {
    const Eigen::Index some = std::min(most_at_once, count - first);
    for (Eigen::Index k = 0; k < some; ++k) {
      const double* const z = w.col(first + k).data();
      double* product = products.col(k).data();
      for (Eigen::Index i = 0; i < rank; ++i) {
        for (Eigen::Index j = i; j < rank; ++j) *product++ = z[i] * z[j];
      }
    }
    const auto now = products.leftCols(some);
    weighted.leftCols(some) = now * weights.segment(first, some).asDiagonal();
    with_one.noalias() += weighted.leftCols(some) * w.middleCols(first, some).transpose();
    with_pair.noalias() += weighted.leftCols(some) * now.transpose();
  }
  Moments moments = cumulants_of(rank, with_one, with_pair);
  result.third_ = std::move(moments.third);
  result.fourth_ = std::move(moments.fourth);
  return result;
}

Cumulants Cumulants::mapped(const Matrix<double>& map) const {
  if (map.cols() != size()) {
    throw Error(ErrorKind::usage, "moments: the matrix must have a column for each component");
  }
  Matrix<double> turn;
  Cumulants result = turned(map * mean_, map * axes_, turn);
  result.add_turned(*this, turn);
  if (gaussian_log_volume_ && map.rows() == map.cols()) {
    const std::optional<double> before = log_volume(), after = result.log_volume();
    if (before && after) result.gaussian_log_volume_ = *gaussian_log_volume_ + *after - *before;
  }
  return result;
}

Matrix<double> Cumulants::covariance() const { return axes_ * axes_.transpose(); }

Vector<double> Cumulants::standard_deviations() const { return axes_.rowwise().norm(); }

Vector<double> Cumulants::skewness() const {
  const Vector<double> deviations = standard_deviations();
  Vector<double> result = Vector<double>::Zero(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (deviations[i] == 0) continue;
    const Matrix<double> direction = axes_.row(i) / deviations[i];
    result[i] = turned_tensor(third_, direction, 3)[0];
  }
  return result;
}

Vector<double> Cumulants::excess_kurtosis() const {
  const Vector<double> deviations = standard_deviations();
  Vector<double> result = Vector<double>::Zero(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (deviations[i] == 0) continue;
    const Matrix<double> direction = axes_.row(i) / deviations[i];
    result[i] = turned_tensor(fourth_, direction, 4)[0];
  }
  return result;
}

}  // namespace hamjet
