#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "../../store/text_file.hpp"
#include "../../studies/descriptions/system_description.hpp"
#include "../scene_sections.hpp"
#include "hamjet/formats/gravity_field_file.hpp"
#include "scene_earth.hpp"
#include "scene_earth_field.hpp"
#include "scene_own_system.hpp"
#include "scene_spacecraft.hpp"

namespace hamjet::io {
namespace {

/// The keys J_n by n, from ZonalCoefficients::lowest on.
constexpr std::array<std::string_view, 19> zonal_keys = {
    "J2",  "J3",  "J4",  "J5",  "J6",  "J7",  "J8",  "J9",  "J10", "J11",
    "J12", "J13", "J14", "J15", "J16", "J17", "J18", "J19", "J20"};

/// Largest distance, in radii, of a file's origin from the centre of mass that is ignored without a
/// key that asks for it: 0.13 m for the Earth. Frames in which satellites are tracked keep to the
/// Earth's centre of mass within centimetres.
constexpr double largest_origin_offset = 2e-8;

std::string_view zonal_key(int n) {
  return zonal_keys.at(static_cast<std::size_t>(n - ZonalCoefficients::lowest));
}

/// The keys of zonal-gravity, which are read in this file.
std::vector<SceneKey> zonal_gravity_keys() {
  constexpr int lowest = ZonalCoefficients::lowest, highest = ZonalCoefficients::highest;
  const std::vector<std::string_view> owner = {description_of(SystemModel::zonal_gravity).name};
  const std::vector<std::string_view> both = {description_of(SystemModel::earth).name, owner[0]};
  std::vector<SceneKey> keys = {
      {"mu_km3_s2", form::positive(), absent::other("required, or of the file"),
       "gravitational parameter", owner},
      {"radius_km", form::positive(), absent::other("required by a `J_n`, or of the file"),
       "reference radius of the `J_n`", owner},
      {"gravity_file", form::text(),
       absent::other("the keys that it replaces; earth: EGM96 to degree 20"),
       "model of the ICGEM (`.gfc`), relative to the scene's folder", both},
      {"highest_zonal", form::integer(lowest, highest), absent::other("`zonals`, beside a file"),
       "the highest zonal harmonic that is taken from the file", owner},
      {"zonals", form::array(form::integer(lowest, highest)),
       absent::other("`highest_zonal`, beside a file"),
       "the zonal harmonics that are taken from the file, ascending", owner},
      {"gravity_epoch", form_of_epoch(), absent::other("the epoch of the nominal's start"),
       "epoch for a file's coefficients that vary with time", owner},
      {"leave_out_C10", form::boolean(), absent::value(false),
       "whether to leave out C(1,0) of a file whose origin is not the centre of mass", both}};
  // |J| <= 1 is far beyond every planet (Saturn, the most oblate, has J2 = 0.016); a larger number
  // was meant in other units.
  for (const std::string_view key : zonal_keys) {
    keys.push_back(
        {key, form::between(-1, 1), absent::value(0), "not normalised: J_n = -C_n0", owner});
  }
  return keys;
}

SceneKey key_of(const SystemParameter& parameter, std::string_view system) {
  const auto* number = std::get_if<double SystemSettings::*>(&parameter.member);
  const double least = static_cast<double>(parameter.least),
               most = static_cast<double>(parameter.most);
  SceneKey key = {parameter.key,
                  number == nullptr ? form::integer(least, most) : form::number(),
                  absent::refused(),
                  parameter.help,
                  {system}};
  key.form.is_positive = number != nullptr && parameter.is_positive;
  if (parameter.second_member != nullptr) key.form = form::array(key.form, 2);
  if (!parameter.is_required) key.absence = absent::value(SystemSettings().**number);
  return key;
}

/// J1 and J21 look like keys. The nearest existing key would not be what the user meant.
void refuse_other_zonals(const TableReader& system) {
  for (int n = 0; n < 100; ++n) {
    const std::string key = fmt::format("J{}", n);
    const bool is_one = n >= ZonalCoefficients::lowest && n <= ZonalCoefficients::highest;
    if (!is_one && system.has(key)) {
      system.fail(key, fmt::format("unknown key, got {}, must be one of J{} to J{}", key,
                                   ZonalCoefficients::lowest, ZonalCoefficients::highest));
    }
  }
}

/// Reads the zonal coefficients and their reference radius, key by key.
void read_zonals(const TableReader& system, SystemSettings& settings) {
  const auto refuse = [&](std::string_view key, std::string_view right) {
    if (!system.has(key)) return;
    system.fail(
        key, fmt::format("without a gravity_file, got {}, must be {}", system.found(key), right));
  };
  for (const std::string_view key : {"highest_zonal", "zonals"}) {
    refuse(key, "J2 to J20 one by one");
  }
  for (const std::string_view key : {"gravity_epoch", "leave_out_C10"}) refuse(key, "left out");
  settings.mu_km3_s2 = system.number("mu_km3_s2");
  bool needs_radius = system.has("radius_km");
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    if (!system.has(zonal_key(n))) continue;
    settings.J[n] = system.number(zonal_key(n));
    needs_radius = true;
  }
  // Without zonal coefficients the radius has no meaning.
  if (needs_radius) settings.radius_km = system.number("radius_km");
}

ZonalChoice read_zonal_choice(const TableReader& root) {
  const TableReader system = root.table("system");
  ZonalChoice choice;
  if (system.has("gravity_epoch")) {
    choice.epoch = [epoch = read_epoch(system, "gravity_epoch")] { return epoch; };
  } else {
    choice.epoch = [&root] { return epoch_of_start(root); };
  }
  if (system.exactly_one_of({"highest_zonal", "zonals"}) == "highest_zonal") {
    choice.highest = static_cast<int>(system.integer("highest_zonal"));
    return choice;
  }
  for (const std::int64_t n : system.integers("zonals")) {
    const std::size_t index = choice.degrees.size();
    if (index > 0 && n <= choice.degrees.back()) {
      system.fail_element(
          "zonals", index,
          fmt::format("out of order, got {} after {}, must ascend", n, choice.degrees.back()));
    }
    choice.degrees.push_back(static_cast<int>(n));
  }
  return choice;
}

/// Reads the gravity field from a file. The file defines all of it, so that another key beside it
/// would contradict it.
void read_gravity_file(const TableReader& root, SystemSettings& settings) {
  const TableReader system = root.table("system");
  std::vector<std::string_view> keys = {"mu_km3_s2", "radius_km"};
  keys.insert(keys.end(), zonal_keys.begin(), zonal_keys.end());
  for (const std::string_view key : keys) {
    if (system.has(key)) {
      system.fail(key, fmt::format("given twice, got {} here, and the gravity_file has its own; "
                                   "must be left out, or the gravity_file",
                                   system.found(key)));
    }
  }
  const ZonalChoice choice = read_zonal_choice(root);
  const std::string name = printable_path(system.path_beside_scene("gravity_file"));
  const std::string text = system.content_beside_scene("gravity_file", largest_gravity_field_bytes);
  const int max_degree = parse_gravity_model(name, text).max_degree;
  const int degree = choice.degrees.empty() ? choice.highest : choice.degrees.back();
  if (degree > max_degree) {
    system.fail(choice.degrees.empty() ? "highest_zonal" : "zonals",
                fmt::format("beyond the file's, got {}, must be at most {}, the max_degree of {}",
                            degree, max_degree, name));
  }
  const GravityField field = parse_gravity_field(name, text, choice);
  require_centre_of_mass(system, field.origin_offset_km, field.radius_km);
  settings.mu_km3_s2 = field.mu_km3_s2;
  settings.radius_km = field.radius_km;
  settings.J = field.J;
  settings.gravity_file = gravity_file_of(system, field, field.origin_offset_km);
}

void read_pair(const TableReader& system, const SystemParameter& parameter,
               SystemSettings& settings) {
  const std::vector<double> values = system.numbers(parameter.key, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    if (values[i] > 0) continue;
    system.fail_element(parameter.key, i,
                        fmt::format("not positive, got {}, must be a number above 0", values[i]));
  }
  settings.*std::get<double SystemSettings::*>(parameter.member) = values[0];
  settings.*parameter.second_member = values[1];
}

void read_parameter(const TableReader& system, const SystemParameter& parameter,
                    SystemSettings& settings) {
  if (!parameter.is_required && !system.has(parameter.key)) return;
  if (parameter.second_member != nullptr) return read_pair(system, parameter, settings);
  if (const auto* number = std::get_if<double SystemSettings::*>(&parameter.member)) {
    settings.** number = parameter.is_positive ? system.positive_number(parameter.key)
                                               : system.number(parameter.key);
    return;
  }
  settings.*std::get<std::size_t SystemSettings::*>(parameter.member) = static_cast<std::size_t>(
      system.integer_between(parameter.key, parameter.least, parameter.most));
}

}  // namespace

