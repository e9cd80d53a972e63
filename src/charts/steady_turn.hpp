#pragma once

#include <optional>

#include "hamjet/charts/flow_box.hpp"
#include "plane_elements.hpp"

namespace hamjet {

/// Turns the pair (q, p) = A (-sin theta, cos theta) by an angle, so that theta becomes theta +
/// angle.
template <class Real, class T>
void turn_pair(T& q, T& p, const T& angle) {
  const auto [s, c] = sine_and_cosine(angle);
  const T turned = q * c - p * s;
  p = p * c + q * s;
  q = turned;
}

/// The place of the pericentre's pair among the coordinates of a section in elements. The pair
/// stands behind the node where the node is a coordinate of its own, and before the node's pair
/// otherwise.
inline std::size_t pericentre_place(std::optional<std::size_t> ignored) { return ignored ? 2 : 1; }
inline constexpr std::size_t node_pair_place = 2;  ///< where the node has a pair

/// Turns the coordinates of a section by a steady motion; coordinates that are not elements stay.
template <class Real, class T>
void turn_steadily(const FlowSection<Real>& section, const SteadyMotion<T>& steady,
                   SixNumbers<T>& z) {
  if (!section.chart().is_of_elements()) return;
  const std::size_t pair = pericentre_place(section.ignored());
  turn_pair<Real>(z[pair], z[pair + 3], steady.pericentre);
  if (section.ignored()) return;
  turn_pair<Real>(z[node_pair_place], z[node_pair_place + 3], steady.node);
}

}  // namespace hamjet
