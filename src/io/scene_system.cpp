#include <fmt/format.h>

#include "scene_sections.hpp"

namespace hamjet::io {
namespace {

/// Of the chain fermi-pasta-ulam.
constexpr int most_pairs = 4;

const std::vector<std::string_view> all_keys = {
    "model",    "mu_km3_s2",    "radius_km",       "J2",   "J3", "mass_kg", "stiffness_N_per_m",
    "length_m", "gravity_m_s2", "omega_rad_per_s", "pairs"};

std::vector<std::string_view> keys_of(SystemModel model) {
  switch (model) {
    case SystemModel::zonal_gravity:
      return {"model", "mu_km3_s2", "radius_km", "J2", "J3"};
    case SystemModel::kepler:
      return {"model", "mu_km3_s2"};
    case SystemModel::harmonic_oscillator:
    case SystemModel::oscillator_pair:
      return {"model", "mass_kg", "stiffness_N_per_m"};
    case SystemModel::spring_pendulum:
      return {"model", "mass_kg", "stiffness_N_per_m", "length_m", "gravity_m_s2"};
    case SystemModel::fermi_pasta_ulam:
      return {"model", "omega_rad_per_s", "pairs"};
    case SystemModel::double_well:
      break;
  }
  return {"model"};
}

/// A zonal coefficient. |J| <= 1 is far beyond every planet (Saturn, the most oblate, has J2 =
/// 0.016); what is larger was meant in other units.
double zonal_coefficient(const TableReader& system, std::string_view key) {
  return system.has(key) ? system.number_between(key, -1, 1) : 0.0;
}

/// The keys of the models that are no orbits.
void read_mechanics(const TableReader& system, SystemSettings& settings) {
  if (system.has("mass_kg")) settings.mass_kg = system.positive_number("mass_kg");
  switch (settings.model) {
    case SystemModel::harmonic_oscillator:
      if (system.has("stiffness_N_per_m")) {
        settings.stiffness_N_per_m = system.positive_number("stiffness_N_per_m");
      }
      break;
    case SystemModel::oscillator_pair: {
      const std::vector<double> stiffnesses = system.numbers("stiffness_N_per_m", 2);
      for (std::size_t i = 0; i < 2; ++i) {
        if (stiffnesses[i] > 0) continue;
        system.fail_element(
            "stiffness_N_per_m", i,
            fmt::format("not positive, got {}, must be a number above 0", stiffnesses[i]));
      }
      settings.stiffness_N_per_m = stiffnesses[0];
      settings.second_stiffness_N_per_m = stiffnesses[1];
      break;
    }
    case SystemModel::spring_pendulum:
      settings.stiffness_N_per_m = system.positive_number("stiffness_N_per_m");
      settings.length_m = system.positive_number("length_m");
      settings.gravity_m_s2 = system.number("gravity_m_s2");
      break;
    case SystemModel::fermi_pasta_ulam:
      settings.omega_rad_per_s = system.positive_number("omega_rad_per_s");
      settings.pairs = static_cast<std::size_t>(system.integer_between("pairs", 1, most_pairs));
      break;
    default:
      break;
  }
}

}  // namespace

SystemSettings read_system(const TableReader& system) {
  if (!system.has("model")) system.check_keys({all_keys});  // a misspelt `model` is named
  SystemSettings settings;
  settings.model = static_cast<SystemModel>(system.choice("model", model_names()));
  system.check_keys(
      {keys_of(settings.model), all_keys, "the model " + std::string(model_name(settings.model))});
  if (!is_orbit(settings.model)) {
    read_mechanics(system, settings);
    return settings;
  }
  settings.mu_km3_s2 = system.positive_number("mu_km3_s2");
  if (settings.model == SystemModel::zonal_gravity) {
    settings.J2 = zonal_coefficient(system, "J2");
    settings.J3 = zonal_coefficient(system, "J3");
    // Without J2 and J3 nothing refers to the radius.
    if (system.has("J2") || system.has("J3") || system.has("radius_km")) {
      settings.radius_km = system.positive_number("radius_km");
    }
  }
  return settings;
}

}  // namespace hamjet::io