void require_centre_of_mass(const TableReader& system, const std::optional<double>& offset_km,
                            double radius_km) {
  bool is_left_out = false;
  system.read_if_any("leave_out_C10", is_left_out);
  if (is_left_out) return;
  constexpr std::string_view remedy =
      "leave_out_C10 = true, for a scene whose own origin is that "
      "centre";
  if (!offset_km) {
    system.fail("gravity_file",
                fmt::format("C(1,0) varies with time, got a file whose origin moves about the "
                            "centre of mass, must have gravity_epoch in [system] or epoch in "
                            "[ephemeris] beside it, or {}",
                            remedy));
  }
  if (std::abs(*offset_km) <= largest_origin_offset * radius_km) return;
  system.fail("gravity_file",
              fmt::format("the origin is not the centre of mass, got a file with C(1,0) that puts "
                          "that centre at z = {:.4g} m, must be within {:.2g} m, or {}",
                          1000 * *offset_km, 1000 * largest_origin_offset * radius_km, remedy));
}

GravityFile gravity_file_of(const TableReader& system, const GravityModel& field,
                            const std::optional<double>& origin_offset_km) {
  GravityFile result = {.file = system.text_if_any("gravity_file").value_or("built in"),
                        .model_name = field.model_name,
                        .tide_system = field.tide_system,
                        .epoch = field.epoch ? format_epoch(*field.epoch) : "",
                        .origin_offset_m = origin_offset_km};
  if (auto& offset = result.origin_offset_m) *offset *= 1000;
  return result;
}

