#pragma once

#include <array>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

using ExtendedVector = std::array<Extended, 3>;

inline Extended dot(const ExtendedVector& a, const ExtendedVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline ExtendedVector cross(const ExtendedVector& a, const ExtendedVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace hamjet
