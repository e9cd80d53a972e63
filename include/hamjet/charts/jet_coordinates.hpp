#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hamjet {

/// The coordinates in which the polynomials of an orbit's jet are written, at its start and at its
/// end (`jet.coordinates`). What each is, is said at CanonicalChart and FlowBoxMap.
enum class JetCoordinates {
  cartesian,    ///< positions and momenta themselves
  spherical,    ///< in the chief's plane
  cylindrical,  ///< about the field's axis
  poincare,     ///< Poincaré's elements
  nodal,        ///< elements with the node as a coordinate
  flow_box,     ///< time and energy, and sections across the flow
  automatic,    ///< those of the largest reach, as a study of validity finds it
};

/// The names in scenes and results, in the order of the enumeration.
inline constexpr std::array<std::string_view, 7> jet_coordinates_names = {
    "cartesian", "spherical", "cylindrical", "poincare", "nodal", "flow-box", "auto"};

constexpr std::string_view name_of(JetCoordinates coordinates) {
  return jet_coordinates_names[static_cast<std::size_t>(coordinates)];
}

}  // namespace hamjet
