#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../../src/report/formation/assignment_tables.hpp"
#include "../../src/report/formation/deputy_motion_report.hpp"
#include "../../src/report/formation/validity_table.hpp"
#include "../../src/report/formation/validity_view.hpp"
#include "table_walk.hpp"
#include "transfer_samples.hpp"
#include "transfer_walks.hpp"

// Made-up motions, assignments and validities, in which no two numbers are the same.

namespace hamjet::io::report_tables {

inline ValidityResult told_validity() {
  ValidityResult result = sample_validity();
  result.coordinates.start = JetCoordinates::nodal;
  result.points[1].time = 2.5;
  result.scene.validity->tolerance_m = 3;
  result.scene.validity->semi_axes = {1, 0.5, 0.25};
  result.domains = {4321, 987, 81, "vT", 5, 0.4375};
  result.domains->parts = {{{{1, 2, 3}, {4, 5, 6}}, 7, 0.25},
                           {{{71, 72, 73}, {74, 75, 76}}, 19, 0.4375}};
  result.domains->parts.resize(41);
  return result;
}

inline Walk split_domains_walk() {
  const ValidityResult result = told_validity();
  return {split_domains_table(result),
          validity_report(result, sample_transfer_origin()),
          {1},
          {{"centre_m", {"m", {71, 72, 73}}},
           {"centre_m_s", {"m/s", {74, 75, 76}}},
           {"deputies", {"", 19}},
           {"miss_m", {"m", 0.4375}}}};
}

inline Walk validity_walk() {
  const ValidityResult result = told_validity();
  return {validity_table(result),
          validity_report(result, sample_transfer_origin()),
          {3},
          with_frame({{"verdict", {"", validity_verdict(result)}},
                      {"tolerance_m", {"m", 3}},
                      {"time_canonical", {"", 2.5}},
                      {"time_s", {"s", 2.5 * sample_unit_s}},
                      {"order", {"", 2}},
                      {"predicted_m", {"m", 2e4}},
                      {"proved_m", {"m", 5e5}},
                      {"miss_m", {"m", 0.2}},
                      {"at_limit", {"", true}},
                      {"limit_degree", {"", 2.96875}},
                      {"limit_start_coordinate", {"", "period"}},
                      {"limit_start_degree", {"", 2.1875}},
                      {"limit_end_coordinate", {"", "tau"}},
                      {"limit_end_share", {"", 0.90625}},
                      {"semi_axes", {"", {1, 0.5, 0.25}}},
                      {"samples", {"", 40}},
                      {"flights", {"", 1234}},
                      {"domains", {"", 41}},
                      {"separation_m", {"m", 4321}},
                      {"domains_split_across", {"", "vT"}},
                      {"domain_deputies", {"", 987}},
                      {"domain_miss_m", {"m", 0.4375}},
                      {"deputies_not_right", {"", 5}},
                      {"domain_maps", {"", 81}},
                      {"flight_floor_m", {"m", 1e-6}}})};
}

inline Walk motion_walk() {
  DeputyMotion motion;
  motion.scene = sample_relative_scene();
  motion.scene.deputy.emplace();
  motion.coordinates.start = JetCoordinates::nodal;
  motion.points.resize(2);
  motion.points[0] = {0, {{3, 4, 12}, {0.5, 0.25, 0.125}}, {0, 0}, 1e-7};
  motion.points[1] = {6, {{4, -8, 1}, {1.5, 2.5, 3.5}}, {0.375, 0.0625}, 2e-7};
  motion.flown = sample_trajectory();
  motion.flight_floor_m = 2e-7;
  return {deputy_motion_table(motion),
          deputy_motion_report(motion, sample_transfer_origin()),
          {1},
          with_frame({{"verdict", {"", deputy_motion_verdict(motion)}},
                      {"time_canonical", {"", 6}},
                      {"time_s", {"s", 6 * sample_unit_s}},
                      {"position_m", {"m", {4, -8, 1}}},
                      {"velocity_m_s", {"m/s", {1.5, 2.5, 3.5}}},
                      {"separation_m", {"m", 9}},
                      {"error_m_by_order", {"m", {0.375, 0.0625}}},
                      {"duration_s", {"s", 6 * sample_unit_s}},
                      {"times", {"", 2}},
                      {"largest_error_m", {"m", 0.0625}},
                      {"largest_error_m_by_order", {"m", {0.375, 0.0625}}},
                      {"is_resolved", {"", true}},
                      {"flight_floor_m", {"m", 2e-7}},
                      {"manoeuvres", {"", 0}},
                      {"exit_code", {"", 0}}})};
}

inline std::vector<Walk> assignment_walks() {
  AssignmentResult result = sample_assignment();
  result.coordinates.start = JetCoordinates::nodal;
  result.scene.assignment->deputies.resize(3);
  result.common_time = 1;
  result.failure = "one is left";
  result.pairs = {{0, 1, 1.5, 250}};
  TransferPoint& point = result.transfers[1].transfer;
  point.position_condition = 4.5;
  point.keep_out_ratio = 1.75;
  point.lowest = 0.875;
  point.drift.emplace().per_revolution_m = 12.5;
  const StudyReport report = assignment_report(result);
  ExpectedColumns columns = transfer_columns_expected(point);
  for (auto& [name, column] : columns) column.further.clear();
  columns.merge(with_frame({{"thrust_energy_m2_s3", {"m^2/s^3", nullptr}},
                            {"thrust_change_m_s", {"m/s", nullptr}},
                            {"largest_thrust_m_s2", {"m/s^2", nullptr}},
                            {"thrust_miss_m", {"m", nullptr}},
                            {"deputy", {"", 1}},
                            {"slot", {"", 0}},
                            {"common_time_s", {"s", 2 * sample_unit_s}},
                            {"deputies_without_slot", {"", {2}}},
                            {"slots_without_deputy", {"", Json::array()}},
                            {"flight_floor_m", {"m", 1e-6}},
                            {"not_assigned", {"", "one is left"}},
                            {"exit_code", {"", 4}}}));
  return {{assignment_table(result), report, {1}, columns},
          {costs_table(result),
           report,
           {2},
           {{"deputy", {"", 1}},
            {"slot", {"", 0}},
            {"time_canonical", {"", 6}},
            {"time_s", {"s", 6 * sample_unit_s}},
            {"total_change_m_s", {"m/s", 2.25}},
            {"energy_m2_s3", {"m^2/s^3", nullptr}}}},
          {pairs_table(result),
           report,
           {0},
           {{"deputy", {"", 0}},
            {"other_deputy", {"", 1}},
            {"time_canonical", {"", 1.5}},
            {"time_s", {"s", 1.5 * sample_unit_s}},
            {"least_separation_m", {"m", 250}}}}};
}

/// All of these.
inline std::vector<Walk> formation_walks() {
  std::vector<Walk> all = transfer_walks();
  for (Walk& walk : assignment_walks()) all.push_back(std::move(walk));
  all.push_back(motion_walk());
  all.push_back(validity_walk());
  all.push_back(split_domains_walk());
  return all;
}

}  // namespace hamjet::io::report_tables
