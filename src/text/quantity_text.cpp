#include "quantity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace hamjet {
namespace {

/// The value rounded to this number of significant digits.
double rounded_to(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value)) + 1e-12) + 1 - digits);
  return std::round(value / unit) * unit;
}

/// A value as three digits and the prefix that leaves one to three of them before the point. A
/// value below the smallest prefix has an exponent: there a length is zero but for rounding.
std::string prefixed(double value, std::string_view unit) {
  static constexpr const char* prefixes[] = {"p", "n", "μ", "m", "", "k", "M", "G", "T"};
  if (value == 0 || !std::isfinite(value)) return fmt::format("{:g} {}", value, unit);
  const double shown = std::abs(rounded_to(value, 3));
  const int thousands = static_cast<int>(std::floor(std::log10(shown) / 3 + 1e-12));
  if (thousands < -4 || thousands > 4) return fmt::format("{:.2e} {}", value, unit);
  return fmt::format("{:.3g} {}{}", value / std::pow(1000.0, thousands), prefixes[thousands + 4],
                     unit);
}

/// The number with a comma before every three digits of its whole part, if that has five digits or
/// more.
std::string grouped(std::string number) {
  const std::size_t first = number.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(number.find('.'), number.size());
  if (end - first < 5) return number;
  for (std::size_t at = end - 3; at > first && at < end; at -= 3) number.insert(at, ",");
  return number;
}

}  // namespace

std::string duration_text(double seconds) { return prefixed(seconds, "s"); }

std::string days_behind(double seconds) {
  const double days = seconds / 86400;
  return std::abs(days) < 2 ? "" : fmt::format(" ({:.4g} days)", days);
}

std::string length_text(double metres, int digits) {
  const double km = metres / 1000;
  if (!(std::abs(km) >= 1 - 1e-12) || !(std::abs(km) < 1e12)) return prefixed(metres, "m");
  const bool has_fraction = std::abs(km) < std::pow(10.0, digits - 1);
  return grouped(has_fraction ? fmt::format("{:.{}g}", km, digits)
                              : fmt::format("{:.0f}", rounded_to(km, digits))) +
         " km";
}

std::string memory_text(double bytes) { return prefixed(bytes, "B"); }

std::string count_text(double count) {
  return count < 1e6 ? fmt::format("{:.0f}", count) : fmt::format("{:.2e}", count);
}

std::string counted(std::string_view number, std::string_view noun) {
  if (number == "1" || number == "-1") return fmt::format("{} {}", number, noun);
  if (!noun.ends_with('y')) return fmt::format("{} {}s", number, noun);
  noun.remove_suffix(1);
  return fmt::format("{} {}ies", number, noun);
}

}  // namespace hamjet
