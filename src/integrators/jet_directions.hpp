#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "line_restriction.hpp"

// Directions of deviations along which a jet is judged by integrations in one variable.

namespace hamjet {

/// The largest magnitudes of the coefficients of each degree.
template <class Real>
std::vector<double> largest_by_degree(const FlowJet<Real>& jet) {
  const SeriesSpace& space = jet[0].space();
  std::vector<double> largest(static_cast<std::size_t>(space.order()) + 1, 0);
  for (const Series<Real>& component : jet) {
    for (std::size_t k = 0; k < space.size(); ++k) {
      double& of = largest[static_cast<std::size_t>(space.degree(k))];
      of = std::max(of, std::abs(static_cast<double>(component[k])));
    }
  }
  return largest;
}

/// By degree, the size of a jet along a direction if none of its monomials cancel: the root of the
/// sum of their squares, in the largest component.
template <class Real>
std::vector<double> sizes_along(const FlowJet<Real>& jet, const std::vector<Real>& direction,
                                const SpacePointer& line) {
  FlowJet<Real> squares = jet;
  for (Series<Real>& component : squares) {
    for (Real& x : component.coefficients()) x *= x;
  }
  std::vector<Real> entries;
  for (const Real& x : direction) entries.push_back(x * x);
  std::vector<double> result = largest_by_degree(restrict_to_line(squares, entries, line));
  for (double& x : result) x = std::sqrt(x);
  return result;
}

/// A direction, with the jet along it.
template <class Real>
struct Direction {
  std::vector<Real> entries;
  FlowJet<Real> jet;
  std::vector<double> sizes;  ///< sizes_along
  double distortion =
      0;  ///< logarithm of the largest factor by which a degree is larger or smaller along it
};

/// A direction whose entries have magnitudes of about `length`.
template <class Real>
Direction<Real> direction_of(std::vector<Real> entries, double length, const FlowJet<Real>& jet,
                             const SpacePointer& line, const std::vector<double>& largest) {
  Direction<Real> direction{std::move(entries), {}, {}, 0};
  direction.jet = restrict_to_line(jet, direction.entries, line);
  direction.sizes = sizes_along(jet, direction.entries, line);
  const std::vector<double> along = largest_by_degree(direction.jet);
  double weight = 1;  // weight of a monomial
  for (std::size_t d = 1; d < along.size(); ++d) {
    weight *= length;
    if (largest[d] == 0) continue;
    const double distortion = std::abs(std::log(along[d] / (weight * largest[d])));
    direction.distortion = std::max(direction.distortion, distortion);
  }
  return direction;
}

template <class Real>
Direction<Real> draw_direction(std::mt19937_64& generator, const FlowJet<Real>& jet,
                               const SpacePointer& line, const std::vector<double>& largest) {
  std::vector<Real> entries;
  for (std::size_t v = 0; v < jet[0].space().variables(); ++v) {
    const std::uint64_t bits = generator();
    const double fraction = static_cast<double>(bits >> 12) * 0x1p-52;  // in [0, 1)
    const double size = std::sqrt(0.5) * (1 + fraction);
    entries.emplace_back((bits & 1) == 0 ? size : -size);
  }
  return direction_of(std::move(entries), 1, jet, line, largest);
}

/// This number of directions: of those drawn by a generator of constant seed, the ones along which
/// the degrees of the jet are nearest in size to their largest coefficients.
template <class Real>
std::vector<Direction<Real>> choose_directions(const FlowJet<Real>& jet, const SpacePointer& line,
                                               const std::vector<double>& largest,
                                               std::size_t count) {
  constexpr std::size_t candidates = 16;
  std::mt19937_64 generator(20040693);
  std::vector<Direction<Real>> drawn;
  for (std::size_t k = 0; k < candidates; ++k) {
    drawn.push_back(draw_direction(generator, jet, line, largest));
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const auto& a, const auto& b) { return a.distortion < b.distortion; });
  drawn.resize(count);
  return drawn;
}

}  // namespace hamjet
