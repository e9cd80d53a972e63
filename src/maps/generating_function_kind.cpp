#include "hamjet/detail/maps/generating_function_kind.hpp"

#include <fmt/format.h>

#include "hamjet/error.hpp"

namespace hamjet {

std::string GeneratingFunctionKind::name() const {
  std::string result;
  for (const bool momentum : final_is_momentum) result += momentum ? 'p' : 'q';
  result += '-';
  for (const bool momentum : initial_is_momentum) result += momentum ? 'p' : 'q';
  return result;
}

std::size_t GeneratingFunctionKind::final_variable(std::size_t i, bool chosen) const {
  return final_is_momentum[i] == chosen ? degrees_of_freedom() + i : i;
}

std::size_t GeneratingFunctionKind::initial_variable(std::size_t i, bool chosen) const {
  return initial_is_momentum[i] == chosen ? degrees_of_freedom() + i : i;
}

GeneratingFunctionKind parse_kind(std::string_view text, std::size_t degrees_of_freedom) {
  const std::size_t n = degrees_of_freedom;
  if (text.size() == 2 && text[0] == 'F' && text[1] >= '1' && text[1] <= '4') {
    const int number = text[1] - '1';
    return {std::vector<bool>(n, number >= 2), std::vector<bool>(n, number % 2 == 1)};
  }
  GeneratingFunctionKind kind;
  bool is_valid = text.size() == 2 * n + 1 && text[n] == '-';
  for (std::size_t i = 0; is_valid && i < text.size(); ++i) {
    if (i == n) continue;
    is_valid = text[i] == 'q' || text[i] == 'p';
    (i < n ? kind.final_is_momentum : kind.initial_is_momentum).push_back(text[i] == 'p');
  }
  if (!is_valid) {
    throw Error(
        ErrorKind::usage,
        fmt::format("generating function kind '{}': allowed are F1, F2, F3, F4 or {} letters "
                    "q or p, a hyphen and {} more, such as '{}'",
                    text, n, n, all_kinds(n).back().name()));
  }
  return kind;
}

std::vector<GeneratingFunctionKind> all_kinds(std::size_t degrees_of_freedom) {
  const std::size_t n = degrees_of_freedom;
  const std::size_t choices = std::size_t{1} << n;
  const auto bits = [&](std::size_t number) {
    std::vector<bool> result(n);
    for (std::size_t i = 0; i < n; ++i) result[i] = (number >> (n - 1 - i) & 1) != 0;
    return result;
  };
  std::vector<GeneratingFunctionKind> result;
  for (std::size_t final_choice = 0; final_choice < choices; ++final_choice) {
    for (std::size_t initial_choice = 0; initial_choice < choices; ++initial_choice) {
      result.push_back({bits(final_choice), bits(initial_choice)});
    }
  }
  return result;
}

}  // namespace hamjet
