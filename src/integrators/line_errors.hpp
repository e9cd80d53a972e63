#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "../algebra/raise_to.hpp"
#include "jet_directions.hpp"
#include "real_number.hpp"

// The error of a jet, degree by degree, that independent runs along lines show.

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

/// By degree, the larger of `result` and the error that a known line shows, relative to the
/// coefficients along this line; along a line coefficients may add up, and their errors too.
template <class Real>
void include_known(std::vector<double>& result, const Direction<Real>& direction,
                   const FlowJet<Real>& run, const std::vector<double>& largest) {
  const std::vector<double> shown = line_differences(direction.jet, run);
  const std::vector<double> along = largest_by_degree(run);
  for (std::size_t d = 0; d < result.size(); ++d) {
    const double scale = along[d] > 0 ? along[d] : largest[d];
    if (scale > 0) raise_to(result[d], shown[d] / scale);
  }
}

/// Leaves of a jet's differences to a first run, by degree, the part that is the jet's own. Where a
/// second run is closer to the jet along the directions that both runs have, the rest is the error
/// of the first: two independent integrations seldom agree by chance.
template <class Real>
void take_own_part(std::vector<double>& of_first, std::span<const Direction<Real>> directions,
                   const std::vector<FlowJet<Real>>& first,
                   const std::vector<FlowJet<Real>>& second) {
  const auto differences = [&](const std::vector<FlowJet<Real>>& lines) {
    std::vector<double> sum(lines.front()[0].size(), 0);
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const std::vector<double> one = line_differences(directions[k].jet, lines[k]);
      for (std::size_t d = 0; d < sum.size(); ++d) sum[d] = std::hypot(sum[d], one[d]);
    }
    return sum;
  };
  const std::vector<double> to_first = differences(first);
  const std::vector<double> to_second = differences(second);
  for (std::size_t d = 0; d < of_first.size(); ++d) {
    if (!(to_second[d] < to_first[d] && std::isfinite(to_first[d]))) continue;
    const double part = to_second[d] / to_first[d];
    // Lines of a run share the nominal, so that one difference stands for all of degree 0, and may
    // be small by chance.
    of_first[d] *= d == 0 ? std::sqrt(part) : part;
  }
}

/// By degree, the differences between a jet and lines along its directions, as root mean squares
/// over the directions: a single direction may miss an error, or may sum up many small ones.
///
/// They are relative to the geometric mean of the jet's largest coefficient and its size along the
/// directions without cancellation. If the errors are spread over the monomials as the coefficients
/// are, the latter is right; if a single monomial has all of the error, the former. Where a jet
/// differs from the lines by a tenth, its own size may be wrong, and the lines are the measure.
template <class Real>
std::vector<double> mean_line_differences(std::span<const Direction<Real>> directions,
                                          const std::vector<FlowJet<Real>>& lines,
                                          const std::vector<double>& largest) {
  std::vector<double> error(largest.size(), 0);
  std::vector<double> along(largest.size(), 0);
  std::vector<double> uncancelled(largest.size(), 0);
  const auto add = [](double& sum, double x) { sum = std::hypot(sum, x); };
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const std::vector<double> difference = line_differences(directions[j].jet, lines[j]);
    const std::vector<double> of_line = largest_by_degree(lines[j]);
    for (std::size_t d = 0; d < error.size(); ++d) {
      add(error[d], difference[d]);
      add(along[d], of_line[d]);
      add(uncancelled[d], directions[j].sizes[d]);
    }
  }
  const double root = std::sqrt(static_cast<double>(directions.size()));
  for (std::size_t d = 0; d < error.size(); ++d) {
    double scale = std::sqrt(uncancelled[d] / root * largest[d]);
    if (10 * error[d] > along[d] && along[d] > 0) scale = std::min(along[d] / root, largest[d]);
    if (scale == 0) scale = std::max(along[d] / root, largest[d]);
    error[d] = scale == 0 ? 0 : error[d] / root / std::max(scale, least_with_digits);
  }
  return error;
}

/// Raises the errors of all degrees that the jet or its lines have to the rounding of the numbers.
template <class Real>
void raise_to_rounding(std::vector<double>& errors, const std::vector<FlowJet<Real>>& lines,
                       const std::vector<double>& largest) {
  for (std::size_t d = 0; d < errors.size(); ++d) {
    bool is_empty = largest[d] == 0;
    for (const FlowJet<Real>& line : lines) is_empty = is_empty && largest_by_degree(line)[d] == 0;
    if (!is_empty) raise_to(errors[d], rounding_unit<Real>());
  }
}

}  // namespace hamjet
