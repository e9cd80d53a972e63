#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "../../text/scene_message.hpp"
#include "../content_checksum.hpp"
#include "../jet_description.hpp"
#include "../stored_coefficients.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/error.hpp"
#include "hdf5_jets.hpp"
#include "hdf5_jets_format.hpp"
#include "hdf5_reader.hpp"
#include "hdf5_seal.hpp"

namespace hamjet::io {
namespace {

using hdf5::Reader;

void require_this_format(const Reader& root) {
  if (!root.has_attribute("format") || root.text("format") != hdf5::format) {
    root.fail("format", fmt::format("must be {}: the file holds no jets", in_quotes(hdf5::format)));
  }
  const int stored = root.integer("format_version");
  if (stored < hdf5::format_version || stored > hdf5::flow_box_format_version) {
    root.fail("format_version",
              fmt::format("is {}, this hamjet reads {} to {}; write the file again", stored,
                          hdf5::format_version, hdf5::flow_box_format_version));
  }
}

double positive(const Reader& root, const char* name) {
  const double number = root.number(name);
  if (!(number > 0)) root.fail(name, "the attribute must be positive");
  return number;
}

template <class Name>
std::size_t index_of(const Reader& root, const char* attribute, const std::string& text,
                     const std::vector<Name>& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    root.fail(attribute, fmt::format("the attribute must be one of {}, got {}",
                                     fmt::join(names, ", "), in_quotes(text)));
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// Indices of variables, which must ascend as the writer has them.
std::vector<std::size_t> indices(const Reader& root, const char* attribute,
                                 const std::vector<std::string_view>& names) {
  std::vector<std::size_t> result;
  for (const std::string& text : root.texts(attribute)) {
    result.push_back(index_of(root, attribute, text, names));
  }
  if (result.empty()) root.fail(attribute, "the attribute must not be empty");
  if (std::adjacent_find(result.begin(), result.end(), std::greater_equal<>()) != result.end()) {
    root.fail(attribute, "the attribute must ascend in the order of the state");
  }
  return result;
}

StoredFlowBox read_flow_box(const Reader& root) {
  StoredFlowBox box;
  const auto section = hamjet::chart_of(root.text("section_chart"));
  if (!section || *section == ChartName::cartesian) {
    root.fail("section_chart", "the attribute must name a chart of sections");
  }
  box.section = *section;
  box.field.radius = root.number("field_radius");
  constexpr std::size_t count = ZonalCoefficients::count;
  const std::vector<double> J = root.numbers("field_J", count);
  box.field.J = ZonalCoefficients(std::span(J).first<count>());
  if (!box.has_radius_of_field()) {
    root.fail("field_radius", fmt::format("the attribute {}", radius_of_field_rule));
  }
  return box;
}

/// The coordinates in a file of the second or third version, and its flow box.
void read_coordinates(const Reader& root, int version, StoredJet& stored) {
  if (version == hdf5::flow_box_format_version) {
    for (const char* name : {"coordinates", "end_coordinates"}) {
      if (root.text(name) != name_of(JetCoordinates::flow_box)) {
        root.fail(name, "the attribute must be flow-box in a file of this version");
      }
    }
    stored.coordinates = JetCoordinates::flow_box;
    stored.flow_box = read_flow_box(root);
  } else {
    const std::vector<std::string_view> names(jet_coordinates_names.begin(),
                                              jet_coordinates_names.end());
    const auto read = [&](const char* name) {
      const std::size_t index = index_of(root, name, root.text(name), names);
      if (!chart_of(names[index])) {
        root.fail(name, "the attribute must name coordinates of a jet in six variables");
      }
      return static_cast<JetCoordinates>(index);
    };
    stored.coordinates = {read("coordinates"), read("end_coordinates")};
  }
  if (!is_orbit(stored.model) || stored.variables.size() != 6) {
    root.fail("coordinates", "the attribute is for jets of orbits in all six variables");
  }
}

StoredJet read_scene(const Reader& root) {
  StoredJet stored;
  stored.scene = root.text("scene");
  stored.model =
      static_cast<SystemModel>(index_of(root, "model", root.text("model"), model_names()));
  stored.precision = static_cast<Precision>(
      index_of(root, "precision", root.text("precision"), hdf5::precision_names));
  stored.units = {positive(root, "length_unit_km"), positive(root, "time_unit_s")};
  stored.duration = root.number("duration_canonical");
  if (root.has_attribute("start_canonical")) {
    stored.start_time = ClockTime(root.number("start_canonical"));
  }
  stored.is_autonomous = !root.has_attribute("autonomous");
  stored.nominal_initial = root.numbers("nominal_initial");
  const std::size_t dimension = stored.nominal_initial.size();
  if (root.has_attribute("state_parameters")) {
    const int count = root.integer("state_parameters");
    if (count < 1 || static_cast<std::size_t>(count) > most_state_parameters ||
        !has_state_parameters(stored.model)) {
      root.fail("state_parameters",
                fmt::format("the attribute must be 1 to {}, of a model that has parameters, is {}",
                            most_state_parameters, count));
    }
    stored.parameters = static_cast<std::size_t>(count);
  }
  const auto possible = possible_dimensions(stored.model, stored.parameters);
  if (std::find(possible.begin(), possible.end(), dimension) == possible.end()) {
    root.fail("nominal_initial", fmt::format("the attribute has {} numbers, which is no state of "
                                             "the model",
                                             dimension));
  }
  if (stored.model == SystemModel::own || stored.parameters > 0) {
    stored.own_names = root.texts("state");
    if (stored.own_names.size() != dimension) {
      root.fail("state", fmt::format("the attribute must have {} names", dimension));
    }
  }
  const auto names = stored.variable_names();
  stored.components = indices(root, "components", names);
  stored.variables = indices(root, "variables", names);
  if (!std::includes(stored.components.begin(), stored.components.end(), stored.variables.begin(),
                     stored.variables.end())) {
    root.fail("variables", "the attribute must be among the components");
  }
  const int version = root.integer("format_version");
  if (version != hdf5::format_version) read_coordinates(root, version, stored);
  if (root.has_attribute("epoch")) {
    EphemerisSettings& ephemeris = stored.ephemeris.emplace();
    ephemeris.epoch = root.text("epoch");
    ephemeris.time_system = root.text("time_system");
    ephemeris.reference_frame = root.text("reference_frame");
    ephemeris.center_name = root.text("center_name");
    if (root.has_attribute("reference_frame_epoch")) {
      ephemeris.reference_frame_epoch = root.text("reference_frame_epoch");
    }
  }
  return stored;
}

/// The label of the wanted run.
std::string choose_run(const Reader& root, const std::optional<std::string>& label) {
  const std::vector<std::string> labels = root.texts("runs");
  for (const std::string& candidate : labels) {
    if (candidate.empty() || candidate[0] == '.' || candidate.find('/') != std::string::npos) {
      root.fail("runs", fmt::format("must be names of groups, got {}", in_quotes(candidate)));
    }
    if (label && candidate != *label) continue;
    const Reader run = root.group(candidate);
    if (!run.has_attribute("error")) return candidate;
    if (label) {
      run.fail("error",
               fmt::format("the run has no result: {}", printable(run.text("error"), 300)));
    }
  }
  if (!label) root.fail("runs", "no run has a result");
  throw Error(ErrorKind::usage, fmt::format("no run has the label {}; {}", printable(*label),
                                            suggestion(*label, {labels.begin(), labels.end()})));
}

void require_graded(const Reader& run, const SeriesSpace& space) {
  const std::size_t width = space.variables();
  const std::vector<std::uint8_t> exponents = run.bytes("exponents", {space.size(), width});
  for (std::size_t k = 0; k < space.size(); ++k) {
    const auto right = space.exponents(k);
    const auto found = exponents.begin() + static_cast<std::ptrdiff_t>(k * width);
    if (!std::equal(right.begin(), right.end(), found)) {
      run.fail("exponents",
               fmt::format("of term {} must be ({}) in the graded order, are ({})", k,
                           fmt::join(right, ", "),
                           fmt::join(found, found + static_cast<std::ptrdiff_t>(width), ", ")));
    }
  }
}

FlowJet<Extended> read_jet(const Reader& run, const StoredJet& stored, int order) {
  std::size_t components = stored.components.size();
  std::size_t variables = stored.variables.size();
  if (stored.flow_box) {
    const SeriesNames names = series_names(stored);
    components = names.components.size();
    variables = names.variables.size();
  }
  const auto terms =
      static_cast<hsize_t>(std::round(SeriesSpace::monomial_count(variables, order)));
  // The coefficients are read before memory of the size that the order demands is allocated: a
  // damaged order could ask for gigabytes.
  const std::vector<double> rounded = run.doubles("coefficients", {components, terms});
  const bool is_extended = stored.precision == Precision::extended;
  std::vector<std::string> decimals;
  if (is_extended) decimals = run.decimals("coefficients_decimal", {components, terms});
  const SpacePointer space = SeriesSpace::create(variables, order);
  require_graded(run, *space);
  FlowJet<Extended> jet;
  for (std::size_t c = 0; c < components; ++c) {
    Series<Extended>& series = jet.emplace_back(space);
    for (std::size_t k = 0; k < space->size(); ++k) {
      const std::size_t i = c * space->size() + k;
      series[k] = Extended(rounded[i]);
      if (!is_extended) {
        if (std::isfinite(rounded[i])) continue;
        run.fail("coefficients",
                 fmt::format("component {}, term {}: must be finite, is {}", c, k, rounded[i]));
      }
      const auto number = parse_coefficient(decimals[i], Precision::extended);
      if (!number || static_cast<double>(*number) != rounded[i]) {
        run.fail("coefficients_decimal",
                 fmt::format("component {}, term {}: must be a finite number that rounds to {}, "
                             "got {}",
                             c, k, rounded[i], in_quotes(decimals[i])));
      }
      series[k] = *number;
    }
  }
  return jet;
}

}  // namespace

StoredJet read_jets_hdf5(const std::string& name, std::string_view bytes,
                         const std::optional<std::string>& label) {
  const UnsealedHdf5 unsealed = unseal_hdf5(name, bytes);
  const hdf5::Session session;
  const Reader root(name, unsealed.image);
  require_this_format(root);
  StoredJet stored = read_scene(root);
  const int order = root.integer("order");
  if (order < 1 || order > 60) {
    root.fail("order", fmt::format("the attribute must be 1 to 60, is {}", order));
  }
  stored.label = choose_run(root, label);
  const Reader run = root.group(stored.label);
  stored.nominal_final = run.numbers("nominal_final", stored.nominal_initial.size());
  stored.jet = read_jet(run, stored, order);
  if (run.has_attribute(hdf5::error_attribute)) {
    stored.error_by_degree =
        run.numbers(hdf5::error_attribute, static_cast<std::size_t>(order) + 1);
  }
  for (std::size_t c = 0; c < stored.components.size(); ++c) {
    // In other coordinates the constant terms are the coordinates of the chief's end.
    if (stored.coordinates.end == JetCoordinates::cartesian &&
        static_cast<double>(stored.jet[c].constant()) !=
            stored.nominal_final[stored.components[c]]) {
      run.fail("nominal_final", "the attribute is not the constant term of the coefficients");
    }
  }
  if (unsealed.has_grown) {
    if (!run.has_attribute(hdf5::checksum_attribute) ||
        run.text(hdf5::checksum_attribute) != content_checksum(stored, stored.jet)) {
      refuse_changed_hdf5(name);
    }
    stored.notes.push_back(fmt::format(
        "{}: another program has added to it; the jet of the run {} is as hamjet wrote it", name,
        stored.label));
  }
  return stored;
}

}  // namespace hamjet::io
