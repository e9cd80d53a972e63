#include "system_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "../../store/json_values.hpp"
#include "../../studies/descriptions/system_description.hpp"
#include "../scene_sections.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json texts_json(const std::vector<NamedText>& texts) {
  Json json = Json::object();
  for (const NamedText& text : texts) json[text.name] = text.text;
  return json;
}

/// A system as its scene writes it; null for one that was made in C++.
Json own_json(const std::optional<SystemText>& text) {
  if (!text) return nullptr;
  Json json = Json::object();
  if (text->is_hamiltonian()) {
    json["coordinates"] = text->coordinates;
    json["momenta"] = text->momenta;
    json["hamiltonian"] = text->hamiltonian;
  } else {
    json["states"] = text->states;
    json["vector_field"] = texts_json(text->vector_field);
  }
  json["parameters"] = texts_json(text->parameters);
  if (!text->state_parameters.empty()) json["state_parameters"] = text->state_parameters;
  json["definitions"] = texts_json(text->definitions);
  return json;
}

/// The parameters that the model has, by the keys of scenes.
Json mechanics_json(const SystemSettings& system) {
  Json json = Json::object();
  for (const SystemParameter& parameter : description_of(system.model).parameters) {
    Json& value = json[std::string(parameter.key)];
    std::visit([&](auto member) { value = json_value(system.*member); }, parameter.member);
    if (parameter.second_member != nullptr) {
      value = {value, json_value(system.*parameter.second_member)};
    }
  }
  return json;
}

}  // namespace

Json system_json(const SystemSettings& system) {
  if (system.model == SystemModel::own) return own_json(system.own_text);
  if (!is_orbit(system.model)) return mechanics_json(system);
  Json J = Json::object();
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    if (system.J[n] != 0) J[fmt::format("J{}", n)] = system.J[n];
  }
  Json json = {{"mu_km3_s2", system.mu_km3_s2},
               {"radius_km", J.empty() ? Json(nullptr) : Json(system.radius_km)},
               {"zonal_coefficients", J},
               {"gravity_file", nullptr}};
  if (system.gravity_file) {
    json["gravity_file"] = {{"file", system.gravity_file->file},
                            {"model_name", text_or_null(system.gravity_file->model_name)},
                            {"tide_system", system.gravity_file->tide_system},
                            {"epoch", text_or_null(system.gravity_file->epoch)},
                            {"origin_offset_m", json_value(system.gravity_file->origin_offset_m)}};
  }
  if (const auto& earth = system.earth) {
    const auto of_air = [&](const auto& value) {
      return earth->atmosphere ? Json(value(*earth)) : Json(nullptr);
    };
    const auto of_light = [&](const auto& value) {
      return earth->radiation ? Json(value(*earth)) : Json(nullptr);
    };
    json["earth"] = {
        {"gravity_degree", earth->degree},
        {"gravity_order", earth->order},
        {"sun_mu_km3_s2", earth->has_sun ? Json(earth->mu_sun_km3_s2) : Json(nullptr)},
        {"moon_mu_km3_s2", earth->has_moon ? Json(earth->mu_moon_km3_s2) : Json(nullptr)},
        {"epoch_tt", earth->epoch_tt},
        {"orientation_file", text_or_null(earth->orientation_file)},
        {"atmosphere", of_air([](const EarthSettings& e) { return name_of(e.atmosphere->model); })},
        {"density_factor",
         of_air([](const EarthSettings& e) { return e.atmosphere->density_factor; })},
        {"bulge_exponent",
         of_air([](const EarthSettings& e) { return e.atmosphere->bulge_exponent; })},
        {"density_file",
         of_air([](const EarthSettings& e) { return text_or_null(e.atmosphere->density_file); })},
        {"drag_m2_kg", of_air([](const EarthSettings& e) { return e.drag_m2_kg; })},
        {"radiation_m2_kg", of_light([](const EarthSettings& e) { return e.radiation_m2_kg; })},
        {"shadow", of_light([](const EarthSettings& e) { return name_of(e.radiation->shadow); })},
        {"axes", earth->axes}};
  }
  return json;
}

Json units_json(const CanonicalUnits& units, const std::optional<double>& mass_kg) {
  Json json = {{"length_km", units.length_km}, {"time_s", units.time_s}};
  if (mass_kg) {
    json["mass_kg"] = *mass_kg;
    json["momentum_kg_m_s"] = momentum_kg_m_s(units, *mass_kg);
    json["energy_J"] = energy_J(units, *mass_kg);
  }
  return json;
}

Json integrator_json(const IntegratorSettings& settings) {
  const std::vector<std::string_view> keys = integrator_keys(settings.method);
  Json json;
  for_each_field(settings, [&](std::string_view name, const auto& member) {
    const bool is_of_method = std::find(keys.begin(), keys.end(), name) != keys.end();
    json[std::string(name)] = is_of_method ? json_value(member) : Json(nullptr);
  });
  return json;
}

Json ephemeris_json(const Scene& scene) {
  if (!scene.ephemeris) return nullptr;
  const EphemerisSettings& settings = *scene.ephemeris;
  return {{"epoch", settings.epoch},
          {"time_system", settings.time_system},
          {"reference_frame", settings.reference_frame},
          {"reference_frame_epoch", text_or_null(settings.reference_frame_epoch)},
          {"center_name", settings.center_name},
          {"object_name", settings.object_name},
          {"object_id", settings.object_id}};
}

Json nominal_file_json(const Scene& scene) {
  if (!scene.nominal_file) return nullptr;
  const NominalFile& file = *scene.nominal_file;
  return {{"path", file.path}, {"format", file.format}, {"unused", file.unused}};
}

}  // namespace hamjet::io
