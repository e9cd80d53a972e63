#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace hamjet {

/// Independent standard normal numbers in pairs (G. E. P. Box and M. E. Muller, Annals of
/// Mathematical Statistics 29 (1958) 610). They are the same with every implementation of the
/// standard library, whose own distributions differ.
class StandardNormals {
 public:
  explicit StandardNormals(std::uint64_t seed) : generator_(seed) {}

  double operator()() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    second_ = radius * std::sin(angle);
    has_second_ = true;
    return radius * std::cos(angle);
  }

 private:
  /// A uniform number in (0, 1), one of 2^53 values.
  double uniform() { return (static_cast<double>(generator_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 generator_;
  double second_ = 0;
  bool has_second_ = false;
};

}  // namespace hamjet