const TableDescription& system_table() {
  static const TableDescription table = [] {
    std::vector<std::string_view> models;
    for (const SystemDescription& system : all_systems()) models.push_back(system.name);
    TableDescription result{
        {{"model", form::choice(models), absent::refused(), "see `hamjet list systems`"}}};
    for (const SystemDescription& system : all_systems()) {
      if (system.model == SystemModel::zonal_gravity) {
        result.keys = joined<SceneKey>({result.keys, zonal_gravity_keys()});
      }
      if (system.model == SystemModel::earth) {
        result.keys =
            joined<SceneKey>({result.keys, earth_keys(), surface_force_keys(), earth_field_keys()});
      }
      for (const SystemParameter& parameter : system.parameters) {
        result.keys.push_back(key_of(parameter, system.name));
      }
    }
    result.keys = joined<SceneKey>({result.keys, own_keys()});
    return result;
  }();
  return table;
}

SystemSettings read_system(const TableReader& root) {
  const TableReader system = root.table("system");
  if (!system.has("model")) system.check_keys();  // a misspelt `model` is reported first
  SystemSettings settings;
  settings.model = static_cast<SystemModel>(system.choice("model"));
  const bool has_zonals = settings.model == SystemModel::zonal_gravity;
  if (has_zonals) refuse_other_zonals(system);
  const std::string_view model = model_name(settings.model);
  system.check_keys(model, "the model " + std::string(model));
  if (settings.model == SystemModel::earth) {
    read_earth(root, settings);
  } else if (settings.model == SystemModel::own) {
    read_own_system(root, settings);
  } else if (has_zonals && system.has("gravity_file")) {
    read_gravity_file(root, settings);
  } else if (has_zonals) {
    read_zonals(system, settings);
  }
  for (const SystemParameter& parameter : description_of(settings.model).parameters) {
    read_parameter(system, parameter, settings);
  }
  read_surface_forces(root, settings);
  return settings;
}

}  // namespace hamjet::io
