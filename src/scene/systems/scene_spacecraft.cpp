#include "scene_spacecraft.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../studies/earth_system.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"

namespace hamjet::io {
namespace {

/// C_D A / m of real spacecraft: from 0.0003 m^2/kg (a sphere of lead, LARES) to some 20 (a
/// balloon, Echo).
constexpr double least_drag_m2_kg = 2e-4;
constexpr double most_drag_m2_kg = 50;

void warn_of_unit(const TableReader& table, std::string_view key, double drag_m2_kg) {
  if (drag_m2_kg == 0 || (drag_m2_kg >= least_drag_m2_kg && drag_m2_kg <= most_drag_m2_kg)) return;
  table.warn(key, fmt::format("C_D A / m of no spacecraft, got {:.4g} m^2/kg, should be from {} to "
                              "{}; is the area in cm^2, or the coefficient kg/m^2?",
                              drag_m2_kg, least_drag_m2_kg, most_drag_m2_kg));
}

double read_drag_coefficient(const TableReader& table) {
  constexpr std::string_view parts[] = {"mass_kg", "area_m2", "drag_coefficient"};
  if (table.has("drag_m2_kg")) {
    for (const std::string_view part : parts) {
      if (!table.has(part)) continue;
      table.fail(part, fmt::format("given twice, got {} beside drag_m2_kg, must be left out, or "
                                   "drag_m2_kg",
                                   table.found(part)));
    }
    const double drag = table.number("drag_m2_kg");
    if (drag < 0) {
      table.fail("drag_m2_kg", fmt::format("negative, got {}, must be at least 0", drag));
    }
    warn_of_unit(table, "drag_m2_kg", drag);
    return drag;
  }
  const double mass = table.positive_number("mass_kg");
  const double area = table.positive_number("area_m2");
  double coefficient = usual_drag_coefficient;
  table.read_if_any("drag_coefficient", coefficient);
  const double drag = coefficient * area / mass;
  warn_of_unit(table, "area_m2", drag);
  return drag;
}

}  // namespace

const TableDescription& spacecraft_table() {
  static const TableDescription table = {
      {{"mass_kg", form::positive(), absent::other("`drag_m2_kg`"), "of the spacecraft"},
       {"area_m2", form::positive(), absent::other("`drag_m2_kg`"), "across its motion"},
       {"drag_coefficient", form::positive(), absent::value(usual_drag_coefficient),
        "C_D, beside mass and area"},
       {"drag_m2_kg", form::number(), absent::other("of mass, area and C_D"),
        "C_D A / m, at least 0"}},
      "What the air does to a spacecraft of the model `earth`; a deputy without this table is like "
      "the chief."};
  return table;
}

std::vector<SceneKey> atmosphere_keys() {
  const std::vector<std::string_view> owner = {"earth"};
  const AtmosphereSettings preset;
  return {{"atmosphere", form::choice({atmosphere_names.begin(), atmosphere_names.end()}),
           absent::other("no drag"),
           "density of the air, which turns with the Earth: `harris-priester` bulges on the "
           "afternoon side, 100 to 1000 km high",
           owner},
          {"density_factor", form::positive(), absent::value(preset.density_factor),
           "of all densities of the air", owner},
          {"bulge_exponent", form::integer(2, 6), absent::value(preset.bulge_exponent),
           "of the bulge's cosine, even: 2 for low inclinations, 6 for polar orbits", owner}};
}

void read_drag(const TableReader& root, SystemSettings& settings) {
  if (!settings.earth) {
    if (!root.has("spacecraft")) return;
    root.table("spacecraft")
        .fail("", fmt::format("without air, got a spacecraft of the model {}, must be left out, or "
                              "system.model = \"earth\" with an atmosphere",
                              model_name(settings.model)));
  }
  EarthSettings& earth = *settings.earth;
  const TableReader system = root.table("system");
  if (!system.has("atmosphere")) {
    for (const std::string_view key : {"density_factor", "bulge_exponent"}) {
      if (!system.has(key)) continue;
      system.fail(key, fmt::format("without air, got {}, must be left out, or beside atmosphere",
                                   system.found(key)));
    }
    if (root.has("spacecraft")) {
      root.table("spacecraft")
          .fail("",
                "without air, got a spacecraft, must be left out, or system.atmosphere = "
                "\"harris-priester\"");
    }
  } else {
    AtmosphereSettings air;
    air.model = static_cast<AtmosphereModel>(system.choice("atmosphere"));
    if (system.has("density_factor")) air.density_factor = system.positive_number("density_factor");
    system.read_if_any("bulge_exponent", air.bulge_exponent);
    if (air.bulge_exponent % 2 != 0) {
      system.fail("bulge_exponent",
                  fmt::format("odd, got {}, must be 2, 4 or 6", air.bulge_exponent));
    }
    if (!root.has("spacecraft")) {
      system.fail(
          "atmosphere",
          fmt::format("without a spacecraft, got {}, must stand beside a table [spacecraft] "
                      "with mass_kg and area_m2, or drag_m2_kg",
                      system.found("atmosphere")));
    }
    earth.atmosphere = air;
    const TableReader spacecraft = root.table("spacecraft");
    spacecraft.check_keys();
    earth.drag_m2_kg = read_drag_coefficient(spacecraft);
  }
  if (!root.has("jet") || !root.table("jet").has("variables")) return;
  const TableReader jet = root.table("jet");
  const std::vector<std::string> variables = jet.texts("variables");
  for (std::size_t i = 0; i < variables.size(); ++i) {
    for (const EarthParameter& parameter : earth_parameters()) {
      const auto& known = earth.parameters;
      const bool is_known = std::find(known.begin(), known.end(), parameter.name) != known.end();
      if (parameter.name != variables[i] || is_known) continue;
      if (const auto force = parameter.missing ? parameter.missing(settings) : std::nullopt) {
        jet.fail_element("variables", i,
                         fmt::format("{}, got \"{}\", must be left out, or {}", force->what,
                                     parameter.name, force->right));
      }
      add_parameter(settings, parameter.name);
    }
  }
}

std::optional<double> read_spacecraft(const TableReader& owner, const SystemSettings& system) {
  if (!owner.has("spacecraft")) return std::nullopt;
  const TableReader table = owner.table("spacecraft");
  if (!system.earth || !system.earth->atmosphere) {
    table.fail("",
               "without air, got a spacecraft, must be left out, or system.model = \"earth\" "
               "with an atmosphere");
  }
  table.check_keys();
  return read_drag_coefficient(table);
}

}  // namespace hamjet::io
