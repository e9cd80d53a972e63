#pragma once

#include "hamjet/dynamics/dynamical_system.hpp"

// Small systems that several tests integrate.

namespace hamjet::test {

/// H = p^T W p / 2 + V(q) with a full matrix W.
inline DynamicalSystem coupled_masses() {
  return make_system("coupled", 2, [](auto q, auto p) {
    return p[0] * p[0] + p[0] * p[1] / 2 + 2 * p[1] * p[1] + cos(q[0]) * q[1] + square(q[1]) +
           square(square(q[0])) / 4;
  });
}

inline DynamicalSystem pendulum() {
  return make_system("pendulum", 1, [](auto q, auto p) { return p[0] * p[0] / 2 - cos(q[0]); });
}

}  // namespace hamjet::test
