#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

// Series along lines through one nominal, which are integrated side by side in one ring.

namespace hamjet {

/// Combines jets in one variable each, which share the nominal, into a ring in which products of
/// different variables vanish (SeriesSpace::create_uncoupled).
template <class Real>
FlowJet<Real> side_by_side(const std::vector<FlowJet<Real>>& lines) {
  const SpacePointer space = SeriesSpace::create_uncoupled(lines.size(), lines[0][0].order());
  FlowJet<Real> all(lines[0].size(), Series<Real>(space));
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i][0] = lines[0][i][0];
    for (int d = 1; d <= space->order(); ++d) {
      for (std::size_t j = 0; j < lines.size(); ++j) {
        all[i][space->first(d) + j] = lines[j][i][static_cast<std::size_t>(d)];
      }
    }
  }
  return all;
}

/// Extracts the jets in one variable each from such a combined jet.
template <class Real>
std::vector<FlowJet<Real>> line_by_line(const FlowJet<Real>& all) {
  const SeriesSpace& space = all[0].space();
  const SpacePointer line = SeriesSpace::create(1, space.order());
  std::vector<FlowJet<Real>> lines(space.variables(),
                                   FlowJet<Real>(all.size(), Series<Real>(line)));
  for (std::size_t j = 0; j < lines.size(); ++j) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      lines[j][i][0] = all[i][0];
      for (int d = 1; d <= space.order(); ++d) {
        lines[j][i][static_cast<std::size_t>(d)] = all[i][space.first(d) + j];
      }
    }
  }
  return lines;
}

}  // namespace hamjet
