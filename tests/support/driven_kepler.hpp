#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"

// An orbit whose forces depend on the time, and its flights by a program of their own.

namespace hamjet::test {

/// Kepler's problem with a uniform force and a tide that turn with the time:
///
///   H = |p|^2/2 - 1/|q| - f.q - b (cos c (q_1^2 - q_2^2)/2 + sin c q_1 q_2) ,
///   f = a (cos c, sin c, cos(2 c + 1)/2) ,   c = w t .
///
/// At no two times of a few revolutions are its forces the same, so that a flight from a wrong time
/// ends elsewhere by about a times the square of its duration, and so do its neighbours.
struct DrivenKepler {
  static constexpr double a = 2e-3;
  static constexpr double b = 3e-3;
  static constexpr double w = 0.7;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p, const T& t) const {
    const T r = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    const T angle = t * T(w);
    const T c = cos(angle);
    const T s = sin(angle);
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / T(2) - T(1) / r -
           T(a) * (c * q[0] + s * q[1] + cos(T(2) * angle + T(1)) / T(2) * q[2]) -
           T(b) * (c * (q[0] * q[0] - q[1] * q[1]) / T(2) + s * q[0] * q[1]);
  }

  /// The force, written by hand.
  static std::array<double, 3> force(const double* q, double t) {
    const double r = std::hypot(q[0], q[1], q[2]);
    const double c = std::cos(w * t), s = std::sin(w * t);
    const double central = -1 / (r * r * r);
    return {central * q[0] + a * c + b * (c * q[0] + s * q[1]),
            central * q[1] + a * s + b * (s * q[0] - c * q[1]),
            central * q[2] + a / 2 * std::cos(2 * w * t + 1)};
  }
};

inline DynamicalSystem driven_kepler() { return make_system("driven kepler", 3, DrivenKepler{}); }

using OdeintState = std::array<double, 6>;

/// The flight of a state by Boost.odeint, with the force written by hand: it shares no code with
/// what it is compared with.
inline std::vector<double> driven_flight(const std::vector<double>& from, double start,
                                         double duration) {
  namespace odeint = boost::numeric::odeint;
  OdeintState z;
  std::copy_n(from.begin(), 6, z.begin());
  const auto rates = [](const OdeintState& x, OdeintState& dx, double t) {
    const std::array<double, 3> force = DrivenKepler::force(x.data(), t);
    std::copy_n(x.begin() + 3, 3, dx.begin());
    std::copy_n(force.begin(), 3, dx.begin() + 3);
  };
  if (duration != 0) {
    odeint::integrate_adaptive(
        odeint::make_controlled(1e-14, 1e-14, odeint::runge_kutta_fehlberg78<OdeintState>()), rates,
        z, start, start + duration, duration / 100);
  }
  return {z.begin(), z.end()};
}

/// The largest difference of two states.
inline double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace hamjet::test
