#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "hamjet/algebra/elementary_functions.hpp"

namespace hamjet {

/// The constant term of a series, or a number itself.
template <class Real>
const Real& constant_of(const Real& number) {
  return number;
}
template <class Real>
const Real& constant_of(const Series<Real>& series) {
  return series[0];
}

/// Sine and cosine of a number or a series.
template <class T>
struct SineAndCosine {
  T sine;
  T cosine;
};
template <class Real>
SineAndCosine<Real> sine_and_cosine(const Real& angle) {
  using std::cos;
  using std::sin;
  return {sin(angle), cos(angle)};
}
template <class Real>
SineAndCosine<Series<Real>> sine_and_cosine(const Series<Real>& angle) {
  auto [sine, cosine] = sin_cos(angle);
  return {std::move(sine), std::move(cosine)};
}

/// The root F of Kepler's equation, with its sine and cosine.
template <class Real>
struct EccentricLongitude {
  Real angle;
  Real sine;
  Real cosine;
};

/// The root F of Kepler's equation in elements that are regular on a circle,
///
///   F - k sin F + h cos F = lambda ,   k^2 + h^2 < 1 ,
///
/// by Newton's method inside the bracket lambda - e, lambda + e. The root is NaN if it is not
/// found.
template <class Real>
EccentricLongitude<Real> eccentric_longitude(const Real& lambda, const Real& k, const Real& h) {
  using std::sqrt;
  constexpr int most_iterations = 200;
  const Real e = sqrt(Real(k * k + h * h));
  Real low = lambda - e;
  Real high = lambda + e;
  // The first guess is the series in e to the third power, with M = lambda - w; it is made of
  // products of e sin M and e cos M.
  const auto [sine_start, cosine_start] = sine_and_cosine(lambda);
  const Real across = k * sine_start - h * cosine_start;
  const Real along = k * cosine_start + h * sine_start;
  Real f = lambda + across * (Real(1) + along + along * along - across * across / Real(2));
  if (!(f >= low && f <= high)) f = lambda + across;
  for (int i = 0; i < most_iterations; ++i) {
    const auto [s, c] = sine_and_cosine(f);
    const Real excess = f - k * s + h * c - lambda;
    (excess > 0 ? high : low) = f;
    Real next = f - excess / (Real(1) - k * c - h * s);
    if (!(next >= low && next <= high)) next = (low + high) / Real(2);
    const Real change = next - f;
    f = next;
    // Newton's method doubles the number of right digits: after a change this small none is left to
    // be found, and the square of the change no longer alters a sine. The comparison is written so
    // that it also ends the loop for NaN.
    if (!(change * change > std::numeric_limits<Real>::epsilon() / Real(1024))) {
      return {f, s + c * change, c - s * change};
    }
  }
  const Real none = std::numeric_limits<Real>::quiet_NaN();
  return {none, none, none};
}

/// For series: Newton's method, started from the constant terms, doubles the number of right
/// degrees.
template <class Real>
EccentricLongitude<Series<Real>> eccentric_longitude(const Series<Real>& lambda,
                                                     const Series<Real>& k, const Series<Real>& h) {
  Series<Real> f(lambda.space_pointer(), eccentric_longitude(lambda[0], k[0], h[0]).angle);
  auto [s, c] = sine_and_cosine(f);
  for (int right = 0; right < lambda.order(); right = 2 * right + 1) {
    f -= (f - k * s + h * c - lambda) / (Real(1) - k * c - h * s);
    std::tie(s, c) = sin_cos(f);
  }
  return {std::move(f), std::move(s), std::move(c)};
}

/// An ellipse in its plane by elements that are regular on a circle; mu is the gravitational
/// parameter, k = e cos w and h = e sin w, where w is the angle of the pericentre from the x axis.
template <class T>
struct PlaneElements {
  T lambda;  ///< mean longitude, w + M
  T L;       ///< sqrt(mu a)
  T k;
  T h;
};

/// Position (X, Y) and velocity in the plane.
template <class T>
struct PlaneState {
  T x;
  T y;
  T x_velocity;
  T y_velocity;
};

/// Source: Broucke and Cefola, with beta = 1 / (1 + sqrt(1 - h^2 - k^2)),
///
///   X = a [(1 - h^2 beta) cos F + h k beta sin F - k] ,
///   Y = a [(1 - k^2 beta) sin F + h k beta cos F - h] ,   r = a (1 - k cos F - h sin F) .
template <class Real, class T>
PlaneState<T> plane_state(const PlaneElements<T>& elements, const Real& mu) {
  using std::sqrt;
  const auto& [lambda, L, k, h] = elements;
  const auto [angle, s, c] = eccentric_longitude(lambda, k, h);
  const T beta = Real(1) / (Real(1) + sqrt(T(Real(1) - k * k - h * h)));
  const T hh = Real(1) - h * h * beta;
  const T kk = Real(1) - k * k * beta;
  const T hk = h * k * beta;
  const T a = L * L / mu;
  const T rate = L / (Real(1) - k * c - h * s) / a;  // sqrt(mu a) / r
  return {a * (hh * c + hk * s - k), a * (kk * s + hk * c - h), rate * (hk * c - hh * s),
          rate * (kk * c - hk * s)};
}

/// The elements that belong to position and velocity in the plane. They are not finite if the orbit
/// is not an ellipse.
template <class Real, class T>
PlaneElements<T> plane_elements(const PlaneState<T>& state, const Real& mu) {
  using std::atan2;
  using std::sqrt;
  const auto& [x, y, u, v] = state;
  const T r = sqrt(T(x * x + y * y));
  const T momentum = x * v - y * u;
  const T k = v * momentum / mu - x / r;
  const T h = -(u * momentum) / mu - y / r;
  const T a = Real(1) / (Real(2) / r - (u * u + v * v) / mu);
  const T eta = sqrt(T(Real(1) - h * h - k * k));
  const T beta = Real(1) / (Real(1) + eta);
  const T hk = h * k * beta;
  const T unit = Real(1) / (a * eta);
  const T cosine = k + ((Real(1) - k * k * beta) * x - hk * y) * unit;
  const T sine = h + ((Real(1) - h * h * beta) * y - hk * x) * unit;
  return {atan2(sine, cosine) - k * sine + h * cosine, sqrt(T(mu * a)), k, h};
}

}  // namespace hamjet
