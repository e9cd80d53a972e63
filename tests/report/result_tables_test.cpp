#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../../src/report/declared_tables.hpp"
#include "../../src/report/formation/validity_table.hpp"
#include "../../src/report/formation/validity_view.hpp"
#include "report_tables.hpp"
#include "transfer_samples.hpp"

// All columns of all tables of results: of made-up results, in which no two numbers are the same,
// the values are written down here, and CSV and summary.json have them under the declared names.

namespace hamjet::io {
namespace {

using namespace report_tables;

/// What a column must hold in one row, as JSON has it, and its unit.
struct Expected {
  std::string unit;
  Json value;
};

struct Walk {
  TableView table;
  std::string csv;
  Json summary;
  std::size_t row = 0;
  std::map<std::string, Expected> columns;
};

Walk validity_walk() {
  ValidityResult result = sample_validity();
  result.points[1].time = 2.5;
  result.scene.validity->tolerance_m = 3;
  result.scene.validity->semi_axes = {1, 0.5, 0.25};
  const StudyReport report = validity_report(result, sample_transfer_origin());
  return {validity_table(result),
          report.files[0].content,
          Json::parse(report.summary()),
          3,
          {{"verdict", {"", validity_verdict(result)}},
           {"tolerance_m", {"m", 3}},
           {"time_canonical", {"", 2.5}},
           {"time_s", {"s", 2.5 * 927.6}},
           {"order", {"", 2}},
           {"predicted_m", {"m", 2e4}},
           {"proved_m", {"m", 5e5}},
           {"miss_m", {"m", 0.2}},
           {"at_limit", {"", true}},
           {"frame", {"", "RTN"}},
           {"derivatives", {"", "rotating"}},
           {"coordinates", {"", "cartesian"}},
           {"end_coordinates", {"", "cartesian"}},
           {"axes", {"", {"R", "T", "N"}}},
           {"limit_degree", {"", 2.96875}},
           {"limit_start_coordinate", {"", "period"}},
           {"limit_start_degree", {"", 2.1875}},
           {"limit_end_coordinate", {"", "tau"}},
           {"limit_end_share", {"", 0.90625}},
           {"semi_axes", {"", {1, 0.5, 0.25}}},
           {"samples", {"", 40}},
           {"flights", {"", 1234}},
           {"flight_floor_m", {"m", 1e-6}}}};
}

std::vector<Walk> walks() { return {validity_walk()}; }

/// The unit that a name ends with, as in "miss_m".
std::string unit_of_name(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> endings = {
      {"_m_s", "m/s"}, {"_m", "m"}, {"_s", "s"}, {"_km", "km"}, {"_deg", "deg"}};
  for (const auto& [ending, unit] : endings) {
    if (name.ends_with(ending)) return unit;
  }
  return "";
}

void expect_field(const std::string& field, const Json& value, const std::string& name) {
  if (value.is_null()) {
    EXPECT_EQ(field, "") << name;
  } else if (value.is_string()) {
    EXPECT_EQ(field, value) << name;
  } else if (value.is_boolean()) {
    EXPECT_EQ(field, value ? "true" : "false") << name;
  } else {
    ASSERT_NE(field, "") << name;
    EXPECT_EQ(std::stod(field), value) << name;
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
    if (table.dimensions[i].name.empty()) return all;
    const std::size_t below = table.count(table.dimensions.size()) / table.count(i + 1);
    place += "/" + table.dimensions[i].name + "/" +
             std::to_string(row / below % table.dimensions[i].length);
  }
  all.push_back(place);
  return all;
}

TEST(ResultTables, HoldTheNumbersOfTheResultInEveryColumn) {
  for (const Walk& walk : walks()) {
    const Table csv = parse(walk.csv);
    EXPECT_EQ(walk.columns.size(), walk.table.columns.size()) << walk.table.name;
    for (const TableColumn& column : walk.table.columns) {
      const std::string name = walk.table.name + "." + column.name;
      const auto expected = walk.columns.find(column.name);
      ASSERT_NE(expected, walk.columns.end()) << name << ": say here what it must be";
      const auto& [unit, value] = expected->second;
      EXPECT_EQ(column.unit, unit) << name;
      EXPECT_EQ(unit_of_name(column.name), unit) << name;
      EXPECT_NE(column.meaning, "") << name;
      for (std::size_t i = 0; column.is_in_csv && i < column.parts.size(); ++i) {
        EXPECT_EQ(unit_of_name(column.parts[i]), unit) << name;
        const bool is_part = column.is_array() && !value.is_null();
        expect_field(csv.at(walk.row, column.parts[i]),
                     is_part ? value.flatten().at("/" + std::to_string(i)) : value, name);
      }
      if (!column.is_in_json) continue;
      for (const std::string& place : places(walk.table, column.level, walk.row)) {
        const Json::json_pointer pointer(place + "/" + column.name);
        ASSERT_TRUE(walk.summary.contains(pointer)) << pointer.to_string();
        EXPECT_EQ(walk.summary[pointer], value) << pointer.to_string();
      }
    }
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
