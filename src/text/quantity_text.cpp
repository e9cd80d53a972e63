#include "quantity_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace hamjet {
namespace {

/// A value as three digits and the prefix that leaves one to three of them before the point.
std::string prefixed(double value, std::string_view unit) {
  static constexpr const char* prefixes[] = {"f", "p", "n", "μ", "m", "", "k", "M", "G", "T"};
  if (value == 0 || !std::isfinite(value)) return fmt::format("{:g} {}", value, unit);
  const int thousands = static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-12));
  if (thousands < -5 || thousands > 4) return fmt::format("{:.2e} {}", value, unit);
  return fmt::format("{:.3g} {}{}", value / std::pow(1000.0, thousands), prefixes[thousands + 5],
                     unit);
}

}  // namespace

std::string duration_text(double seconds) { return prefixed(seconds, "s"); }
std::string length_text(double metres) { return prefixed(metres, "m"); }
std::string memory_text(double bytes) { return prefixed(bytes, "B"); }

std::string count_text(double count) {
  return count < 1e6 ? fmt::format("{:.0f}", count) : fmt::format("{:.2e}", count);
}

}  // namespace hamjet
