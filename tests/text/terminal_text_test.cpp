#include "text/terminal_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/text.hpp"

// Texts are fitted to a terminal; the expected lines were counted by hand.

namespace hamjet::io {
namespace {

TEST(FittedText, BreaksBetweenWordsAndLeavesShortLinesAlone) {
  EXPECT_EQ(fitted("one two three", 9), "one two\nthree");
  EXPECT_EQ(fitted("one two three\n\n  four  five\n", 13), "one two three\n\n  four  five\n");
  EXPECT_EQ(fitted("", 9), "");
}

TEST(FittedText, GoesOnUnderTheValue) {
  EXPECT_EQ(fitted("  name   one two three", 16), "  name   one two\n         three");
  EXPECT_EQ(fitted("  one two three", 9), "  one two\n  three");
  EXPECT_EQ(fitted("name  one two", 9), "name  one\n      two");
}

TEST(FittedText, CountsCharactersNotBytesAndKeepsWordsWhole) {
  EXPECT_EQ(text_width("3 μs Störmer"), 12U);
  EXPECT_EQ(fitted("3 μs äöü", 8), "3 μs äöü");
  EXPECT_EQ(fitted("in /a/very/long/path end", 6), "in\n/a/very/long/path\nend");
}

TEST(FittedText, KeepsANumberWithItsUnit) {
  EXPECT_EQ(fitted("misses by 9.6 m now", 13), "misses by\n9.6 m now");
  EXPECT_EQ(fitted("of 200 times", 6), "of 200\ntimes");
  EXPECT_EQ(fitted("after 12", 6), "after\n12");
}

TEST(FittedText, FittingTwiceChangesNothing) {
  const std::string once = fitted("  name   " + std::string(30, 'x') + " one two three four", 20);
  EXPECT_EQ(fitted(once, 20), once);
}

TEST(AlignedTable, LeavesOutWhatWasNotComputed) {
  EXPECT_EQ(
      aligned_table(
          {{"run", "time", "error", "verdict"}, {"a", "1 s", "", "ok"}, {"long", "10 s", "", ""}}),
      "run   time  verdict\n"
      "a      1 s       ok\n"
      "long  10 s        -\n");
}

TEST(AlignedTable, ColumnsThatDoNotFitFollowBelow) {
  const std::string wide(36, 'x');
  const std::string table = aligned_table({{"run", "a", "b", "c"}, {"r", wide, wide, "1"}});
  // Three characters and twice two blanks and 36 are 79; the next column takes three more.
  EXPECT_EQ(test::widest_line(table), 79U);
  EXPECT_TRUE(table.ends_with("\n\nrun  c\nr    1\n")) << table;
}

TEST(AlignedTable, ALongLabelLosesItsMiddle) {
  const std::string label = "begin" + std::string(100, 'x') + "end";
  const std::string table = aligned_table({{"run", "time"}, {label, "1 s"}});
  EXPECT_LE(test::widest_line(table), terminal_width);
  EXPECT_NE(table.find("begin"), std::string::npos) << table;
  EXPECT_NE(table.find("…x"), std::string::npos) << table;
  EXPECT_NE(table.find("end  "), std::string::npos) << table;
}

}  // namespace
}  // namespace hamjet::io
