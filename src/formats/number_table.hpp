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

/// A table of finite numbers, or a part of one, row after row, one number for each column.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> numbers;
  std::size_t first_row = 0;  ///< number of the part's first row in the table, counted from 0

  std::size_t rows() const { return numbers.size() / columns; }
  std::span<const double> row(std::size_t i) const {
    return std::span(numbers).subspan(i * columns, columns);
  }
  /// The line of the file in which a row of this part stands.
  std::size_t line(std::size_t row) const { return first_row + row + 2; }
};

/// Reads CSV text part by part, so that a table of any length takes little memory. The first line
/// names the columns: exactly those of `columns`, in any order; the parts have the columns in the
/// order of `columns`. Throws Error(input_output), with one line that names file, line and column,
/// for a header with other names (which are quoted only if they look like names of columns), a
/// table without rows, another number of columns, and a field that is not a finite number;
/// Error(too_large) for a line longer than `longest_line`. The locale has no influence.
class NumberTableReader {
 public:
  /// The longest line in bytes; no row of numbers needs more.
  static constexpr std::size_t longest_line = 65536;
  /// Gives the next bytes of the text, as many as fit; returns 0 at the end.
  using Source = std::function<std::size_t(std::span<char>)>;

  /// `name` is the file's name for messages.
  NumberTableReader(std::string name, std::vector<std::string_view> columns, Source source);

  /// The next rows, at most `most_rows`; empty at the end of a table that had some.
  NumberTable read(std::size_t most_rows);

 private:
  /// Puts the next line, without its end, into line_; returns false after the last line.
  bool next_line();
  void read_header();
  void add_row(NumberTable& part);

  std::string name_;
  std::vector<std::string_view> columns_;
  Source source_;
  std::vector<char> bytes_;  ///< bytes that were read from the source
  std::string_view rest_;    ///< the part of `bytes_` that is not yet used
  std::string_view line_;    ///< the current line
  std::size_t line_number_ = 0;
  std::size_t rows_ = 0;             ///< number of rows handed out
  std::vector<std::size_t> places_;  ///< place of each of the file's columns in the table
  std::vector<std::string_view> fields_;
};

/// The number that a text spells, apart from blanks around it, if it is finite and within double
/// precision. The exponent stands after an E or, as in Fortran, a D. No value for any other text.
std::optional<double> finite_number(std::string_view text);

/// A decimal number with 113 significant bits: digits with an optional point, minus sign and
/// exponent after an e. No value for any other text, for a number that is not finite or longer than
/// 100 characters, and for an exponent beyond 5000, which binary128 does not have and which would
/// overflow Boost's reader.
std::optional<Extended> finite_extended_number(std::string_view text);

}  // namespace hamjet::io
