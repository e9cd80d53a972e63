#include "scene_spacecraft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "../../formats/orbit_messages/message_agreement.hpp"
#include "../../studies/earth_system.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "../starts/scene_nominal_file.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "scene_atmosphere.hpp"
#include "spacecraft_coefficients.hpp"

namespace hamjet::io {
namespace {

/// The forces that act on a spacecraft by its surface.
struct SurfaceForces {
  bool has_drag = false;
  bool has_radiation = false;

  explicit SurfaceForces(const SystemSettings& system)
      : has_drag(system.earth && system.earth->atmosphere),
        has_radiation(system.earth && system.earth->radiation) {}
  bool any() const { return has_drag || has_radiation; }
};

void refuse_keys_without(const TableReader& table, const CoefficientKeys& keys,
                         std::string_view what, std::string_view remedy) {
  for (const std::string_view key : {keys.itself, keys.factor, keys.own_area}) {
    if (key.empty() || !table.has(key)) continue;
    table.fail(key, fmt::format("without {}, got {}, must be left out, or beside {}", what,
                                table.found(key), remedy));
  }
}

constexpr std::string_view message_key = "opm_file";

/// The coefficient that the OPM of a table tells; no value if it has no mass or no area. Areas and
/// factors of 0 say that the force does not act.
std::optional<double> coefficient_of_message(const TableReader& table, const CoefficientKeys& keys,
                                             SpacecraftParts& parts) {
  if (!parts.mass_kg || !(parts.*keys.part_area)) return std::nullopt;
  const double mass = *parts.mass_kg, area = *(parts.*keys.part_area);
  const double factor = (parts.*keys.part_factor).value_or(keys.usual_factor);
  if (!(mass > 0) || area < 0 || factor < 0) {
    table.fail(message_key,
               fmt::format("no {}, got a message with a mass of {:.6g} kg, an area of {:.6g} m^2 "
                           "and a coefficient of {:.6g}, must be a positive mass and areas and "
                           "coefficients of at least 0, or beside [spacecraft]",
                           keys.symbol, mass, area, factor));
  }
  parts.*keys.part_factor = factor;
  const double value = factor * area / mass;
  warn_of_unit(table, message_key, keys, value);
  return value;
}

/// What the OPM of a table tells of the forces that there are.
SpacecraftSettings coefficients_of_message(const TableReader& table, const SurfaceForces& forces) {
  SpacecraftSettings settings;
  const auto message = spacecraft_of_orbit_file(table);
  if (!message) return settings;
  settings.parts = {message->mass_kg, message->drag_area_m2, message->drag_coefficient,
                    message->radiation_area_m2, message->radiation_coefficient};
  if (forces.has_drag) {
    settings.drag_m2_kg = coefficient_of_message(table, drag_keys, settings.parts);
  }
  if (forces.has_radiation) {
    settings.radiation_m2_kg = coefficient_of_message(table, radiation_keys, settings.parts);
  }
  return settings;
}

/// A coefficient of an object of a CDM: itself, or what its area and mass make with the usual
/// factor.
std::optional<double> coefficient_of_object(const TableReader& table, const CoefficientKeys& keys,
                                            const std::optional<double>& itself,
                                            const std::optional<double>& area,
                                            const std::optional<double>& mass) {
  if (!itself && !(area && mass)) return std::nullopt;
  const double value = itself ? *itself : keys.usual_factor * *area / *mass;
  if (!(value >= 0) || (!itself && !(*mass > 0))) {
    table.fail("file", fmt::format("no {}, got a message with {:.6g} m^2/kg, must be at least 0, "
                                   "of a positive mass, or beside [spacecraft]",
                                   keys.symbol, value));
  }
  warn_of_unit(table, "file", keys, value);
  return value;
}

/// What the CDM of a table of uncertainty tells of the forces that there are; `usual` is the object
/// that is meant where the table names none.
SpacecraftSettings coefficients_of_conjunction(const TableReader& table, std::string_view usual,
                                               const SurfaceForces& forces) {
  SpacecraftSettings settings;
  if (!table.has("file")) return settings;
  const std::string text = table.content_beside_scene("file", largest_orbit_message_bytes);
  if (!is_cdm(text)) return settings;
  const std::string object = table.has("object") ? table.text("object") : std::string(usual);
  const std::string name = printable(table.path_beside_scene("file").string(), std::string::npos);
  const ConjunctionDataMessage message = read_cdm(name, text);
  for (std::size_t k = 0; k < message.objects.size(); ++k) {
    const ConjunctionObject& one = message.objects[k];
    const std::vector<std::string> names = known_names_of(one);
    const bool is_named = std::find(names.begin(), names.end(), object) != names.end();
    if (!is_named && object != fmt::format("OBJECT{}", k + 1)) continue;
    const ConjunctionSpacecraft& craft = one.spacecraft;
    const auto area_or_whole = [&](const std::optional<double>& own) {
      return own ? own : craft.visible_area_m2;
    };
    if (forces.has_drag) {
      settings.drag_m2_kg = coefficient_of_object(table, drag_keys, craft.drag_m2_kg,
                                                  area_or_whole(craft.drag_area_m2), craft.mass_kg);
    }
    if (forces.has_radiation) {
      settings.radiation_m2_kg =
          coefficient_of_object(table, radiation_keys, craft.radiation_m2_kg,
                                area_or_whole(craft.radiation_area_m2), craft.mass_kg);
    }
    break;
  }
  return settings;
}

/// What the OPM of a table says of a mass and areas that are not read, such as those in other
/// units.
std::string doubts_of_message(const TableReader& table) {
  std::string text;
  if (!table.has(message_key)) return text;
  for (const std::string& doubt : parameters_of_orbit_file(table).doubts) {
    const bool is_of_spacecraft =
        doubt.find("MASS") != std::string::npos || doubt.find("_AREA") != std::string::npos;
    if (is_of_spacecraft) text += "; " + doubt;
  }
  return text;
}

/// Reads the coefficients of the forces that there are. What a deputy's table leaves out is that of
/// `chief`, which is null for the chief itself.
SpacecraftSettings read_coefficients(const TableReader& table, const SurfaceForces& forces,
                                     const SpacecraftParts* chief) {
  table.check_keys();
  if (!forces.has_drag) refuse_keys_without(table, drag_keys, "air", "system.atmosphere");
  if (!forces.has_radiation) {
    refuse_keys_without(table, radiation_keys, "light", "system.radiation = true");
  }
  const bool drag_needs_parts = forces.has_drag && !table.has(drag_keys.itself);
  const bool radiation_needs_parts = forces.has_radiation && !table.has(radiation_keys.itself);
  const std::string_view other = forces.has_drag ? drag_keys.itself : radiation_keys.itself;
  if (table.has("mass_kg") && !drag_needs_parts && !radiation_needs_parts) {
    fail_given_twice(table, "mass_kg", other);
  }
  const bool needs_area =
      drag_needs_parts || (radiation_needs_parts && !table.has(radiation_keys.own_area));
  // An area across the motion may stand beside a sunlit one, also where there is no air.
  const bool may_have_area = radiation_needs_parts && !forces.has_drag;
  if (table.has("area_m2") && !needs_area && !may_have_area) {
    fail_given_twice(table, "area_m2", radiation_needs_parts ? radiation_keys.own_area : other);
  }
  SpacecraftSettings settings;
  const SpacecraftParts known = chief == nullptr ? SpacecraftParts() : *chief;
  if (forces.has_drag && (chief == nullptr || tells(table, drag_keys))) {
    settings.drag_m2_kg = read_coefficient(table, drag_keys, settings.parts, known);
  }
  if (forces.has_radiation && (chief == nullptr || tells(table, radiation_keys))) {
    settings.radiation_m2_kg = read_coefficient(table, radiation_keys, settings.parts, known);
  }
  return settings;
}

void read_light(const TableReader& system, EarthSettings& earth) {
  if (!system.has("radiation") || !system.boolean("radiation")) {
    refuse_alone(system, {"shadow"}, "light", "radiation = true");
    return;
  }
  if (!earth.has_sun) {
    system.fail(
        "radiation",
        "not possible without the Sun, got true with sun = false, must be false, or true with "
        "sun = true");
  }
  RadiationSettings light;
  if (system.has("shadow")) light.shadow = static_cast<ShadowModel>(system.choice("shadow"));
  earth.radiation = light;
}

/// Reads the parameters in which jets are expanded.
void read_parameters(const TableReader& jet, SystemSettings& settings) {
  const EarthSettings& earth = *settings.earth;
  const std::vector<std::string> variables = jet.texts("variables");
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::optional<EarthParameter> parameter = earth_parameter(variables[i]);
    if (!parameter) continue;
    if (const auto force = parameter->missing ? parameter->missing(settings) : std::nullopt) {
      jet.fail_element("variables", i,
                       fmt::format("{}, got \"{}\", must be left out, or {}", force->what,
                                   variables[i], force->right));
    }
    if (parameter->name != variables[i]) {
      jet.fail_element("variables", i,
                       fmt::format("written in another way, got \"{}\", must be \"{}\"",
                                   variables[i], parameter->name));
    }
    const auto& known = earth.parameters;
    if (std::find(known.begin(), known.end(), variables[i]) == known.end()) {
      add_parameter(settings, variables[i]);
    }
  }
}

}  // namespace

