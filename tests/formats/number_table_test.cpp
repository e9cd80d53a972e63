#include "formats/number_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/errors.hpp"

// Tables are read part by part, and are the same however their bytes come.

namespace hamjet::io {
namespace {

const std::vector<std::string_view> columns = {"x", "y"};

NumberTableReader reader_of(std::string_view text, std::size_t bytes) {
  return {"a.csv", columns, [text, bytes](std::span<char> room) mutable {
            const std::size_t count = std::min({room.size(), text.size(), bytes});
            text.copy(room.data(), count);
            text.remove_prefix(count);
            return count;
          }};
}

std::vector<double> numbers(std::string_view text, std::size_t bytes, std::size_t rows) {
  NumberTableReader reader = reader_of(text, bytes);
  std::vector<double> all;
  while (true) {
    const NumberTable part = reader.read(rows);
    EXPECT_LE(part.rows(), rows);
    EXPECT_EQ(part.first_row, all.size() / columns.size());
    if (part.numbers.empty()) return all;
    all.insert(all.end(), part.numbers.begin(), part.numbers.end());
  }
}

TEST(NumberTables, AreTheSameHoweverTheirBytesCome) {
  for (const char* text : {"x,y\n1,2\n3,4\n5,6\n", "x,y\r\n1,2\r\n3,4\r\n5,6",
                           "\xef\xbb\xbfy,x\n2,1\n4,3\n6,5\n\n\r\n\n"}) {
    for (const std::size_t bytes : {1U, 2U, 3U, 1000U}) {
      for (const std::size_t rows : {1U, 2U, 3U, 4U}) {
        EXPECT_EQ(numbers(text, bytes, rows), (std::vector<double>{1, 2, 3, 4, 5, 6})) << text;
      }
    }
  }
}

TEST(NumberTables, SayWhereAMistakeIs) {
  const struct {
    const char* text;
    const char* message;
  } mistakes[] = {{"x,y\n1,2\n\n\n3,4\n", "a.csv:3: has 1 columns"},
                  {"x,y\n1,2\n3,4\n5,b\n", "a.csv:4: column y"},
                  {"x,y\n\n\n", "a.csv:2: the file has no rows"},
                  {"", "a.csv:1: the header is missing"}};
  for (const auto& mistake : mistakes) {
    test::expect_error(ErrorKind::input_output, mistake.message,
                       [&] { numbers(mistake.text, 3, 1); });
  }
}

TEST(NumberTables, ReadALineToItsLongestAndNoLonger) {
  constexpr std::size_t most = NumberTableReader::longest_line;
  const std::string row = "1," + std::string(most - 3, ' ') + "2";
  EXPECT_EQ(numbers("x,y\r\n" + row + "\r\n" + row, 1000, 7), (std::vector<double>{1, 2, 1, 2}));
  std::size_t taken = 0;
  NumberTableReader endless("a.csv", columns, [&](std::span<char> room) {
    std::fill(room.begin(), room.end(), '1');
    taken += room.size();
    return room.size();
  });
  test::expect_error(ErrorKind::too_large, "a.csv:1: a line of more than 65536 bytes",
                     [&] { endless.read(1); });
  EXPECT_LT(taken, 2 * most);
  test::expect_error(ErrorKind::too_large, "a.csv:3: a line of more than 65536 bytes", [&] {
    numbers("x,y\n1,2\n" + std::string(100 * most, '0') + "\n", 70000, 1);
  });
}

}  // namespace
}  // namespace hamjet::io
