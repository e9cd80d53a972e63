#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../formats/output_formats.hpp"
#include "../studies/arcs.hpp"
#include "../text/scene_message.hpp"
#include "default_integrator.hpp"
#include "scene_lasting_thrust.hpp"
#include "scene_relative_motion.hpp"
#include "starts/scene_manoeuvres.hpp"
#include "systems/scene_earth.hpp"
#include "systems/scene_own_system.hpp"
#include "systems/scene_spacecraft.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

/// Refuses a format with dates if the scene has no date for the orbit, or if the motion leaves the
/// calendar.
void require_dates(const TableReader& root, const Scene& scene) {
  const auto wanted = wanted_formats(scene);
  const auto dated = std::find_if(wanted.begin(), wanted.end(),
                                  [](const OutputFormat* format) { return format->needs_date; });
  if (dated == wanted.end()) return;
  if (!scene.ephemeris) {
    root.table("output").fail(
        "formats",
        fmt::format("\"{}\" without a date, got no table [ephemeris], must have one with "
                    "epoch, time_system, reference_frame and center_name",
                    (*dated)->name));
  }
  // The model `earth` has read its date and the span of its flights, across leap seconds too.
  if (scene.system.earth) return;
  // The key that gives the epoch of the nominal's start.
  const TableReader nominal = root.table("nominal");
  if (root.has("ephemeris") && root.table("ephemeris").has("epoch")) {
    require_calendar(root.table("ephemeris"), "epoch", scene);
  } else if (nominal.has("epoch")) {
    require_calendar(nominal, "epoch", scene);
  } else {
    require_calendar(nominal, nominal.exactly_one_of({"oem_file", "opm_file"}), scene);
  }
}

/// Refuses an integrator that cannot be split into arcs if the scene asks for a number of arcs.
void require_splittable(const TableReader& jet, const Scene& scene) {
  if (scene.arcs.value_or(1) == 1) return;
  for (const IntegratorSettings& settings : scene.integrators) {
    const auto reason = reason_not_to_split(scene, settings);
    if (!reason) continue;
    jet.fail("arcs", fmt::format("not possible, got {} for the integrator {}, but {}, must be "
                                 "\"auto\", which splits those of gauss, stormer and "
                                 "velocity-verlet that pay, or 1",
                                 jet.found("arcs"), settings.label, *reason));
  }
}

}  // namespace

Scene read_flow_jet(const TableReader& root, SceneUnits units) {
  Scene scene;
  const bool has_precision = root.attempt([&] { root.read_if_any("precision", scene.precision); });
  // Reads a table that may be left out; an error in it does not prevent the others from being read.
  const auto read_table = [&](std::string_view key, const auto& read) {
    return !root.has(key) || root.attempt([&] { read(root.table(key)); });
  };
  read_table("reference", [&](const auto& table) { scene.reference = read_reference(table); });
  if (root.has("case")) root.attempt([&] { root.table("case").check_keys(); });

  Nominal nominal;
  const bool has_start = root.attempt([&] {
    nominal = read_start(root, scene, units);
    if (root.has("units")) {
      scene.told_units = canonical_units(nominal.told);
      read_unit_of_mass(root.table("units"), scene);
    }
    scene.nominal_file = nominal.file;
    if (is_orbit(scene.system.model)) {
      scene.manoeuvres = read_manoeuvres(root.table("nominal"), scene.system, nominal.scale);
    }
    if (scene.nominal_file && uses_message_of_spacecraft(root, scene.system)) {
      std::erase(scene.nominal_file->unused, "spacecraft parameters");
    }
    scene.warnings = likely_slips(root, scene);
    set_own_system(root, scene);
  });
  if (!has_start) return scene;
  read_table("formation", [&](const auto& table) {
    scene.separation = read_formation(table, scene.system.model, nominal.scale);
  });
  read_table("checks", [&](const auto& table) { scene.checks = read_checks(table, scene); });
  read_table("output",
             [&](const auto& table) { scene.output = read_output(table, scene.system.model); });
  if (nominal.file) scene.ephemeris = nominal.file->ephemeris;
  if (scene.system.earth) scene.ephemeris = ephemeris_of_earth(root);
  const bool has_dates = read_table("ephemeris", [&](const auto& table) {
    scene.ephemeris = read_ephemeris(table, scene.ephemeris, scene.system);
  });
  nominal.ephemeris = scene.ephemeris;
  const bool has_jet = root.attempt([&] {
    const JetSettings jet = read_jet(root.table("jet"), scene.system, scene.precision, nominal);
    scene.order = jet.order;
    scene.variables = jet.variables;
    scene.duration = jet.duration;
    scene.arcs = jet.arcs;
    scene.symmetry = jet.symmetry;
    scene.coordinates = jet.coordinates;
    set_span_of_earth(root, scene);
    refuse_fixed_flows(root, scene);
  });
  if (!has_jet || !has_precision) return scene;

  root.attempt([&] {
    scene.integrators =
        root.has("integrator")
            ? read_integrators(root.tables("integrator"), scene.precision, scene.duration, nominal)
            : std::vector{default_integrator()};
  });
  root.attempt([&] { scene.jet_times = read_jet_times(root.table("jet"), scene, nominal); });
  read_table("generating_function",
             [&](const auto& table) { scene.kinds = read_generating_function(table, scene); });
  read_table("relative_hamiltonian", [&](const auto& table) {
    scene.relative_hamiltonian_times = read_relative_hamiltonian(table, scene.duration, nominal);
  });
  read_table("compare",
             [&](const auto& table) { scene.comparison = read_compare(table, scene, nominal); });
  read_table("figure", [&](const auto& table) { scene.figure = read_figure(table, scene); });
  root.attempt([&] { require_splittable(root.table("jet"), scene); });
  read_table("validity",
             [&](const auto& table) { scene.validity = read_validity(table, scene, nominal); });
  for (const TableOfStudy& study : tables_of_studies()) {
    read_table(study.name, [&](const auto& table) { study.read(table, scene, nominal); });
  }
  const bool has_deputy = read_table("deputy", [&](const auto& table) {
    scene.deputy = read_deputy(table, scene, nominal, has_collision(root));
    if (table.has("spacecraft")) return;
    const SpacecraftSettings told = spacecraft_of_conjunction(root, scene.system);
    if (!scene.deputy->drag_m2_kg) scene.deputy->drag_m2_kg = told.drag_m2_kg;
    if (!scene.deputy->radiation_m2_kg) scene.deputy->radiation_m2_kg = told.radiation_m2_kg;
  });
  if (!has_deputy || root.is_misspelt("deputy")) return scene;
  read_table("uncertainty",
             [&](const auto&) { scene.uncertainty = read_uncertainty(root, scene, nominal); });
  const bool has_transfer = root.attempt([&] {
    if (!root.has("transfer")) return;
    // An assignment has ends of its own.
    scene.transfer = read_transfer(root.table("transfer"), scene, nominal, !root.has("assignment"));
  });
  if (!has_transfer || root.is_misspelt("transfer")) return scene;
  read_table("thruster", [&](const auto& table) {
    const bool has_box = root.has("bounded") && root.table("bounded").has("box");
    scene.thruster = read_thruster(table, scene, has_box);
  });
  root.attempt([&] {
    if (scene.transfer) require_keys_of_thrust(root, scene.transfer->thrust);
  });
  for (std::string& warning : likely_slips_of_deputies(root, scene)) {
    scene.warnings.push_back(std::move(warning));
  }
  read_table("assignment",
             [&](const auto& table) { scene.assignment = read_assignment(table, scene, nominal); });
  if (has_dates) root.attempt([&] { require_dates(root, scene); });
  return scene;
}

