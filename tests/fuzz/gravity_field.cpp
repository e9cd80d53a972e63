#include <cmath>

#include "fuzz_target.hpp"
#include "hamjet/formats/gravity_field_file.hpp"

// Target: a gravity field in the format of ICGEM, all zonal coefficients to degree 6 asked for
// at an epoch, and all harmonics to degree 3.

namespace hamjet::fuzz {
namespace {

void check(const io::GravityField& field) {
  require(std::isnormal(field.mu_km3_s2) && field.mu_km3_s2 > 0, "gravity constant");
  require(std::isnormal(field.radius_km) && field.radius_km > 0, "radius");
  require(field.max_degree >= 6 && field.J.highest_present() <= 6, "degrees");
  for (int n = ZonalCoefficients::lowest; n <= ZonalCoefficients::highest; ++n) {
    require(std::abs(field.J[n]) <= 1, "zonal coefficient");
  }
  require(field.origin_offset_km && std::isfinite(*field.origin_offset_km), "origin");
  require(field.model_name.find('\n') == std::string::npos && field.model_name.size() < 1000,
          "name of the model");
}

void check(const io::HarmonicField& field) {
  for (int n = 0; n <= 3; ++n) {
    for (int m = 0; m <= n; ++m) {
      require(std::abs(field.coefficients.C(n, m)) <= 1, "C");
      require(std::abs(field.coefficients.S(n, m)) <= 1, "S");
    }
  }
  require(field.origin_offset_km && std::isfinite((*field.origin_offset_km)[0]), "origin");
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const io::ZonalChoice choice = {6, {}, [] { return parse_epoch("2006-01-01T06:00:00"); }};
  fuzz::is_read([&] { fuzz::check(io::parse_gravity_field("field.gfc", text, choice)); },
                {{ErrorKind::input_output}, {"field.gfc:"}});
  const io::HarmonicChoice harmonics = {3, 3, {}, {}, choice.epoch};
  fuzz::is_read([&] { fuzz::check(io::parse_harmonic_field("field.gfc", text, harmonics)); },
                {{ErrorKind::input_output}, {"field.gfc:"}});
  return 0;
}
