#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/slice_recurrences.hpp"

// Elementary functions of truncated power series by the recurrences of slice_recurrences.hpp. The
// constant term must lie where the function is analytic. Elsewhere (division by a series with
// constant term 0, logarithm of a negative constant term) the result holds values that are not
// finite, as in real arithmetic.

namespace hamjet {

namespace detail {

/// Completes w = f(u) degree by degree, given f(u_0), f'(u_0), and the scale and the sums of
/// slice_recurrences.hpp.
template <class T, class Sum>
Series<T> complete_function(const Series<T>& u, const T& value, const T& derivative, const T& scale,
                            Sum sum) {
  const SeriesSpace& space = u.space();
  Series<T> w(u.space_pointer(), value);
  for (int d = 1; d <= space.order(); ++d) {
    sum(d, w.coefficients().data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      w[k] = scale * w[k] + derivative * u[k];
    }
  }
  return w;
}

}  // namespace detail

template <class T>
Series<T> operator/(const Series<T>& u, const Series<T>& v) {
  require_same_space(u.space(), v.space());
  const SeriesSpace& space = u.space();
  Series<T> w(u.space_pointer(), T(u[0] / v[0]));
  for (int d = 1; d <= space.order(); ++d) {
    quotient_sum(space, d, v.coefficients().data(), w.coefficients().data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      w[k] = (u[k] - w[0] * v[k] - w[k]) / v[0];
    }
  }
  return w;
}

template <class T>
Series<T> operator/(const std::type_identity_t<T>& a, const Series<T>& u) {
  const T value = T(1) / u[0];
  return a * detail::complete_function(
                 u, value, T(-value * value), quotient_scale(value),
                 [&](int d, T* w) { quotient_sum(u.space(), d, u.coefficients().data(), w); });
}

template <class T>
Series<T> sqrt(const Series<T>& u) {
  using std::sqrt;
  const T value(sqrt(u[0]));
  return detail::complete_function(u, value, T(T(1) / (T(2) * value)), square_root_scale(value),
                                   [&](int d, T* w) { square_root_sum(u.space(), d, w); });
}

/// u^exponent for any real exponent; the constant term must not be zero (nor negative unless the
/// exponent is an integer). Non-negative integer powers of a series without constant term are
/// products: use square and *.
template <class T, class Real>
Series<T> pow(const Series<T>& u, const Real& exponent) {
  const T value = power(u[0], exponent);
  std::vector<T> scratch(u.size(), T(0));
  return detail::complete_function(
      u, value, T(T(exponent) * value / u[0]), power_scale(u[0]), [&](int d, T* w) {
        power_sum(u.space(), d, exponent, u.coefficients().data(), w, scratch.data());
      });
}

template <class T>
Series<T> exp(const Series<T>& u) {
  using std::exp;
  const T value(exp(u[0]));
  std::vector<T> scratch(u.size(), T(0));
  return detail::complete_function(u, value, value, T(1), [&](int d, T* w) {
    exponential_sum<T>(u.space(), d, u.coefficients().data(), w, scratch.data());
  });
}

template <class T>
Series<T> log(const Series<T>& u) {
  using std::log;
  std::vector<T> scratch(u.size(), T(0));
  return detail::complete_function(
      u, T(log(u[0])), T(T(1) / u[0]), logarithm_scale(u[0]), [&](int d, T* w) {
        logarithm_sum<T>(u.space(), d, u.coefficients().data(), w, scratch.data());
      });
}

/// Sine and cosine together, because the recurrence of each needs the other.
template <class T>
std::pair<Series<T>, Series<T>> sin_cos(const Series<T>& u) {
  using std::cos;
  using std::sin;
  const SeriesSpace& space = u.space();
  Series<T> s(u.space_pointer(), T(sin(u[0])));
  Series<T> c(u.space_pointer(), T(cos(u[0])));
  std::vector<T> scratch(u.size(), T(0));
  for (int d = 1; d <= space.order(); ++d) {
    sine_cosine_sum<T>(space, d, u.coefficients().data(), s.coefficients().data(),
                       c.coefficients().data(), scratch.data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      s[k] += c[0] * u[k];
      c[k] = -(c[k] + s[0] * u[k]);
    }
  }
  return {std::move(s), std::move(c)};
}

template <class T>
Series<T> sin(const Series<T>& u) {
  return sin_cos(u).first;
}
template <class T>
Series<T> cos(const Series<T>& u) {
  return sin_cos(u).second;
}

/// The angle of the point (x, y) from the x axis, its constant term in (-pi, pi]. With E f the sum
/// of d f_d over the degrees d, which is a derivation,
///
///   E angle = (x E y - y E x) / (x^2 + y^2) .
template <class T>
Series<T> atan2(const Series<T>& y, const Series<T>& x) {
  using std::atan2;
  const SeriesSpace& space = x.space();
  const auto by_degree = [&](const Series<T>& u) {
    Series<T> result = u;
    for (std::size_t k = 0; k < space.size(); ++k) result[k] *= T(space.degree(k));
    return result;
  };
  Series<T> angle = (x * by_degree(y) - y * by_degree(x)) / (square(x) + square(y));
  for (std::size_t k = 1; k < space.size(); ++k) angle[k] /= T(space.degree(k));
  angle[0] = T(atan2(y[0], x[0]));
  return angle;
}

}  // namespace hamjet
