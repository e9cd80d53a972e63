#include "charted_jet.hpp"

#include "../stopwatch.hpp"
#include "deputy_flows.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/error.hpp"
#include "orbit_charts.hpp"

namespace hamjet {
namespace {

void integrate_flow_box(const Scene& scene, const RunResult& run, ChartedJet& result) {
  const ZonalGravity field = orbit_field(scene);
  const SixNumbers<double> start = six_numbers(scene.nominal);
  const ChartName section = section_chart(start, field.mu);
  FlowBoxPropagation<double> propagation(field, section, start, scene.order,
                                         gauss_settings_of(run.settings));
  const FlowBoxMap<double> map = propagation.advance_to(scene.duration);
  std::vector<Series<double>> values = {map.time};
  values.insert(values.end(), map.coordinates.begin(), map.coordinates.end());
  result.section = section;
  result.jet = convert_map<Extended>(values);
  const SixNumbers<double>& end = map.end->origin();
  result.nominal_final.assign(end.begin(), end.end());
  result.symplecticity = map.symplecticity();
}

void change_charts(const Scene& scene, const RunResult& run, ChartedJet& result) {
  const OrbitCharts charts(scene.coordinates, scene.nominal, run.nominal_final);
  result.jet = charts.into(FlowMap<Extended>(run.jet)).jet();
  round_to(scene.precision, result.jet);
  result.nominal_final = run.nominal_final;
  result.symplecticity = symplecticity_by_degree(result.jet);
}

}  // namespace

std::optional<std::string> reason_without_charted_jet(const Scene& scene) {
  if (scene.coordinates == JetCoordinates::cartesian) return std::nullopt;
  if (scene.coordinates == JetCoordinates::automatic) {
    return "which reach furthest is measured by validity, motion, transfer, assign and eval; a run "
           "takes them by name";
  }
  if (scene.variables.size() != scene.nominal.size()) {
    return "coordinates are of orbits expanded in all six variables";
  }
  if (scene.coordinates == JetCoordinates::flow_box && scene.precision == Precision::extended) {
    return "flow boxes are of double precision";
  }
  return std::nullopt;
}

ChartedJet charted_jet(const Scene& scene, const RunResult& run) {
  ChartedJet result;
  result.coordinates = scene.coordinates;
  const Stopwatch watch(result.seconds);
  try {
    if (scene.coordinates == JetCoordinates::flow_box) {
      integrate_flow_box(scene, run, result);
    } else {
      change_charts(scene, run, result);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical && error.kind() != ErrorKind::scene) throw;
    result.failure = error.what();
  }
  return result;
}

}  // namespace hamjet
