#pragma once

#include <optional>
#include <string_view>

#include "../tables/scene_table.hpp"
#include "hamjet/detail/studies/earth_settings.hpp"

namespace hamjet::io {

/// A coefficient of a spacecraft, and the keys that tell it: itself, or its factor beside mass and
/// area.
struct CoefficientKeys {
  std::string_view itself;
  std::string_view factor;
  std::string_view own_area;  ///< in place of area_m2; empty if there is none
  double usual_factor;
  std::string_view symbol;
  double least;  ///< least value of usual spacecraft
  double most;
  std::optional<double> SpacecraftParts::*part_area;
  std::optional<double> SpacecraftParts::*part_factor;
};

/// Spacecraft have C_D A / m from 0.0003 m^2/kg (a sphere of lead, LARES) to some 7 (with a sail
/// that brakes, NanoSail-D); balloons (Echo) had 20. An m / (C_D A) in kg/m^2 is 10 and more.
inline constexpr CoefficientKeys drag_keys = {"drag_m2_kg",
                                              "drag_coefficient",
                                              "",
                                              usual_drag_coefficient,
                                              "C_D A / m",
                                              2e-4,
                                              9,
                                              &SpacecraftParts::drag_area_m2,
                                              &SpacecraftParts::drag_coefficient};
/// From spheres of lead to solar sails; balloons have more.
inline constexpr CoefficientKeys radiation_keys = {"radiation_m2_kg",
                                                   "reflection_coefficient",
                                                   "sunlit_area_m2",
                                                   usual_reflection_coefficient,
                                                   "C_R A / m",
                                                   1e-4,
                                                   1,
                                                   &SpacecraftParts::radiation_area_m2,
                                                   &SpacecraftParts::radiation_coefficient};

/// Warns of a value that hardly any spacecraft has, at the key that gave it.
void warn_of_unit(const TableReader& table, std::string_view key, const CoefficientKeys& keys,
                  double value);

[[noreturn]] void fail_given_twice(const TableReader& table, std::string_view part,
                                   std::string_view other);

/// The coefficient that a table tells, of which mass and area may belong to another one. `parts`
/// are what it is made of, if it is; what the table leaves out is that of the chief, if it has it.
double read_coefficient(const TableReader& table, const CoefficientKeys& keys,
                        SpacecraftParts& parts, const SpacecraftParts& chief);

/// Whether a table says anything about a coefficient.
bool tells(const TableReader& table, const CoefficientKeys& keys);

}  // namespace hamjet::io
