#pragma once

#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A mass on a spring in a plane, with gravity toward negative q_2:
///
///   H = |p|^2/(2 m) + k/2 (|q| - l)^2 + m g q_2 .
///
/// The point of suspension, q = 0, is a singularity. At rest below it the spring has the length
/// l + m g/k; small oscillations about that point have the frequencies sqrt(k/m) along the spring
/// and sqrt(g/(l + m g/k)) across it, which a stiff spring sets far apart. Source: Ascher and
/// Reich, "The midpoint scheme and variants for Hamiltonian systems: advantages and pitfalls", 1999
/// (stiff spring pendulum, of which this is the form with gravity).
struct SpringPendulumHamiltonian {
  double mass = 1;
  double stiffness = 1;
  double length = 1;   ///< length of the spring without load
  double gravity = 0;  ///< acceleration

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const T extension = sqrt(q[0] * q[0] + q[1] * q[1]) - T(length);
    return (p[0] * p[0] + p[1] * p[1]) / (T(2) * T(mass)) +
           T(stiffness) / T(2) * extension * extension + T(mass) * T(gravity) * q[1];
  }
};

/// The pendulum as a system; mass in kg, stiffness in N/m, length in m, gravity in m/s^2.
inline DynamicalSystem spring_pendulum(double mass, double stiffness, double length,
                                       double gravity) {
  return make_system("spring-pendulum", 2,
                     SpringPendulumHamiltonian{mass, stiffness, length, gravity});
}

}  // namespace hamjet
