#include "hamjet/uncertainty/covariance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "../algebra/symmetric_eigenvalues.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr int fewest_digits = 4;
constexpr int most_digits = 15;

/// The number of decimal digits that are needed to read a number back.
int digits_of(double number) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(number),
                                 std::chars_format::scientific);
  const std::string_view written(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
  const auto mantissa = written.substr(0, written.find('e'));
  return static_cast<int>(mantissa.size() - (mantissa.find('.') != mantissa.npos ? 1 : 0));
}

/// The relative error by which the matrix's numbers may be rounded.
double rounding_of_digits(const Matrix<double>& matrix) {
  int digits = fewest_digits;
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    digits = std::max(digits, digits_of(matrix.data()[i]));
  }
  return 5 * std::pow(10.0, -std::min(digits, most_digits));
}

std::string name_of_component(const std::array<std::string_view, 6>& names, Eigen::Index index) {
  const auto place = static_cast<std::size_t>(index);
  return place < names.size() ? std::string(names[place]) : fmt::format("number {}", index + 1);
}

struct Spectrum {
  Vector<double> deviations;  ///< standard deviations
  Vector<double> values;      ///< eigenvalues of the correlations, ascending
  Matrix<double> vectors;
  double allowance = 0;  ///< an eigenvalue down to minus this is rounding
};

/// The eigenvalues of the correlations. A component without variance has no correlations, and its
/// eigenvalue is zero.
Spectrum spectrum_of(const Matrix<double>& matrix) {
  const Eigen::Index n = matrix.rows();
  Spectrum result;
  result.deviations = matrix.diagonal().array().max(0).sqrt();
  Matrix<double> correlations = Matrix<double>::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (result.deviations[i] == 0 || result.deviations[j] == 0) continue;
      correlations(i, j) = (matrix(i, j) / result.deviations[i] / result.deviations[j] +
                            matrix(j, i) / result.deviations[j] / result.deviations[i]) /
                           2;
    }
  }
  const auto solver = symmetric_eigenvalues("covariance", correlations);
  result.values = solver.eigenvalues();
  result.vectors = solver.eigenvectors();
  result.allowance = 2 * static_cast<double>(n) * rounding_of_digits(matrix);
  return result;
}

/// A direction in words, with each component in units of its standard deviation. Components below a
/// tenth of the largest are left out.
std::string direction_text(const Vector<double>& direction,
                           const std::array<std::string_view, 6>& names) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(direction.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(direction[a]) > std::abs(direction[b]);
  });
  const double sign = direction[order.front()] < 0 ? -1 : 1;
  std::string text;
  for (const Eigen::Index i : order) {
    const double share = sign * direction[i];
    if (std::abs(share) < 0.1 * std::abs(direction[order.front()])) break;
    text += text.empty() ? fmt::format("{:.2f} {}", share, name_of_component(names, i))
                         : fmt::format(" {} {:.2f} {}", share < 0 ? "-" : "+", std::abs(share),
                                       name_of_component(names, i));
  }
  return text;
}

}  // namespace

std::array<std::string_view, 6> component_names(RelativeFrame frame) {
  if (is_along_coordinates(frame)) return {"x", "y", "z", "vx", "vy", "vz"};
  return {"R", "T", "N", "vR", "vT", "vN"};
}

std::optional<std::string> Covariance::fault_of(const Matrix<double>& matrix,
                                                const std::array<std::string_view, 6>& names) {
  const Eigen::Index n = matrix.rows();
  if (n == 0 || matrix.cols() != n) {
    return fmt::format("not square, got {} rows of {}, must have as many rows as columns", n,
                       matrix.cols());
  }
  const auto name = [&](Eigen::Index i) { return name_of_component(names, i); };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (std::isfinite(matrix(i, j))) continue;
      return fmt::format("not finite, got {} for {} with {}, must be a finite number", matrix(i, j),
                         name(i), name(j));
    }
    if (matrix(i, i) < 0) {
      return fmt::format("no covariance, got the variance {:.6g} of {}, must not be below 0",
                         matrix(i, i), name(i));
    }
  }
  const double rounding = rounding_of_digits(matrix);
  const Vector<double> deviations = matrix.diagonal().array().sqrt();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double below = matrix(i, j);
      const double above = matrix(j, i);
      const double spread = deviations[i] * deviations[j];
      // Each of the two numbers is rounded to its digits, or, if a sum made it, to the rounding of
      // the terms of that sum.
      const double allowed =
          rounding * (std::abs(below) + std::abs(above)) +
          4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * spread;
      if (std::abs(below - above) > allowed) {
        return fmt::format(
            "not symmetric, got {:.10g} for {} with {} and {:.10g} for {} with {}, "
            "must be the same number twice",
            below, name(i), name(j), above, name(j), name(i));
      }
      if (spread == 0 && (below != 0 || above != 0)) {
        const Eigen::Index still = deviations[i] == 0 ? i : j;
        return fmt::format(
            "no covariance, got {:.6g} for {} with {} though the variance of {} is "
            "0, must be 0",
            below, name(i), name(j), name(still));
      }
    }
  }
  const Spectrum spectrum = spectrum_of(matrix);
  if (spectrum.values[0] < -spectrum.allowance) {
    return fmt::format(
        "not positive semidefinite, got the eigenvalue {:.3g} of the correlations along {} (each "
        "in its standard deviation), must not be below 0 by more than the {:.1g} of its digits' "
        "rounding",
        spectrum.values[0], direction_text(spectrum.vectors.col(0), names), spectrum.allowance);
  }
  return std::nullopt;
}

