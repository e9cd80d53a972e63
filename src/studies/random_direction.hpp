#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace hamjet {

/// A random direction. (The distributions of the standard library differ between implementations.)
inline std::vector<double> random_direction(std::mt19937_64& generator, std::size_t dimension) {
  while (true) {
    std::vector<double> direction;
    double square = 0;
    for (std::size_t i = 0; i < dimension; ++i) {
      const auto bits = static_cast<double>(static_cast<std::int64_t>(generator()) >> 11);
      direction.push_back(bits * 0x1p-52);  // in [-1, 1)
      square += direction.back() * direction.back();
    }
    if (square > 1 || square < 0.01) continue;
    for (double& x : direction) x /= std::sqrt(square);
    return direction;
  }
}

}  // namespace hamjet
