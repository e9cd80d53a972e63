#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "hamjet/report/study_report.hpp"

// The tables and summaries of reports, read back.

namespace hamjet::io::report_tables {

using Json = nlohmann::json;

/// A table by the names of its columns. Fields in quotes may hold commas.
struct Table {
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

inline std::vector<std::string> fields(const std::string& line) {
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

inline Table parse(const std::string& csv) {
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  std::istringstream text(csv);
  Table table;
  for (std::string line; std::getline(text, line);) {
    (table.columns.empty() ? table.columns : table.rows.emplace_back()) = fields(line);
  }
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  return table;
}

inline const Json& summary_of(const StudyReport& report, Json& json) {
  EXPECT_EQ(report.files.back().path, "summary.json");
  EXPECT_EQ(report.summary().find("\"nan\""), std::string::npos);
  json = Json::parse(report.summary());
  return json;
}

}  // namespace hamjet::io::report_tables
