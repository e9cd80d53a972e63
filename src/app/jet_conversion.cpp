#include "jet_conversion.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "../charts/coordinate_units.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../studies/exact_flow.hpp"
#include "../studies/formation/charts/deputy_flows.hpp"
#include "../studies/formation/charts/orbit_charts.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "refusal.hpp"
#include "stored_chief.hpp"

namespace hamjet::cli {
namespace {

void require_charts(const CoordinatesAtEnds& coordinates, Caller caller) {
  for (const JetCoordinates one : {coordinates.start, coordinates.end}) {
    if (chart_of(name_of(one))) continue;
    refuse(fmt::format("{}: {}", argument(caller, "coordinates", name_of(coordinates)),
                       one == JetCoordinates::flow_box
                           ? "flow boxes are of both ends"
                           : "a stored jet has no scene to measure by, must name coordinates"));
  }
}

/// By how much a stored jet in these coordinates differs from another by degree, both in the
/// chief's own units, in which the coefficients of a degree are compared with each other.
std::vector<double> difference_by_degree(const FlowJet<Extended>& jet, const io::StoredJet& stored,
                                         const CoordinatesAtEnds& coordinates) {
  const double distance = initial_distance(stored.nominal_initial);
  const auto units = [&](JetCoordinates end) {
    return coordinate_units(chart_of(end), distance, canonical_mu);
  };
  const std::array<double, 6> of_variables = units(coordinates.start);
  const std::array<double, 6> of_values = units(coordinates.end);
  const auto comparable = [&](const FlowJet<Extended>& one) {
    return in_units(one, of_values, of_variables);
  };
  return relative_error_by_degree(comparable(jet), comparable(stored.jet));
}

/// The gravity field of the scene, which must be the one that the jet's chief has moved in.
ZonalGravity field_of(const io::StoredJet& stored, const Scene* scene, const std::string& name,
                      Caller caller) {
  const std::string option = argument(caller, "scene");
  if (scene == nullptr) {
    refuse(
        fmt::format("{}: {} does not say its gravity field, which the sections need; name the "
                    "jet's scene by {}",
                    argument(caller, "coordinates", "flow-box"), name, option));
  }
  if (!is_about_chief(stored, *scene)) {
    refuse(fmt::format("{}: {} is about another orbit than the scene's", option, name));
  }
  const ZonalGravity field = orbit_field(*scene);
  // Flown anew, the chief comes to the jet's own end, but for the integrations' errors. What an
  // integration of any use loses is less than what another harmonic would move.
  constexpr double most = 1e-7;
  const std::vector<double> flown =
      exact_flow(zonal_gravity(field), stored.nominal_initial, stored.start_time, stored.duration);
  const auto position = [](const std::vector<double>& state) {
    return Eigen::Vector3d(state.data());
  };
  const double change = (position(flown) - position(stored.nominal_final)).norm() /
                        position(stored.nominal_final).norm();
  if (!(change <= most)) {
    refuse(
        fmt::format("{}: in its gravity field the jet's chief flies to another place, by {:.2g} "
                    "of its distance from the centre, must be at most {:.0e}: another field, or "
                    "too coarse a run",
                    option, change, most));
  }
  return field;
}

/// A jet in positions and momenta in flow boxes, whose constant terms are the stored nominal's end.
void make_flow_box(io::StoredJet& stored, FlowJet<Extended> jet, const ZonalGravity& field) {
  SixNumbers<Extended> start;
  for (std::size_t i = 0; i < start.size(); ++i) {
    start[i] = stored.nominal_initial[i];
    jet[i][0] = stored.nominal_final[i];
  }
  const ChartName chart = section_chart(six_numbers(stored.nominal_initial), canonical_mu);
  FlowBoxMap<Extended> map = flow_box_map_of_jet<Extended>(field, chart, start, stored.duration,
                                                           FlowMap<Extended>(std::move(jet)));
  stored.flow_box = {chart, field};
  stored.jet = std::move(map.coordinates);
  stored.jet.insert(stored.jet.begin(), std::move(map.time));
  round_to(stored.precision, stored.jet);
}

}  // namespace

ConvertedJet converted_jet(const io::StoredJet& stored, const CoordinatesAtEnds& coordinates,
                           const std::string& name, const Scene* scene, Caller caller) {
  if (stored.flow_box && coordinates == stored.coordinates) return {stored, coordinates, {}, {}};
  const bool is_to_flow_box = coordinates == JetCoordinates::flow_box;
  if (!is_to_flow_box) require_charts(coordinates, caller);
  if (!is_orbit(stored.model) || stored.components.size() != 6 || stored.variables.size() != 6) {
    refuse(fmt::format("{}: {}: only jets of orbits in all six variables have coordinates",
                       argument(caller, "coordinates", name_of(coordinates)), name));
  }
  const CoordinatesAtEnds from = stored.flow_box ? JetCoordinates::cartesian : stored.coordinates;
  const OrbitCharts before(from, stored.nominal_initial, stored.nominal_final);
  ConvertedJet result{stored, stored.coordinates, {}, {}};
  result.stored.coordinates = coordinates;
  result.stored.flow_box.reset();
  result.stored.error_by_degree.clear();
  if (is_to_flow_box) {
    const ZonalGravity field = field_of(stored, scene, name, caller);
    make_flow_box(result.stored, before.out_of(FlowMap<Extended>(stored.jet)).jet(), field);
    const FlowBoxMap<double> map = flow_box_map(result.stored);
    const FlowMap<Extended> back(convert_map<Extended>(flow_box_jet(field, map).jet()));
    result.there_and_back = difference_by_degree(before.into(back).jet(), stored, from);
    result.symplecticity = map.symplecticity();
    return result;
  }
  const OrbitCharts after(coordinates, stored.nominal_initial, stored.nominal_final);
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
    result.there_and_back =
        difference_by_degree(before.into(after.out_of(FlowMap<Extended>(jet))).jet(), stored, from);
  }
  result.symplecticity = symplecticity_by_degree(jet);
  return result;
}

}  // namespace hamjet::cli