Covariance::Covariance(const Matrix<double>& matrix, const std::array<std::string_view, 6>& names) {
  if (const auto fault = fault_of(matrix, names)) {
    throw Error(ErrorKind::usage, "covariance: " + *fault);
  }
  const Spectrum spectrum = spectrum_of(matrix);
  const Eigen::Index n = matrix.rows();
  // The rounding of the decomposition itself: eigenvalues are right to n units of rounding of the
  // largest.
  const double least = static_cast<double>(n) * std::numeric_limits<double>::epsilon() *
                       std::max(spectrum.values[n - 1], 0.0);
  Eigen::Index rank = 0;
  while (rank < n && spectrum.values[n - 1 - rank] > least) ++rank;
  factor_.resize(n, rank);
  for (Eigen::Index k = 0; k < rank; ++k) {
    factor_.col(k) = std::sqrt(spectrum.values[n - 1 - k]) *
                     spectrum.deviations.cwiseProduct(spectrum.vectors.col(n - 1 - k));
  }
  if (spectrum.values[0] < -least) taken_as_zero_ = -spectrum.values[0];
}

Matrix<double> Covariance::matrix() const { return factor_ * factor_.transpose(); }

Vector<double> Covariance::standard_deviations() const { return factor_.rowwise().norm(); }

Covariance Covariance::mapped(const Matrix<double>& map) const { return of_factor(map * factor_); }

Covariance Covariance::of_factor(Matrix<double> factor) {
  if (!factor.allFinite()) {
    throw Error(ErrorKind::numerical, "covariance: its factor is not finite");
  }
  Covariance result;
  result.factor_ = std::move(factor);
  return result;
}

Covariance Covariance::of_standard_deviations(const Vector<double>& deviations) {
  Matrix<double> factor =
      Matrix<double>::Zero(deviations.size(), (deviations.array() != 0).count());
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < deviations.size(); ++i) {
    if (!(deviations[i] >= 0) || !std::isfinite(deviations[i])) {
      throw Error(ErrorKind::usage,
                  fmt::format("covariance: out of range, got the standard deviation {}, must be a "
                              "finite number that is not below 0",
                              deviations[i]));
    }
    if (deviations[i] != 0) factor(i, column++) = deviations[i];
  }
  return of_factor(std::move(factor));
}

Covariance Covariance::plus(const Covariance& other) const {
  if (other.size() != size()) {
    throw Error(ErrorKind::usage, "covariance: a sum of two of different sizes");
  }
  Matrix<double> factor(size(), rank() + other.rank());
  factor << factor_, other.factor_;
  return of_factor(std::move(factor));
}

Covariance Covariance::of_independent(const Covariance& first, const Covariance& second) {
  Matrix<double> factor =
      Matrix<double>::Zero(first.size() + second.size(), first.rank() + second.rank());
  factor.topLeftCorner(first.size(), first.rank()) = first.factor_;
  factor.bottomRightCorner(second.size(), second.rank()) = second.factor_;
  Covariance result = of_factor(std::move(factor));
  result.taken_as_zero_ = std::max(first.taken_as_zero_, second.taken_as_zero_);
  return result;
}

Matrix<double> deviations_of_relative_states(const ChiefFrame& frame) {
  Matrix<double> map(6, 6);
  for (Eigen::Index j = 0; j < 6; ++j) {
    RelativeState unit;
    (j < 3 ? unit.position_m[j] : unit.velocity_m_s[j - 3]) = 1;
    const std::vector<double> deviation = frame.deviation(unit);
    map.col(j) = Eigen::Map<const Vector<double>>(deviation.data(), 6);
  }
  return map;
}

Matrix<double> relative_states_of_deviations(const ChiefFrame& frame) {
  Matrix<double> map(6, 6);
  for (Eigen::Index j = 0; j < 6; ++j) {
    std::array<double, 6> unit{};
    unit[static_cast<std::size_t>(j)] = 1;
    const RelativeState state = frame.relative(unit);
    map.col(j) << state.position_m, state.velocity_m_s;
  }
  return map;
}

}  // namespace hamjet
