#pragma once

#include <array>
#include <string>
#include <vector>

#include "hamjet/charts/flow_box.hpp"
#include "hamjet/maps/flow_map.hpp"

namespace hamjet {

/// The coordinates at the end of a flow-box map, as series in the initial deviations (dq, dp) along
/// inertial axes, to the order of the polynomials. There are six: the time by which a state is
/// behind the section through the chief's end; its period over the chief's, minus one (or its
/// substitute, see FlowSection); the differences from the chief in the section's coordinates, in
/// their order; and the difference in the ignored coordinate, where the chart has one. All are 0
/// for the chief.
std::vector<Series<double>> flow_box_coordinates(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map);

/// The jet in positions and momenta that belongs to a flow-box map, to the order of the map: its
/// final coordinates are carried out of the end's section. It differs from a jet that is integrated
/// in positions and momenta by the error of the integrations. Its constant terms are the state
/// through which the end's section goes.
FlowMap<double> flow_box_jet(const ZonalGravity& field, const FlowBoxMap<double>& map);

/// The names of these coordinates: tau, period, and the names of the chart's coordinates.
std::array<std::string, 6> flow_box_coordinate_names(const FlowSection<double>& section);

/// The names of a chart's coordinates, positions and then momenta.
std::array<std::string, 6> coordinate_names(ChartName chart);

}  // namespace hamjet
