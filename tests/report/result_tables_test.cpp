#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "../../src/report/declared_tables.hpp"
#include "bounded_walks.hpp"
#include "formation_walks.hpp"
#include "table_walk.hpp"
#include "uncertainty_walks.hpp"

// All columns of all tables of results: of made-up results, in which no two numbers are the same,
// the values are written down here, and CSV and summary.json have them under the declared names.

namespace hamjet::io {
namespace {

using namespace report_tables;

std::vector<Walk> walks() {
  std::vector<Walk> all = formation_walks();
  for (Walk& walk : uncertainty_walks()) all.push_back(std::move(walk));
  for (Walk& walk : long_motion_walks()) all.push_back(std::move(walk));
  return all;
}

/// The unit that a name ends with, as in "miss_m".
std::string unit_of_name(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> endings = {
      {"_m_s2", "m/s^2"},
      {"_m2_s3", "m^2/s^3"},
      {"_m_s", "m/s"},
      {"_m", "m"},
      {"_s", "s"},
      {"_km", "km"},
      {"_kg", "kg"},
      {"_deg", "deg"},
      {"_m_s_a_day", "m/s a day"},
      {"_m_per_revolution", "m a revolution"},
      {"_deg_per_revolution", "deg a revolution"}};
  static const std::regex by_order("_by_order$|_order_[0-9]+$");
  const std::string quantity = std::regex_replace(name, by_order, "");
  for (const auto& [ending, named] : endings) {
    if (quantity.ends_with(ending)) return named;
  }
  return "";
}

/// A number may differ by what the report's computation of it rounds, and by nothing else.
void expect_number(double found, double value, double rounding, const std::string& name) {
  EXPECT_LE(std::abs(found - value), rounding * (1 + std::abs(value)))
      << name << " is " << found << ", must be " << value;
}

void expect_json(const Json& found, const Json& value, double rounding, const std::string& name) {
  if (found.is_array() && value.is_array()) {
    ASSERT_EQ(found.size(), value.size()) << name;
    for (std::size_t i = 0; i < value.size(); ++i) {
      expect_json(found[i], value[i], rounding, name);
    }
  } else if (found.is_number() && value.is_number()) {
    expect_number(found, value, rounding, name);
  } else {
    EXPECT_EQ(found, value) << name;
  }
}

void expect_field(const std::string& field, const Json& value, double rounding,
                  const std::string& name) {
  if (value.is_null()) {
    EXPECT_EQ(field, "") << name;
  } else if (value.is_string()) {
    EXPECT_EQ(field, value) << name;
  } else if (value.is_boolean()) {
    EXPECT_EQ(field, value ? "true" : "false") << name;
  } else {
    ASSERT_NE(field, "") << name;
    expect_number(std::stod(field), value, rounding, name);
  }
}

/// The pointers to the object in summary.json that has the columns of a level in a row.
std::vector<std::string> places(const TableView& table, std::size_t level, std::size_t row) {
  std::vector<std::string> all;
  if (level == table.dimensions.size()) {
    for (const auto& [at, place] : table.places_of_rows) {
      if (at == row) all.push_back(place);
    }
  }
  std::string place = table.place;
  for (std::size_t i = 0; i < level; ++i) {
    if (!table.has_rows_in_json) return all;
    const std::size_t below = table.count(table.dimensions.size()) / table.count(i + 1);
    place += "/" + table.dimensions[i].name + "/" +
             std::to_string(row / below % table.dimensions[i].length);
  }
  all.push_back(place);
  return all;
}

/// The entries of arrays in arrays, one after the other.
std::vector<Json> entries(const Json& value) {
  if (!value.is_array()) return {value};
  std::vector<Json> all;
  for (const Json& entry : value) {
    for (Json& one : entries(entry)) all.push_back(std::move(one));
  }
  return all;
}

/// A cell holds these values, which are what Python has of it.
void expect_cell(const std::vector<CellValue>& cell, const Json& value, double rounding,
                 const std::string& name) {
  const std::vector<Json> expected = entries(value);
  if (cell.empty()) {
    EXPECT_TRUE(value.is_null() || value.empty()) << name;
    return;
  }
  ASSERT_EQ(cell.size(), expected.size()) << name;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    expect_field(csv_text(cell[i]), expected[i], rounding, name);
  }
}

void expect_in_csv(const Walk& walk, const TableColumn& column, std::size_t row,
                   const Json& value) {
  const std::string name = walk.table.name + "." + column.name;
  const auto file =
      std::find_if(walk.report.files.begin(), walk.report.files.end(),
                   [&](const ReportFile& one) { return one.path == walk.table.name + ".csv"; });
  ASSERT_NE(file, walk.report.files.end()) << name;
  const Table csv = parse(file->content);
  for (std::size_t i = 0; i < column.parts.size(); ++i) {
    const bool is_part = column.is_array() && !value.is_null();
    expect_field(csv.at(row, column.parts[i]), is_part ? value[i] : value, walk.rounding, name);
  }
}

/// The object that has arrays over the last dimension has the column's, or not where it holds
/// nothing.
void expect_in_arrays(const Walk& walk, const Json& summary, const TableColumn& column,
                      std::size_t row, const Json& value) {
  const std::string name = walk.place_of_arrays + "/" + column.name;
  const Json& object = summary.at(Json::json_pointer(walk.place_of_arrays));
  EXPECT_EQ(object.contains(column.name), !value.is_null()) << name;
  if (value.is_null() || !object.contains(column.name)) return;
  const bool is_array = column.level == walk.table.dimensions.size();
  const Json& held = object[column.name];
  const std::size_t last = row % walk.table.dimensions.back().length;
  expect_json(is_array ? held.at(last) : held, value, walk.rounding, name);
}

/// A column's value in a row is in the view, in CSV under its name, and in summary.json.
void expect_value(const Walk& walk, const Json& summary, const TableColumn& column, std::size_t row,
                  const Json& value) {
  const std::string name = walk.table.name + "." + column.name;
  expect_cell(column.cells[walk.table.cell_of_row(column, row)], value, walk.rounding, name);
  if (column.is_in_csv) expect_in_csv(walk, column, row, value);
  if (!column.is_in_json) return;
  for (const std::string& place : places(walk.table, column.level, row)) {
    const Json::json_pointer pointer(place + "/" + column.name);
    ASSERT_TRUE(summary.contains(pointer)) << name << " at " << pointer.to_string();
    expect_json(summary[pointer], value, walk.rounding, name + " at " + pointer.to_string());
  }
  if (!walk.place_of_arrays.empty() && column.level > 0) {
    expect_in_arrays(walk, summary, column, row, value);
  }
}

TEST(ResultTables, HoldTheNumbersOfTheResultInEveryColumn) {
  for (const Walk& walk : walks()) {
    const Json summary = Json::parse(walk.report.summary());
    std::set<std::string> names;
    for (const TableColumn& column : walk.table.columns) {
      const std::string name = walk.table.name + "." + column.name;
      EXPECT_TRUE(names.insert(column.name).second) << name << " is there twice";
      const auto expected = walk.columns.find(column.name);
      ASSERT_NE(expected, walk.columns.end()) << name << ": say here what it must be";
      const auto& [unit_text, value, further] = expected->second;
      EXPECT_EQ(column.unit, unit_text) << name;
      EXPECT_NE(column.meaning, "") << name;
      EXPECT_EQ(unit_of_name(column.name), unit_text) << name;
      for (const std::string& part : column.parts) {
        if (column.is_in_csv) {
          EXPECT_EQ(unit_of_name(part), unit_text) << part;
        }
      }
      expect_value(walk, summary, column, walk.rows[0], value);
      for (std::size_t i = 0; i < further.size(); ++i) {
        expect_value(walk, summary, column, walk.rows[i + 1], further[i]);
      }
    }
    EXPECT_EQ(walk.columns.size(), names.size()) << walk.table.name;
  }
}

TEST(ResultTables, AreAllWalked) {
  std::set<std::string> walked, declared;
  for (const Walk& walk : walks()) walked.insert(walk.table.name);
  for (const TableView& table : declared_tables()) declared.insert(table.name);
  EXPECT_EQ(walked, declared);
}

TEST(ResultTables, AreOnThePageOfColumns) {
  std::ifstream file(std::string(HAMJET_SOURCE_DIR) + "/src/formats/columns/README.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == columns_page())
      << "renew it by: hamjet list columns > src/formats/columns/README.md";
}

}  // namespace
}  // namespace hamjet::io
