#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hamjet::test {

/// Least-squares slope of log(error) against log(step): the order of convergence.
inline double fitted_order(const std::vector<double>& steps, const std::vector<double>& errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto count = static_cast<double>(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double x = std::log(steps[k]);
    const double y = std::log(errors[k]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

}  // namespace hamjet::test
