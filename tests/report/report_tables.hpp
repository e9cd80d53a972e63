#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "hamjet/detail/report/study_report.hpp"
#include "support/table.hpp"

// The tables and summaries of reports, read back.

namespace hamjet::io::report_tables {

using Json = nlohmann::json;

using test::Table;

inline Table parse(const std::string& csv) {
  // A cell, not a part of a name.
  static const std::regex no_number("(^|[,\n-])nan");
  EXPECT_FALSE(std::regex_search(csv, no_number)) << csv;
  Table table = test::parse_table(csv);
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
