#include "evaluation_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double half_ulp = 0.5 * std::numeric_limits<double>::epsilon();
/// The number of roundings when a deviation is converted into canonical units and rotating axes,
/// and when the result is converted back: a quotient, three products with their sum, and the rate
/// of the axes, each way.
constexpr double conversion_roundings = 10;

/// The largest coefficient of a degree in any component.
double largest_coefficient_of(const std::vector<Series<double>>& map, int degree) {
  double largest = 0;
  for (const Series<double>& component : map) {
    const SeriesSpace& space = component.space();
    for (std::size_t k = space.first(degree); k < space.first(degree + 1); ++k) {
      largest = std::max(largest, std::abs(component[k]));
    }
  }
  return largest;
}

}  // namespace

double evaluation_rounding(const SeriesSpace& space, int degree) {
  const double roundings =
      1 + conversion_roundings +
      std::sqrt(static_cast<double>(space.first(degree + 1)) + static_cast<double>(degree));
  return roundings * half_ulp;
}

std::vector<Series<double>> evaluation_error(const std::vector<Series<double>>& map, int degree,
                                             std::span<const double> error_by_degree) {
  if (map.empty() || degree < 1 || degree > map[0].order()) {
    throw Error(ErrorKind::usage, "evaluation error: the degree must be 1 to the order of the map");
  }
  const SeriesSpace& space = map[0].space();
  const auto error_of = [&](int d) {
    const auto i = static_cast<std::size_t>(d);
    return i < error_by_degree.size() ? error_by_degree[i] : 0;
  };
  std::vector<Series<double>> result;
  for (const Series<double>& component : map) result.emplace_back(component.space_pointer());
  for (int d = 1; d <= degree; ++d) {
    const double largest = largest_coefficient_of(map, d);
    const double relative = evaluation_rounding(space, degree);
    for (std::size_t c = 0; c < map.size(); ++c) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        const double size = std::abs(map[c][k]);
        result[c][k] = relative * size + error_of(d) * std::sqrt(largest) * std::sqrt(size);
      }
    }
  }
  return result;
}

}  // namespace hamjet
