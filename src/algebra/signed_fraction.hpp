#pragma once

#include <random>

namespace hamjet {

/// A random number in [-1, 1), a multiple of 2^-52. The distributions of the standard library would
/// differ between implementations.
inline double signed_fraction(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11U) * 0x1p-52 - 1;
}

}  // namespace hamjet
