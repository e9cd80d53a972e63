#pragma once

#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// H = p^2/2 + (q^4 - q^2)/2: two wells at q = +-1/sqrt(2), of depth 1/8, and a barrier of height 0
/// at q = 0. Source: Guibout and Bloch, section "Applications of the discrete Hamilton-Jacobi
/// theory".
struct DoubleWellHamiltonian {
  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const T square = q[0] * q[0];
    return (p[0] * p[0] + square * square - square) / T(2);
  }
};

inline DynamicalSystem double_well() {
  return make_system("double-well", 1, DoubleWellHamiltonian{});
}

}  // namespace hamjet
