#include "orbit_message_units.hpp"

#include <algorithm>
#include <map>

namespace hamjet::io {

const std::vector<Quantity>& state_quantities() {
  static const std::vector<Quantity> quantities = {{"X", "km"},       {"Y", "km"},
                                                   {"Z", "km"},       {"X_DOT", "km/s"},
                                                   {"Y_DOT", "km/s"}, {"Z_DOT", "km/s"}};
  return quantities;
}

const std::vector<UnusedPart>& unused_parts() {
  static const std::vector<UnusedPart> parts = {{"Keplerian elements",
                                                 {{"SEMI_MAJOR_AXIS", "km"},
                                                  {"ECCENTRICITY", ""},
                                                  {"INCLINATION", "deg"},
                                                  {"RA_OF_ASC_NODE", "deg"},
                                                  {"ARG_OF_PERICENTER", "deg"},
                                                  {"TRUE_ANOMALY", "deg"},
                                                  {"MEAN_ANOMALY", "deg"},
                                                  {"GM", "km**3/s**2"}}},
                                                {"spacecraft parameters",
                                                 {{"MASS", "kg"},
                                                  {"SOLAR_RAD_AREA", "m**2"},
                                                  {"SOLAR_RAD_COEFF", ""},
                                                  {"DRAG_AREA", "m**2"},
                                                  {"DRAG_COEFF", ""}}},
                                                {"covariance",
                                                 {{"CX_X", "km**2"},
                                                  {"CY_X", "km**2"},
                                                  {"CY_Y", "km**2"},
                                                  {"CZ_X", "km**2"},
                                                  {"CZ_Y", "km**2"},
                                                  {"CZ_Z", "km**2"},
                                                  {"CX_DOT_X", "km**2/s"},
                                                  {"CX_DOT_Y", "km**2/s"},
                                                  {"CX_DOT_Z", "km**2/s"},
                                                  {"CX_DOT_X_DOT", "km**2/s**2"},
                                                  {"CY_DOT_X", "km**2/s"},
                                                  {"CY_DOT_Y", "km**2/s"},
                                                  {"CY_DOT_Z", "km**2/s"},
                                                  {"CY_DOT_X_DOT", "km**2/s**2"},
                                                  {"CY_DOT_Y_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_X", "km**2/s"},
                                                  {"CZ_DOT_Y", "km**2/s"},
                                                  {"CZ_DOT_Z", "km**2/s"},
                                                  {"CZ_DOT_X_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_Y_DOT", "km**2/s**2"},
                                                  {"CZ_DOT_Z_DOT", "km**2/s**2"}}}};
  return parts;
}

const std::vector<SpacecraftQuantity>& spacecraft_quantities() {
  static const std::vector<SpacecraftQuantity> quantities = [] {
    const std::vector<Quantity>& named =
        std::find_if(unused_parts().begin(), unused_parts().end(), [](const UnusedPart& part) {
          return part.name == "spacecraft parameters";
        })->quantities;
    return std::vector<SpacecraftQuantity>{{named[0], &OpmSpacecraft::mass_kg},
                                           {named[1], &OpmSpacecraft::radiation_area_m2},
                                           {named[2], &OpmSpacecraft::radiation_coefficient},
                                           {named[3], &OpmSpacecraft::drag_area_m2},
                                           {named[4], &OpmSpacecraft::drag_coefficient}};
  }();
  return quantities;
}

const std::vector<Quantity>& covariance_quantities() {
  return std::find_if(unused_parts().begin(), unused_parts().end(),
                      [](const UnusedPart& part) { return part.name == "covariance"; })
      ->quantities;
}

const std::vector<Quantity>& manoeuvre_quantities() {
  static const std::vector<Quantity> quantities = {{"MAN_DURATION", "s"},
                                                   {"MAN_DELTA_MASS", "kg"},
                                                   {"MAN_DV_1", "km/s"},
                                                   {"MAN_DV_2", "km/s"},
                                                   {"MAN_DV_3", "km/s"}};
  return quantities;
}

bool is_orbital_frame(std::string_view reference_frame) {
  return reference_frame == "RTN" || reference_frame == "RSW" || reference_frame == "TNW";
}

std::string_view unit_of_keyword(std::string_view keyword) {
  static const std::map<std::string_view, std::string_view> units = [] {
    // Accelerations have keywords only in XML.
    std::map<std::string_view, std::string_view> result = {
        {"X_DDOT", "km/s**2"}, {"Y_DDOT", "km/s**2"}, {"Z_DDOT", "km/s**2"}};
    for (const Quantity& quantity : state_quantities())
      result.emplace(quantity.keyword, quantity.unit);
    for (const Quantity& quantity : manoeuvre_quantities())
      result.emplace(quantity.keyword, quantity.unit);
    for (const UnusedPart& part : unused_parts()) {
      for (const Quantity& quantity : part.quantities) {
        result.emplace(quantity.keyword, quantity.unit);
      }
    }
    return result;
  }();
  const auto found = units.find(keyword);
  return found != units.end() ? found->second : std::string_view();
}

}  // namespace hamjet::io
