#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hamjet/detail/algebra/matrix.hpp"

// Polynomials of independent standard normal variables, written in Hermite polynomials, which are
// orthogonal under the normal distribution.

namespace hamjet {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The place of each monomial of degree 0..M in v variables, computed from partial sums of
/// exponents, which add up in products. With s_i = a_1 + ... + a_i the place is the sum over i of
/// C(s_i + i - 1, i), which numbers all exponent vectors without gaps (the combinatorial number
/// system).
class MonomialPlaces {
 public:
  MonomialPlaces(std::size_t variables, int most)
      : table_(variables, std::vector<std::size_t>(static_cast<std::size_t>(most) + 2)) {
    for (std::size_t i = 0; i < variables; ++i) {
      // C(s + i, i + 1) = C(s - 1 + i, i + 1) + C(s - 1 + i, i)
      for (std::size_t s = 1; s < table_[i].size(); ++s) {
        table_[i][s] = table_[i][s - 1] + (i == 0 ? 1 : table_[i - 1][s]);
      }
    }
  }

  std::size_t count() const { return table_.back().back(); }

  /// The place of the product of two monomials with these partial sums.
  std::size_t operator()(const std::uint8_t* a, const std::uint8_t* b) const {
    std::size_t place = 0;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      place += table_[i][static_cast<std::size_t>(a[i]) + b[i]];
    }
    return place;
  }

 private:
  std::vector<std::vector<std::size_t>> table_;
};

/// The exponents of all monomials and their partial sums, in the order of the places.
struct Monomials {
  std::size_t variables = 0;
  std::vector<std::uint8_t> sums;

  const std::uint8_t* of(std::size_t place) const { return &sums[place * variables]; }
  int exponent(std::size_t place, std::size_t i) const {
    const std::uint8_t* s = of(place);
    return s[i] - (i == 0 ? 0 : s[i - 1]);
  }
};

/// All monomials up to degree M; the last partial sum, which is the degree, grows slowest.
inline Monomials all_monomials(const MonomialPlaces& places, std::size_t variables, int most) {
  Monomials result{variables, std::vector<std::uint8_t>(places.count() * variables)};
  std::vector<std::uint8_t> sums(variables, 0);
  const std::vector<std::uint8_t> zero(variables, 0);
  while (true) {
    std::copy(sums.begin(), sums.end(),
              result.sums.begin() +
                  static_cast<std::ptrdiff_t>(places(sums.data(), zero.data()) * variables));
    // The next nondecreasing sequence of partial sums.
    std::size_t i = 0;
    while (i + 1 < variables && sums[i] == sums[i + 1]) ++i;
    if (i + 1 == variables && sums[i] == most) return result;
    ++sums[i];
    std::fill(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(i), std::uint8_t{0});
  }
}

/// Converts columns of coefficients of monomials (rows by place) into coefficients of the
/// orthonormal polynomials He_a / sqrt(a!), one variable after the other:
///
///   x^n = sum over k of n! / (2^k k! (n - 2k)!) He_(n-2k) .
inline void to_hermite(const MonomialPlaces& places, const Monomials& monomials, int most,
                       RowMatrix& columns) {
  const auto degrees = static_cast<std::size_t>(most) + 1;
  std::vector<std::vector<double>> parts(degrees);
  for (std::size_t n = 0; n < degrees; ++n) {
    double part = 1;
    for (std::size_t k = 0; 2 * k <= n; ++k) {
      parts[n].push_back(part);
      const auto left = static_cast<double>(n - 2 * k);
      part *= left * (left - 1) / (2.0 * static_cast<double>(k + 1));
    }
  }
  const std::size_t count = monomials.sums.size() / monomials.variables;
  std::vector<std::uint8_t> raised(monomials.variables);
  const std::vector<std::uint8_t> zero(monomials.variables, 0);
  for (std::size_t i = 0; i < monomials.variables; ++i) {
    // Places grow with every exponent, so that a place to which something is added is always
    // converted later.
    for (std::size_t place = 0; place < count; ++place) {
      const std::uint8_t* sums = monomials.of(place);
      const auto n = static_cast<std::size_t>(monomials.exponent(place, i));
      const int left = most - sums[monomials.variables - 1];
      for (std::size_t k = 1; 2 * k <= static_cast<std::size_t>(left); ++k) {
        std::copy_n(sums, monomials.variables, raised.begin());
        for (std::size_t j = i; j < monomials.variables; ++j) {
          raised[j] = static_cast<std::uint8_t>(raised[j] + 2 * k);
        }
        const auto from = static_cast<Eigen::Index>(places(raised.data(), zero.data()));
        columns.row(static_cast<Eigen::Index>(place)) += parts[n + 2 * k][k] * columns.row(from);
      }
    }
  }
  for (std::size_t place = 0; place < count; ++place) {
    double factorial = 1;
    for (std::size_t i = 0; i < monomials.variables; ++i) {
      for (int n = 2; n <= monomials.exponent(place, i); ++n) factorial *= n;
    }
    columns.row(static_cast<Eigen::Index>(place)) *= std::sqrt(factorial);
  }
}

}  // namespace hamjet
