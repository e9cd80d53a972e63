#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"
#include "support/magnitude.hpp"

namespace hamjet::test {

/// Half a unit in the last place of 1.
template <class Real>
constexpr double rounding_of() {
  if constexpr (std::is_same_v<Real, double>) {
    return 0x1p-53;
  } else {
    return std::is_same_v<Real, DoubleDouble> ? 0x1p-106 : 0x1p-113;
  }
}

/// The coefficients of a field at one point.
template <class Real>
std::vector<Real> expanded(const LocalField& field, const std::array<Real, 3>& r, int degree) {
  std::vector<Real> result(local_field_size(degree));
  field.expand(1, &r[0], &r[1], &r[2], degree, result.data());
  return result;
}

/// The largest error of the coefficients of one degree, in roundings of the largest of them.
template <class Real>
double roundings(const std::vector<Real>& c, const std::vector<Extended>& expected, int degree) {
  double error = 0;
  double size = 0;
  const std::size_t first = degree == 0 ? 0 : local_field_size(degree - 1);
  for (std::size_t k = first; k < local_field_size(degree); ++k) {
    error = larger(error, magnitude_of(Extended(Extended(c[k]) - expected[k])));
    size = larger(size, magnitude_of(expected[k]));
  }
  return error / size / rounding_of<Real>();
}

/// The value of a polynomial of three variables in the order of LocalField.
template <class Real>
Real polynomial_value(const std::vector<Real>& c, const std::array<Real, 3>& d, int degree) {
  Real sum = 0;
  std::size_t k = 0;
  for (int n = 0; n <= degree; ++n) {
    for (int i = n; i >= 0; --i) {
      for (int j = n - i; j >= 0; --j) {
        Real term = c[k++];
        for (int a = 0; a < i; ++a) term *= d[0];
        for (int a = 0; a < j; ++a) term *= d[1];
        for (int a = 0; a < n - i - j; ++a) term *= d[2];
        sum += term;
      }
    }
  }
  return sum;
}

}  // namespace hamjet::test