const TableDescription& spacecraft_table() {
  static const TableDescription table = {
      {{"mass_kg", form::positive(), absent::other("`drag_m2_kg` and `radiation_m2_kg`"),
        "mass of the spacecraft"},
       {"area_m2", form::positive(), absent::other("the same"), "across its motion"},
       {"drag_coefficient", form::positive(), absent::value(usual_drag_coefficient),
        "C_D, beside mass and area"},
       {"drag_m2_kg", form::number(), absent::other("of mass, area and C_D"),
        "C_D A / m, at least 0"},
       {"sunlit_area_m2", form::positive(), absent::other("`area_m2`"),
        "across the Sun's direction"},
       {"reflection_coefficient", form::between(0, 2), absent::value(usual_reflection_coefficient),
        "C_R, beside mass and area: 1 where all light is absorbed"},
       {"radiation_m2_kg", form::number(), absent::other("of mass, area and C_R"),
        "C_R A / m, at least 0"}},
      "What air and light do to a spacecraft of the model `earth`; a deputy is like the chief in "
      "the keys that it leaves out."};
  return table;
}

std::vector<SceneKey> surface_force_keys() {
  const std::vector<std::string_view> owner = {"earth"};
  return joined<SceneKey>({atmosphere_keys(),
                           {{"radiation", form::boolean(), absent::value(false),
                             "whether the Sun's light presses on a spacecraft", owner},
                            {"shadow", form::choice({shadow_names.begin(), shadow_names.end()}),
                             absent::value(name_of(RadiationSettings().shadow)),
                             "the shadow of the Earth: `conical` has umbra and penumbra", owner}}});
}

