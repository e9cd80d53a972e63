#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../../src/report/formation/burn_view.hpp"
#include "../../src/report/formation/feedback_errors_view.hpp"
#include "../../src/report/formation/fuel_view.hpp"
#include "../../src/report/formation/impulse_tables.hpp"
#include "../../src/report/formation/thrust_view.hpp"
#include "../../src/report/formation/transfer_tables.hpp"
#include "../../src/report/formation/transfer_view.hpp"
#include "table_walk.hpp"
#include "transfer_samples.hpp"

// A made-up transfer, in which no two numbers are the same.

namespace hamjet::io::report_tables {

/// What add_frame declares.
inline ExpectedColumns with_frame(ExpectedColumns columns) {
  columns.merge(ExpectedColumns{{"frame", {"", "RTN"}},
                                {"derivatives", {"", "rotating"}},
                                {"coordinates", {"", "nodal"}},
                                {"end_coordinates", {"", "cartesian"}},
                                {"axes", {"", {"R", "T", "N"}}}});
  return columns;
}

inline Json json_of(const Eigen::Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }

inline constexpr double sample_unit_s = 927.6;  ///< the unit of time in all samples

/// A transfer study with all that a scene may ask for; the last time is the best.
inline TransferResult whole_transfer() {
  TransferResult result = sample_transfer();
  result.coordinates.start = JetCoordinates::nodal;
  result.chief_error_m = 3e-6;
  result.times_between = 17;
  result.scene.transfer->budget_m_s = 20;
  result.budget_windows = {{1.5, 2.5, true, false}};
  TransferPoint& best = result.points.back();
  best.position_condition = 4.5;
  best.keep_out_ratio = 1.75;
  best.lowest = 0.875;
  best.drift.emplace().per_revolution_m = 12.5;
  result.points[2].exceeds_impulse = true;
  result.points[4].is_beyond_tolerance = result.points[4].exceeds_impulse = true;
  ImpulsePlan& plan = result.optimal.emplace().plan.emplace();
  plan.duration = 6;
  plan.impulses = {{0.5, {1, 2, 3}}, {6, {-4, 5, 8}}};
  result.optimal->by_time = {{6, 14.5, 14.75, "why", true}};
  WaypointPlan way;
  way.duration = 5;
  way.impulses = {{0.25, {3, 4, 12}}, {5, {0, 0, 2}}};
  way.legs.resize(1);
  way.forbidden = "not this way";
  result.waypoints.emplace().plans = {way};
  result.waypoints->best_plan = 0;
  EnergyOptimalTransfer thrust;
  thrust.time = 5;
  thrust.condition = 6.5;
  thrust.answers = {{1, {}, 0.5, 70, 0.07, ""}, {2, {}, 0.5625, 1.5, 0.0015, ""}};
  thrust.refined = {2, {1, 2, 3, 4, 5, 6}, 0.5625, 1e-3, 2e-6, ""};
  thrust.refinement_flights = 3;
  thrust.energy_m2_s3 = 0.625;
  thrust.change_m_s = 9.5;
  thrust.largest_m_s2 = 0.0625;
  thrust.exceeds_thrust = true;
  thrust.start_thrust_m_s2 = {0.01, 0.02, 0.03};
  thrust.end_thrust_m_s2 = {0.04, 0.05, -0.06};
  result.thrust = {2, {thrust}, 0, {{0, {1, 2, 2}}, {5, {2, 3, -6}}}, {}, ""};
  FeedbackInstant instant;
  instant.time = 2.5;
  const SpacePointer space = SeriesSpace::create(6, 1);
  for (const double x : {4.0, 5.0, -6.0}) {
    instant.thrust.emplace_back(space, x);
    instant.thrust.back()[space->linear_index(3)] = x / 8;
  }
  result.thrust->feedback = {{instant}, 0.5, 0.25, 0.75, 9.75, {}, ""};
  result.scene.transfer->errors.emplace();
  for (const double x : {1.0, 3.0, 2.0, 8.0}) {
    result.thrust->feedback->samples.push_back(
        {{x, x / 64, x / 16, x + 10, ""}, {100 * x, x / 4, x / 8, x + 20, ""}});
  }
  result.thrust->feedback->samples.push_back({{5, 5, 5, 5, ""}, {0, 0, 0, 0, "it fell"}});
  FuelOptimalTransfer fuel;
  fuel.time = 5;
  fuel.burns = {{0.25, 0.75, 2.5, {0.6, 0, 0.8}, {0, 1, 0}}, {4, 5, 5, {0, 0, 1}, {0, -1, 0}}};
  fuel.change_m_s = 7.5;
  fuel.energy_optimal_m_s = 9.5;
  fuel.impulses_m_s = 7.25;
  fuel.impulses_bound_m_s = 7.125;
  fuel.propellant_kg = 0.75;
  fuel.miss_m = 1e-6;
  fuel.velocity_miss_m_s = 1e-9;
  fuel.costates = {6, 5, 4, 3, 2, 1};
  fuel.primer_at_switches = 1e-15;
  fuel.primer_in_coasts = 0.875;
  fuel.primer_in_burns = 1.125;
  fuel.hamiltonian_change = 1e-13;
  fuel.continuation_steps = 12;
  fuel.flights = 40;
  FuelOptimalTransfer no_fuel;
  no_fuel.time = 6;
  no_fuel.least_acceleration_m_s2 = 0.375;
  no_fuel.failure = "not enough";
  result.fuel = {0.3125, {fuel, no_fuel}, 0, {{0, {0, 0, 0}, 0.5}, {5, {0, 0, 0.25}, 1.5}}, ""};
  BurnPlan burns;
  burns.duration = 4;
  burns.impulses_m_s = 7;
  burns.burns = {{0, -0.5, 0.75, {0.6, 0, 0.8}, 3.25, 3, 1.5, 98.5},
                 {4, 3.5, 4.25, {0, 1, 0}, 4.5, 4, 2, 96.5}};
  burns.flights = 5;
  burns.miss_m = 1e-4;
  burns.velocity_miss_m_s = 1e-7;
  burns.least_acceleration_m_s2 = 0.125;
  BurnPlan none;
  none.is_optimal = true;
  none.duration = 6;
  none.impulses_m_s = 8;
  none.failure = "too weak";
  result.burns = {{burns, none}, 0, ""};
  return result;
}

inline StudyReport report_of(const TransferResult& result) {
  return transfer_report(result, std::nullopt, sample_transfer_origin());
}

/// The columns of one transfer, of whole_transfer's last time, in rows 5, 2 and 4.
inline ExpectedColumns transfer_columns_expected(const TransferPoint& point) {
  const TransferAnswer& shown = *point.refined;
  const TransferAnswer &first = point.answers[0], &second = point.answers[1];
  return {{"time_canonical", {"", point.time}},
          {"time_s", {"s", point.time * sample_unit_s}},
          {"kind", {"", "qqq-qqq"}},
          {"condition", {"", 10.0 / 3}},
          {"position_condition", {"", point.position_condition}},
          {"singular_distance_s", {"s", 0.7 * sample_unit_s}},
          {"near_singular", {"", false, {true, false}}},
          {"beyond_tolerance", {"", false, {true, true}}},
          {"answer", {"", "refined"}},
          {"exceeds_impulse", {"", false, {true, true}}},
          {"keep_out_ratio", {"", 1.75}},
          {"lowest_km", {"km", 0.875 * 7000}},
          {"below_surface", {"", false, {false, false}}},
          {"start_change_m_s", {"m/s", json_of(shown.start_change_m_s)}},
          {"end_change_m_s", {"m/s", json_of(shown.end_change_m_s)}},
          {"total_change_m_s", {"m/s", shown.total_change_m_s()}},
          {"miss_m", {"m", 1.0 / 3e4}},
          {"linear_total_change_m_s", {"m/s", first.total_change_m_s()}},
          {"linear_miss_m", {"m", 1234.5}},
          {"miss_m_by_order", {"m", {1234.5, 0.1 + 0.2}}},
          {"start_change_m_s_by_order",
           {"m/s", {json_of(first.start_change_m_s), json_of(second.start_change_m_s)}}},
          {"end_change_m_s_by_order",
           {"m/s", {json_of(first.end_change_m_s), json_of(second.end_change_m_s)}}},
          {"refined_total_change_m_s", {"m/s", shown.total_change_m_s()}},
          {"refined_miss_m", {"m", 1.0 / 3e4}},
          {"refinement_flights", {"", 2}},
          {"hamilton_jacobi_residual", {"", 1e-14 / 3}},
          {"end_drift_m_per_revolution", {"m a revolution", 12.5}},
          {"failure", {"", nullptr}}};
}

inline std::vector<Walk> transfer_walks() {
  const TransferResult result = whole_transfer();
  const StudyReport report = report_of(result);
  ExpectedColumns columns = transfer_columns_expected(result.points.back());
  columns.merge(with_frame({{"verdict", {"", transfer_verdict(result)}},
                            {"best", {"", 5}},
                            {"is_first_or_last_time", {"", true}},
                            {"times_between_listed", {"", 17}},
                            {"flight_floor_m", {"m", 2e-6}},
                            {"chief_error_m", {"m", 3e-6}},
                            {"largest_hamilton_jacobi_residual", {"", 1e-14 / 3}},
                            {"hamilton_jacobi_floor", {"", 1e-15}},
                            {"steps", {"", 44}},
                            {"exit_code", {"", 1}}}));
  // Where nothing was refined, the answer of the highest order is shown.
  const Json null;
  for (const std::size_t row : {std::size_t{2}, std::size_t{4}}) {
    const TransferAnswer& second = result.points[row].answers[1];
    columns["total_change_m_s"].further.push_back(second.total_change_m_s());
    columns["miss_m"].further.push_back(second.miss_m);
    columns["refined_total_change_m_s"].further.push_back(null);
    columns["refined_miss_m"].further.push_back(null);
  }
  std::vector<std::string> kinds;
  std::vector<double> conditions = result.conditions.values[1];
  for (const GeneratingFunctionKind& kind : result.conditions.kinds) kinds.push_back(kind.name());
  return {{transfers_table(result), report, {5, 2, 4}, columns},
          {singular_times_table(result),
           report,
           {0},
           {{"kind", {"", "qqq-qqq"}},
            {"time_canonical", {"", 3.01}},
            {"time_s", {"s", 3.01 * sample_unit_s}},
            {"resolution_s", {"s", 2e-9 * sample_unit_s}},
            {"smallest_ratio", {"", 1e-17}},
            {"second_ratio", {"", 0.25}},
            {"directions_lost", {"", 1}},
            {"direction_inertial", {"", {0, 0.6, -0.8}}},
            {"direction_rtn", {"", {0, 0, 1}}}}},
          {conditions_table(result),
           report,
           {1},
           {{"time_canonical", {"", 2}},
            {"time_s", {"s", 2 * sample_unit_s}},
            {"condition", {"", conditions}},
            {"kinds", {"", kinds}}}},
          {budget_windows_table(result),
           report,
           {0},
           {{"first_s", {"s", 1.5 * sample_unit_s}},
            {"last_s", {"s", 2.5 * sample_unit_s}},
            {"begins_at_first_time", {"", true}},
            {"ends_at_last_time", {"", false}}}},
          {optimal_impulses_table(result),
           report,
           {1},
           {{"time_canonical", {"", 6}},
            {"time_s", {"s", 6 * sample_unit_s}},
            {"change_m_s", {"m/s", {-4, 5, 8}}},
            {"magnitude_m_s", {"m/s", std::sqrt(105)}}}},
          {least_by_time_table(result),
           report,
           {0},
           {{"time_s", {"s", 6 * sample_unit_s}},
            {"linear_change_m_s", {"m/s", 14.5}},
            {"flown_change_m_s", {"m/s", 14.75}},
            {"failure", {"", "why"}},
            {"solver_failed", {"", true}}}},
          {waypoint_impulses_table(result),
           report,
           {0},
           {{"time_canonical", {"", 0.25}},
            {"time_s", {"s", 0.25 * sample_unit_s}},
            {"change_m_s", {"m/s", {3, 4, 12}}},
            {"magnitude_m_s", {"m/s", 13}}}},
          {total_by_time_table(result),
           report,
           {0},
           {{"time_s", {"s", 5 * sample_unit_s}},
            {"total_change_m_s", {"m/s", 15}},
            {"forbidden", {"", "not this way"}}}},
          {energy_optimal_table(result),
           report,
           {0},
           {{"time_s", {"s", 5 * sample_unit_s}},
            {"condition", {"", 6.5}},
            {"energy_m2_s3", {"m^2/s^3", 0.625}},
            {"energy_m2_s3_by_order", {"m^2/s^3", {0.5, 0.5625}}},
            {"change_m_s", {"m/s", 9.5}},
            {"largest_m_s2", {"m/s^2", 0.0625}},
            {"exceeds_thrust", {"", true}},
            {"start_thrust_m_s2", {"m/s^2", {0.01, 0.02, 0.03}}},
            {"end_thrust_m_s2", {"m/s^2", {0.04, 0.05, -0.06}}},
            {"miss_m_by_order", {"m", {70, 1.5}}},
            {"velocity_miss_m_s_by_order", {"m/s", {0.07, 0.0015}}},
            {"refined_miss_m", {"m", 1e-3}},
            {"refined_velocity_miss_m_s", {"m/s", 2e-6}},
            {"costates", {"", {1, 2, 3, 4, 5, 6}}},
            {"refinement_flights", {"", 3}},
            {"continuation_steps", {"", 0}},
            {"failure", {"", nullptr}}}},
          {thrust_profile_table(result),
           report,
           {1},
           {{"time_s", {"s", 5 * sample_unit_s}},
            {"thrust_m_s2", {"m/s^2", {2, 3, -6}}},
            {"magnitude_m_s2", {"m/s^2", 7}}}},
          {feedback_table(result),
           report,
           {4},
           {{"time_s", {"s", 2.5 * sample_unit_s}},
            {"powers", {"", {0, 0, 0, 1, 0, 0}}},
            {"thrust_m_s2", {"m/s^2", {0.5, 0.625, -0.75}}},
            {"miss_m", {"m", 0.5}},
            {"velocity_miss_m_s", {"m/s", 0.25}},
            {"energy_m2_s3", {"m^2/s^3", 0.75}},
            {"change_m_s", {"m/s", 9.75}}}},
          {feedback_errors_table(result),
           report,
           {1},
           {{"loop", {"", "open"}},
            {"miss_m", {"m", {250, 800, 800}}},
            {"velocity_miss_m_s", {"m/s", {0.625, 2, 2}}},
            {"energy_m2_s3", {"m^2/s^3", {0.3125, 1, 1}}},
            {"change_m_s", {"m/s", {22.5, 28, 28}}},
            {"flights", {"", 5}},
            {"failed", {"", 1}}}},
          {feedback_samples_table(result),
           report,
           {1, 4},
           {{"closed_miss_m", {"m", 3, {5}}},
            {"closed_velocity_miss_m_s", {"m/s", 3.0 / 64, {5}}},
            {"closed_energy_m2_s3", {"m^2/s^3", 3.0 / 16, {5}}},
            {"closed_change_m_s", {"m/s", 13, {5}}},
            {"closed_failure", {"", nullptr, {nullptr}}},
            {"open_miss_m", {"m", 300, {nullptr}}},
            {"open_velocity_miss_m_s", {"m/s", 0.75, {nullptr}}},
            {"open_energy_m2_s3", {"m^2/s^3", 0.375, {nullptr}}},
            {"open_change_m_s", {"m/s", 23, {nullptr}}},
            {"open_failure", {"", nullptr, {"it fell"}}}}},
          {fuel_optimal_table(result),
           report,
           {0, 1},
           {{"time_s", {"s", 5 * sample_unit_s, {6 * sample_unit_s}}},
            {"change_m_s", {"m/s", 7.5, {nullptr}}},
            {"energy_optimal_m_s", {"m/s", 9.5, {nullptr}}},
            {"impulses_m_s", {"m/s", 7.25, {nullptr}}},
            {"impulses_bound_m_s", {"m/s", 7.125, {nullptr}}},
            {"burns", {"", 2, {nullptr}}},
            {"burning_s", {"s", 1.5 * sample_unit_s, {nullptr}}},
            {"propellant_kg", {"kg", 0.75, {nullptr}}},
            {"miss_m", {"m", 1e-6, {nullptr}}},
            {"velocity_miss_m_s", {"m/s", 1e-9, {nullptr}}},
            {"primer_at_switches", {"", 1e-15, {nullptr}}},
            {"primer_in_coasts", {"", 0.875, {nullptr}}},
            {"primer_in_burns", {"", 1.125, {nullptr}}},
            {"hamiltonian_change", {"", 1e-13, {nullptr}}},
            {"costates", {"", {6, 5, 4, 3, 2, 1}, {nullptr}}},
            {"continuation_steps", {"", 12, {0}}},
            {"flights", {"", 40, {0}}},
            {"least_acceleration_m_s2", {"m/s^2", nullptr, {0.375}}},
            {"failure", {"", nullptr, {"not enough"}}},
            {"acceleration_m_s2", {"m/s^2", 0.3125}},
            {"shortest_transfer_time_s", {"s", 5 * sample_unit_s}}}},
          {fuel_optimal_burns_table(result),
           report,
           {1},
           {{"transfer_time_s", {"s", 5 * sample_unit_s}},
            {"burn", {"", 2}},
            {"start_s", {"s", 4 * sample_unit_s}},
            {"end_s", {"s", 5 * sample_unit_s}},
            {"change_m_s", {"m/s", 5}},
            {"start_direction", {"", {0, 0, 1}}},
            {"end_direction", {"", {0, -1, 0}}}}},
          {primer_profile_table(result),
           report,
           {1},
           {{"time_s", {"s", 5 * sample_unit_s}},
            {"thrust_m_s2", {"m/s^2", {0, 0, 0.25}}},
            {"primer", {"", 1.5}}}},
          {burns_table(result),
           report,
           {1, 2},
           {{"impulses", {"", "two", {"optimal"}}},
            {"transfer_time_s", {"s", 4 * sample_unit_s, {6 * sample_unit_s}}},
            {"burn", {"", 2, {null}}},
            {"impulse_time_s", {"s", 4 * sample_unit_s, {null}}},
            {"start_s", {"s", 3.5 * sample_unit_s, {null}}},
            {"end_s", {"s", 4.25 * sample_unit_s, {null}}},
            {"length_s", {"s", 0.75 * sample_unit_s, {null}}},
            {"direction", {"", {0, 1, 0}, {null}}},
            {"change_m_s", {"m/s", 4.5, {null}}},
            {"impulse_m_s", {"m/s", 4, {null}}},
            {"gravity_loss_m_s", {"m/s", 0.5, {null}}},
            {"propellant_kg", {"kg", 2, {null}}},
            {"mass_after_kg", {"kg", 96.5, {null}}},
            {"total_change_m_s", {"m/s", 7.75, {null}}},
            {"total_impulses_m_s", {"m/s", 7, {8}}},
            {"miss_m", {"m", 1e-4, {null}}},
            {"velocity_miss_m_s", {"m/s", 1e-7, {null}}},
            {"flights", {"", 5, {0}}},
            {"least_acceleration_m_s2", {"m/s^2", 0.125, {null}}},
            {"failure", {"", nullptr, {"too weak"}}},
            {"least_change_m_s", {"m/s", 7.75}},
            {"least_transfer_time_s", {"s", 4 * sample_unit_s}},
            {"shortest_transfer_time_s", {"s", 4 * sample_unit_s}}}}};
}

}  // namespace hamjet::io::report_tables
