#include "content_checksum.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../store/sealed_summary.hpp"
#include "jet_description.hpp"
#include "stored_coefficients.hpp"

namespace hamjet::io {

std::string content_checksum(const StoredJet& description, const FlowJet<Extended>& jet) {
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{:.17g} {:.17g} {:.17g}\n{:.17g}\n{:.17g}\n{}\n{}\n{:.17g}\n",
      description.scene, description.label, model_name(description.model),
      static_cast<int>(description.precision), description.units.length_km,
      description.units.time_s, description.duration, fmt::join(description.nominal_initial, " "),
      fmt::join(description.nominal_final, " "), fmt::join(description.components, " "),
      fmt::join(description.variables, " "), fmt::join(description.error_by_degree, " "));
  if (const auto& ephemeris = description.ephemeris) {
    text += fmt::format("{}\n{}\n{}\n{}\n{}\n", ephemeris->epoch, ephemeris->time_system,
                        ephemeris->reference_frame, ephemeris->reference_frame_epoch,
                        ephemeris->center_name);
  }
  if (description.start_time != ClockTime::epoch()) {
    text += fmt::format("start {:.17g}\n", description.start_time.in<double>());
  }
  if (!description.is_autonomous) text += "not autonomous\n";
  if (description.coordinates != JetCoordinates::cartesian) {
    text += name_of(description.coordinates) + "\n";
  }
  if (const auto& box = description.flow_box) {
    text += fmt::format("{}\n{:.17g}\n", name_of(box->section), box->field.radius);
    for (const double J : box->field.J.values()) text += fmt::format("{:.17g}\n", J);
    text += polynomials_csv(description, jet);
    return fmt::format("{:08x}", record_of({}, text).crc32);
  }
  text += coefficients_csv(description.variable_names(), description.components,
                           description.variables, description.precision, jet);
  return fmt::format("{:08x}", record_of({}, text).crc32);
}

}  // namespace hamjet::io
