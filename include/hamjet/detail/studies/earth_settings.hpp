#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/studies/fields.hpp"

namespace hamjet {

class DensityProfile;
class EarthOrientation;
class Sunlight;
class SphericalHarmonicCoefficients;

/// C_D where a scene gives none: of a compact body in free molecular flow.
inline constexpr double usual_drag_coefficient = 2.2;

/// How dense the air is; the exponential one and a table of the scene's have no bulge.
enum class AtmosphereModel { harris_priester, exponential, table };

/// The models' names in scenes and results, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> atmosphere_names = {"harris-priester",
                                                                     "exponential", "table"};

inline std::string_view name_of(AtmosphereModel model) {
  return atmosphere_names[static_cast<std::size_t>(model)];
}

/// The air of the model `earth`, see TurningAtmosphere.
struct AtmosphereSettings {
  AtmosphereModel model = AtmosphereModel::harris_priester;
  double density_factor = 1;            ///< a factor of all densities
  int bulge_exponent = 4;               ///< 2 for low inclinations to 6 for polar orbits
  std::vector<double> heights_km;       ///< the heights of a table: at least 4, increasing
  std::vector<double> densities_kg_m3;  ///< there, positive
  std::string density_file;             ///< the file of the table, as in the scene; may be empty
  std::shared_ptr<const DensityProfile> profile;  ///< through the table
};

/// C_R where a scene gives none: between 1 of a sphere that absorbs and 1.9 of aluminium
/// (Montenbruck and Gill, Satellite Orbits, table 3.5: solar panels 1.21, a high-gain
/// antenna 1.30).
inline constexpr double usual_reflection_coefficient = 1.3;

/// Whether the Earth keeps the Sun's light from a spacecraft.
enum class ShadowModel { conical, none };

/// The models' names in scenes and results, in the order of the enumeration.
inline constexpr std::array<std::string_view, 2> shadow_names = {"conical", "none"};

inline std::string_view name_of(ShadowModel model) {
  return shadow_names[static_cast<std::size_t>(model)];
}

/// What a scene says of a spacecraft as orbit messages do, as far as it does.
struct SpacecraftParts {
  std::optional<double> mass_kg;
  std::optional<double> drag_area_m2;
  std::optional<double> drag_coefficient;
  std::optional<double> radiation_area_m2;
  std::optional<double> radiation_coefficient;
};

/// The pressure of the Sun's light in the model `earth`, see RadiationPressure.
struct RadiationSettings {
  ShadowModel shadow = ShadowModel::conical;
};

/// The model `earth`: the forces that act, and when and how the Earth stands.
struct EarthSettings {
  int degree = 20;
  int order = 20;
  /// A field of at least this degree and order.
  std::shared_ptr<const SphericalHarmonicCoefficients> field;
  bool has_sun = true;
  bool has_moon = true;
  /// The value of DE440 (Park et al., Astron. J. 161:105, 2021).
  double mu_sun_km3_s2 = 132712440041.27942;
  double mu_moon_km3_s2 = 4902.800118;  ///< likewise
  std::string epoch_tt;              ///< the moment at which the scene's clock is 0, ISO 8601 in TT
  std::string orientation_file;      ///< as in the scene; empty without one
  std::string orientation_checksum;  ///< the checksum of the file's content
  std::shared_ptr<const EarthOrientation> orientation;  ///< null without a file
  std::optional<AtmosphereSettings> atmosphere;         ///< absent if there is no drag
  double drag_m2_kg = 0;                                ///< C_D A / m of the chief
  std::optional<RadiationSettings> radiation;  ///< absent if the Sun's light presses on nothing
  double radiation_m2_kg = 0;                  ///< C_R A / m of the chief
  SpacecraftParts parts;                       ///< of which both are made, for messages
  /// The light along the nominal, in canonical times; null where all is lit. See light_nominal.
  std::shared_ptr<const Sunlight> sunlight;
  /// Names of the parameters with which states end, see earth_parameters.
  std::vector<std::string> parameters;
  /// The axes in which the scene gives its orbits; all are flown along those of GCRF.
  std::string axes = "GCRF";
  /// The span in which the scene flies, in seconds from the epoch.
  double first_s = 0;
  double last_s = 0;
};

HAMJET_FIELDS(AtmosphereSettings, model, density_factor, bulge_exponent, heights_km,
              densities_kg_m3, density_file, profile)
HAMJET_FIELDS(SpacecraftParts, mass_kg, drag_area_m2, drag_coefficient, radiation_area_m2,
              radiation_coefficient)
HAMJET_FIELDS(RadiationSettings, shadow)
HAMJET_FIELDS(EarthSettings, degree, order, field, has_sun, has_moon, mu_sun_km3_s2, mu_moon_km3_s2,
              epoch_tt, orientation_file, orientation_checksum, orientation, atmosphere, drag_m2_kg,
              radiation, radiation_m2_kg, parts, sunlight, parameters, axes, first_s, last_s)

}  // namespace hamjet
