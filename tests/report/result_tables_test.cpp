#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../../src/report/declared_tables.hpp"
#include "../../src/report/formation/validity_table.hpp"
#include "../../src/report/formation/validity_view.hpp"
#include "../../src/report/uncertainty/moments_table.hpp"
#include "../../src/report/uncertainty/uncertainty_report.hpp"
#include "../../src/report/uncertainty/uncertainty_view.hpp"
#include "report_tables.hpp"
#include "transfer_samples.hpp"
#include "uncertainty_samples.hpp"

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
  /// The object whose members are arrays over the last dimension, where summary.json has no rows.
  std::string place_of_arrays = {};
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

using Columns = std::map<std::string, Expected>;

/// The moments of the second component, see sample_moments.
Columns moments_columns(double size, const Columns& further) {
  std::vector<std::vector<double>> covariance(6, std::vector<double>(6));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const bool are_of_one = (i < 3) == (j < 3);
      covariance[i][j] = are_of_one ? 0.16 * size * size * (i + 1) * (j + 1) : 0;
    }
  }
  Columns columns = {{"time_s", {"s", 2.5 * 927.6}},
                     {"mean", {"", 28 * size}},
                     {"standard_deviation", {"", 0.8 * size}},
                     {"covariance", {"", covariance}},
                     {"skewness", {"", 1.5}},
                     {"excess_kurtosis", {"", 0.25}},
                     {"rank", {"", 2}},
                     {"mardia_skewness", {"", 1.5 * 1.5}},
                     // E[(w^2 + v^2)^2] - 2 * 4 with E[w^4] = 3.25 and E[v^4] = 1.
                     {"mardia_excess_kurtosis", {"", 3.25 + 2 + 1 - 8}},
                     {"negentropy", {"", 2.25 / 12 + (0.0625 + 4) / 48}}};
  columns.insert(further.begin(), further.end());
  return columns;
}

/// Of order 2 against the Gaussian distribution of half its size, whose mean is less by 35
/// standard deviations of that along each of both: log(1/2) + (4 + 35^2) / 2 - 1/2 each.
Columns order_columns() {
  const double divergence =
      2.25 / 12 + (0.0625 + 4) / 48 + 2 * (std::log(0.5) + (4 + 35.0 * 35) / 2 - 0.5);
  return {{"negentropy_is_sure", {"", false}},
          {"divergence_from_linear", {"", divergence}},
          {"probability_error_of_linear", {"", 1}}};
}
const Columns scatter_columns = {{"mean_scatter", {"", 0.01}},
                                 {"standard_deviation_scatter", {"", 0.02}},
                                 {"skewness_scatter", {"", 0.03}},
                                 {"excess_kurtosis_scatter", {"", 0.04}}};

Columns without_values(Columns columns) {
  for (auto& [name, expected] : columns) expected.value = nullptr;
  return columns;
}
Columns both(Columns one, const Columns& other) {
  one.insert(other.begin(), other.end());
  return one;
}

Columns collision_columns() {
  return {{"radius_m", {"m", 15}},
          {"window_s", {"s", {10, 100}}},
          {"window_widened", {"", true}},
          {"event", {"", "entry"}},
          {"order", {"", 2}},
          {"sampling", {"", "entries"}},
          {"probability", {"", 0.25}},
          {"confidence", {"", 0.75}},
          {"interval", {"", {0.225, 0.3}}},
          {"path_error_m", {"m", 0.75}},
          {"standard_error", {"", 0.025}},
          {"samples", {"", 5000}},
          {"hits", {"", 321}},
          {"equivalent_samples", {"", 77000}},
          {"change_from_lower_order", {"", 0.005}},
          {"standard_error_of_change", {"", 0.0025}},
          {"sampled_radius_m", {"m", 31}},
          {"largest_difference_m", {"m", 7}},
          {"time_s", {"s", 45}},
          {"probability_by_time", {"", 0.175}}};
}

