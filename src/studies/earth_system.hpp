#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/body_position.hpp"
#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A quantity that may be a parameter of the model `earth`, and with it a variable of jets and a
/// difference between spacecraft.
struct EarthParameter {
  std::string_view name;                  ///< in `jet.variables`, and of its key
  double (*value)(const EarthSettings&);  ///< the chief's
};
const std::vector<EarthParameter>& earth_parameters();

/// C_D A / m and C_R A / m, in m^2/kg.
inline constexpr std::string_view drag_parameter = "drag_m2_kg";
inline constexpr std::string_view radiation_parameter = "radiation_m2_kg";

/// Adds a parameter to the states of the model `earth`, and its name to theirs. Which spacecraft
/// has which value is the caller's to say.
void add_parameter(SystemSettings& settings, std::string_view name);

/// The chief's values of a system's parameters, in the order in which states have them; empty for
/// other models.
std::vector<double> parameter_values(const SystemSettings& settings);

/// The position of the Sun in canonical units, of a system with this radius of its field.
std::shared_ptr<const BodyPosition> position_of_sun(const SystemSettings& settings,
                                                    double canonical_radius);

/// The system of the model `earth` in canonical units, in which the field's radius is
/// `canonical_radius` and mu is 1; its clock is 0 at the scene's epoch. Throws as EarthRotation and
/// BodyPosition.
DynamicalSystem earth_system(const SystemSettings& settings, double canonical_radius);

}  // namespace hamjet
