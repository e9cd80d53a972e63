#include <algorithm>
#include <cmath>

#include "../content_checksum.hpp"
#include "../jet_description.hpp"
#include "../results_names.hpp"
#include "../stored_coefficients.hpp"
#include "hamjet/error.hpp"
#include "hamjet/version.hpp"
#include "hdf5_jets.hpp"
#include "hdf5_jets_format.hpp"
#include "hdf5_seal.hpp"
#include "hdf5_writer.hpp"

namespace hamjet::io {
namespace {

using hdf5::Handle;
using hdf5::Writer;

constexpr const char* description =
    R"(Taylor expansions (jets) of Hamiltonian flows about a nominal trajectory, by hamjet.

Each group but this one is a run, with the jet of one integrator. Component c of the final state is
  sum over k of coefficients[c, k] * product over v of d[v] ** exponents[k, v],
where d are the deviations of the variables from the nominal at the start; the term 0 is the nominal's
final state. Where the file has the attributes coordinates and end_coordinates, d and the final state
are in these canonical coordinates about the chief (coordinates_names, end_coordinates_names), else
in positions and momenta. In coordinates "flow-box" a state is flown to the section through the chief's
start, where its first angle in the chart section_chart is the chief's: d are its period over the
chief's less one and differences of the other coordinates; the values are the time of flight to the
section through the chief's end less that of the steady motion, and the coordinates there, turned back
by it (hamjet/charts/flow_box.hpp), in the zonal field of field_radius and field_J (J2 to J20).
Names of components and variables, of the axes (DIMENSION_LABELS) and the units stand in
attributes. Numbers are canonical: a length is length_unit_km km, a time time_unit_s s.
Where precision is "extended", coefficients_decimal holds all 113 bits as 36 digits, and coefficients
the nearest doubles.

Python:
  import h5py, numpy
  with h5py.File("jets.h5") as f:
      run = f[f.attrs["runs"][0]]
      c, e = run["coefficients"][()], run["exponents"][()]
      final = lambda d: c @ numpy.prod(numpy.power(d, e), axis=1)
      names, axes = list(f.attrs["components"]), [a.label for a in run["coefficients"].dims]
MATLAB and Julia store the first index fastest and show every dataset with its axes reversed:
  MATLAB: c = h5read("jets.h5", "/LABEL/coefficients");      % (term, component)
          e = double(h5read("jets.h5", "/LABEL/exponents")); % (variable, term)
          final = c' * prod(d(:) .^ e, 1)';
  Julia:  using HDF5; f = h5open("jets.h5")
          c, e = read(f["LABEL/coefficients"]), read(f["LABEL/exponents"])
          final = c' * vec(prod(d .^ e, dims = 1))
On a file system without locks set HDF5_USE_FILE_LOCKING=FALSE for these programs; hamjet needs none.
)";

std::vector<std::string> names_of(const std::vector<std::string_view>& names) {
  return {names.begin(), names.end()};
}

std::vector<std::string> names_of(const std::vector<std::string_view>& names,
                                  const std::vector<std::size_t>& indices) {
  std::vector<std::string> chosen;
  for (const std::size_t i : indices) chosen.emplace_back(names[i]);
  return chosen;
}

void write_scene(const Writer& file, const StoredJet& jet, int order, const std::string& title,
                 const std::vector<std::string>& labels) {
  const hid_t root = file.root();
  const auto names = jet.variable_names();
  file.attribute(root, "format", hdf5::format);
  const bool is_charted = jet.coordinates != JetCoordinates::cartesian;
  file.attribute(root, "format_version",
                 jet.flow_box ? hdf5::flow_box_format_version
                 : is_charted ? hdf5::charted_format_version
                              : hdf5::format_version);
  file.attribute(root, "hamjet_version", std::string(version));
  file.attribute(root, "description", std::string(description));
  file.attribute(root, "scene", jet.scene);
  if (!title.empty()) file.attribute(root, "title", title);
  file.attribute(root, "model", std::string(model_name(jet.model)));
  file.attribute(root, "precision", hdf5::precision_names[static_cast<std::size_t>(jet.precision)]);
  file.attribute(root, "frame", frame_of(jet.model));
  file.attribute(root, "units", std::string("canonical"));
  file.attribute(root, "length_unit_km", jet.units.length_km);
  file.attribute(root, "time_unit_s", jet.units.time_s);
  file.attribute(root, "order", order);
  file.attribute(root, "duration_canonical", jet.duration);
  if (jet.start_time != ClockTime::epoch()) {
    file.attribute(root, "start_canonical", jet.start_time.in<double>());
  }
  if (!jet.is_autonomous) file.attribute(root, "autonomous", std::string("no"));
  file.attribute(root, "state", names_of(names));
  if (jet.parameters > 0) {
    file.attribute(root, "state_parameters", static_cast<int>(jet.parameters));
  }
  file.attribute(root, "components", names_of(names, jet.components));
  file.attribute(root, "variables", names_of(names, jet.variables));
  file.attribute(root, "nominal_initial", jet.nominal_initial);
  file.attribute(root, "runs", labels);
  if (jet.flow_box) {
    const std::string coordinates(name_of(JetCoordinates::flow_box));
    const SeriesNames series = series_names(jet);
    file.attribute(root, "coordinates", coordinates);
    file.attribute(root, "coordinates_names", series.of(series.variables));
    file.attribute(root, "end_coordinates", coordinates);
    file.attribute(root, "end_coordinates_names", series.of(series.components));
    file.attribute(root, "section_chart", std::string(name_of(jet.flow_box->section)));
    file.attribute(root, "field_radius", jet.flow_box->field.radius);
    const auto J = jet.flow_box->field.J.values();
    file.attribute(root, "field_J", std::vector<double>(J.begin(), J.end()));
  } else if (is_charted) {
    const auto write = [&](const std::string& key, JetCoordinates coordinates) {
      file.attribute(root, key.c_str(), std::string(name_of(coordinates)));
      file.attribute(root, (key + "_names").c_str(),
                     coordinate_names(*chart_of(name_of(coordinates))));
    };
    write("coordinates", jet.coordinates.start);
    write("end_coordinates", jet.coordinates.end);
  }
  if (!jet.ephemeris) return;
  const EphemerisSettings& ephemeris = *jet.ephemeris;
  file.attribute(root, "reference_frame", ephemeris.reference_frame);
  if (!ephemeris.reference_frame_epoch.empty()) {
    file.attribute(root, "reference_frame_epoch", ephemeris.reference_frame_epoch);
  }
  file.attribute(root, "center_name", ephemeris.center_name);
  file.attribute(root, "epoch", ephemeris.epoch);
  file.attribute(root, "time_system", ephemeris.time_system);
}

/// Coefficients from the term `first` on.
struct Coefficients {
  std::vector<double> rounded;
  std::string decimals;

