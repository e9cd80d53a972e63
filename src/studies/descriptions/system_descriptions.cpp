#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "../../dynamics/double_well.hpp"
#include "../../dynamics/fermi_pasta_ulam.hpp"
#include "../../dynamics/harmonic_oscillator.hpp"
#include "../../dynamics/oscillator_pair.hpp"
#include "../../dynamics/spring_pendulum.hpp"
#include "../earth_system.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "system_description.hpp"

namespace hamjet {
namespace {

const SystemParameter mass = {
    .key = "mass_kg", .help = "mass", .member = &SystemSettings::mass_kg, .is_required = false};

double period_of(double mass_kg, double stiffness_N_per_m) {
  return 2 * std::numbers::pi * std::sqrt(mass_kg / stiffness_N_per_m);
}

std::vector<SystemDescription> describe_systems() {
  return {
      {.model = SystemModel::earth,
       .name = "earth",
       .help = "the real Earth: a field of any degree and order that turns, Sun and Moon; an epoch "
               "and axes in [nominal]: gravity_degree, gravity_order, gravity_file, sun, moon, "
               "atmosphere or radiation beside a table [spacecraft], orientation_file",
       .has_state_parameters = true,
       .is_orbit = true,
       .degrees_of_freedom = {3},
       .make = earth_system},
      {.model = SystemModel::zonal_gravity,
       .name = "zonal-gravity",
       .help = "Earth orbit with J2 to J20, each optional: mu_km3_s2, radius_km, J2, ..., J20; or "
               "gravity_file (ICGEM .gfc) with highest_zonal or zonals",
       .is_orbit = true,
       .degrees_of_freedom = {3},
       .make =
           [](const SystemSettings& s, double canonical_radius) {
             return zonal_gravity({1.0, canonical_radius, s.J});
           }},
      {.model = SystemModel::kepler,
       .name = "kepler",
       .help = "Kepler's problem: mu_km3_s2",
       .is_orbit = true,
       .degrees_of_freedom = {3},
       .parameters = {{.key = "mu_km3_s2",
                       .help = "gravitational parameter",
                       .member = &SystemSettings::mu_km3_s2}},
       .make = [](const SystemSettings&, double) { return kepler(); }},
      {.model = SystemModel::harmonic_oscillator,
       .name = "harmonic-oscillator",
       .help = "one degree of freedom: mass_kg, stiffness_N_per_m",
       .parameters = {mass,
                      {.key = "stiffness_N_per_m",
                       .help = "stiffness of the spring",
                       .member = &SystemSettings::stiffness_N_per_m,
                       .is_required = false}},
       .make = [](const SystemSettings& s,
                  double) { return harmonic_oscillator(s.mass_kg, s.stiffness_N_per_m); },
       .period_s =
           [](const SystemSettings& s) { return period_of(s.mass_kg, s.stiffness_N_per_m); }},
      {.model = SystemModel::double_well,
       .name = "double-well",
       .help = "one degree of freedom, H = p^2/2 + (q^4 - q^2)/2",
       .make = [](const SystemSettings&, double) { return double_well(); }},
      {.model = SystemModel::oscillator_pair,
       .name = "oscillator-pair",
       .help = "two oscillators without coupling: mass_kg, stiffness_N_per_m = [k1, k2]",
       .degrees_of_freedom = {2},
       .parameters = {mass,
                      {.key = "stiffness_N_per_m",
                       .help = "stiffness of the two springs",
                       .member = &SystemSettings::stiffness_N_per_m,
                       .second_member = &SystemSettings::second_stiffness_N_per_m}},
       .make =
           [](const SystemSettings& s, double) {
             return oscillator_pair(s.mass_kg, s.stiffness_N_per_m, s.second_stiffness_N_per_m);
           },
       .period_s =
           [](const SystemSettings& s) {
             return period_of(s.mass_kg, std::min(s.stiffness_N_per_m, s.second_stiffness_N_per_m));
           }},
      {.model = SystemModel::spring_pendulum,
       .name = "spring-pendulum",
       .help = "mass on a spring in a plane, q2 upwards: mass_kg, stiffness_N_per_m, length_m, "
               "gravity_m_s2",
       .degrees_of_freedom = {2},
       .parameters = {mass,
                      {.key = "stiffness_N_per_m",
                       .help = "stiffness of the spring",
                       .member = &SystemSettings::stiffness_N_per_m},
                      {.key = "length_m",
                       .help = "length of the spring at rest",
                       .member = &SystemSettings::length_m},
                      {.key = "gravity_m_s2",
                       .help = "toward negative q2",
                       .member = &SystemSettings::gravity_m_s2,
                       .is_positive = false}},
       .make =
           [](const SystemSettings& s, double) {
             return spring_pendulum(s.mass_kg, s.stiffness_N_per_m, s.length_m, s.gravity_m_s2);
           },
       .no_start_at_origin = "at the point of suspension, where the spring has no direction"},
      {.model = SystemModel::fermi_pasta_ulam,
       .name = "fermi-pasta-ulam",
       .help = "chain of stiff linear and soft quartic springs: omega_rad_per_s, pairs (1 to 4)",
       .degrees_of_freedom = {2, 4, 6, 8},
       .degrees_of_freedom_of = [](const SystemSettings& s) { return 2 * s.pairs; },
       .parameters = {{.key = "omega_rad_per_s",
                       .help = "frequency of the stiff springs",
                       .member = &SystemSettings::omega_rad_per_s},
                      {.key = "pairs",
                       .help = "number of stiff springs",
                       .member = &SystemSettings::pairs,
                       .least = 1,
                       .most = 4}},
       .make = [](const SystemSettings& s,
                  double) { return fermi_pasta_ulam(s.omega_rad_per_s, s.pairs); }},
      {.model = SystemModel::own,
       .name = "own",
       .help = "written in the scene: coordinates, momenta and hamiltonian, or states and "
               "vector_field; parameters, definitions",
       .has_state_parameters = true,
       .degrees_of_freedom = {1, 2, 3, 4, 5, 6, 7, 8},
       .degrees_of_freedom_of = [](const SystemSettings& s) { return s.own_degrees_of_freedom; },
       .make = [](const SystemSettings& s, double) -> DynamicalSystem {
         if (s.own_text) return make_system("own", *s.own_text);
         throw Error(ErrorKind::usage,
                     "an own system without a text is made by its user: Scene::own_system");
       }}};
}

}  // namespace

const std::vector<SystemDescription>& all_systems() {
  static const std::vector<SystemDescription> systems = describe_systems();
  return systems;
}

const SystemDescription& description_of(SystemModel model) {
  return all_systems().at(static_cast<std::size_t>(model));
}

const std::vector<std::string_view>& model_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result;
    for (const SystemDescription& system : all_systems()) result.push_back(system.name);
    return result;
  }();
  return names;
}

