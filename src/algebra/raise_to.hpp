#pragma once

namespace hamjet {

/// Raises a maximum to the value. A NaN counts as the largest of all and stays.
inline void raise_to(double& largest, double value) {
  if (largest == largest && !(value <= largest)) largest = value;
}

}  // namespace hamjet
