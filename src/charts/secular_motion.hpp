#pragma once

#include <cmath>

#include "hamjet/algebra/elementary_functions.hpp"

namespace hamjet {

/// The mean motion of an ellipse about an oblate body: its angles' steady advance to first order in
/// J2, by closed formulas. The rest of the motion is small and hardly nonlinear, so that
/// polynomials reach far once the mean motion is taken out of them. The mean motion is put back
/// exactly, so that its own error of order J2^2 costs nothing. With a = L^2/mu, eta = G/L, c = H/G,
/// p = G^2/mu,
///
///   f = 3/4 J2 R^2 n / p^2 ,                     K = mu J2 R^2 (1 - 3 c^2) / (4 a^3 eta^3) ,
///   l' = n + f eta (3 c^2 - 1) ,  g' = f (5 c^2 - 1) ,  h' = -2 f c ,
///
/// and L of the mean ellipse from the energy, E = -mu^2/(2 L^2) + K. Source: D. Brouwer, "Solution
/// of the problem of artificial satellite theory without drag", Astronomical Journal 64 (1959) 378.
template <class T>
struct SecularRates {
  T anomaly;     ///< l'
  T pericentre;  ///< g'
  T node;        ///< h'
};

/// The rates for an energy and the momenta L - G and H; `oblateness` is J2 R^2.
template <class Real, class T>
SecularRates<T> secular_rates(const T& energy, const T& eccentric, const T& H, const Real& mu,
                              const Real& oblateness) {
  using std::sqrt;
  T L = mu / sqrt(T(Real(-2) * energy));
  if (oblateness == Real(0)) {
    const T n = mu * mu / (L * L * L);
    return {n, n * Real(0), n * Real(0)};
  }
  T G = L - eccentric;
  T cosine = H / G;
  // K is of the order of J2, so that two iterations leave an error of order J2^3.
  for (int i = 0; i < 2; ++i) {
    const T K = oblateness * mu * mu * mu * mu / Real(4) * (Real(1) - Real(3) * cosine * cosine) /
                (L * L * L * G * G * G);
    L = mu / sqrt(T(Real(-2) * (energy - K)));
    G = L - eccentric;
    cosine = H / G;
  }
  const T n = mu * mu / (L * L * L);
  const T f = Real(0.75) * oblateness * mu * mu * n / (G * G * G * G);
  const T square = cosine * cosine;
  return {n + f * (G / L) * (Real(3) * square - Real(1)), f * (Real(5) * square - Real(1)),
          Real(-2) * f * cosine};
}

}  // namespace hamjet
