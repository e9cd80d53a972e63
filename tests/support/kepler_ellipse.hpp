#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "hamjet/algebra/elementary_functions.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet::test {

namespace kepler_ellipse {

inline double leading(const Extended& x) { return static_cast<double>(x); }
inline double leading(const Series<Extended>& x) { return static_cast<double>(x[0]); }

inline std::pair<Extended, Extended> sine_cosine(const Extended& x) { return {sin(x), cos(x)}; }
inline std::pair<Series<Extended>, Series<Extended>> sine_cosine(const Series<Extended>& x) {
  return sin_cos(x);
}

template <class T>
T one_minus(const T& x) {
  return x * Extended(-1) + Extended(1);
}

/// The root x of x - c sin x + s (1 - cos x) = mean, Kepler's equation for the change of the
/// eccentric anomaly: by bisection, and then by Newton's method, each step of which doubles the
/// digits and the degrees of a series.
template <class T>
T change_of_anomaly(const T& c, const T& s, const T& mean, int steps) {
  const double c0 = leading(c), s0 = leading(s), mean0 = leading(mean);
  double low = mean0 - 2, high = mean0 + 2;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (x - c0 * std::sin(x) + s0 * (1 - std::cos(x)) < mean0 ? low : high) = x;
  }
  T x = mean * Extended(0) + Extended(0.5 * (low + high));
  for (int i = 0; i < steps; ++i) {
    const auto [sine, cosine] = sine_cosine(x);
    const T residual = x - c * sine + s * one_minus(cosine) - mean;
    x = x - residual / (one_minus(c * cosine) + s * sine);
  }
  return x;
}

}  // namespace kepler_ellipse

/// A state (q, p) of Kepler's problem with mu = 1 on an ellipse, after a time, by Lagrange's f and
/// g in the change of the eccentric anomaly; of numbers, or of series about them. A closed form: it
/// shares nothing with integrators. Source: R. H. Battin, An Introduction to the Mathematics and
/// Methods of Astrodynamics, section 4.3.
template <class T>
std::array<T, 6> along_ellipse(const std::array<T, 6>& z, const Extended& time, int steps = 7) {
  using kepler_ellipse::one_minus;
  using std::sqrt;
  const auto dot = [&](std::size_t a, std::size_t b) {
    return T(z[a] * z[b] + z[a + 1] * z[b + 1] + z[a + 2] * z[b + 2]);
  };
  const T radius = sqrt(dot(0, 0));
  const T inverse_axis = dot(0, 0) * Extended(0) + Extended(2) / radius - dot(3, 3);
  const T root = sqrt(inverse_axis);  // a^(-1/2)
  const T c = one_minus(T(radius * inverse_axis));
  const T s = dot(0, 3) * root;
  const T mean = root * inverse_axis * time;
  const T x = kepler_ellipse::change_of_anomaly(c, s, mean, steps);
  const auto [sine, cosine] = kepler_ellipse::sine_cosine(x);
  const T versine = one_minus(cosine);
  const T end_radius = (one_minus(T(c * cosine)) + s * sine) / inverse_axis;
  const T f = one_minus(T(versine / (inverse_axis * radius)));
  const T g = (x - sine) / (root * inverse_axis) * Extended(-1) + time;
  const T f_slope = sine / (root * end_radius * radius) * Extended(-1);
  const T g_slope = one_minus(T(versine / (inverse_axis * end_radius)));
  return {f * z[0] + g * z[3],
          f * z[1] + g * z[4],
          f * z[2] + g * z[5],
          f_slope * z[0] + g_slope * z[3],
          f_slope * z[1] + g_slope * z[4],
          f_slope * z[2] + g_slope * z[5]};
}

}  // namespace hamjet::test
