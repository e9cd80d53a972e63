#pragma once

#include "plane_elements.hpp"

namespace hamjet {

/// Turns the pair (q, p) = A (-sin theta, cos theta) by an angle, theta to theta + angle.
template <class Real, class T>
void turn_pair(T& q, T& p, const T& angle) {
  const auto [s, c] = sine_and_cosine(angle);
  const T turned = q * c - p * s;
  p = p * c + q * s;
  q = turned;
}

}  // namespace hamjet
