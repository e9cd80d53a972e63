#pragma once

#include <array>
#include <string>
#include <vector>

#include "hamjet/charts/flow_box.hpp"
#include "hamjet/maps/flow_map.hpp"

namespace hamjet {

/// The coordinates at the end of a flow-box map, as series in the initial deviations (dq, dp) along
/// inertial axes, of the polynomials' order: by how much a state is behind the section through the
/// chief's end, in time; its period over the chief's, less one (or what takes its place, see
/// FlowSection); differences from the chief of the section's coordinates in their order, and of the
/// ignored one, where the chart has it. Six of them; the chief's are all 0.
std::vector<Series<double>> flow_box_coordinates(const ZonalGravity& field,
                                                 const FlowBoxMap<double>& map);

/// The jet in positions and momenta of a flow-box map, to its order: those coordinates carried out
/// of the end's section. It differs from a jet that is integrated in positions and momenta by the
/// error of the integrations; its constant terms are the end that the section goes through.
FlowMap<double> flow_box_jet(const ZonalGravity& field, const FlowBoxMap<double>& map);

/// Their names: tau, period, and those of the chart's.
std::array<std::string, 6> flow_box_coordinate_names(const FlowSection<double>& section);

/// The names of a chart's coordinates, positions and then momenta.
std::array<std::string, 6> coordinate_names(ChartName chart);

}  // namespace hamjet
