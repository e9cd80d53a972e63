#include "earth_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "../astronomy/physical_constants.hpp"
#include "../astronomy/sunlight.hpp"
#include "../dynamics/fields/atmosphere_field.hpp"
#include "../dynamics/fields/exponential_atmosphere.hpp"
#include "../dynamics/fields/harris_priester_table.hpp"
#include "../dynamics/fields/point_mass_field.hpp"
#include "../dynamics/fields/spherical_harmonic_field.hpp"
#include "hamjet/astronomy/earth_rotation.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "hamjet/dynamics/spacecraft_forces.hpp"
#include "harmonic_parameter.hpp"

namespace hamjet {
namespace {

SphericalHarmonicCoefficients coefficients_of(const EarthSettings& earth) {
  SphericalHarmonicCoefficients result(earth.degree, earth.order);
  for (int n = 0; n <= earth.degree; ++n) {
    for (int m = 0; m <= std::min(n, earth.order); ++m) {
      result.C(n, m) = earth.field->C(n, m);
      result.S(n, m) = earth.field->S(n, m);
    }
  }
  return result;
}

/// A coefficient of the chief, or the parameter of that name where states have one.
SpacecraftCoefficient coefficient(const EarthSettings& earth, std::string_view name, double value) {
  const auto place = std::find(earth.parameters.begin(), earth.parameters.end(), name);
  if (place == earth.parameters.end()) return {value};
  return {value, static_cast<std::size_t>(place - earth.parameters.begin())};
}

constexpr std::string_view density_factor_name = "density_factor";
constexpr std::string_view mu_name = "mu_km3_s2";
constexpr std::array<std::string_view, 3> thrust_names = {"thrust_R_m_s2", "thrust_T_m_s2",
                                                          "thrust_N_m_s2"};

/// J_n = -sqrt(2n + 1) C_n0, by which a zonal coefficient loses its normalisation.
double not_normalised(int n) { return -std::sqrt(2.0 * n + 1); }

/// Why a coefficient is none of the scene's field.
std::optional<MissingForce> beyond_field(const HarmonicParameter& harmonic,
                                         const EarthSettings& earth) {
  using Part = HarmonicParameter::Part;
  const auto [part, n, m] = harmonic;
  if (part != Part::J && m == 0) {
    if (part == Part::S) return MissingForce{"always zero", "a coefficient of order 1 or more"};
    const std::string zonal = HarmonicParameter{Part::J, n, 0}.name();
    return MissingForce{"zonal", fmt::format("{}, which is -sqrt({}) times it", zonal, 2 * n + 1)};
  }
  if (m > n) {
    return MissingForce{fmt::format("of order {} above its degree {}", m, n),
                        "a coefficient of at most the order of its degree"};
  }
  if (n < ZonalCoefficients::lowest) {
    return MissingForce{"0 about the centre of mass", "a coefficient of degree 2 or more"};
  }
  if (n > earth.degree) {
    return MissingForce{fmt::format("beyond the field of degree {}", earth.degree),
                        fmt::format("beside gravity_degree = {} or more", n)};
  }
  if (m > earth.order) {
    return MissingForce{fmt::format("beyond the field of order {}", earth.order),
                        fmt::format("beside gravity_order = {} or more", m)};
  }
  return std::nullopt;
}

EarthParameter parameter_of(const HarmonicParameter& harmonic) {
  EarthParameter parameter;
  parameter.name = harmonic.name();
  parameter.missing = [harmonic](const SystemSettings& s) {
    return beyond_field(harmonic, *s.earth);
  };
  if (harmonic.part == HarmonicParameter::Part::J) {
    parameter.help = "zonal coefficient, not normalised, tide-free";
    parameter.value = [n = harmonic.degree](const SystemSettings& s) {
      return not_normalised(n) * s.earth->field->C(n, 0);
    };
  } else {
    parameter.help = "tesseral coefficient, fully normalised";
    parameter.value = [harmonic](const SystemSettings& s) {
      const SphericalHarmonicCoefficients& field = *s.earth->field;
      const bool is_cosine = harmonic.part == HarmonicParameter::Part::C;
      return is_cosine ? field.C(harmonic.degree, harmonic.order)
                       : field.S(harmonic.degree, harmonic.order);
    };
  }
  return parameter;
}

std::optional<MissingForce> without_air(const SystemSettings& settings) {
  if (settings.earth->atmosphere) return std::nullopt;
  return MissingForce{"of no effect without air", "beside system.atmosphere"};
}

std::vector<EarthParameter> describe_parameters() {
  std::vector<EarthParameter> all = {
      {std::string(drag_parameter), "C_D A / m in m^2/kg",
       [](const SystemSettings& s) { return s.earth->drag_m2_kg; }, without_air},
      {std::string(density_factor_name), "of all densities of the air",
       [](const SystemSettings& s) {
         return s.earth->atmosphere ? s.earth->atmosphere->density_factor : 1;
       },
       without_air},
      {std::string(radiation_parameter), "C_R A / m in m^2/kg",
       [](const SystemSettings& s) { return s.earth->radiation_m2_kg; },
       [](const SystemSettings& s) -> std::optional<MissingForce> {
         if (s.earth->radiation) return std::nullopt;
         return MissingForce{"of no effect without light", "beside system.radiation = true"};
       }},
      {std::string(mu_name), "gravitational parameter of the Earth in km^3/s^2",
       [](const SystemSettings& s) { return s.mu_km3_s2; }}};
  for (const std::string_view name : thrust_names) {
    all.push_back({std::string(name), "constant acceleration along R, T or N of the orbit in m/s^2",
                   [](const SystemSettings&) { return 0.0; }});
  }
  return all;
}

/// Along R, T, N, in canonical units of acceleration; no value where none is a parameter.
std::optional<OrbitThrust> thrust_of(const EarthSettings& earth, const Extended& length_km,
                                     const Extended& time_s) {
  OrbitThrust thrust;
  bool is_there = false;
  for (std::size_t i = 0; i < thrust_names.size(); ++i) {
    thrust.along[i] = coefficient(earth, thrust_names[i], 0);
    is_there = is_there || thrust.along[i].parameter;
  }
  if (!is_there) return std::nullopt;
  thrust.unit = time_s * time_s / (length_km * 1000);
  return thrust;
}

/// mu and the coefficients of the field that are parameters.
void vary_field(const SystemSettings& settings, double canonical_radius,
                GravityOfTurningBody& gravity) {
  const EarthSettings& earth = *settings.earth;
  gravity.scale = coefficient(earth, mu_name, 1);
  if (gravity.scale.parameter) gravity.unit_of_scale = Extended(1) / settings.mu_km3_s2;
  for (const std::string& name : earth.parameters) {
    const auto harmonic = HarmonicParameter::named(name);
    if (!harmonic) continue;
    const auto [part, n, m] = *harmonic;
    SphericalHarmonicCoefficients unit(n, m);
    unit.C(0, 0) = 0;
    if (part == HarmonicParameter::Part::J) {
      unit.C(n, 0) = 1 / not_normalised(n);
    } else {
      (part == HarmonicParameter::Part::C ? unit.C(n, m) : unit.S(n, m)) = 1;
    }
    gravity.variations.push_back(
        {std::make_shared<const SphericalHarmonicField>(1.0, canonical_radius, std::move(unit)),
         coefficient(earth, name, parameter_of(*harmonic).value(settings))});
  }
}

// Splines through the shipped tables are made once: systems are made several times in a study.
struct HarrisPriesterProfiles {
  DensityProfile least;
  DensityProfile greatest;
};

const HarrisPriesterProfiles& harris_priester_profiles() {
  static const HarrisPriesterProfiles profiles = [] {
    const HarrisPriesterTable table = harris_priester_table();
    return HarrisPriesterProfiles{table.minimum, table.maximum};
  }();
  return profiles;
}

const DensityProfile& exponential_profile() {
  static const DensityProfile profile = exponential_table();
  return profile;
}

/// The density of air without a bulge.
const DensityProfile& steady_profile(const AtmosphereSettings& air) {
  return air.model == AtmosphereModel::table ? *air.profile : exponential_profile();
}

/// Whether there is air that bulges towards the Sun.
bool bulges(const EarthSettings& earth) {
  return earth.atmosphere && earth.atmosphere->model == AtmosphereModel::harris_priester;
}

/// Canonical units, and the times between which bodies are to be known.
struct EarthClock {
  EarthClock(const SystemSettings& settings, double canonical_radius)
      : length_km(Extended(settings.radius_km) / canonical_radius),
        time_s(sqrt(length_km * length_km * length_km / settings.mu_km3_s2)),
        epoch{parse_epoch(settings.earth.value().epoch_tt).value()},
        first(convert<double>(Extended(settings.earth->first_s) / time_s)),
        last(convert<double>(Extended(settings.earth->last_s) / time_s)) {}

