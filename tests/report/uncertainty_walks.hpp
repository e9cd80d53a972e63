#pragma once

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../../src/report/uncertainty/moments_table.hpp"
#include "../../src/report/uncertainty/uncertainty_report.hpp"
#include "../../src/report/uncertainty/uncertainty_view.hpp"
#include "table_walk.hpp"
#include "transfer_samples.hpp"
#include "uncertainty_samples.hpp"

// A small study of uncertainty with collisions and passive safety, of made-up numbers.

namespace hamjet::io::report_tables {

/// The moments of the second component, see sample_moments.
inline ExpectedColumns moments_columns(double size, const ExpectedColumns& further) {
  std::vector<std::vector<double>> covariance(6, std::vector<double>(6));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const bool are_of_one = (i < 3) == (j < 3);
      covariance[i][j] = are_of_one ? 0.16 * size * size * (i + 1) * (j + 1) : 0;
    }
  }
  ExpectedColumns columns = {{"time_s", {"s", 2.5 * 927.6}},
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
inline ExpectedColumns order_columns() {
  const double divergence =
      2.25 / 12 + (0.0625 + 4) / 48 + 2 * (std::log(0.5) + (4 + 35.0 * 35) / 2 - 0.5);
  return {{"negentropy_is_sure", {"", false}},
          {"divergence_from_linear", {"", divergence}},
          {"probability_error_of_linear", {"", 1}}};
}
inline const ExpectedColumns scatter_columns = {{"mean_scatter", {"", 0.01}},
                                                {"standard_deviation_scatter", {"", 0.02}},
                                                {"skewness_scatter", {"", 0.03}},
                                                {"excess_kurtosis_scatter", {"", 0.04}}};

inline ExpectedColumns without_values(ExpectedColumns columns) {
  for (auto& [name, expected] : columns) expected.value = nullptr;
  return columns;
}
inline ExpectedColumns both(ExpectedColumns one, const ExpectedColumns& other) {
  one.insert(other.begin(), other.end());
  return one;
}

inline ExpectedColumns collision_columns() {
  return {{"radius_m", {"m", 15}},
          {"window_s", {"s", {10, 100}}},
          {"window_widened", {"", true}},
          {"event", {"", "entry"}},
          {"gaussian_in", {"", {"positions", "elements"}}},
          {"order", {"", 2}},
          {"sampling", {"", "entries"}},
          {"parts", {"", 9}},
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

inline ExpectedColumns whole_passage_columns() {
  return {{"window_s", {"s", {5, 110}}},
          {"probability", {"", 0.5}},
          {"interval", {"", {0.45, 0.6}}},
          {"path_error_m", {"m", 1.5}},
          {"standard_error", {"", 0.05}}};
}

inline ExpectedColumns least_separation_columns() {
  return {{"samples", {"", 4000}},
          {"shares", {"", {0.01, 0.5}}},
          {"separations_m", {"m", {52, 210}}},
          {"errors_m", {"m", {0.25, 0.5}}},
          {"flights", {"", 32}},
          {"flight_difference_m", {"m", 0.125}},
          {"lower_m", {"m", {49, 201}}},
          {"upper_m", {"m", {56, 220}}}};
}

inline ExpectedColumns approaches_columns() {
  return {{"time_s", {"s", 60}},
          {"in_window", {"", false}},
          {"distance_m", {"m", 17}},
          {"speed_m_s", {"m/s", 8}},
          {"time_deviation_s", {"s", 0.375}},
          {"distance_deviation_m", {"m", 6}},
          {"flights", {"", 64}},
          {"polynomials_hold", {"", true}},
          {"position_error_m", {"m", 0.0625}},
          {"time_error_s", {"s", 0.03125}}};
}

inline ExpectedColumns short_encounter_columns() {
  return {
      {"foster", {"", 0.26}},        {"alfano", {"", 0.27}},           {"chan", {"", 0.28}},
      {"offset_m", {"m", {11, 13}}}, {"deviation_m", {"m", {19, 23}}}, {"passage_s", {"s", 1.5}},
      {"departure", {"", 0.015625}}, {"cut_by_window", {"", true}},    {"holds", {"", true}}};
}

inline ExpectedColumns safety_columns() {
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

inline std::vector<Walk> uncertainty_walks() {
  UncertaintyResult result = sample_uncertainty();
  const StudyReport report = uncertainty_report(result, sample_transfer_origin());
  std::map<std::string, TableView> tables;
  for (TableView& table : uncertainty_tables(result)) tables[table.name] = table;
  UncertaintyResult split = result;
  split.scene.uncertainty->domains.emplace();
  split.points[0].states[0].split = split.points[0].states[0].cartesian;
  split.domains = {{"chief",
                    {{Vector<double>{{1, 2, 3, 4, 5, 6}}, 0.25, 5},
                     {Vector<double>{{7, 8, 9, 10, 11, 12}}, 0.75, 6}},
                    3}};
  const StudyReport split_report = uncertainty_report(split, sample_transfer_origin());
  std::map<std::string, TableView> of_split;
  for (TableView& table : uncertainty_tables(split)) of_split[table.name] = table;
  const ExpectedColumns keys = {
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
  const ExpectedColumns of_order =
      both(keys, {{"polynomials", {"", "cartesian"}}, {"order", {"", 2}}});
  const ExpectedColumns of_samples =
      both(keys, {{"polynomials", {"", "flown"}}, {"order", {"", nullptr}}});
  const auto walk = [&](const std::string& name, std::size_t row, const ExpectedColumns& columns,
                        const std::string& place = "") {
    return Walk{tables.at(name), report, {row}, columns, place, 1e-12};
  };
  // Rows are components of two orders of two families, and of the samples.
  return {
      walk("moments", 7,
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
      Walk{of_split.at("split"), split_report, {7}, moments_columns(2, order_columns()), "", 1e-12},
      Walk{of_split.at("domains"),
           split_report,
           {1},
           {{"spacecraft", {"", "chief"}},
            {"centre_m", {"m", {7, 8, 9}}},
            {"centre_m_s", {"m/s", {10, 11, 12}}},
            {"share", {"", 0.75}},
            {"error_m", {"m", 6}}},
           "",
           1e-12},
      walk("collision", 1, collision_columns()),
      walk("whole_passage", 0, whole_passage_columns()),
      walk("least_separation", 0, least_separation_columns()),
      walk("approaches", 1, approaches_columns()),
      walk("short_encounter", 1, short_encounter_columns()),
      walk("safety", 1, safety_columns())};
}

}  // namespace hamjet::io::report_tables
