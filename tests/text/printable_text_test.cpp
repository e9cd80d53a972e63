#include "text/printable_text.hpp"

#include <gtest/gtest.h>

#include "text/terminal_text.hpp"

// A text from outside can neither move the cursor nor turn the order of the following text.

namespace hamjet::io {
namespace {

TEST(PrintableText, EscapesControlAndFormatCharacters) {
  const struct {
    std::string text;
    std::string shown;
  } cases[] = {{"\x1b[2J", "\\x1b[2J"},
               {"a\nb\r\tc", "a\\x0ab\\x0d\\x09c"},
               {"\x7f", "\\x7f"},
               {"\u009b31m", "\\xc2\\x9b31m"},     // C1: control sequence introducer
               {"a\u202eb", "a\\xe2\\x80\\xaeb"},  // right-to-left override
               {"\u2066x\u2069", "\\xe2\\x81\\xa6x\\xe2\\x81\\xa9"},  // isolates
               {"\u200f\ufeff", "\\xe2\\x80\\x8f\\xef\\xbb\\xbf"},
               {"\U000e0041", "\\xf3\\xa0\\x81\\x81"},  // a tag
               {"\u2028", "\\xe2\\x80\\xa8"},
               {std::string("\0", 1), "\\x00"},
               {"\xff\xc0", "\\xff\\xc0"},
               {"é 中 Ω 🛰", "é 中 Ω 🛰"}};
  for (const auto& one : cases) {
    EXPECT_EQ(printable(one.text), one.shown);
    EXPECT_EQ(printable(one.shown), one.shown);
  }
}

TEST(PrintableText, OfLinesKeepsTheirEnds) {
  EXPECT_EQ(printable_lines("a\x1b\n\n\u202e"), "a\\x1b\n\n\\xe2\\x80\\xae");
  EXPECT_EQ(printable_lines(""), "");
  EXPECT_EQ(fitted("title\x1b]0;owned\x07\nrow\n"), "title\\x1b]0;owned\\x07\nrow\n");
}

}  // namespace
}  // namespace hamjet::io