std::string_view model_name(SystemModel model) { return description_of(model).name; }

bool is_orbit(SystemModel model) { return description_of(model).is_orbit; }

std::vector<std::size_t> possible_degrees_of_freedom(SystemModel model) {
  return description_of(model).degrees_of_freedom;
}

bool has_state_parameters(SystemModel model) { return description_of(model).has_state_parameters; }

std::vector<std::size_t> possible_dimensions(SystemModel model, std::size_t parameters) {
  std::vector<std::size_t> sizes = possible_degrees_of_freedom(model);
  for (std::size_t& size : sizes) size = 2 * size + parameters;
  return sizes;
}

std::vector<std::string_view> variable_names(SystemModel model, std::size_t degrees_of_freedom) {
  static constexpr std::string_view positions[] = {"q1", "q2", "q3", "q4", "q5", "q6", "q7", "q8"};
  static constexpr std::string_view momenta[] = {"p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"};
  if (is_orbit(model)) return {"x", "y", "z", "px", "py", "pz"};
  if (degrees_of_freedom == 1) return {"q", "p"};
  std::vector<std::string_view> names(std::begin(positions),
                                      std::begin(positions) + degrees_of_freedom);
  names.insert(names.end(), std::begin(momenta), std::begin(momenta) + degrees_of_freedom);
  return names;
}

std::size_t degrees_of_freedom_of(const SystemSettings& settings) {
  const SystemDescription& system = description_of(settings.model);
  if (system.degrees_of_freedom_of != nullptr) return system.degrees_of_freedom_of(settings);
  return system.degrees_of_freedom.front();
}

std::vector<std::string_view> variable_names(const SystemSettings& settings) {
  if (!settings.own_names.empty()) return {settings.own_names.begin(), settings.own_names.end()};
  return variable_names(settings.model, degrees_of_freedom_of(settings));
}

const std::vector<std::string>& state_parameters(const SystemSettings& settings) {
  static const std::vector<std::string> none;
  if (settings.earth) return settings.earth->parameters;
  return settings.own_text ? settings.own_text->state_parameters : none;
}

}  // namespace hamjet
