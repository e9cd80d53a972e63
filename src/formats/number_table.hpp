#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"

namespace hamjet::io {

/// Rows of finite numbers, one a column, row after row.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> numbers;

  std::size_t rows() const { return numbers.size() / columns; }
  std::span<const double> row(std::size_t i) const {
    return std::span(numbers).subspan(i * columns, columns);
  }
  /// The line of the file that a row of the table stands in.
  static std::size_t line(std::size_t row) { return row + 2; }
};

/// Reads CSV text whose first line names the columns: exactly `columns`, in any order; the table
/// has them in the order given. `name` is the file's, for messages; `pause` is called every few
/// thousand rows. Throws Error(input_output), one line with file, line and column, for a header
/// with other names (which are quoted only where they look like names of columns), no rows,
/// another number of columns, and what is no finite number. The locale has no influence.
NumberTable read_number_table(const std::string& name, std::string_view text,
                              const std::vector<std::string_view>& columns,
                              const std::function<void()>& pause = {});

/// A number between blanks, finite and within double precision, its exponent behind an E or, as
/// Fortran writes it, a D; no value for any other text.
std::optional<double> finite_number(std::string_view text);

/// A decimal number with 113 significant bits: digits with a point among or behind them, a minus
/// sign, an exponent behind an e. No value if it is anything else, not finite, longer than 100
/// characters, or has an exponent beyond 5000, which binary128 does not have and at which Boost's
/// reader would overflow.
std::optional<Extended> finite_extended_number(std::string_view text);

}  // namespace hamjet::io
