#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../formats/output_formats.hpp"
#include "../studies/arcs.hpp"
#include "../text/scene_message.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// The tables `[output]` and `[ephemeris]`; both may be left out.
void read_output_and_ephemeris(const TableReader& root, Scene& scene) {
  if (root.has("output")) scene.output = read_output(root.table("output"), scene.system.model);
  if (scene.nominal_file) scene.ephemeris = scene.nominal_file->ephemeris;
  if (root.has("ephemeris")) {
    scene.ephemeris = read_ephemeris(root.table("ephemeris"), scene.nominal_file, scene.system);
  }
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
  // The key that says when the nominal starts.
  const TableReader nominal = root.table("nominal");
  if (root.has("ephemeris") && root.table("ephemeris").has("epoch")) {
    require_calendar(root.table("ephemeris"), "epoch", scene);
  } else if (nominal.has("epoch")) {
    require_calendar(nominal, "epoch", scene);
  } else {
    require_calendar(nominal, nominal.exactly_one_of({"oem_file", "opm_file"}), scene);
  }
}

/// Refuses an integrator that cannot be split where the scene asks for a number of arcs.
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

Scene read_flow_jet(const TableReader& root) {
  Scene scene;
  scene.title = root.text("title");
  root.read_if_any("precision", scene.precision);
  const Nominal nominal = read_start(root, scene);
  const CanonicalScale& scale = nominal.scale;
  scene.nominal_file = nominal.file;
  scene.warnings = likely_slips(root, scene);

  const JetSettings jet = read_jet(root.table("jet"), scene.system, scene.precision, nominal);
  scene.order = jet.order;
  scene.variables = jet.variables;
  scene.duration = jet.duration;
  scene.arcs = jet.arcs;

  scene.integrators =
      read_integrators(root.tables("integrator"), scene.precision, scene.duration, scale);
  if (root.has("formation")) {
    scene.separation = read_formation(root.table("formation"), scene.system.model, scale);
  }
  if (root.has("generating_function")) {
    scene.kinds = read_generating_function(root.table("generating_function"), scene);
  }
  if (root.has("reference")) scene.reference = read_reference(root.table("reference"));
  if (root.has("relative_hamiltonian")) {
    scene.relative_hamiltonian_times =
        read_relative_hamiltonian(root.table("relative_hamiltonian"), scene.duration);
  }
  if (root.has("checks")) scene.checks = read_checks(root.table("checks"), scene);
  if (root.has("compare")) {
    scene.comparison = read_compare(root.table("compare"), scene.order, scene.duration);
  }
  if (root.has("figure")) scene.figure = read_figure(root.table("figure"), scene);
  require_splittable(root.table("jet"), scene);
  if (root.has("transfer")) {
    // An assignment gives the ends itself.
    scene.transfer = read_transfer(root.table("transfer"), scene, nominal, !root.has("assignment"));
  }
  if (root.has("validity")) {
    scene.validity = read_validity(root.table("validity"), scene, nominal);
  }
  if (root.has("assignment")) {
    scene.assignment = read_assignment(root.table("assignment"), scene, nominal);
  }
  read_output_and_ephemeris(root, scene);
  if (root.has("case")) root.table("case").check_keys();
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
  static const TableDescription table = {
      {{"separation_km", form::positive(), absent::refused(), "of the deviations", {orbits}},
       {"separation_m", form::positive(), absent::refused(), "of the deviations", {other_models}}}};
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
        "from 0 to the duration, moving away from 0"}}};
  return table;
}

double read_formation(const TableReader& formation, SystemModel model,
                      const CanonicalScale& scale) {
  const bool orbit = is_orbit(model);
  const std::string_view key = orbit ? "separation_km" : "separation_m";
  check_keys_of_model(formation, model);
  const double given = formation.number(key);
  const double separation = orbit ? scale.length_of_km(given) : given;
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

std::vector<double> read_relative_hamiltonian(const TableReader& table, double duration) {
  table.check_keys();
  const std::vector<double> times = table.numbers("times_canonical");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool is_inside = times[i] * duration >= 0 && std::abs(times[i]) <= std::abs(duration);
    if (!is_inside || (i > 0 && std::abs(times[i]) <= std::abs(times[i - 1]))) {
      table.fail_element("times_canonical", i,
                         fmt::format("outside the span or out of order, got {}, must lie between 0 "
                                     "and the duration of {} and move away from 0",
                                     times[i], duration));
    }
  }
  return times;
}

}  // namespace hamjet::io
