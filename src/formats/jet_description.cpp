#include "jet_description.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/dynamics/expression_text.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/version.hpp"
#include "hdf5/hdf5_jets.hpp"

namespace hamjet::io {

StoredJet describe_jet(const PropagationResult& result, const RunResult& run) {
  const Scene& scene = result.scene;
  StoredJet description;
  description.scene = scene.name;
  description.label = run.settings.label;
  description.model = scene.system.model;
  description.own_names = scene.system.own_names;
  description.parameters = result.problem.system->parameters;
  description.precision = scene.precision;
  description.units = scene.units;
  description.duration = scene.duration;
  description.start_time = scene.start_time;
  description.is_autonomous = result.problem.system->is_autonomous();
  description.nominal_initial = scene.nominal;
  description.nominal_final = run.nominal_final;
  description.components = result.problem.components;
  description.variables = scene.variables;
  description.ephemeris = scene.ephemeris;
  description.error_by_degree =
      run.error_by_degree.value_or(run.error_estimate.by_degree.value_or(std::vector<double>()));
  return description;
}

std::optional<std::string> set_state_parameters(StoredJet& stored,
                                                const std::vector<std::string>& names) {
  if (names.empty()) return std::nullopt;
  if (!has_state_parameters(stored.model) || names.size() > most_state_parameters) {
    return fmt::format("got {} of the model {}, must be at most {} of the model earth or own",
                       counted(names.size(), "name"), model_name(stored.model),
                       most_state_parameters);
  }
  const std::size_t n = (stored.nominal_initial.size() - names.size()) / 2;
  const std::vector<std::string_view> usual = hamjet::variable_names(stored.model, n);
  std::vector<std::string> all(usual.begin(), usual.end());
  for (const std::string& name : names) {
    if (!is_expression_name(name) || std::find(all.begin(), all.end(), name) != all.end()) {
      return fmt::format("got {}, must be names of letters, digits and _, each once, other than {}",
                         in_quotes(name), fmt::join(usual, ", "));
    }
    all.push_back(name);
  }
  stored.own_names = std::move(all);
  stored.parameters = names.size();
  return std::nullopt;
}

std::string frame_of(SystemModel model) {
  if (!is_orbit(model)) return "the model's generalised coordinates q and momenta p";
  return "inertial, origin at the centre of attraction, z along its axis; p is the velocity";
}

std::vector<std::string> coordinate_names(ChartName chart) {
  switch (chart) {
    case ChartName::cartesian:
      return {"x", "y", "z", "px", "py", "pz"};
    case ChartName::spherical:
      return {"alpha", "r", "beta", "p_alpha", "p_r", "p_beta"};
    case ChartName::cylindrical:
      return {"phi", "rho", "z", "L_z", "p_rho", "p_z"};
    case ChartName::poincare:
      return {"l+g+h", "-sqrt(2(L-G))sin(g+h)", "-sqrt(2(G-H))sin(h)",
              "L",     "sqrt(2(L-G))cos(g+h)",  "sqrt(2(G-H))cos(h)"};
    case ChartName::nodal:
      return {"l+g", "h", "-sqrt(2(L-G))sin(g)", "L", "H", "sqrt(2(L-G))cos(g)"};
  }
  return {};
}

void require_place_for_coordinates(const StoredJet& stored, const std::string& ending) {
  if (stored.coordinates == JetCoordinates::cartesian || ending == hdf5_format.ending) return;
  throw Error(
      ErrorKind::usage,
      fmt::format("{}: such a file does not say that its jet is in {} coordinates, must end "
                  "in {}",
                  ending, name_of(stored.coordinates), hdf5_format.ending));
}

void require_positions_and_momenta(const StoredJet& stored, const std::string& name) {
  if (stored.coordinates == JetCoordinates::cartesian) return;
  throw Error(ErrorKind::usage,
              fmt::format("{}: the jet of {} is in {} coordinates; hamjet eval takes it, and "
                          "`hamjet convert {} other.h5 --coordinates cartesian` writes it in "
                          "positions and momenta",
                          name, stored.label, name_of(stored.coordinates), name));
}

std::vector<std::string> jet_notes(const StoredJet& description, int order) {
  const auto names = description.variable_names();
  const auto listed = [&](const std::vector<std::size_t>& indices) {
    std::string text;
    for (const std::size_t i : indices) text += fmt::format(" {}", names[i]);
    return text;
  };
  std::vector<std::string> notes = {
      fmt::format("hamjet {}, scene {}, run {}", version, description.scene, description.label),
      fmt::format("polynomials, the components of the final state:{}",
                  listed(description.components)),
      fmt::format("variables, deviations of the initial state:{}", listed(description.variables)),
      fmt::format("order {}, duration {:.17g} canonical", order, description.duration),
      fmt::format("canonical units: length {:.17g} km, time {:.17g} s", description.units.length_km,
                  description.units.time_s),
      "frame: " + frame_of(description.model)};
  if (const auto& ephemeris = description.ephemeris) {
    notes.push_back(fmt::format("start: {} {}; axes {}{}{} about {}", ephemeris->epoch,
                                ephemeris->time_system, ephemeris->reference_frame,
                                ephemeris->reference_frame_epoch.empty() ? "" : " of ",
                                ephemeris->reference_frame_epoch, ephemeris->center_name));
  }
  if (description.start_time != ClockTime::epoch()) {
    notes.push_back(fmt::format("the jet starts at {:.17g} canonical after the epoch",
                                description.start_time.in<double>()));
  }
  if (description.precision == Precision::extended) {
    notes.emplace_back("coefficients of extended precision, rounded to double precision");
  }
  return notes;
}

}  // namespace hamjet::io
