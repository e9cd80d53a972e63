#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "../algebra/raise_to.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "jet_directions.hpp"

// What independent runs along lines show of a jet's error, degree by degree.

namespace hamjet {

template <class Real>
constexpr double rounding_unit() {
  return static_cast<double>(std::numeric_limits<Real>::epsilon());
}

/// By degree, the largest difference of two univariate jets.
template <class Real>
std::vector<double> line_differences(const FlowJet<Real>& a, const FlowJet<Real>& b) {
  std::vector<double> result(a[0].size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t d = 0; d < result.size(); ++d) {
      const double difference = std::abs(static_cast<double>(Real(a[i][d] - b[i][d])));
      raise_to(result[d], difference);
    }
  }
  return result;
}

/// By degree, how far two runs along a direction differ, relative to what the jet's coefficients
/// are.
template <class Real>
std::vector<double> relative_line_differences(const FlowJet<Real>& a, const FlowJet<Real>& run,
                                              bool is_known, const std::vector<double>& largest) {
  std::vector<double> result = line_differences(a, run);
  const std::vector<double> along = largest_by_degree(run);
  for (std::size_t d = 0; d < result.size(); ++d) {
    double scale = along[d] > 0 ? std::min(along[d], largest[d]) : largest[d];
    // The coefficients may add up along a known line, and their errors with them.
    if (is_known && along[d] > 0) scale = along[d];
    if (scale == 0) scale = std::max(along[d], largest[d]);
    result[d] = scale == 0 ? 0 : result[d] / scale;
  }
  return result;
}

/// By degree, the larger of `result` and the error that a known line shows.
template <class Real>
void include_known(std::vector<double>& result, const Direction<Real>& direction,
                   const FlowJet<Real>& run, const std::vector<double>& largest) {
  const std::vector<double> shown = relative_line_differences(direction.jet, run, true, largest);
  const std::vector<double> along = largest_by_degree(run);
  for (std::size_t d = 0; d < result.size(); ++d) {
    if (along[d] == 0 && largest[d] == 0) continue;
    double estimate = error_estimate_safety * shown[d];
    if (estimate < rounding_unit<Real>()) estimate = rounding_unit<Real>();
    raise_to(result[d], estimate);
  }
}

/// All runs have the same nominal, so that its difference between two of them is error too.
template <class Real>
void include_nominals(std::vector<double>& result, const FlowJet<Real>& a, const FlowJet<Real>& b,
                      double largest) {
  if (largest == 0) return;
  raise_to(result[0], error_estimate_safety * line_differences(a, b)[0] / largest);
}

/// By degree, the larger of `result` and the error that a run shows along its directions: the root
/// mean square over them, for one may be blind to it and another sum up much that is small,
/// relative to the smaller of that of the run and the jet's largest coefficient.
template <class Real>
void include_lines(std::vector<double>& result, std::span<const Direction<Real>> directions,
                   const std::vector<FlowJet<Real>>& lines, const std::vector<double>& largest) {
  std::vector<double> error(result.size(), 0);
  std::vector<double> along(result.size(), 0);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const std::vector<double> difference = line_differences(directions[j].jet, lines[j]);
    const std::vector<double> size = largest_by_degree(lines[j]);
    for (std::size_t d = 0; d < result.size(); ++d) {
      error[d] = std::hypot(error[d], difference[d]);
      along[d] = std::hypot(along[d], size[d]);
    }
  }
  const double root = std::sqrt(static_cast<double>(directions.size()));
  for (std::size_t d = 0; d < result.size(); ++d) {
    const double mean = along[d] / root;
    if (mean == 0 && largest[d] == 0) continue;
    const double scale =
        mean > 0 && largest[d] > 0 ? std::min(mean, largest[d]) : std::max(mean, largest[d]);
    raise_to(result[d], rounding_unit<Real>());
    raise_to(result[d], error_estimate_safety * error[d] / root / scale);
  }
}

}  // namespace hamjet
