#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "double_double.hpp"

namespace hamjet::attack {

/// The power series of a quantity along a line of initial states z0 + s d, up to s^N: the attack
/// follows a flow's jet along lines, which takes N + 1 coefficients where the jet has C(N + 6, 6).
/// T is double or DoubleDouble.
template <class T, int N>
struct LineSeries {
  std::array<T, static_cast<std::size_t>(N) + 1> coefficients{};

  LineSeries() = default;
  explicit LineSeries(const T& constant) { (*this)[0] = constant; }

  T& operator[](int k) { return coefficients[static_cast<std::size_t>(k)]; }
  const T& operator[](int k) const { return coefficients[static_cast<std::size_t>(k)]; }

  LineSeries& operator+=(const LineSeries& b) {
    for (int k = 0; k <= N; ++k) (*this)[k] += b[k];
    return *this;
  }
  LineSeries& operator-=(const LineSeries& b) {
    for (int k = 0; k <= N; ++k) (*this)[k] -= b[k];
    return *this;
  }
  LineSeries& operator*=(const T& b) {
    for (int k = 0; k <= N; ++k) (*this)[k] *= b;
    return *this;
  }
};

template <class T, int N>
LineSeries<T, N> operator+(LineSeries<T, N> a, const LineSeries<T, N>& b) {
  return a += b;
}
template <class T, int N>
LineSeries<T, N> operator-(LineSeries<T, N> a, const LineSeries<T, N>& b) {
  return a -= b;
}
template <class T, int N>
LineSeries<T, N> operator*(const T& b, LineSeries<T, N> a) {
  return a *= b;
}

/// Cauchy's product.
template <class T, int N>
LineSeries<T, N> operator*(const LineSeries<T, N>& a, const LineSeries<T, N>& b) {
  LineSeries<T, N> c;
  for (int k = 0; k <= N; ++k) {
    T sum = a[0] * b[k];
    for (int j = 1; j <= k; ++j) sum += a[j] * b[k - j];
    c[k] = sum;
  }
  return c;
}

/// a^(exponent / 2) of a series with positive constant term, from a b' = (exponent / 2) a' b.
template <class T, int N>
LineSeries<T, N> half_power(const LineSeries<T, N>& a, int exponent) {
  using std::sqrt;
  LineSeries<T, N> b;
  const T root = sqrt(a[0]);
  b[0] = T(1);
  for (int i = 0; i < std::abs(exponent); ++i) b[0] = b[0] * root;
  if (exponent < 0) b[0] = T(1) / b[0];
  const T inverse = T(1) / a[0];
  for (int k = 1; k <= N; ++k) {
    T sum(0);
    for (int j = 1; j <= k; ++j) sum += T(0.5 * exponent * j - (k - j)) * a[j] * b[k - j];
    b[k] = sum * inverse / T(k);
  }
  return b;
}

}  // namespace hamjet::attack
