#include "formats/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "fuzz_target.hpp"

// Target: CSV of deviations. What is read and written again, columns in another order, must come
// back bit by bit.

namespace hamjet::fuzz {
namespace {

const std::vector<std::string_view> columns = {"R_m", "T_m", "N_m", "vR_m_s", "vT_m_s", "vN_m_s"};
constexpr const char* name = "deviations.csv";

/// Reads the whole table; the text comes in pieces of the given number of bytes, and the rows are
/// read in groups of the given number.
io::NumberTable read(const char* file, std::string_view text, std::size_t bytes, std::size_t rows) {
  io::NumberTableReader reader(file, columns, [&](std::span<char> room) {
    const std::size_t count = std::min({room.size(), text.size(), bytes});
    text.copy(room.data(), count);
    text.remove_prefix(count);
    return count;
  });
  io::NumberTable table{columns.size(), {}};
  while (true) {
    const io::NumberTable part = reader.read(rows);
    require(part.first_row == table.rows(), "rows that are left out");
    if (part.numbers.empty()) return table;
    table.numbers.insert(table.numbers.end(), part.numbers.begin(), part.numbers.end());
  }
}

std::string written(const io::NumberTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(columns.rbegin(), columns.rend(), ","));
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    text += fmt::format("{}\n", fmt::join(row.rbegin(), row.rend(), ","));
  }
  return text;
}

void check(const io::NumberTable& table) {
  require(table.columns == columns.size() && table.rows() >= 1, "sizes of the table");
  require(table.numbers.size() == table.rows() * table.columns, "a row that is cut off");
  require_finite(table.numbers, "table");
  const io::NumberTable again = read("again", written(table), 7, 3);
  require(again.numbers.size() == table.numbers.size() &&
              std::memcmp(again.numbers.data(), table.numbers.data(),
                          table.numbers.size() * sizeof(double)) == 0,
          "numbers that do not come back");
}

}  // namespace
}  // namespace hamjet::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hamjet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::is_read([&] { fuzz::check(fuzz::read(fuzz::name, text, size, size + 1)); },
                {{ErrorKind::input_output, ErrorKind::too_large}, {"deviations.csv:"}});
  return 0;
}
