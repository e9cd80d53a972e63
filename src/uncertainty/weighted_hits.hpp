#pragma once

#include <algorithm>
#include <cmath>

namespace hamjet {

/// The samples that have an event: their number, the sum of their weights, and the sum of the
/// squares of the weights.
struct Hits {
  long count = 0;
  double x = 0;
  double x_squared = 0;

  void add(double weight) {
    ++count;
    x += weight;
    x_squared += weight * weight;
  }
  void add(const Hits& other) {
    count += other.count;
    x += other.x;
    x_squared += other.x_squared;
  }
  /// A mean of weights may exceed 1 by its error.
  double probability(double samples) const { return std::min(1.0, x / samples); }
  double variance(double samples) const {
    return std::max(0.0, x_squared / samples - std::pow(probability(samples), 2));
  }
};

}  // namespace hamjet