  std::shared_ptr<const BodyPosition> position_of(PerturbingBody body) const {
    return std::make_shared<const BodyPosition>(body, epoch, time_s, convert<double>(length_km),
                                                first, last);
  }

  Extended length_km;
  Extended time_s;
  Instant epoch;
  double first;
  double last;
};

/// The potential whose force on 1 m^2/kg is the pressure of the Sun's light, in canonical units.
std::shared_ptr<const PointMassField> pressure_potential(const EarthClock& clock) {
  const double length_km = convert<double>(clock.length_km);
  const double time_s = convert<double>(clock.time_s);
  const double distance = astronomical_unit_km / length_km;
  const double acceleration = pressure_of_sun * time_s * time_s / (1000 * length_km);
  return std::make_shared<const PointMassField>(acceleration * distance * distance);
}

}  // namespace

const std::vector<EarthParameter>& earth_parameters() {
  static const std::vector<EarthParameter> parameters = describe_parameters();
  return parameters;
}

std::optional<EarthParameter> earth_parameter(std::string_view name) {
  for (const EarthParameter& parameter : earth_parameters()) {
    if (parameter.name == name) return parameter;
  }
  const auto harmonic = HarmonicParameter::named(name);
  if (!harmonic) return std::nullopt;
  return parameter_of(*harmonic);
}

bool is_of_all_spacecraft(std::string_view name) {
  return name != drag_parameter && name != radiation_parameter &&
         std::find(thrust_names.begin(), thrust_names.end(), name) == thrust_names.end();
}

void add_parameter(SystemSettings& settings, std::string_view name) {
  if (settings.own_names.empty()) {
    const std::vector<std::string_view> names = variable_names(settings);
    settings.own_names.assign(names.begin(), names.end());
  }
  settings.earth.value().parameters.emplace_back(name);
  settings.own_names.emplace_back(name);
}

const DensityProfile& greatest_density(const AtmosphereSettings& air) {
  return air.model == AtmosphereModel::harris_priester ? harris_priester_profiles().greatest
                                                       : steady_profile(air);
}

std::vector<double> parameter_values(const SystemSettings& settings) {
  if (settings.own_text) return state_parameter_values(*settings.own_text);
  std::vector<double> values;
  if (!settings.earth) return values;
  for (const std::string& name : settings.earth->parameters) {
    values.push_back(earth_parameter(name).value().value(settings));
  }
  return values;
}

std::shared_ptr<const BodyPosition> position_of_sun(const SystemSettings& settings,
                                                    double canonical_radius) {
  return EarthClock(settings, canonical_radius).position_of(PerturbingBody::sun);
}

DynamicalSystem earth_system(const SystemSettings& settings, double canonical_radius) {
  const EarthSettings& earth = settings.earth.value();
  const EarthClock clock(settings, canonical_radius);
  const Extended& length_km = clock.length_km;
  const Extended& time_s = clock.time_s;
  GravityOfTurningBody gravity;
  gravity.potential =
      std::make_shared<const SphericalHarmonicField>(1.0, canonical_radius, coefficients_of(earth));
  gravity.axes = std::make_shared<const EarthRotation>(clock.epoch, time_s, clock.first, clock.last,
                                                       earth.orientation);
  const auto add = [&](std::shared_ptr<const BodyPosition> position, double mu_km3_s2) {
    const double mu = mu_km3_s2 / settings.mu_km3_s2;
    gravity.others.push_back({mu, std::make_shared<const PointMassField>(mu), std::move(position)});
  };
  // What attracts, shines and makes the air bulge is one function, asked once a stage.
  std::shared_ptr<const BodyPosition> sun;
  if (earth.has_sun || earth.radiation || bulges(earth)) {
    sun = clock.position_of(PerturbingBody::sun);
  }
  if (earth.has_sun) add(sun, earth.mu_sun_km3_s2);
  if (earth.has_moon) add(clock.position_of(PerturbingBody::moon), earth.mu_moon_km3_s2);
  gravity.parameters = earth.parameters.size();
  if (earth.radiation) {
    gravity.radiation =
        RadiationPressure{pressure_potential(clock), sun, earth.sunlight,
                          coefficient(earth, radiation_parameter, earth.radiation_m2_kg)};
  }
  vary_field(settings, canonical_radius, gravity);
  DynamicalSystem system = earth_gravity(gravity);
  if (const auto thrust = thrust_of(earth, clock.length_km, clock.time_s)) {
    system = with_thrust(system, *thrust);
  }
  if (earth.radiation && earth.sunlight) system.break_times = earth.sunlight->edges();
  if (!earth.atmosphere) return system;
  const AtmosphereSettings& air = *earth.atmosphere;
  // Densities in kg/m^3 times metres a unit of length, so that B in m^2/kg gives canonical forces.
  const double density_unit = convert<double>(length_km) * 1000;
  TurningAtmosphere atmosphere;
  const auto density = [&](const DensityProfile& profile) {
    return std::make_shared<const AtmosphereField>(profile, convert<double>(length_km),
                                                   density_unit);
  };
  if (bulges(earth)) {
    const auto& [least, greatest] = harris_priester_profiles();
    atmosphere.least = density(least);
    atmosphere.greatest = density(greatest);
    atmosphere.sun = sun;
    atmosphere.lag = harris_priester_lag;
    atmosphere.exponent = air.bulge_exponent;
  } else {
    atmosphere.least = density(steady_profile(air));
  }
  atmosphere.rate = earth_rate * convert<double>(time_s);
  atmosphere.factor = coefficient(earth, density_factor_name, air.density_factor);
  return with_drag(system, gravity.axes, atmosphere,
                   coefficient(earth, drag_parameter, earth.drag_m2_kg));
}

}  // namespace hamjet
