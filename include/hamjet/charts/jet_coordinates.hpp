#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet {

/// The coordinates in which the polynomials of an orbit's jet are written, at the start or at the
/// end (`jet.coordinates`). CanonicalChart and FlowBoxMap define each of them.
enum class JetCoordinates {
  cartesian,    ///< positions and momenta
  spherical,    ///< spherical coordinates in the chief's plane
  cylindrical,  ///< cylindrical coordinates about the field's axis
  poincare,     ///< Poincaré's elements
  nodal,        ///< elements with the node as a coordinate
  flow_box,     ///< time and energy, and sections across the flow
  automatic,    ///< the coordinates of the largest reach, as a study of validity finds them
};

/// The names in scenes and results, in the order of the enumeration.
inline constexpr std::array<std::string_view, 7> jet_coordinates_names = {
    "cartesian", "spherical", "cylindrical", "poincare", "nodal", "flow-box", "auto"};

constexpr std::string_view name_of(JetCoordinates coordinates) {
  return jet_coordinates_names[static_cast<std::size_t>(coordinates)];
}

/// The coordinates of the deviations that polynomials take and of the final ones that they give
/// (`jet.coordinates` and `jet.end_coordinates`). Flow boxes have two sections, so that either both
/// ends use them or none does; `automatic` also applies to both ends.
struct CoordinatesAtEnds {
  JetCoordinates start = JetCoordinates::cartesian;
  JetCoordinates end = JetCoordinates::cartesian;

  constexpr CoordinatesAtEnds() = default;
  /// The same coordinates at both ends.
  constexpr CoordinatesAtEnds(JetCoordinates both) : start(both), end(both) {}
  constexpr CoordinatesAtEnds(JetCoordinates at_start, JetCoordinates at_end)
      : start(at_start), end(at_end) {}

  friend constexpr bool operator==(const CoordinatesAtEnds&, const CoordinatesAtEnds&) = default;

  /// Whether coordinates that need both ends (flow boxes, `automatic`) stand at both ends or at
  /// none.
  constexpr bool fit_each_other() const {
    const auto is_of_both = [](JetCoordinates one) {
      return one == JetCoordinates::flow_box || one == JetCoordinates::automatic;
    };
    return start == end || !(is_of_both(start) || is_of_both(end));
  }
};

/// The name, or both with "to" in between where the ends differ.
inline std::string name_of(const CoordinatesAtEnds& coordinates) {
  std::string name(name_of(coordinates.start));
  if (coordinates.end != coordinates.start) name.append(" to ").append(name_of(coordinates.end));
  return name;
}

/// Coordinates, and the measurements by which they were chosen.
struct ChosenCoordinates : CoordinatesAtEnds {
  struct Reach {
    JetCoordinates coordinates;
    double metres;
  };

  ChosenCoordinates() = default;
  ChosenCoordinates(const CoordinatesAtEnds& named) : CoordinatesAtEnds(named) {}
  ChosenCoordinates(JetCoordinates both) : CoordinatesAtEnds(both) {}

  /// Where the coordinates were automatic, the reach of the polynomials of the highest order in
  /// each of the coordinates that the orbit has; otherwise empty.
  std::vector<Reach> reaches;
};

}  // namespace hamjet
