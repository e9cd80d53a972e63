#include "scene_earth_field.hpp"

#include <fmt/format.h>

#include <cmath>

#include "../dynamics/fields/spherical_harmonic_coefficients.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/formats/gravity_field_file.hpp"
#include "scene_sections.hpp"
#include "shipped_gravity_field.hpp"

namespace hamjet::io {
namespace {

constexpr int shipped_degree = 20;

const std::vector<std::string_view> tide_systems = {"tide_free", "zero_tide"};

/// By how much the normalised C(2,0) of a field without permanent tides is above that with them: A0
/// H0 k20 / sqrt(5), IERS Conventions (2010), equation 6.14.
constexpr double permanent_tide = 4.4228e-8 * 0.31460 * 0.30190;

/// Takes the permanent tide out of C(2,0), for the tides of Sun and Moon are no force of the model.
void take_out_permanent_tide(const TableReader& system, const std::string& of_file,
                             SphericalHarmonicCoefficients& field) {
  std::string tides = of_file;
  if (system.has("tide_system")) {
    tides = tide_systems[system.choice("tide_system")];
    if (of_file != "unknown" && tides != of_file) {
      system.fail("tide_system",
                  fmt::format("not that of the file, got {} and tide_system {} in its "
                              "header, must be left out",
                              in_quotes(tides), in_quotes(of_file)));
    }
  }
  if (tides == "tide_free") return;
  if (tides != "zero_tide") {
    system.fail(
        "gravity_file",
        fmt::format("a tide system that is not known, got {} in its header, must be "
                    "tide_free or zero_tide, or tide_system in the scene; the two differ by "
                    "10 m a day in a low orbit",
                    in_quotes(of_file)));
  }
  if (field.degree() >= 2) field.C(2, 0) += permanent_tide;
}

}  // namespace

std::vector<SceneKey> earth_field_keys() {
  return {{"tide_system",
           form::choice(tide_systems),
           absent::other("of the file"),
           "of a file that does not say it; the permanent tide is taken out",
           {"earth"}}};
}

void read_earth_field(const TableReader& system, const Epoch& epoch, SystemSettings& settings,
                      EarthSettings& earth) {
  const HarmonicChoice choice = {earth.degree, earth.order,
                                 [epoch]() -> std::optional<Epoch> { return epoch; }};
  HarmonicField field;
  if (system.has("gravity_file")) {
    field = parse_harmonic_field(
        printable_path(system.path_beside_scene("gravity_file")),
        system.content_beside_scene("gravity_file", largest_gravity_field_bytes), choice);
  } else {
    if (system.has("tide_system")) {
      system.fail("tide_system", fmt::format("without a gravity_file, got {}, must be left out",
                                             system.found("tide_system")));
    }
    if (earth.degree > shipped_degree) {
      system.fail("degree",
                  fmt::format("beyond the field that is built in, got {}, must be at most "
                              "{}, or gravity_file of a larger one (ICGEM, .gfc)",
                              earth.degree, shipped_degree));
    }
    field = parse_harmonic_field("EGM96-to-20.gfc", shipped_gravity_field, choice);
  }
  take_out_permanent_tide(system, field.zonal.tide_system, *field.coefficients);
  require_centre_of_mass(system, field.zonal);
  settings.mu_km3_s2 = field.zonal.mu_km3_s2;
  settings.radius_km = field.zonal.radius_km;
  settings.J = field.zonal.J;
  settings.gravity_file = gravity_file_of(system, field.zonal);
  earth.field = std::move(field.coefficients);
}

}  // namespace hamjet::io
