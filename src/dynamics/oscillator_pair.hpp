#pragma once

#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Two harmonic oscillators without coupling, H = (p_1^2 + p_2^2)/(2 m) + (k_1 q_1^2 + k_2
/// q_2^2)/2: the simplest system of two frequencies, sqrt(k_1/m) and sqrt(k_2/m), whose ratio is
/// free.
struct OscillatorPairHamiltonian {
  double mass = 1;
  double first_stiffness = 1;
  double second_stiffness = 1;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (T(2) * T(mass)) +
           (T(first_stiffness) * q[0] * q[0] + T(second_stiffness) * q[1] * q[1]) / T(2);
  }
};

/// The oscillator pair as a system; mass in kg, stiffnesses in N/m.
inline DynamicalSystem oscillator_pair(double mass, double first_stiffness,
                                       double second_stiffness) {
  return make_system("oscillator-pair", 2,
                     OscillatorPairHamiltonian{mass, first_stiffness, second_stiffness});
}

}  // namespace hamjet
