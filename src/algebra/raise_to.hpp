#pragma once

namespace hamjet {

/// Raises a maximum to the value. NaN is the largest of all and, once there, stays.
inline void raise_to(double& largest, double value) {
  if (largest == largest && !(value <= largest)) largest = value;
}

}  // namespace hamjet
