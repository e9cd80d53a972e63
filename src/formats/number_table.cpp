#include "number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t rows_between_pauses = 4096;

/// The decimal exponents of binary128 stay below this; a larger one would keep the parser busy.
constexpr unsigned largest_exponent = 5000;
constexpr std::size_t longest_number = 100;

/// Length of the run of digits at the start.
std::size_t digits(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

[[noreturn]] void fail(const std::string& name, std::size_t line, const std::string& what) {
  throw Error(ErrorKind::input_output, fmt::format("{}:{}: {}", name, line, what));
}

/// Whether a name is short and ends in a unit that one of the columns has. What is quoted of a
/// header must look like one: the file may be any other, whose content is nobody's business.
bool has_unit_of(std::string_view name, const std::vector<std::string_view>& columns) {
  constexpr std::size_t longest = 24;
  const std::size_t unit = name.find('_');
  return unit != std::string_view::npos && name.size() <= longest &&
         std::any_of(columns.begin(), columns.end(),
                     [&](std::string_view column) { return column.ends_with(name.substr(unit)); });
}

/// For each column of the file the place of its name in `columns`.
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
  // Fortran writes the exponent of double precision behind a D.
  std::string with_e;
  const std::size_t mark = text.find_first_of("Dd");
  if (mark != std::string_view::npos && text.size() <= longest_number) {
    with_e = text;
    with_e[mark] = 'e';
    text = with_e;
  }
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || !std::isfinite(number)) return std::nullopt;
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
  return text.starts_with('-') == signbit(number) ? number : -number;  // -0
}

NumberTable read_number_table(const std::string& name, std::string_view text,
                              const std::vector<std::string_view>& columns,
                              const std::function<void()>& pause) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string_view> fields;
  split_line(take_line(text), fields);
  const std::vector<std::size_t> place = places(name, fields, columns);
  // Empty lines at the end are no rows.
  const std::size_t last = text.find_last_not_of("\r\n");
  text = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
  NumberTable table{columns.size(), {}};
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  table.numbers.resize(text.empty() ? 0 : lines * columns.size());
  for (std::size_t row = 0; !text.empty(); ++row) {
    if (pause && row % rows_between_pauses == 0) pause();
    split_line(take_line(text), fields);
    if (fields.size() != columns.size()) {
      fail(name, NumberTable::line(row),
           fmt::format("has {} columns, must have {}", fields.size(), columns.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto number = finite_number(fields[i]);
      if (!number) {
        fail(name, NumberTable::line(row),
             fmt::format("column {}: must be a finite number, got {}", columns[place[i]],
                         in_quotes(fields[i])));
      }
      table.numbers[row * columns.size() + place[i]] = *number;
    }
  }
  if (table.numbers.empty()) fail(name, 2, "the file has no rows");
  return table;
}

}  // namespace hamjet::io
