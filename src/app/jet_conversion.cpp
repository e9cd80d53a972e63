#include "jet_conversion.hpp"

#include <fmt/format.h>

#include "../studies/formation/orbit_charts.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "refusal.hpp"

namespace hamjet::cli {
namespace {

void require_charts(const CoordinatesAtEnds& coordinates) {
  for (const JetCoordinates one : {coordinates.start, coordinates.end}) {
    if (chart_of(name_of(one))) continue;
    refuse(fmt::format("--coordinates {}: {}", name_of(one),
                       one == JetCoordinates::flow_box
                           ? "its polynomials are no jet in six variables, and are not made from "
                             "one: `hamjet run scene.toml --set jet.coordinates=flow-box` "
                             "integrates and stores them"
                           : "a stored jet has no scene to measure by, must name coordinates"));
  }
}

}  // namespace

ConvertedJet converted_jet(const io::StoredJet& stored, const CoordinatesAtEnds& coordinates,
                           const std::string& name) {
  if (stored.flow_box && coordinates == stored.coordinates) return {stored, coordinates, {}, {}};
  require_charts(coordinates);
  if (!is_orbit(stored.model) || stored.components.size() != 6 || stored.variables.size() != 6) {
    refuse(fmt::format("--coordinates {}: {}: coordinates are of orbits in all six variables",
                       name_of(coordinates), name));
  }
  const CoordinatesAtEnds from = stored.flow_box ? JetCoordinates::cartesian : stored.coordinates;
  const OrbitCharts before(from, stored.nominal_initial, stored.nominal_final);
  const OrbitCharts after(coordinates, stored.nominal_initial, stored.nominal_final);
  ConvertedJet result{stored, stored.coordinates, {}, {}};
  result.stored.coordinates = coordinates;
  result.stored.flow_box.reset();
  result.stored.error_by_degree.clear();
  FlowJet<Extended>& jet = result.stored.jet;
  if (stored.flow_box) {
    jet = convert_map<Extended>(flow_box_jet(stored.flow_box->field, flow_box_map(stored)).jet());
  }
  jet = after.into(before.out_of(FlowMap<Extended>(jet))).jet();
  round_to(stored.precision, jet);
  if (coordinates.end == JetCoordinates::cartesian) {
    // The nominal's end is what the file has of it, not rounding beside.
    for (std::size_t i = 0; i < jet.size(); ++i) jet[i][0] = stored.nominal_final[i];
  }
  if (!stored.flow_box) {
    result.there_and_back = relative_error_by_degree(
        before.into(after.out_of(FlowMap<Extended>(jet))).jet(), stored.jet);
  }
  result.symplecticity = symplecticity_by_degree(jet);
  return result;
}

}  // namespace hamjet::cli
