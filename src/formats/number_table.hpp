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

/// Rows of finite numbers, one a column, row after row: a table, or a part of one.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> numbers;
  std::size_t first_row = 0;  ///< of the part in the table, counted from 0

  std::size_t rows() const { return numbers.size() / columns; }
  std::span<const double> row(std::size_t i) const {
    return std::span(numbers).subspan(i * columns, columns);
  }
  /// The line of the file that a row of this part stands in.
  std::size_t line(std::size_t row) const { return first_row + row + 2; }
};

/// Reads CSV text part by part, so that a table of any length takes little memory. The first line
/// names the columns: exactly those given, in any order; the parts have them in the order given.
/// Throws Error(input_output), one line with file, line and column, for a header with other names
/// (which are quoted only where they look like names of columns), no rows, another number of
/// columns, and what is no finite number; Error(too_large) for a line that is longer than
/// `longest_line`. The locale has no influence.
class NumberTableReader {
 public:
  /// Bytes of a line, which no row of numbers needs.
  static constexpr std::size_t longest_line = 65536;
  /// Gives the next bytes of the text, as many as there is room for; 0 at its end.
  using Source = std::function<std::size_t(std::span<char>)>;

  /// `name` is the file's, for messages.
  NumberTableReader(std::string name, std::vector<std::string_view> columns, Source source);

  /// The next rows, at most `most_rows`; none at the end of a table that had some.
  NumberTable read(std::size_t most_rows);

 private:
  /// Puts the next line, without its end, into line_; false behind the last.
  bool next_line();
  void read_header();
  void add_row(NumberTable& part);

  std::string name_;
  std::vector<std::string_view> columns_;
  Source source_;
  std::vector<char> bytes_;  ///< read from the source
  std::string_view rest_;    ///< of these, what is not yet taken
  std::string_view line_;    ///< the last line
  std::size_t line_number_ = 0;
  std::size_t rows_ = 0;             ///< handed out
  std::vector<std::size_t> places_;  ///< of the file's columns in the table
  std::vector<std::string_view> fields_;
};

/// A number between blanks, finite and within double precision, its exponent behind an E or, as
/// Fortran writes it, a D; no value for any other text.
std::optional<double> finite_number(std::string_view text);

/// A decimal number with 113 significant bits: digits with a point among or behind them, a minus
/// sign, an exponent behind an e. No value if it is anything else, not finite, longer than 100
/// characters, or has an exponent beyond 5000, which binary128 does not have and at which Boost's
/// reader would overflow.
std::optional<Extended> finite_extended_number(std::string_view text);

}  // namespace hamjet::io
