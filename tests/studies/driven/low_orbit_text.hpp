#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace hamjet {

/// The beginning of a scene of a chief on a circle 514 km up in air, about the Earth of degree 2
/// without tesserals, Sun and Moon. `air` is the line, or lines, of the atmosphere.
inline std::string low_orbit_text(std::string_view air, double drag_m2_kg, double i_deg) {
  return fmt::format(R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
gravity_order = 0
sun = false
moon = false
{}
[spacecraft]
drag_m2_kg = {}
[nominal]
epoch_utc = "2026-03-01T06:00:00"
height_km = 514
i_deg = {}
raan_deg = 30
u_deg = 0
)",
                     air, drag_m2_kg, i_deg);
}

/// The same with a deputy at a place along R, T, N, for half a day at order 3.
inline std::string low_pair_text(std::string_view air, double chief, double deputy, double i_deg,
                                 std::string_view position_m) {
  return low_orbit_text(air, chief, i_deg) + fmt::format(R"([deputy]
position_m = [{}]
spacecraft = {{ drag_m2_kg = {} }}
[jet]
order = 3
duration_s = 43200
)",
                                                         position_m, deputy);
}

}  // namespace hamjet