CanonicalUnits canonical_units(const CanonicalScale& scale) {
  return {convert<double>(scale.length_km), convert<double>(scale.time_s)};
}

double read_canonical_radius(const TableReader& system, const SystemSettings& settings,
                             const CanonicalScale& scale) {
  const double radius = scale.length_of_km(settings.radius_km);
  if (!std::isfinite(radius)) {
    system.fail("radius_km",
                fmt::format("out of range, got {:.3g} times the nominal's distance of {:.3g} km "
                            "from the centre, must be within binary64",
                            radius, canonical_units(scale).length_km));
  }
  return radius;
}

const TableDescription& formation_table() {
  static const TableDescription table = {{{"separation_km",
                                           form::positive(),
                                           absent::refused(),
                                           "separation of the deviations",
                                           {orbits}},
                                          {"separation_m",
                                           form::positive(),
                                           absent::refused(),
                                           "separation of the deviations",
                                           {other_models}}}};
  return table;
}

const TableDescription& reference_table() {
  static const TableDescription table = {
      {{"tolerance", form::between(1e-28, 1e-16), absent::value(ReferenceSettings().tolerance),
        "local tolerance of the finer of two runs in extended precision"}}};
  return table;
}

const TableDescription& relative_hamiltonian_table() {
  static const TableDescription table = {
      {{"times_canonical", form::array(form::number()), absent::refused(),
        "times from 0 to the duration, moving away from 0"}}};
  return table;
}

double read_formation(const TableReader& formation, SystemModel model,
                      const CanonicalScale& scale) {
  const bool orbit = is_orbit(model);
  const std::string_view key = orbit ? "separation_km" : "separation_m";
  check_keys_of_model(formation, model);
  const double given = formation.number(key);
  const double km = orbit ? given : given / 1000;
  const bool is_canonical = !orbit && model != SystemModel::own;
  const double separation = is_canonical ? given : scale.length_of_km(km);
  if (!std::isfinite(separation) || separation == 0) {
    formation.fail(key, fmt::format("out of range, got {}, which is {} in canonical units, must be "
                                    "within binary64 there",
                                    formation.found(key), separation));
  }
  return separation;
}

ReferenceSettings read_reference(const TableReader& reference) {
  reference.check_keys();
  ReferenceSettings settings;
  reference.read_if_any("tolerance", settings.tolerance);
  return settings;
}

std::vector<double> read_relative_hamiltonian(const TableReader& table, double span,
                                              const Nominal& nominal) {
  table.check_keys();
  std::vector<double> times = table.numbers("times_canonical");
  const double duration = nominal.told_time(span);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool is_inside = times[i] * duration >= 0 && std::abs(times[i]) <= std::abs(duration);
    if (!is_inside || (i > 0 && std::abs(times[i]) <= std::abs(times[i - 1]))) {
      table.fail_element("times_canonical", i,
                         fmt::format("outside the span or out of order, got {}, must lie between 0 "
                                     "and the duration of {} and move away from 0",
                                     times[i], duration));
    }
  }
  for (double& time : times) time = nominal.time_of_canonical(time);
  return times;
}

}  // namespace hamjet::io
