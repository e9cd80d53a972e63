#include "key_unit.hpp"

#include <algorithm>
#include <utility>

namespace hamjet::io {
namespace {

using Ending = std::pair<std::string_view, std::string_view>;

const Ending* ending_of(std::string_view name) {
  static constexpr Ending units[] = {{"_kg_m_s", "kg m/s"},
                                     {"_kg_m3", "kg/m^3"},
                                     {"_m2_kg", "m^2/kg"},
                                     {"_km3_s2", "km^3/s^2"},
                                     {"_km_s", "km/s"},
                                     {"_m_s2", "m/s^2"},
                                     {"_m_s", "m/s"},
                                     {"_N_per_m", "N/m"},
                                     {"_rad_per_s", "rad/s"},
                                     {"_km", "km"},
                                     {"_kg", "kg"},
                                     {"_N", "N"},
                                     {"_deg", "degrees"},
                                     {"_rad", "rad"},
                                     {"_m", "m"},
                                     {"_s", "s"},
                                     {"_canonical", "canonical"},
                                     {"_orbits", "orbits"}};
  const auto* const unit = std::find_if(std::begin(units), std::end(units),
                                        [&](const Ending& u) { return name.ends_with(u.first); });
  return unit != std::end(units) ? unit : nullptr;
}

}  // namespace

std::string_view unit_of(std::string_view name) {
  const Ending* ending = ending_of(name);
  return ending != nullptr ? ending->second : std::string_view();
}

std::string_view without_unit(std::string_view name) {
  const Ending* ending = ending_of(name);
  return ending != nullptr ? name.substr(0, name.size() - ending->first.size()) : name;
}

}  // namespace hamjet::io