Columns whole_passage_columns() {
  return {{"window_s", {"s", {5, 110}}},
          {"probability", {"", 0.5}},
          {"interval", {"", {0.45, 0.6}}},
          {"path_error_m", {"m", 1.5}},
          {"standard_error", {"", 0.05}}};
}

Columns least_separation_columns() {
  return {{"samples", {"", 4000}},
          {"shares", {"", {0.01, 0.5}}},
          {"separations_m", {"m", {52, 210}}},
          {"errors_m", {"m", {0.25, 0.5}}},
          {"flights", {"", 32}},
          {"flight_difference_m", {"m", 0.125}},
          {"lower_m", {"m", {49, 201}}},
          {"upper_m", {"m", {56, 220}}}};
}

Columns approaches_columns() {
  return {{"time_s", {"s", 60}},
          {"distance_m", {"m", 17}},
          {"speed_m_s", {"m/s", 8}},
          {"time_deviation_s", {"s", 0.375}},
          {"distance_deviation_m", {"m", 6}},
          {"flights", {"", 64}},
          {"polynomials_hold", {"", true}},
          {"position_error_m", {"m", 0.0625}},
          {"time_error_s", {"s", 0.03125}}};
}

Columns short_encounter_columns() {
  return {
      {"foster", {"", 0.26}},        {"alfano", {"", 0.27}},           {"chan", {"", 0.28}},
      {"offset_m", {"m", {11, 13}}}, {"deviation_m", {"m", {19, 23}}}, {"passage_s", {"s", 1.5}},
      {"departure", {"", 0.015625}}, {"cut_by_window", {"", false}},   {"holds", {"", true}}};
}

Columns safety_columns() {
  return {{"keep_apart_m", {"m", 50}},
          {"window_s", {"s", {20, 200}}},
          {"share", {"", 0.99}},
          {"confidence", {"", 0.95}},
          {"order", {"", 2}},
          {"keep_out_m", {"m", {200, 400, 300}}},
          {"least_separation_m", {"m", 45}},
          {"least_deviations", {"", 3}},
          {"first", {"", "chief"}},
          {"second", {"", "deputy"}},
          {"burn_share", {"", 0.5}},
          {"mean_separation_m", {"m", 350}},
          {"separation_m", {"m", 52}},
          {"separation_interval_m", {"m", {49, 56}}},
          {"separation_error_m", {"m", 0.25}},
          {"samples", {"", 4000}},
          {"nearer", {"", 8}},
          {"probability_nearer", {"", 0.002}},
          {"probability_nearer_interval", {"", {0.001, 0.003}}},
          {"flights", {"", 32}},
          {"flight_difference_m", {"m", 0.125}},
          {"keep_out_deviations", {"", 4.5}},
          {"keep_out_time_s", {"s", 150}},
          {"keep_out_flown_ratio", {"", 1.25}},
          {"keep_out_in_doubt", {"", true}},
          {"no_keep_out", {"", nullptr}}};
}

