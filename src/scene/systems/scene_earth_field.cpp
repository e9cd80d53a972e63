#include "scene_earth_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../store/text_file.hpp"
#include "../../text/scene_message.hpp"
#include "../scene_sections.hpp"
#include "hamjet/formats/gravity_field_file.hpp"
#include "shipped_gravity_field.hpp"

namespace hamjet::io {
namespace {

constexpr int shipped_degree = 20;

const std::vector<std::string_view> tide_systems = {tide_system_name(TideSystem::tide_free),
                                                    tide_system_name(TideSystem::zero_tide)};

/// Largest distance of a file's origin from the centre of mass that is ignored, as for zonal
/// fields.
void require_origin(const TableReader& system, const HarmonicField& field) {
  std::optional<double> distance_km;
  if (const auto& offset = field.origin_offset_km) {
    distance_km = std::hypot((*offset)[0], (*offset)[1], (*offset)[2]);
  }
  require_centre_of_mass(system, distance_km, field.radius_km);
}

/// Refuses a degree beyond the file's.
void require_degree(const TableReader& system, int degree, const GravityModel& model,
                    const std::string& name) {
  if (degree <= model.max_degree) return;
  const std::string right =
      fmt::format("must be at most {}, the max_degree of {}", model.max_degree, name);
  if (system.has("gravity_degree")) {
    system.fail("gravity_degree", fmt::format("beyond the file's, got {}, {}", degree, right));
  }
  system.fail("gravity_file",
              fmt::format("no gravity_degree, whose default of {} is beyond the file's, {}", degree,
                          right));
}

/// Refuses a file whose tide system nobody says, and one that says another than the scene.
void require_tide_system(const TableReader& system, const GravityModel& model,
                         const std::string& name) {
  const bool is_said =
      std::find(tide_systems.begin(), tide_systems.end(), model.tide_system) != tide_systems.end();
  if (!system.has("tide_system")) {
    if (is_said) return;
    system.fail("gravity_file",
                fmt::format("a file that does not say whether C(2,0) contains the permanent tide, "
                            "got tide_system {} in {}, must be tide_free or zero_tide there, or "
                            "with tide_system = \"tide_free\" or \"zero_tide\" in [system]: one "
                            "taken for the other is 10 m after a day of a low orbit",
                            in_quotes(model.tide_system), name));
  }
  if (is_said && system.text("tide_system") != model.tide_system) {
    system.fail(
        "tide_system",
        fmt::format("not that of the file, got {}, must be {}, as in {}, or left out",
                    in_quotes(system.text("tide_system")), in_quotes(model.tide_system), name));
  }
}

/// J_n = -sqrt(2n + 1) C_n0 of normalised coefficients.
ZonalCoefficients zonals_of(const SphericalHarmonicCoefficients& coefficients) {
  ZonalCoefficients J;
  const int highest = std::min(coefficients.degree(), ZonalCoefficients::highest);
  for (int n = ZonalCoefficients::lowest; n <= highest; ++n) {
    J[n] = -std::sqrt(2.0 * n + 1) * coefficients.C(n, 0);
  }
  return J;
}

}  // namespace

std::vector<SceneKey> earth_field_keys() {
  return {{"tide_system",
           form::choice(tide_systems),
           absent::other("of the file"),
           "the tide system of a file that does not say it; the permanent tide is taken out",
           {"earth"}}};
}

void read_earth_field(const TableReader& system, const Epoch& epoch, SystemSettings& settings,
                      EarthSettings& earth) {
  HarmonicChoice choice;
  choice.degree = earth.degree;
  choice.order = earth.order;
  // Solid tides are no force of the model, and their mean is none either.
  choice.tide_system = TideSystem::tide_free;
  if (system.has("tide_system")) {
    choice.tide_system_of_file = static_cast<TideSystem>(system.choice("tide_system"));
  }
  choice.epoch = [epoch]() -> std::optional<Epoch> { return epoch; };
  HarmonicField field;
  if (system.has("gravity_file")) {
    const std::string name = printable_path(system.path_beside_scene("gravity_file"));
    const std::string text =
        system.content_beside_scene("gravity_file", largest_gravity_field_bytes);
    const GravityModel model = parse_gravity_model(name, text);
    require_degree(system, earth.degree, model, name);
    require_tide_system(system, model, name);
    field = parse_harmonic_field(name, text, choice);
  } else {
    if (system.has("tide_system")) {
      system.fail("tide_system", fmt::format("without a gravity_file, got {}, must be left out",
                                             system.found("tide_system")));
    }
    if (earth.degree > shipped_degree) {
      system.fail("gravity_degree",
                  fmt::format("beyond the field that is built in, got {}, must be at most "
                              "{}, or gravity_file of a larger one (ICGEM, .gfc)",
                              earth.degree, shipped_degree));
    }
    field = parse_harmonic_field("EGM96-to-20.gfc", shipped_gravity_field, choice);
  }
  require_origin(system, field);
  settings.mu_km3_s2 = field.mu_km3_s2;
  settings.radius_km = field.radius_km;
  settings.J = zonals_of(field.coefficients);
  settings.gravity_file = gravity_file_of(system, field, 0);
  earth.field =
      std::make_shared<const SphericalHarmonicCoefficients>(std::move(field.coefficients));
}

}  // namespace hamjet::io
