#include <fmt/format.h>

#include <algorithm>

#include "../../text/printable_text.hpp"
#include "../../text/scene_message.hpp"
#include "expression_part.hpp"
#include "hamjet/dynamics/expression_text.hpp"

namespace hamjet {

using io::in_quotes;

std::string ExpressionPart::words_of_place(std::size_t place) const {
  constexpr std::size_t longest = 24;
  const std::string_view before = text.substr(0, place);
  const std::size_t line_begin = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  std::string words;
  if (text.find('\n') != text.npos) {
    words = fmt::format("line {}, ", 1 + std::count(before.begin(), before.end(), '\n'));
  }
  words += fmt::format("column {}", place - line_begin + 1);
  std::string_view shown = before.substr(line_begin);
  if (shown.size() > longest) {
    shown.remove_prefix(shown.size() - longest);
    // The cut may not go through a character of UTF-8.
    while (!shown.empty() && (static_cast<unsigned char>(shown[0]) & 0xC0) == 0x80) {
      shown.remove_prefix(1);
    }
  }
  return shown.empty() ? words : fmt::format("{}, behind {}", words, in_quotes(shown));
}

void ExpressionPart::fail(const ExpressionToken& token, std::string_view what,
                          std::string_view right) const {
  throw ExpressionTextError(path,
                            fmt::format("{}, got {} at {}, {}", what, in_quotes(text_of(token)),
                                        words_of_place(token.begin), right));
}

std::string part_path(ExpressionPart::Kind kind, const std::string& name) {
  switch (kind) {
    case ExpressionPart::Kind::varied:
    case ExpressionPart::Kind::parameter:
      return "parameters." + io::printable(name);
    case ExpressionPart::Kind::definition:
      return "definitions." + io::printable(name);
    default:
      return io::printable(name);
  }
}

}  // namespace hamjet
