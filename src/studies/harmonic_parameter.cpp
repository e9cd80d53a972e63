#include "harmonic_parameter.hpp"

#include <fmt/format.h>

#include <charconv>

#include "hamjet/detail/dynamics/zonal_coefficients.hpp"

namespace hamjet {
namespace {

/// A number of one to three digits that is written as usual.
std::optional<int> small_number(std::string_view text) {
  constexpr std::size_t most_digits = 3;
  if (text.empty() || text.size() > most_digits || (text.size() > 1 && text[0] == '0')) {
    return std::nullopt;
  }
  int number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

std::string HarmonicParameter::name() const {
  if (part == Part::J) return fmt::format("J{}", degree);
  const char letter = part == Part::C ? 'C' : 'S';
  if (degree < 10 && order < 10) return fmt::format("{}{}{}", letter, degree, order);
  return fmt::format("{}_{}_{}", letter, degree, order);
}

std::optional<HarmonicParameter> HarmonicParameter::named(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  const char letter = text[0];
  const std::string_view indices = text.substr(1);
  if (letter == 'J') {
    const auto degree = small_number(indices);
    if (!degree) return std::nullopt;
    return HarmonicParameter{Part::J, *degree, 0};
  }
  if (letter != 'C' && letter != 'S') return std::nullopt;
  std::string_view degree = indices.substr(0, 1), order = indices.substr(1);
  if (indices[0] == '_') {
    const std::size_t between = indices.find('_', 1);
    if (between == std::string_view::npos) return std::nullopt;
    degree = indices.substr(1, between - 1);
    order = indices.substr(between + 1);
  } else if (indices.size() != 2) {
    return std::nullopt;
  }
  const auto n = small_number(degree), m = small_number(order);
  if (!n || !m) return std::nullopt;
  return HarmonicParameter{letter == 'C' ? Part::C : Part::S, *n, *m};
}

std::string HarmonicParameter::names_of_field(int degree, int order) {
  std::string names = fmt::format("J{} to J{}", ZonalCoefficients::lowest, degree);
  if (order == 0) return names;
  for (const Part part : {Part::C, Part::S}) {
    const auto first = HarmonicParameter{part, ZonalCoefficients::lowest, 1};
    names += fmt::format(", {} to {}", first.name(), HarmonicParameter{part, degree, order}.name());
  }
  return names;
}

}  // namespace hamjet
