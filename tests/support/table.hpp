#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace hamjet::test {

/// A CSV file: the names of the columns from its first line, and the following rows.
struct Table {
  std::string header;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::string at(std::size_t row, const std::string& column) const {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i] == column) return rows.at(row).at(i);
    }
    ADD_FAILURE() << "no column " << column;
    return "";
  }
  double number(std::size_t row, const std::string& column) const {
    return std::stod(at(row, column));
  }
};

/// The fields of a line of CSV; those in quotes may hold commas, and quotes that are doubled.
inline std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> result(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool is_double = is_quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (is_double) result.back() += line[i++];
      if (!is_double) is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      result.emplace_back();
    } else {
      result.back() += line[i];
    }
  }
  return result;
}

inline Table parse_table(const std::string& csv) {
  std::istringstream text(csv);
  Table table;
  std::getline(text, table.header);
  table.columns = csv_fields(table.header);
  for (std::string line; std::getline(text, line);) table.rows.push_back(csv_fields(line));
  return table;
}

}  // namespace hamjet::test
