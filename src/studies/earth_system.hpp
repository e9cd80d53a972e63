#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/body_position.hpp"
#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Why a parameter has no effect in a scene: what is wrong, and beside what it would be right.
struct MissingForce {
  std::string what;
  std::string right;
};

/// A quantity that may be a parameter of the model `earth`, and with it a variable of jets and a
/// difference between spacecraft. Each is said here alone: `name` is that of jet.variables, which a
/// part of the system finds again by SpacecraftCoefficient.
struct EarthParameter {
  std::string name;
  std::string help;                                    ///< what it is, with its unit
  std::function<double(const SystemSettings&)> value;  ///< the chief's
  /// Why it would have no effect in a scene; null if it always has one.
  std::function<std::optional<MissingForce>(const SystemSettings&)> missing = {};
};
/// All of them but the coefficients of the field.
const std::vector<EarthParameter>& earth_parameters();

/// The parameter of a name: one of these, or a HarmonicParameter, also one that the field of a
/// scene lacks. No value for any other name.
std::optional<EarthParameter> earth_parameter(std::string_view name);

/// Whether a parameter is the same of all spacecraft, as those of the air and of the field are.
bool is_of_all_spacecraft(std::string_view name);

/// C_D A / m and C_R A / m, in m^2/kg.
inline constexpr std::string_view drag_parameter = "drag_m2_kg";
inline constexpr std::string_view radiation_parameter = "radiation_m2_kg";

/// Adds a parameter to the states of the model `earth`, and its name to theirs. Which spacecraft
/// has which value is the caller's to say.
void add_parameter(SystemSettings& settings, std::string_view name);

/// The values of a system's state_parameters: the chief's, or those of an own system.
std::vector<double> parameter_values(const SystemSettings& settings);

/// The position of the Sun in canonical units, of a system with this radius of its field.
std::shared_ptr<const BodyPosition> position_of_sun(const SystemSettings& settings,
                                                    double canonical_radius);

/// The density of the air where it is greatest, at each height in km: that of a bulge's middle.
const DensityProfile& greatest_density(const AtmosphereSettings& air);

/// The system of the model `earth` in canonical units, in which the field's radius is
/// `canonical_radius` and mu is 1; its clock is 0 at the scene's epoch. Throws as EarthRotation and
/// BodyPosition.
DynamicalSystem earth_system(const SystemSettings& settings, double canonical_radius);

}  // namespace hamjet
