#include "spacecraft_coefficients.hpp"

#include <fmt/format.h>

#include <string>

namespace hamjet::io {
namespace {

/// The limits are far outside what is used, so that what they find is a slip, as 220 for 2.2.
void warn_of_drag_coefficient(const TableReader& table, double factor) {
  constexpr double least = 1, most = 6;
  if (factor >= least && factor <= most) return;
  table.warn(drag_keys.factor,
             fmt::format("of no spacecraft, got C_D = {:.6g}, should be from {} to {}; most have "
                         "about {}",
                         factor, least, most, usual_drag_coefficient));
}

/// A number of a table, or the chief's where the table leaves it out and the chief has it.
double positive_or(const TableReader& table, std::string_view key,
                   const std::optional<double>& of_chief) {
  return of_chief && !table.has(key) ? *of_chief : table.positive_number(key);
}

/// The key of the area to which a coefficient belongs; empty if it is the chief's.
std::string_view area_key_of(const TableReader& table, const CoefficientKeys& keys,
                             const SpacecraftParts& chief) {
  constexpr std::string_view whole = "area_m2";
  if (!keys.own_area.empty() && table.has(keys.own_area)) return keys.own_area;
  const std::optional<double>& of_chief = chief.*keys.part_area;
  if (!of_chief) return whole;
  const bool is_another = chief.drag_area_m2 && *of_chief != *chief.drag_area_m2;
  return table.has(whole) && !is_another ? whole : std::string_view();
}

}  // namespace

void warn_of_unit(const TableReader& table, std::string_view key, const CoefficientKeys& keys,
                  double value) {
  if (value == 0 || (value >= keys.least && value <= keys.most)) return;
  table.warn(key,
             fmt::format("{} of hardly any spacecraft, got {:.4g} m^2/kg, should be from {} to "
                         "{}; {}?",
                         keys.symbol, value, keys.least, keys.most,
                         value > keys.most ? "is the area in cm^2, or the coefficient kg/m^2"
                                           : "is the mass in g, or the coefficient km^2/kg"));
}

void fail_given_twice(const TableReader& table, std::string_view part, std::string_view other) {
  table.fail(part, fmt::format("given twice, got {} beside {}, must be left out, or {}",
                               table.found(part), other, other));
}

double read_coefficient(const TableReader& table, const CoefficientKeys& keys,
                        SpacecraftParts& parts, const SpacecraftParts& chief) {
  if (table.has(keys.itself)) {
    for (const std::string_view part : {keys.factor, keys.own_area}) {
      if (!part.empty() && table.has(part)) fail_given_twice(table, part, keys.itself);
    }
    const double value = table.number(keys.itself);
    if (value < 0) {
      table.fail(keys.itself, fmt::format("negative, got {}, must be at least 0", value));
    }
    warn_of_unit(table, keys.itself, keys, value);
    return value;
  }
  const std::string_view area_key = area_key_of(table, keys, chief);
  const double mass = positive_or(table, "mass_kg", chief.mass_kg);
  const double area = area_key.empty() ? *(chief.*keys.part_area) : table.positive_number(area_key);
  double factor = (chief.*keys.part_factor).value_or(keys.usual_factor);
  table.read_if_any(keys.factor, factor);
  if (keys.factor == drag_keys.factor) warn_of_drag_coefficient(table, factor);
  parts.mass_kg = mass;
  parts.*keys.part_area = area;
  parts.*keys.part_factor = factor;
  const double value = factor * area / mass;
  warn_of_unit(table,
               !area_key.empty()      ? area_key
               : table.has("mass_kg") ? std::string_view("mass_kg")
                                      : keys.factor,
               keys, value);
  return value;
}

bool tells(const TableReader& table, const CoefficientKeys& keys) {
  for (const std::string_view key : {keys.itself, keys.factor, keys.own_area,
                                     std::string_view("mass_kg"), std::string_view("area_m2")}) {
    if (!key.empty() && table.has(key)) return true;
  }
  return false;
}

}  // namespace hamjet::io
