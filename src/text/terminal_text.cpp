#include "terminal_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "printable_text.hpp"

namespace hamjet::io {
namespace {

using Row = std::vector<std::string>;

constexpr std::string_view blanks_between = "  ";
/// Where a value begins further to the right than this, the lines that continue it are not aligned
/// with the value.
constexpr std::size_t furthest_value = 28;
/// The greatest width of a table's first column, so that the other columns have room.
constexpr std::size_t widest_label = 34;

/// The number of bytes of a line before the word under which continuation lines begin.
std::size_t head_size(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find(blanks_between, begin);
  if (gap == std::string_view::npos) return begin;
  const std::size_t value = line.find_first_not_of(' ', gap);
  return value <= furthest_value ? value : begin;
}

/// The number of bytes of the first word; a number and its unit count as one word.
std::size_t word_size(std::string_view line) {
  constexpr std::size_t longest_unit = 3;
  const std::size_t size = std::min(line.find(' '), line.size());
  const bool is_number = size > 0 && line[size - 1] >= '0' && line[size - 1] <= '9';
  if (!is_number || size == line.size()) return size;
  const std::size_t unit = std::min(line.find(' ', size + 1), line.size()) - size - 1;
  return text_width(line.substr(size + 1, unit)) <= longest_unit ? size + 1 + unit : size;
}

void append_fitted(std::string_view line, std::size_t width, std::string& text) {
  if (text_width(line) <= width) {
    text += line;
    return;
  }
  const std::size_t head = head_size(line);
  const std::size_t column = text_width(line.substr(0, head));
  text += line.substr(0, head);
  line.remove_prefix(head);
  std::size_t used = column;
  for (bool is_first = true; !line.empty(); is_first = false) {
    const std::string_view word = line.substr(0, word_size(line));
    line.remove_prefix(
        std::min(std::max(word.size(), line.find_first_not_of(' ', word.size())), line.size()));
    if (!is_first && used + 1 + text_width(word) > width) {
      text += "\n" + std::string(column, ' ');
      used = column;
    } else if (!is_first) {
      text += " ";
      ++used;
    }
    text += word;
    used += text_width(word);
  }
}

/// The number of bytes at the beginning of a text that fill this many places.
std::size_t bytes_of(std::string_view text, std::size_t places) {
  std::size_t end = 0;
  while (end < text.size() && text_width(text.substr(0, end + 1)) <= places) ++end;
  return end;
}

/// The text, with its middle left out where it takes too many places.
std::string shortened(const std::string& text, std::size_t places) {
  const std::size_t all = text_width(text);
  if (all <= places) return text;
  const std::size_t behind = places / 3;
  return text.substr(0, bytes_of(text, places - behind - 1)) + "…" +
         text.substr(bytes_of(text, all - behind));
}

std::string in_first_column(const std::string& text, std::size_t width) {
  return text + std::string(width - text_width(text), ' ');
}

/// The table of the first column and of the columns `first` to `last` - 1.
std::string part_of_table(const std::vector<Row>& rows, const std::vector<std::size_t>& widths,
                          std::size_t first, std::size_t last) {
  std::string text;
  for (const Row& row : rows) {
    text += in_first_column(row[0], widths[0]);
    for (std::size_t c = first; c < last; ++c) {
      text += blanks_between;
      text += std::string(widths[c] - text_width(row[c]), ' ') + row[c];
    }
    text += "\n";
  }
  return text;
}

/// The rows, all of the same length, without the columns that were not computed.
std::vector<Row> shown_cells(const std::vector<Row>& rows) {
  std::vector<Row> shown(rows.size());
  for (std::size_t c = 0; c < rows[0].size(); ++c) {
    const auto cell = [c](const Row& row) { return c < row.size() ? row[c] : std::string(); };
    const bool is_shown = c == 0 || std::any_of(rows.begin() + 1, rows.end(),
                                                [&](const Row& row) { return !cell(row).empty(); });
    if (!is_shown) continue;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const std::string text = cell(rows[r]);
      shown[r].push_back(c == 0 ? shortened(text, widest_label) : text.empty() ? "-" : text);
    }
  }
  return shown;
}

}  // namespace

std::size_t text_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string fitted(std::string_view given, std::size_t width) {
  const std::string shown = printable_lines(given);
  std::string_view text = shown;
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    append_fitted(text.substr(0, end), width, result);
    if (end == std::string_view::npos) break;
    result += "\n";
    text.remove_prefix(end + 1);
  }
  return result;
}

std::string aligned_table(const std::vector<Row>& rows) {
  const std::vector<Row> shown = shown_cells(rows);
  std::vector<std::size_t> widths(shown[0].size(), 0);
  for (const Row& row : shown) {
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], text_width(row[c]));
  }
  std::string text;
  std::size_t first = 1;
  do {
    std::size_t last = first;
    for (std::size_t used = widths[0]; last < widths.size(); ++last) {
      used += blanks_between.size() + widths[last];
      if (used > terminal_width && last > first) break;
    }
    if (!text.empty()) text += "\n";
    text += part_of_table(shown, widths, first, last);
    first = last;
  } while (first < widths.size());
  return text;
}

}  // namespace hamjet::io