std::vector<Walk> uncertainty_walks() {
  UncertaintyResult result = sample_uncertainty();
  std::map<std::string, std::string> files;
  for (const ReportFile& file : uncertainty_report(result, sample_transfer_origin()).files) {
    files[file.path] = file.content;
  }
  const Json summary = Json::parse(files["summary.json"]);
  std::map<std::string, TableView> tables;
  for (TableView& table : uncertainty_tables(result)) tables[table.name] = table;
  const Columns keys = {
      {"coordinates", {"", "cartesian"}},
      {"frame", {"", "RTN"}},
      {"derivatives", {"", "inertial"}},
      {"units",
       {"", "m, m/s; in other coordinates canonical, by the chief's distance at the start"}},
      {"verdict", {"", uncertainty_verdict(result)}},
      {"notes", {"", uncertainty_notes(result)}},
      {"misleading_probability", {"", 0.05}},
      {"samples", {"", 900}},
      {"time_canonical", {"", 2.5}},
      {"state", {"", "chief"}},
      {"component", {"", "T"}},
      {"unit", {"", "m"}},
      {"told_in", {"", "RTN"}}};
  const Columns of_order = both(keys, {{"polynomials", {"", "cartesian"}}, {"order", {"", 2}}});
  const Columns of_samples = both(keys, {{"polynomials", {"", "flown"}}, {"order", {"", nullptr}}});
  const auto walk = [&](const std::string& name, std::size_t row, const Columns& columns,
                        const std::string& place = "") {
    return Walk{tables.at(name), files[name + ".csv"], summary, row, columns, place};
  };
  // Rows are components of two orders of two families, and of the samples.
  return {walk("moments", 7,
               both(moments_columns(2, of_order),
                    both(order_columns(), without_values(scatter_columns))),
               "/times/0/states/0/families/0/orders/1"),
          walk("moments", 25,
               both(moments_columns(5, of_samples),
                    both(without_values(order_columns()), scatter_columns)),
               "/times/0/states/0/flown"),
          walk("cartesian", 7, moments_columns(2, order_columns())),
          walk("charted", 1,
               moments_columns(3, {{"negentropy_is_sure", {"", false}},
                                   {"divergence_from_linear", {"", 2.25 / 12 + 4.0625 / 48}},
                                   {"probability_error_of_linear",
                                    {"", std::sqrt((2.25 / 12 + 4.0625 / 48) / 2)}}})),
          walk("flown", 1, moments_columns(5, scatter_columns)),
          walk("collision", 1, collision_columns()),
          walk("whole_passage", 0, whole_passage_columns()),
          walk("least_separation", 0, least_separation_columns()),
          walk("approaches", 1, approaches_columns()),
          walk("short_encounter", 1, short_encounter_columns()),
          walk("safety", 1, safety_columns())};
}

std::vector<Walk> walks() {
  std::vector<Walk> all = {validity_walk()};
  for (Walk& walk : uncertainty_walks()) all.push_back(std::move(walk));
  return all;
}

/// The unit that a name ends with, as in "miss_m".
std::string unit_of_name(const std::string& name) {
  static const std::vector<std::pair<std::string, std::string>> endings = {
      {"_m_s", "m/s"}, {"_m", "m"}, {"_s", "s"}, {"_km", "km"}, {"_deg", "deg"}};
  for (const auto& [ending, unit] : endings) {
    if (name.ends_with(ending)) return unit;
  }
  return "";
}

/// Numbers that are computed may differ by rounding.
void expect_value(const Json& found, const Json& value, const std::string& name) {
  if (value.is_array()) {
    ASSERT_EQ(found.size(), value.size()) << name;
    for (std::size_t i = 0; i < value.size(); ++i) expect_value(found[i], value[i], name);
  } else if (value.is_number_float()) {
    ASSERT_TRUE(found.is_number()) << name << ' ' << found;
    const double wanted = value;
    EXPECT_NEAR(found.get<double>(), wanted, 1e-12 * (1 + std::abs(wanted))) << name;
  } else {
    EXPECT_EQ(found, value) << name;
  }
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
    expect_value(std::stod(field), value.get<double>(), name);
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
      expect_value(cell_json(column, walk.table.cell_of_row(column, walk.row)), value, name);
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
        expect_value(walk.summary[pointer], value, pointer.to_string());
      }
      if (walk.place_of_arrays.empty() || column.level == 0) continue;
      const Json& object = walk.summary[Json::json_pointer(walk.place_of_arrays)];
      EXPECT_EQ(object.contains(column.name), !value.is_null()) << name;
      if (value.is_null()) continue;
      const bool is_array = column.level == walk.table.dimensions.size();
      const Json& held = object[column.name];
      const std::size_t last = walk.row % walk.table.dimensions.back().length;
      expect_value(is_array ? held[last] : held, value, walk.place_of_arrays + "/" + column.name);
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
