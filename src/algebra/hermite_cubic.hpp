#pragma once

#include <array>

namespace hamjet {

/// The weights of (position, velocity) at the start and at the end of an interval in the cubic
/// through these four, and in its derivative.
struct HermiteWeights {
  std::array<double, 4> position;
  std::array<double, 4> velocity;
};

/// The weights at the fraction s, from 0 to 1, of an interval of length h:
///
///   (1 + 2 s) (1 - s)^2,  s (1 - s)^2 h,  s^2 (3 - 2 s),  s^2 (s - 1) h .
inline HermiteWeights hermite_weights(double length, double s) {
  const double r = 1 - s;
  return {{(1 + 2 * s) * r * r, s * r * r * length, s * s * (3 - 2 * s), -s * s * r * length},
          {-6 * s * r / length, r * (1 - 3 * s), 6 * s * r / length, s * (3 * s - 2)}};
}

}  // namespace hamjet
