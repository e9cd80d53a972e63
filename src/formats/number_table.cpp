#include "number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "../store/text_file.hpp"
#include "../text/quantity_text.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

/// The decimal exponents of binary128 stay below this; a larger exponent would keep the parser busy
/// for long.
constexpr unsigned largest_exponent = 5000;
constexpr std::size_t longest_number = 100;

/// Length of the sequence of digits at the start.
std::size_t digits(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name, line, what));
}

/// Whether a name is short and ends in a unit that one of the columns has. Names of a header are
/// quoted only if they look like this: the file may be any other file, whose content must not
/// appear in messages.
bool has_unit_of(std::string_view name, const std::vector<std::string_view>& columns) {
  constexpr std::size_t longest = 24;
  const std::size_t unit = name.find('_');
  return unit != std::string_view::npos && name.size() <= longest &&
         std::any_of(columns.begin(), columns.end(),
                     [&](std::string_view column) { return column.ends_with(name.substr(unit)); });
}

/// For each column of the file, the place of its name in `columns`.
std::vector<std::size_t> places(const std::string& name,
                                const std::vector<std::string_view>& header,
                                const std::vector<std::string_view>& columns) {
  const std::string right = fmt::format("the columns must be {}", listed(columns));
  if (header.size() == 1 && without_blanks(header[0]).empty()) {
    fail(name, 1, fmt::format("the header is missing; {}", right));
  }
  if (std::all_of(header.begin(), header.end(), finite_number)) {
    fail(name, 1, fmt::format("numbers where the header must be; {}", right));
  }
  std::vector<std::size_t> result;
  for (const std::string_view field : header) {
    const std::string_view column = without_blanks(field);
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) {
      const bool is_quoted = nearest(column, columns) || has_unit_of(column, columns);
      fail(name, 1,
           fmt::format("unknown column {}; {}",
                       is_quoted ? in_quotes(column) : std::to_string(result.size() + 1), right));
    }
    const auto place = static_cast<std::size_t>(found - columns.begin());
    if (std::find(result.begin(), result.end(), place) != result.end()) {
      fail(name, 1, fmt::format("the column {} is there twice", column));
    }
    result.push_back(place);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (std::find(result.begin(), result.end(), i) == result.end()) {
      fail(name, 1, fmt::format("the column {} is missing; {}", columns[i], right));
    }
  }
  return result;
}

}  // namespace

std::optional<double> finite_number(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto read = [&number](std::string_view whole) {
    const auto [rest, error] = std::from_chars(whole.data(), whole.data() + whole.size(), number);
    if (error != std::errc()) return std::size_t{0};
    return static_cast<std::size_t>(rest - whole.data());
  };
  std::size_t end = read(text);
  // Fortran writes the exponent of double precision after a D.
  const bool has_d = end > 0 && end < text.size() && (text[end] == 'D' || text[end] == 'd');
  if (has_d && text.size() <= longest_number) {
    std::string with_e(text);
    with_e[end] = 'e';
    end = read(with_e);
  }
  if (end == 0 || end != text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<Extended> finite_extended_number(std::string_view text) {
  if (text.size() > longest_number) return std::nullopt;
  std::string_view rest = text;
  if (rest.starts_with('-')) rest.remove_prefix(1);
  const std::size_t before = digits(rest);
  rest.remove_prefix(before);
  std::size_t after = 0;
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    after = digits(rest);
    rest.remove_prefix(after);
  }
  if (before + after == 0) return std::nullopt;
  if (rest.starts_with('e')) {
    rest.remove_prefix(1);
    if (rest.starts_with('+') || rest.starts_with('-')) rest.remove_prefix(1);
    const auto exponent = whole_number<unsigned>(rest);
    if (!exponent || *exponent > largest_exponent) return std::nullopt;
    rest = {};
  }
  if (!rest.empty()) return std::nullopt;
  Extended number{std::string(text)};
  if (!isfinite(number)) return std::nullopt;
  const bool is_negative = signbit(number) != 0;
  return text.starts_with('-') == is_negative ? number : -number;  // -0
}

NumberTableReader::NumberTableReader(std::string name, std::vector<std::string_view> columns,
                                     Source source)
    : name_(std::move(name)),
      columns_(std::move(columns)),
      source_(std::move(source)),
      bytes_(longest_line + 2) {}

bool NumberTableReader::next_line() {
  for (bool is_at_end = false;;) {
    const std::size_t end = rest_.find('\n');
    if (end != std::string_view::npos || (is_at_end && !rest_.empty())) {
      ++line_number_;
      line_ = take_line(rest_);
      return true;
    }
    if (is_at_end) return false;
    if (rest_.size() == bytes_.size()) {
      throw Error(ErrorKind::too_large,
                  fmt::format("{}:{}: a line of more than {} bytes, must be a row of {}", name_,
                              line_number_ + 1, longest_line, counted(columns_.size(), "number")));
    }
    const std::size_t kept = rest_.size();
    if (kept > 0) std::memmove(bytes_.data(), rest_.data(), kept);
    const std::size_t count = source_(std::span(bytes_).subspan(kept));
    rest_ = {bytes_.data(), kept + count};
    is_at_end = count == 0;
  }
}

void NumberTableReader::read_header() {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (!next_line()) line_ = {};
  if (line_.starts_with(byte_order_mark)) line_.remove_prefix(byte_order_mark.size());
  split_line(line_, fields_);
  places_ = places(name_, fields_, columns_);
}

void NumberTableReader::add_row(NumberTable& part) {
  split_line(line_, fields_);
  if (fields_.size() != columns_.size()) {
    fail(name_, line_number_,
         fmt::format("has {} columns, must have {}", fields_.size(), columns_.size()));
  }
  const std::size_t begin = part.numbers.size();
  part.numbers.resize(begin + columns_.size());
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto number = finite_number(fields_[i]);
    if (!number) {
      fail(name_, line_number_,
           fmt::format("column {}: must be a finite number, got {}", columns_[places_[i]],
                       in_quotes(fields_[i])));
    }
    part.numbers[begin + places_[i]] = *number;
  }
}

NumberTable NumberTableReader::read(std::size_t most_rows) {
  if (places_.empty()) read_header();
  NumberTable part{columns_.size(), {}, rows_};
  while (part.rows() < most_rows && next_line()) {
    if (!line_.empty()) {
      add_row(part);
      continue;
    }
    // Empty lines at the end are not rows; empty lines elsewhere are rows with too few columns.
    const std::size_t first_empty = line_number_;
    bool has_more = true;
    while (line_.empty() && (has_more = next_line())) {
    }
    if (!has_more) break;
    fail(name_, first_empty, fmt::format("has 1 columns, must have {}", columns_.size()));
  }
  rows_ += part.rows();
  if (rows_ == 0) fail(name_, 2, "the file has no rows");
  return part;
}

}  // namespace hamjet::io
