#pragma once

#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// H = p^2/(2 m) + k q^2/2. Source: Guibout and Bloch, section "Harmonic Oscillator".
struct HarmonicOscillatorHamiltonian {
  double mass = 1;
  double stiffness = 1;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    return p[0] * p[0] / T(2 * mass) + T(stiffness) * q[0] * q[0] / T(2);
  }
};

inline DynamicalSystem harmonic_oscillator(double mass = 1, double stiffness = 1) {
  return make_system("harmonic-oscillator", 1, HarmonicOscillatorHamiltonian{mass, stiffness});
}

}  // namespace hamjet
