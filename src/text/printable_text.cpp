#include "printable_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace hamjet::io {
namespace {

struct CodeRange {
  char32_t first;
  char32_t last;
};

/// The characters of Unicode 15.1 in the categories Cc and Cf, and the separators of lines and
/// paragraphs, in ascending order.
constexpr CodeRange unprintable[] = {
    {0x0, 0x1f},        {0x7f, 0x9f},       {0xad, 0xad},       {0x600, 0x605},
    {0x61c, 0x61c},     {0x6dd, 0x6dd},     {0x70f, 0x70f},     {0x890, 0x891},
    {0x8e2, 0x8e2},     {0x180e, 0x180e},   {0x200b, 0x200f},   {0x2028, 0x202e},
    {0x2060, 0x2064},   {0x2066, 0x206f},   {0xfeff, 0xfeff},   {0xfff9, 0xfffb},
    {0x110bd, 0x110bd}, {0x110cd, 0x110cd}, {0x13430, 0x1343f}, {0x1bca0, 0x1bca3},
    {0x1d173, 0x1d17a}, {0xe0001, 0xe0001}, {0xe0020, 0xe007f}};
static_assert(std::is_sorted(std::begin(unprintable), std::end(unprintable),
                             [](const CodeRange& one, const CodeRange& next) {
                               return one.last < next.first;
                             }));

/// The character that a well-formed UTF-8 sequence encodes.
char32_t character(std::string_view sequence) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(sequence[i]); };
  if (sequence.size() == 1) return byte(0);
  char32_t code = byte(0) & (0xffU >> (sequence.size() + 1));
  for (std::size_t i = 1; i < sequence.size(); ++i) code = (code << 6) | (byte(i) & 0x3fU);
  return code;
}

bool is_unprintable(std::string_view sequence) {
  const char32_t code = character(sequence);
  const auto range =
      std::lower_bound(std::begin(unprintable), std::end(unprintable), code,
                       [](const CodeRange& one, char32_t wanted) { return one.last < wanted; });
  return range != std::end(unprintable) && code >= range->first;
}

/// The UTF-8 sequence at the beginning of a text, or its first byte alone where that byte is not
/// UTF-8.
std::string_view next_sequence(std::string_view text) {
  return text.substr(0, std::max<std::size_t>(utf8_sequence_length(text), 1));
}

bool is_escaped(std::string_view sequence) {
  return utf8_sequence_length(sequence) == 0 || is_unprintable(sequence);
}

std::string escaped(std::string_view sequence) {
  std::string result;
  for (const char c : sequence) result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return result;
}

/// Writes the sequence as escapes of a JSON string, which are in UTF-16.
std::string escaped_in_json(std::string_view sequence) {
  char32_t code = character(sequence);
  if (code < 0x10000) return fmt::format("\\u{:04x}", static_cast<std::uint32_t>(code));
  code -= 0x10000;
  return fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + static_cast<std::uint32_t>(code >> 10),
                     0xdc00 + static_cast<std::uint32_t>(code & 0x3ff));
}

}  // namespace

std::string printable(std::string_view text, std::size_t most_characters) {
  constexpr std::size_t escape_length = 4;
  std::string result;
  for (std::size_t count = 0; !text.empty();) {
    const std::string_view sequence = next_sequence(text);
    const bool is_shown = !is_escaped(sequence);
    count += is_shown ? 1 : escape_length * sequence.size();
    if (count > most_characters) return result + "...";
    if (is_shown) {
      result += sequence;
    } else {
      result += escaped(sequence);
    }
    text.remove_prefix(sequence.size());
  }
  return result;
}

std::string printable_lines(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += printable(text.substr(0, end), std::string::npos);
    if (end == text.size()) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", printable(text)); }

std::string printable_json(std::string_view json) {
  std::string result;
  while (!json.empty()) {
    const std::string_view sequence = next_sequence(json);
    // Line ends between the values of a JSON text are layout and stay; inside strings they are
    // escaped already.
    if (sequence == "\n" || !is_escaped(sequence)) {
      result += sequence;
    } else {
      result += escaped_in_json(sequence);
    }
    json.remove_prefix(sequence.size());
  }
  return result;
}

std::size_t utf8_sequence_length(std::string_view text) {
  const auto byte = [text](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto continues = [&byte](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
  const unsigned first = byte(0);
  if (text.empty()) return 0;
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return continues(1) ? 2 : 0;
  if (first >= 0xe0 && first <= 0xef) {
    const bool overlong = first == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = first == 0xed && byte(1) > 0x9f;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool overlong = first == 0xf0 && byte(1) < 0x90;
    const bool beyond_unicode = first == 0xf4 && byte(1) > 0x8f;
    return continues(1) && continues(2) && continues(3) && !overlong && !beyond_unicode ? 4 : 0;
  }
  return 0;
}

}  // namespace hamjet::io