void read_surface_forces(const TableReader& root, SystemSettings& settings) {
  if (!settings.earth) {
    if (!root.has("spacecraft")) return;
    root.table("spacecraft")
        .fail("",
              fmt::format("without air or light, got a spacecraft of the model {}, must be left "
                          "out, or system.model = \"earth\" with an atmosphere or radiation",
                          model_name(settings.model)));
  }
  EarthSettings& earth = *settings.earth;
  const TableReader system = root.table("system");
  read_air(system, earth);
  read_light(system, earth);
  const SurfaceForces forces(settings);
  SpacecraftSettings chief;
  if (!root.has("spacecraft")) {
    chief = coefficients_of_message(root.table("nominal"), forces);
    if (forces.any() && root.has("uncertainty")) {
      const auto other = coefficients_of_conjunction(root.table("uncertainty"), "OBJECT1", forces);
      if (!chief.drag_m2_kg) chief.drag_m2_kg = other.drag_m2_kg;
      if (!chief.radiation_m2_kg) chief.radiation_m2_kg = other.radiation_m2_kg;
    }
    const bool lacks_drag = forces.has_drag && !chief.drag_m2_kg;
    if (lacks_drag || (forces.has_radiation && !chief.radiation_m2_kg)) {
      const std::string_view key = lacks_drag ? "atmosphere" : "radiation";
      system.fail(
          key, fmt::format("without a spacecraft, got {}, must stand beside a table "
                           "[spacecraft] with mass_kg and area_m2, or {}, or a message "
                           "nominal.opm_file with MASS and {}, or a CDM in uncertainty.file{}",
                           system.found(key), lacks_drag ? drag_keys.itself : radiation_keys.itself,
                           lacks_drag ? "DRAG_AREA" : "SOLAR_RAD_AREA",
                           doubts_of_message(root.table("nominal"))));
    }
  }
  if (root.has("spacecraft")) {
    const TableReader table = root.table("spacecraft");
    if (!forces.any()) {
      table.fail("",
                 "without air or light, got a spacecraft, must be left out, or system.atmosphere = "
                 "\"harris-priester\" or system.radiation = true");
    }
    chief = read_coefficients(table, forces, nullptr);
  }
  earth.drag_m2_kg = chief.drag_m2_kg.value_or(0);
  earth.radiation_m2_kg = chief.radiation_m2_kg.value_or(0);
  earth.parts = chief.parts;
  if (root.has("jet") && root.table("jet").has("variables")) {
    read_parameters(root.table("jet"), settings);
  }
}

bool uses_message_of_spacecraft(const TableReader& root, const SystemSettings& system) {
  return SurfaceForces(system).any() && !root.has("spacecraft");
}

SpacecraftSettings spacecraft_of_conjunction(const TableReader& root,
                                             const SystemSettings& system) {
  const SurfaceForces forces(system);
  if (!forces.any() || root.has("spacecraft") || !root.has("uncertainty")) return {};
  const TableReader uncertainty = root.table("uncertainty");
  if (!uncertainty.has("deputy")) return {};
  return coefficients_of_conjunction(uncertainty.table("deputy"), "OBJECT2", forces);
}

SpacecraftSettings read_spacecraft(const TableReader& owner, const SystemSettings& system) {
  const SurfaceForces forces(system);
  if (!owner.has("spacecraft")) {
    return forces.any() ? coefficients_of_message(owner, forces) : SpacecraftSettings();
  }
  const TableReader table = owner.table("spacecraft");
  if (!forces.any()) {
    table.fail("",
               "without air or light, got a spacecraft, must be left out, or system.model = "
               "\"earth\" with an atmosphere or radiation");
  }
  return read_coefficients(table, forces, &system.earth->parts);
}

}  // namespace hamjet::io
