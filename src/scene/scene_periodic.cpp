#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene_relative_motion.hpp"
#include "tables_of_studies.hpp"

namespace hamjet::io {
namespace {

constexpr int most_shooting_arcs = 64;
constexpr int most_members = 10000;
constexpr std::string_view parameter_head = "parameters.";

/// Refuses what is neither the energy, the period, a variable nor, if these are allowed, a
/// parameter of a system that the scene writes.
void require_quantity(const TableReader& table, std::string_view key, const std::string& name,
                      const Scene& scene, bool may_be_parameter) {
  if (name == "energy" || name == "period") return;
  std::vector<std::string> right = {"energy", "period"};
  for (const std::string_view variable : variable_names(scene.system)) {
    if (name == variable) return;
    right.emplace_back(variable);
  }
  if (may_be_parameter && scene.system.own_text) {
    for (const NamedText& parameter : scene.system.own_text->parameters) {
      if (name == std::string(parameter_head) + parameter.name) return;
      right.push_back(std::string(parameter_head) + parameter.name);
    }
  }
  table.fail(key, fmt::format("no such quantity, got {}, must be one of {}", table.found(key),
                              fmt::join(right, ", ")));
}

/// Refuses a system whose flow keeps no energy, or depends on the time at which it starts.
void require_autonomous(const TableReader& periodic, const Scene& scene) {
  if (scene.system.model == SystemModel::earth) {
    periodic.fail("",
                  "the forces depend on the time, got the model earth, must be a system that "
                  "is the same at all times: zonal-gravity, kepler or one of the scene's own");
  }
  if (scene.system.own_text && !scene.system.own_text->is_hamiltonian()) {
    periodic.fail("",
                  "the system is a vector field, got system.vector_field, must be a system with a "
                  "hamiltonian, whose energy the orbit keeps");
  }
  if (scene.own_system && !scene.own_system->is_autonomous()) {
    periodic.fail("",
                  "the Hamiltonian depends on the time, got t in system.hamiltonian, must be "
                  "without t: an orbit closes whenever it starts");
  }
  if (scene.precision == Precision::extended) {
    periodic.fail("",
                  "not available in extended precision, got precision = \"extended\", must be "
                  "\"double\"");
  }
}

const TableDescription& family_table() {
  static const PeriodicFamilySettings preset;
  static const TableDescription table = {
      {{"along", form::text(), absent::refused(),
        "what the family runs along: `energy`, `period`, a variable of the start by its name, or "
        "`parameters.NAME` of a system of one's own, where `hold` is held"},
       {"to", form::number(), absent::refused(),
        "value of that quantity at the last orbit, canonical"},
       {"step", form::positive(), absent::other("a twentieth of the way"),
        "step of that quantity between orbits, canonical; shorter where the family bends"},
       {"members", form::integer(2, most_members), absent::value(preset.members),
        "the most orbits; a family that folds back may never come to `to`"}},
      "A family of periodic orbits, by pseudo-arclength continuation from the first."};
  return table;
}

PeriodicFamilySettings read_family(const TableReader& table, const Scene& scene) {
  table.check_keys();
  table.require({"along", "to"});
  PeriodicFamilySettings family;
  family.along = table.text("along");
  require_quantity(table, "along", family.along, scene, true);
  family.to = table.number("to");
  if (table.has("step")) family.step = table.positive_number("step");
  table.read_if_any("members", family.members);
  return family;
}

const TableDescription& periodic_table() {
  static const PeriodicSettings preset;
  static const TableDescription table = {
      {{"period_s", form::positive(), absent::other("`jet.duration`"), "a guess of the period"},
       {"period_canonical", form::positive(), absent::other("`jet.duration`"), "the same"},
       {"hold", form::text(), absent::value(preset.hold),
        "what picks the orbit: `energy`, `period`, or a variable of the start by its name"},
       {"value", form::number(), absent::other("that of the nominal, or of the guess"),
        "value at which that quantity is held, canonical"},
       {"arcs", form::integer(1, most_shooting_arcs), absent::value(preset.arcs),
        "number of arcs of multiple shooting; more for orbits that are very unstable"},
       {"tolerance", form::between(1e-13, 1e-3), absent::value(preset.tolerance),
        "largest mismatch of the arcs that still makes an orbit, in parts of the orbit's size"},
       {"family", form::table(family_table()), absent::other("one orbit"),
        "the family that the orbit is in"}},
      "A periodic orbit near the nominal, with its multipliers, and the family that it is in."};
  return table;
}

PeriodicSettings read_periodic(const TableReader& periodic, const Scene& scene,
                               const Nominal& nominal) {
  periodic.check_keys();
  require_autonomous(periodic, scene);
  PeriodicSettings settings;
  settings.period = scene.duration;
  if (periodic.has("period_s") && periodic.has("period_canonical")) {
    periodic.exactly_one_of({"period_s", "period_canonical"});
  }
  if (periodic.has("period_s")) {
    settings.period = nominal.scale.time_of_s(periodic.positive_number("period_s"));
  } else if (periodic.has("period_canonical")) {
    settings.period = nominal.time_of_canonical(periodic.positive_number("period_canonical"));
  }
  if (!(settings.period > 0 && std::isfinite(settings.period))) {
    periodic.fail("", fmt::format("no guess of the period, got a jet.duration of {:.6g}, must be "
                                  "above 0, or period_s or period_canonical",
                                  settings.period));
  }
  periodic.read_if_any("hold", settings.hold);
  require_quantity(periodic, "hold", settings.hold, scene, false);
  if (periodic.has("value")) {
    settings.value = periodic.number("value");
    if (settings.hold == "period" && !(*settings.value > 0)) {
      periodic.fail("value", fmt::format("out of range, got a period of {}, must be above 0",
                                         periodic.found("value")));
    }
  }
  periodic.read_if_any("arcs", settings.arcs);
  periodic.read_if_any("tolerance", settings.tolerance);
  if (periodic.has("family")) settings.family = read_family(periodic.table("family"), scene);
  return settings;
}

}  // namespace

TableOfStudy periodic_of_scenes() {
  return {.name = "periodic",
          .description = &periodic_table,
          .absence = "none",
          .help = "what `hamjet periodic` works on",
          .read = [](const TableReader& table, Scene& scene, const Nominal& nominal) {
            scene.periodic = read_periodic(table, scene, nominal);
          }};
}

}  // namespace hamjet::io