  void add(const Series<Extended>& series, std::size_t first, Precision precision) {
    for (std::size_t k = first; k < series.size(); ++k) {
      rounded.push_back(static_cast<double>(series[k]));
      if (precision != Precision::extended) continue;
      std::string digits = extended_digits(series[k]);
      digits.resize(hdf5::decimal_width, '\0');
      decimals += digits;
    }
  }

  void write(const Writer& file, hid_t group, const std::vector<hsize_t>& shape,
             const Writer::Axes& axes) const {
    const Handle dataset = file.dataset(group, "coefficients", shape, rounded, axes);
    file.attribute(dataset, "units", std::string("canonical"));
    if (!decimals.empty()) file.decimals(group, "coefficients_decimal", shape, decimals, axes);
  }
};

void write_exponents(const Writer& file, hid_t group, const SeriesSpace& space, std::size_t first) {
  const std::size_t terms = space.size() - first;
  const std::span<const std::uint8_t> exponents(space.exponents(first).data(),
                                                terms * space.variables());
  file.dataset(group, "exponents", {terms, space.variables()}, exponents, {"term", "variable"});
}

void write_jet(const Writer& file, hid_t group, const FlowJet<Extended>& jet, Precision precision) {
  const SeriesSpace& space = jet.at(0).space();
  Coefficients coefficients;
  for (const Series<Extended>& component : jet) coefficients.add(component, 0, precision);
  coefficients.write(file, group, {jet.size(), space.size()}, {"component", "term"});
  write_exponents(file, group, space, 0);
}

/// Writes all parts of a run that are read back: the final state, the coefficients, their errors
/// where they are known (estimates need these), and the checksum of these parts.
void write_stored(const Writer& file, hid_t group, StoredJet stored, const FlowJet<Extended>& jet) {
  std::vector<double>& errors = stored.error_by_degree;
  const bool is_known =
      std::all_of(errors.begin(), errors.end(), [](double error) { return std::isfinite(error); });
  if (!is_known) errors.clear();
  file.attribute(group, "nominal_final", stored.nominal_final);
  write_jet(file, group, jet, stored.precision);
  if (!errors.empty()) file.attribute(group, hdf5::error_attribute, errors);
  file.attribute(group, hdf5::checksum_attribute, content_checksum(stored, jet));
}

void write_nominal(const Writer& file, hid_t group, const RunResult& run) {
  if (run.nominal.empty()) return;
  std::vector<double> times;
  std::vector<double> states;
  std::vector<double> errors;
  for (const NominalPoint& point : run.nominal) {
    times.push_back(point.time);
    states.insert(states.end(), point.state.begin(), point.state.end());
    errors.push_back(point.energy_error);
  }
  const hsize_t count = times.size();
  file.dataset(group, "nominal_time", {count}, times, {"time"});
  file.dataset(group, "nominal_state", {count, states.size() / count}, states, {"time", "state"});
  file.dataset(group, "nominal_energy_error", {count}, errors, {"time"});
}

void write_generating_functions(const Writer& file, hid_t run_group,
                                const PropagationResult& result, const RunResult& run) {
  const auto has_function = [](const KindResult& kind) {
    return kind.generating_function.has_value();
  };
  if (std::none_of(run.kinds.begin(), run.kinds.end(), has_function)) return;
  const Handle functions = file.group(run_group, "generating_functions");
  for (const KindResult& kind : run.kinds) {
    if (!has_function(kind)) continue;
    const Handle group = file.group(functions, kind_name(kind));
    const Series<Extended>& series = *kind.generating_function;
    // Degrees 0 and 1 vanish and are left out, as in the CSV file.
    const std::size_t first = series.space().first(2);
    Coefficients coefficients;
    coefficients.add(series, first, result.scene.precision);
    coefficients.write(file, group, {series.size() - first}, {"term"});
    write_exponents(file, group, series.space(), first);
    file.attribute(group, "variables", generating_function_variables(result, kind.kind));
    file.attribute(group, "condition", kind.condition);
  }
}

void write_run(const Writer& file, const PropagationResult& result, const RunResult& run) {
  const Handle group = file.group(file.root(), run.settings.label);
  file.attribute(group, "method", std::string(method_name(run.settings.method)));
  if (!run.failure.empty()) {
    file.attribute(group, "error", run.failure);
    return;
  }
  write_stored(file, group, describe_jet(result, run), run.jet);
  write_nominal(file, group, run);
  write_generating_functions(file, group, result, run);
}

}  // namespace

bool hdf5_available() noexcept { return true; }

std::string jets_hdf5(const PropagationResult& result) {
  const hdf5::Session session;
  const Writer file;
  std::vector<std::string> labels;
  for (const RunResult& run : result.runs) labels.push_back(run.settings.label);
  write_scene(file, describe_jet(result, result.runs.at(0)), result.scene.order, result.scene.title,
              labels);
  for (const RunResult& run : result.runs) write_run(file, result, run);
  return seal_hdf5(file.image());
}

std::string jets_hdf5(const StoredJet& stored) {
  const hdf5::Session session;
  const Writer file;
  write_scene(file, stored, stored.order(), "", {stored.label});
  const Handle group = file.group(file.root(), stored.label);
  write_stored(file, group, stored, stored.jet);
  return seal_hdf5(file.image());
}

}  // namespace hamjet::io
