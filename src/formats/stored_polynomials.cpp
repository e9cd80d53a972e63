#include <numeric>
#include <utility>

#include "../studies/formation/charts/deputy_flows.hpp"
#include "hamjet/charts/flow_box_states.hpp"
#include "hamjet/studies/propagation.hpp"
#include "jet_description.hpp"
#include "stored_coefficients.hpp"

// Polynomials in coordinates other than Cartesian, as results keep them.

namespace hamjet::io {
namespace {

std::vector<std::size_t> range(std::size_t first, std::size_t end) {
  std::vector<std::size_t> result(end - first);
  std::iota(result.begin(), result.end(), first);
  return result;
}

FlowSection<double> section_at(const StoredJet& stored, const std::vector<double>& state) {
  return {stored.flow_box->field, stored.flow_box->section, six_numbers(state)};
}

std::vector<std::string_view> views(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

}  // namespace

SeriesNames series_names(const StoredJet& stored) {
  SeriesNames names;
  if (stored.flow_box) {
    const FlowSection<double> section = section_at(stored, stored.nominal_initial);
    const auto all = flow_box_coordinate_names(section);
    names.all.assign(all.begin(), all.end());
    names.variables = range(1, 1 + section.variables());
    // The coordinate that a section ignores is a value, beside the coordinates that are also
    // variables.
    names.components = range(2, all.size());
    names.components.insert(names.components.begin(), 0);
    return names;
  }
  const auto start = hamjet::coordinate_names(chart_of(stored.coordinates.start));
  names.all.assign(start.begin(), start.end());
  names.variables = names.components = range(0, start.size());
  if (stored.coordinates.start == stored.coordinates.end) return names;
  for (const std::string& name : hamjet::coordinate_names(chart_of(stored.coordinates.end))) {
    names.all.push_back("end_" + name);
  }
  names.components = range(start.size(), names.all.size());
  return names;
}

StoredJet describe_charted_jet(const PropagationResult& result, const RunResult& run) {
  const ChartedJet& charted = *run.charted;
  StoredJet description = describe_jet(result, run);
  description.coordinates = charted.coordinates;
  description.nominal_final = charted.nominal_final;
  // The errors of a chart's polynomials are those of the run's jet.
  if (charted.section) {
    description.error_by_degree = charted.error_estimate.by_degree.value_or(std::vector<double>());
    description.flow_box = {*charted.section,
                            {1, result.scene.canonical_radius, result.scene.system.J}};
  }
  return description;
}

std::string polynomials_csv(const StoredJet& description, const FlowJet<Extended>& jet) {
  const SeriesNames names = series_names(description);
  return coefficients_csv(views(names.all), names.components, names.variables,
                          description.precision, jet);
}

FlowJet<Extended> read_polynomials_csv(const StoredJet& description, int order,
                                       const std::string& name, std::string_view text) {
  const SeriesNames names = series_names(description);
  return read_coefficients(
      {name, views(names.all), names.components, names.variables, order, description.precision},
      text);
}

FlowBoxMap<double> flow_box_map(const StoredJet& stored) {
  FlowJet<double> values = convert_map<double>(stored.jet);
  Series<double> time = std::move(values.front());
  values.erase(values.begin());
  return hamjet::flow_box_map<double>(
      stored.flow_box->field,
      std::make_shared<const FlowSection<double>>(section_at(stored, stored.nominal_initial)),
      std::make_shared<const FlowSection<double>>(section_at(stored, stored.nominal_final)),
      stored.duration, std::move(time), std::move(values));
}

}  // namespace hamjet::io
