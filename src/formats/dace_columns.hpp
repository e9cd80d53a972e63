#pragma once

#include <cstddef>
#include <string_view>

// The widths of lines and columns in DACE's text; see hamjet/formats/dace_text.hpp.

namespace hamjet::io::dace {

inline constexpr std::string_view header = "     I  COEFFICIENT              ORDER EXPONENTS";
inline constexpr std::string_view zero = "        ALL COEFFICIENTS ZERO";
inline constexpr std::string_view end = "------------------------------------------------";

inline constexpr std::size_t number_width = 6;
inline constexpr std::size_t coefficient_begin = 8;
inline constexpr std::size_t coefficient_width = 24;
inline constexpr std::size_t degree_begin = 32;
inline constexpr std::size_t degree_width = 4;
inline constexpr std::size_t exponents_begin = 37;
inline constexpr std::size_t exponent_width = 3;

inline constexpr std::size_t most_rows = 999999;
inline constexpr std::size_t most_variables = 34;

}  // namespace hamjet::io::dace
