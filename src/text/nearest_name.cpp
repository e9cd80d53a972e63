#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene_message.hpp"

// What a misspelt name should have been.

namespace hamjet::io {
namespace {

/// Damerau's distance in its restricted form: insertions, deletions, substitutions and swaps of
/// neighbours. Source: G. Navarro, A guided tour to approximate string matching, ACM Computing
/// Surveys 33 (2001).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string digits_of(std::string_view name) {
  std::string digits(name);
  std::erase_if(digits, [](char c) { return c < '0' || c > '9'; });
  return digits;
}

std::vector<std::string_view> name_parts(std::string_view name) {
  std::vector<std::string_view> words;
  for (std::size_t end = 0; end != name.npos; name.remove_prefix(std::min(end + 1, name.size()))) {
    end = name.find('_');
    words.push_back(name.substr(0, end));
  }
  return words;
}

/// Whether at least half of the letters of a name are also letters of the candidate.
bool is_half_right(std::string_view name, std::string_view candidate) {
  return 2 * edit_distance(name, candidate) <= std::max(name.size(), candidate.size());
}

/// Whether one name can be a misspelling of the other: half of the letters of each of its words are
/// right. In names of quantities, one letter more or less in a short word makes another quantity or
/// another unit (ma_deg and ta_deg, a_m and a_km), and so does another digit (J2 and J20): short
/// words and digits must therefore be right in full.
bool is_slip(std::string_view name, std::string_view candidate, std::size_t distance) {
  constexpr std::size_t longest_symbol = 2;
  const std::size_t length = std::max(name.size(), candidate.size());
  if (digits_of(name) != digits_of(candidate) || 2 * distance > length) return false;
  const auto words = name_parts(name);
  const auto right = name_parts(candidate);
  if (words.size() != right.size()) return 4 * distance <= length;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == right[i]) continue;
    const std::size_t letters = std::min(words[i].size() - digits_of(words[i]).size(),
                                         right[i].size() - digits_of(right[i]).size());
    const bool is_symbol = letters <= longest_symbol;
    if (is_symbol || !is_half_right(words[i], right[i])) return false;
  }
  return true;
}

/// Keys that scenes of other programs have, and the keys that replace them here. Without this list
/// the nearest key would be suggested, which has another physical meaning.
struct ForeignKeys {
  std::string_view table;
  std::vector<std::string_view> names;
  std::string_view remedy;
};

const std::vector<ForeignKeys>& foreign_keys() {
  static const std::vector<ForeignKeys> keys = {
      {"",
       {"chief", "target", "leader", "reference_orbit", "orbit", "initial_state"},
       "must be [nominal], the start of the chief"},
      {"", {"follower", "chaser", "secondary", "relative_state"}, "must be [deputy]"},
      {"nominal",
       {"M_deg", "m_deg", "mean_anomaly_deg", "mean_anomaly"},
       "must be ma_deg, the mean anomaly"},
      {"nominal",
       {"E_deg", "eccentric_anomaly_deg", "eccentric_anomaly"},
       "must be ea_deg, the eccentric anomaly"},
      {"nominal",
       {"aol_deg", "arglat_deg", "argument_of_latitude_deg"},
       "must be u_deg, the argument of latitude"},
      {"nominal",
       {"h_km", "alt_km", "altitude_km"},
       "must be height_km of a circle, or perigee_height_km with apogee_height_km"},
      {"nominal",
       {"hp_km", "ha_km", "rp_km", "ra_km", "perigee_km", "apogee_km", "perigee_altitude_km",
        "apogee_altitude_km", "perigee_radius_km", "apogee_radius_km"},
       "must be perigee_height_km and apogee_height_km, above radius_km"},
      {"nominal",
       {"n_rad_s", "n_rev_day", "mean_motion", "mean_motion_rev_day", "period_min", "period_h"},
       "mean motion and other units are not read, must be period_s, the period"},
      {"spacecraft",
       {"B", "b", "ballistic_coefficient", "ballistic_coefficient_m2_kg",
        "ballistic_coefficient_kg_m2", "BC", "bc", "beta"},
       "must be drag_m2_kg, C_D A / m in m^2/kg, of a coefficient in kg/m^2 its inverse"},
      {"system",
       {"C20", "C30", "C40", "C50", "C60", "C70", "C80", "C90", "C100", "C110", "C120", "C130",
        "C140", "C150", "C160", "C170", "C180", "C190", "C200"},
       "C_n0 is not read, must be J_n = -C_n0, or -sqrt(2 n + 1) C_n0 of a normalised one"}};
  return keys;
}

}  // namespace

std::optional<std::string_view> nearest(std::string_view name,
                                        const std::vector<std::string_view>& candidates) {
  // No key is near anything this long, and the distance costs time in proportion to the length.
  if (name.size() > 80) return std::nullopt;
  std::optional<std::string_view> best;
  std::size_t best_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : candidates) {
    const bool unit_left_off = candidate.starts_with(std::string(name) + '_');
    const std::size_t distance = unit_left_off ? 0 : edit_distance(name, candidate);
    if ((unit_left_off || is_slip(name, candidate, distance)) && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string_view>& names) {
  constexpr std::size_t most_shown = 42;
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) result += ", ";
    if (i == most_shown) return fmt::format("{}and {} more", result, names.size() - i);
    result += printable(names[i]);
  }
  return result;
}

std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates) {
  const auto near = nearest(name, candidates);
  if (near) return fmt::format("did you mean {}?", printable(*near));
  return fmt::format("must be one of: {}", listed(candidates));
}

std::optional<std::string_view> remedy_for_foreign_key(std::string_view table,
                                                       std::string_view name) {
  for (const ForeignKeys& keys : foreign_keys()) {
    const bool is_one = std::find(keys.names.begin(), keys.names.end(), name) != keys.names.end();
    const bool is_in_table =
        keys.table == table ||
        (!keys.table.empty() && table.ends_with(fmt::format(".{}", keys.table)));
    if (is_in_table && is_one) return keys.remedy;
  }
  return std::nullopt;
}

}  // namespace hamjet::io
