#pragma once

#include <cmath>
#include <cstddef>

#include "hamjet/detail/algebra/slice_product.hpp"

// Elementary functions of series, one homogeneous slice at a time. With E the Euler operator (E
// f)_d = d f_d, a function w = f(u) that satisfies a differential equation gives a recurrence for
// its slices (Knuth, The Art of Computer Programming 2, section 4.7; Griewank and Walther,
// Evaluating Derivatives, chapter 13). Each recurrence is split as
//
//     w_d = scale sum_d(u_1..u_(d-1), w_1..w_(d-1)) + f'(u_0) u_d ,
//
// because an implicit integrator knows the sum before it knows u_d. The functions below write sum_d
// into the degree-d slice of w (or of both results) and change nothing else. The scale depends on
// the constant terms alone; a comment states it beside each function. `scratch` holds one series.

namespace hamjet {

/// scratch_i = weight(i) u_i for 1 <= i <= d-1.
template <class T, class Weight>
void scale_slices(const SeriesSpace& space, int d, const T* u, T* scratch, Weight weight) {
  for (int i = 1; i < d; ++i) {
    const T factor(weight(i));
    for (std::size_t k = space.first(i); k < space.first(i + 1); ++k) scratch[k] = factor * u[k];
  }
}

/// The sum for w = u / v: from w v = u follows v_0 w_d = u_d - w_0 v_d - sum_(i=1)^(d-1) w_i
/// v_(d-i). For w = 1 / v the term u_d is absent.
template <class T>
void quotient_sum(const SeriesSpace& space, int d, const T* v, T* w) {
  interior_product(space, d, w, v, w);
}
template <class T>
T quotient_scale(const T& inverse_v0) {
  return -inverse_v0;
}

/// The sum for w = sqrt(u): from w^2 = u follows 2 w_0 w_d = u_d - sum_(i=1)^(d-1) w_i w_(d-i).
template <class T>
void square_root_sum(const SeriesSpace& space, int d, T* w) {
  interior_square(space, d, w, w);
}
template <class T>
T square_root_scale(const T& w0) {
  return T(-1) / (w0 + w0);
}

/// The sum for w = u^a: from u E w = a w E u follows u_0 w_d = a w_0 u_d + sum_(i=1)^(d-1) (a i -
/// (d - i))/d u_i w_(d-i).
template <class T, class Real>
void power_sum(const SeriesSpace& space, int d, const Real& exponent, const T* u, T* w,
               T* scratch) {
  scale_slices(space, d, u, scratch,
               [&](int i) { return Real((exponent * Real(i) - Real(d - i)) / Real(d)); });
  interior_product(space, d, scratch, w, w);
}
template <class T>
T power_scale(const T& u0) {
  return T(1) / u0;
}

/// The sum for w = exp(u), with scale 1: from E w = w E u follows w_d = w_0 u_d + sum_(i=1)^(d-1)
/// i/d u_i w_(d-i).
template <class Real, class T>
void exponential_sum(const SeriesSpace& space, int d, const T* u, T* w, T* scratch) {
  scale_slices(space, d, u, scratch, [&](int i) { return Real(Real(i) / Real(d)); });
  interior_product(space, d, scratch, w, w);
}

/// The sum for w = log(u): from u E w = E u follows u_0 w_d = u_d - sum_(i=1)^(d-1) i/d w_i
/// u_(d-i).
template <class Real, class T>
void logarithm_sum(const SeriesSpace& space, int d, const T* u, T* w, T* scratch) {
  scale_slices(space, d, w, scratch, [&](int i) { return Real(Real(i) / Real(d)); });
  interior_product(space, d, scratch, u, w);
}
template <class T>
T logarithm_scale(const T& u0) {
  return T(-1) / u0;
}

/// The sums for s = sin(u), with scale 1, and c = cos(u), with scale -1: from E s = c E u and E c =
/// -s E u follow s_d = c_0 u_d + sum_(i=1)^(d-1) i/d u_i c_(d-i) and c_d = -s_0 u_d - sum i/d u_i
/// s_(d-i).
template <class Real, class T>
void sine_cosine_sum(const SeriesSpace& space, int d, const T* u, T* s, T* c, T* scratch) {
  scale_slices(space, d, u, scratch, [&](int i) { return Real(Real(i) / Real(d)); });
  interior_product(space, d, scratch, c, s);
  interior_product(space, d, scratch, s, c);
}

/// The sums for s = sinh(u) and c = cosh(u), both with scale 1, are those of sine and cosine: from
/// E s = c E u and E c = s E u follow s_d = c_0 u_d + sum_(i=1)^(d-1) i/d u_i c_(d-i) and c_d = s_0
/// u_d + sum i/d u_i s_(d-i).

/// The sum for the angle w of a sine s and a cosine c, with scale 1: from s^2 + c^2 = 1 follows E w
/// = c E s - s E c, that is w_d = c_0 s_d - s_0 c_d + sum_(i=1)^(d-1) (2i - d)/d s_i c_(d-i).
template <class Real, class T>
void angle_sum(const SeriesSpace& space, int d, const T* s, const T* c, T* w, T* scratch) {
  scale_slices(space, d, s, scratch, [&](int i) { return Real(Real(2 * i - d) / Real(d)); });
  interior_product(space, d, scratch, c, w);
}

/// x^exponent: by multiplications and one square root where twice the exponent is a small integer
/// (as for every power that gravity needs), by the standard pow elsewhere.
template <class T, class Real>
T power(const T& x, const Real& exponent) {
  const double twice = 2 * static_cast<double>(exponent);
  if (std::abs(twice) > 40 || twice != std::floor(twice)) {
    using std::pow;
    return T(pow(x, exponent));
  }
  auto n = static_cast<unsigned>(std::abs(twice));
  T result(Real(1));
  if (n % 2 == 1) {
    using std::sqrt;
    result = T(sqrt(x));
  }
  for (unsigned i = 0; i < n / 2; ++i) result *= x;
  return twice < 0 ? T(T(Real(1)) / result) : result;
}

}  // namespace hamjet
