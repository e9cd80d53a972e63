#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../../src/report/bounded/bounded_report.hpp"
#include "../../src/report/bounded/box_report.hpp"
#include "../../src/report/bounded/event_report.hpp"
#include "../../src/report/bounded/frozen_orbit_report.hpp"
#include "../../src/report/periodic/periodic_report.hpp"
#include "sample_scene.hpp"
#include "table_walk.hpp"
#include "transfer_samples.hpp"

// Made-up results of frozen and periodic orbits, events, deputies that stay, and one kept in a box,
// in which no two numbers are the same.

namespace hamjet::io::report_tables {

/// Users are told a fourth of its unit of length and an eighth of its unit of time: numbers told
/// are 4 times the lengths, 8 times the times, half the momenta and twice the actions.
inline Scene sample_long_scene() {
  Scene scene = sample_scene(7);
  scene.told_units = CanonicalUnits{1750, 115.95};
  IntegratorSettings gauss;
  gauss.method = IntegrationMethod::gauss;
  gauss.tolerance = 1e-13;
  gauss.label = "gauss8";
  scene.integrators = {gauss};
  return scene;
}

inline std::vector<Walk> poincare_walks() {
  FrozenOrbitStudy study;
  study.scene = sample_long_scene();
  study.state = {1, 2, 3, 4, 5, 6};
  study.semi_major_axis = 1.25;
  study.eccentricity = 0.001;
  study.inclination_deg = 97.5;
  study.pericentre_deg = 89.5;
  study.nodal_period = 6.5;
  study.node = std::numbers::pi / 4;
  study.residual = 1e-25;
  study.trace = 0.25;
  study.trace_less_2 = -0.25;  // The multiplier is t/2 +- i sqrt((2 - t)(2 + t))/2.
  study.area_defect = 1e-20;
  study.iterations = 7;
  study.pericentre_depth = 0.015625;
  study.smallest_divisor = 0.375;
  study.flown_revolutions = 50;
  study.reach = 0.25;
  LibrationCircle circle;
  circle.amplitude = 0.125;
  circle.rotation_number = -0.0625;
  circle.mean_period = 6.25;
  circle.mean_node = std::numbers::pi / 2;
  circle.action = 0.5;
  circle.miss = 1e-5;
  study.circles = {circle, circle};
  study.circles[1].is_chiefs = true;
  study.circles[1].amplitude = 0.03125;
  study.circles[1].miss = 2e-6;
  const StudyReport report = frozen_orbit_report(study, sample_transfer_origin());
  const std::vector<TableView> tables = poincare_tables(study);
  return {{tables[0],
           report,
           {1},
           {{"verdict", {"", frozen_orbit_verdict(study)}},
            {"failure", {"", nullptr}},
            {"smallest_divisor", {"", 0.375}},
            {"flown_revolutions", {"", 50}},
            {"reach_m", {"m", 0.25 * 1.25 * 7e6}},
            {"largest_miss", {"", 1e-3}},
            {"amplitude_m", {"m", 0.03125 * 1.25 * 7e6}},
            {"amplitude_eccentricity", {"", 0.03125}},
            {"chief", {"", true}},
            {"rotation_number", {"", -0.0625}},
            {"mean_nodal_period_s", {"s", 6.25 * 927.6}},
            {"node_deg_per_revolution",
             {"deg a revolution", std::numbers::pi / 2 * (180 / std::numbers::pi)}},
            {"action_canonical", {"", 1}},
            {"miss", {"", 2e-6}}}},
          {tables[1],
           report,
           {0},
           {{"state_canonical", {"", {4, 8, 12, 2, 2.5, 3}}},
            {"a_km", {"km", 8750}},
            {"e", {"", 0.001}},
            {"i_deg", {"deg", 97.5}},
            {"argp_deg", {"deg", 89.5}},
            {"inside_body", {"", true}},
            {"nodal_period_s", {"s", 6.5 * 927.6}},
            {"node_deg_per_revolution",
             {"deg a revolution", std::numbers::pi / 4 * (180 / std::numbers::pi)}},
            {"residual", {"", 1e-25}},
            {"iterations", {"", 7}},
            {"trace", {"", 0.25}},
            {"trace_less_2", {"", -0.25}},
            {"multiplier", {"", {0.125, 0.375}}},
            {"area_defect", {"", 1e-20}},
            {"stable", {"", true}}}}};
}

inline Walk event_walk() {
  const SpacePointer space = SeriesSpace::create(6, 1);
  const auto series = [&](double constant) { return Series<double>(space, constant); };
  EventStudy study{sample_long_scene(),
                   {series(7), {series(1), series(2), series(3), series(4), series(5), series(6)}},
                   1e-7,
                   8,
                   {}};
  study.scene.event.emplace().number = 3;
  study.misses = {{100, 0.5, 0.25, 5, 2.5}, {1000, 0.75, 0.375, std::nullopt, 3.5}};
  return {event_tables(study).front(),
          event_report(study, sample_transfer_origin()),
          {1},
          {{"verdict", {"", event_verdict(study)}},
           {"condition", {"", "z = 0"}},
           {"number", {"", 3}},
           {"time_s", {"s", 7 * 927.6}},
           {"time_canonical", {"", 56}},
           {"state_canonical", {"", {4, 8, 12, 2, 2.5, 3}}},
           {"position_rounding_m", {"m", 1e-7}},
           {"flown_deputies", {"", 8}},
           {"amplitude_m", {"m", 1000}},
           {"position_miss_m", {"m", 0.75}},
           {"time_miss_s", {"s", 0.375}},
           {"linear_position_miss_m", {"m", nullptr}},
           {"linear_time_miss_s", {"s", 3.5}}}};
}

inline Walk periodic_walk() {
  PeriodicStudy study{sample_long_scene(), {}, {}};
  PeriodicSettings& settings = study.scene.periodic.emplace();
  settings.family.emplace().along = "period";
  PeriodicOrbit orbit;
  orbit.nodes.states = {Vector<double>::LinSpaced(6, 1, 6)};
  orbit.nodes.period = 7;
  orbit.energy = -1.5;
  orbit.mismatch = 1e-14;
  orbit.closing = 1e-12;
  orbit.iterations = 5;
  orbit.monodromy.indices = {{-3, 0}, {0.5, 0}};
  orbit.monodromy.multipliers = {{-5.75, 0}, {0.5, 0.875}};
  orbit.monodromy.trivial_defect = 1e-10;
  orbit.monodromy.determinant_defect = 2e-10;
  orbit.monodromy.symplectic_defect = 3e-10;
  study.family.members = {{orbit, 6}, {orbit, 7, "fold of the energy"}};
  study.family.end = "too few";
  study.paths = {{0, {{0, 0}, {1, 1}}}};
  return {periodic_tables(study).front(),
          periodic_report(study, sample_transfer_origin()),
          {1},
          {{"verdict", {"", periodic_verdict(study)}},
           {"hold", {"", "energy"}},
           {"along", {"", "period"}},
           {"end", {"", "too few"}},
           {"along_value", {"", 56}},
           {"period_canonical", {"", 56}},
           {"period_s", {"s", 7 * 927.6}},
           {"energy", {"", -0.375}},
           {"jacobi_constant", {"", 0.75}},
           {"start", {"", {4, 8, 12, 2, 2.5, 3}}},
           {"closing", {"", 1e-12}},
           {"mismatch", {"", 1e-14}},
           {"newton_steps", {"", 5}},
           {"stability_indices", {"", {-3, 0.5}}},
           {"stability_indices_imag", {"", {0, 0}}},
           {"multipliers", {"", {-5.75, 0.5}}},
           {"multipliers_imag", {"", {0, 0.875}}},
           {"stable", {"", false}},
           {"trivial_defect", {"", 1e-10}},
           {"determinant_defect", {"", 2e-10}},
           {"symplectic_defect", {"", 3e-10}},
           {"marks", {"", "fold of the energy"}}}};
}

inline BoundedFormation sample_bounded() {
  BoundedFormation formation;
  formation.scene = sample_long_scene();
  BoundedSettings& settings = formation.scene.bounded.emplace();
  settings.phase_deg = 91;
  settings.cross_track = 0.4375;
  settings.along_track = 0.1875;
  settings.box.half_widths_m = Eigen::Vector3d(10, 20, 30);
  formation.nodal_period = 6.5;
  formation.mean_period = 6.25;
  formation.mean_node = std::numbers::pi / 4;
  formation.revolutions = 21;
  BoundedDeputy deputy;
  deputy.rule = BoundedRule::refined;
  deputy.wanted_m = 1000;
  deputy.amplitude = 0.03125;
  deputy.size_m = 1001;
  deputy.least_size_m = 990;
  deputy.largest_size_m = 1010;
  deputy.last_size_m = 1005;
  deputy.period_difference = 1e-9;
  deputy.momentum_difference = 0.5;
  deputy.refinements = 3;
  for (std::size_t i = 0; i < 36; ++i) deputy.forms[i / 6][i % 6] = 0.5 + static_cast<double>(i);
  deputy.first = {{{100, -200, 300}, {0, 0, 0}}, {{-300, 400, 1000}, {0, 0, 0}}};
  deputy.drifts = {{2, 1e-6, 2e-7, 3e-8, 4e-9}, {20, -5e-6, 6e-7, 7e-8, 8e-9}};
  deputy.lowest_m = 6.9e6;
  formation.deputies = {deputy, deputy};
  formation.deputies[0].rule = BoundedRule::poincare_map;
  formation.deputies[0].failure = "none of this size";
  BoxControl& box = formation.box.emplace();
  box.days = 2;
  box.start = {1, 2, 3, 4, 5, 6};
  box.farthest = 0.96875;
  box.least_m = {-9, -19, -29};
  box.most_m = {8, 18, 28};
  box.returns.resize(2);
  box.returns[0].first_m_s = {0, 0, 30};
  box.returns[1].time = 0.5;
  box.returns[1].duration = 0.25;
  box.returns[1].first_m_s = {3, 4, 12};
  box.returns[1].second_m_s = {2, 3, 6};
  box.returns[1].miss_m = 0.0625;
  box.returns[1].farthest = 0.875;
  formation.scene.thruster.emplace();
  BurnedReturn& burned = box.returns[1].burns.emplace();
  burned.farthest = 0.75;
  burned.plan.miss_m = 0.03125;
  burned.plan.burns.resize(2);
  FiniteBurn& first = burned.plan.burns[0];
  first.start = -0.03125;
  first.end = 0.0078125;
  first.direction = {0.6, 0, 0.8};
  first.change_m_s = 13.5;
  first.propellant_kg = 0.5;
  FiniteBurn& second = burned.plan.burns[1];
  second.start = 0.1875;
  second.end = 0.3125;
  second.direction = {0, 0.28, 0.96};
  second.change_m_s = 7.25;
  second.propellant_kg = 0.375;
  return formation;
}

inline std::vector<Walk> bounded_walks() {
  const BoundedFormation formation = sample_bounded();
  const StudyReport report = bounded_report(formation, sample_transfer_origin());
  Walk deputies = {bounded_table(formation),
                   report,
                   {1},
                   {{"verdict", {"", bounded_verdict(formation)}},
                    {"phase_deg", {"deg", 91}},
                    {"cross_track", {"", 0.4375}},
                    {"along_track", {"", 0.1875}},
                    {"revolutions", {"", 21}},
                    {"nodal_period_s", {"s", 6.5 * 927.6}},
                    {"mean_nodal_period_s", {"s", 6.25 * 927.6}},
                    {"node_deg_per_revolution",
                     {"deg a revolution", std::numbers::pi / 4 * 180 / std::numbers::pi}},
                    {"wanted_m", {"m", 1000}},
                    {"rule", {"", "refined"}},
                    {"size_m", {"m", 1001}},
                    {"least_size_m", {"m", 990}},
                    {"largest_size_m", {"m", 1010}},
                    {"last_size_m", {"m", 1005}},
                    {"held", {"", true}},
                    {"eccentricity_difference", {"", 0.03125}},
                    {"half_widths_m", {"m", {200, 300, 350}}},
                    {"tenth_revolutions", {"", 2}},
                    {"tenth_along_drift", {"", 1e-6}},
                    {"tenth_along_doubt", {"", 2e-7}},
                    {"tenth_cross_drift", {"", 3e-8}},
                    {"tenth_along_range", {"", 4e-9}},
                    {"window_revolutions", {"", 20}},
                    {"window_along_drift", {"", -5e-6}},
                    {"window_along_doubt", {"", 6e-7}},
                    {"window_cross_drift", {"", 7e-8}},
                    {"window_along_range", {"", 8e-9}},
                    {"period_difference", {"", 1e-9}},
                    {"momentum_difference_canonical", {"", 1}},
                    {"refinements", {"", 3}},
                    {"lowest_m", {"m", 6.9e6}},
                    {"failure", {"", nullptr}}}};
  const std::vector<std::pair<std::string, std::string>> starts = {
      {"RTN-rotating.R_m", "m"},
      {"RTN-rotating.T_m", "m"},
      {"RTN-rotating.N_m", "m"},
      {"RTN-rotating.vR_m_s", "m/s"},
      {"RTN-rotating.vT_m_s", "m/s"},
      {"RTN-rotating.vN_m_s", "m/s"},
      {"RTN-inertial.R_m", "m"},
      {"RTN-inertial.T_m", "m"},
      {"RTN-inertial.N_m", "m"},
      {"RTN-inertial.vR_m_s", "m/s"},
      {"RTN-inertial.vT_m_s", "m/s"},
      {"RTN-inertial.vN_m_s", "m/s"},
      {"inertial.x_m", "m"},
      {"inertial.y_m", "m"},
      {"inertial.z_m", "m"},
      {"inertial.vx_m_s", "m/s"},
      {"inertial.vy_m_s", "m/s"},
      {"inertial.vz_m_s", "m/s"},
      {"curvilinear.radial_m", "m"},
      {"curvilinear.arc_m", "m"},
      {"curvilinear.cross_m", "m"},
      {"curvilinear.radial_rate_m_s", "m/s"},
      {"curvilinear.arc_rate_m_s", "m/s"},
      {"curvilinear.cross_rate_m_s", "m/s"},
      {"relative-elements.a_da_m", "m"},
      {"relative-elements.a_dlambda_m", "m"},
      {"relative-elements.a_dex_m", "m"},
      {"relative-elements.a_dey_m", "m"},
      {"relative-elements.a_dix_m", "m"},
      {"relative-elements.a_diy_m", "m"},
      {"element-differences.da_m", "m"},
      {"element-differences.dtheta_deg", "deg"},
      {"element-differences.di_deg", "deg"},
      {"element-differences.dq1", ""},
      {"element-differences.dq2", ""},
      {"element-differences.draan_deg", "deg"}};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    deputies.columns[starts[i].first] = {starts[i].second, 0.5 + static_cast<double>(i)};
  }
  return {deputies,
          {box_table(formation),
           report,
           {1},
           {{"half_widths_m", {"m", {10, 20, 30}}},
            {"reference", {"", "member"}},
            {"days", {"", 2}},
            {"returns", {"", 2}},
            {"total_change_m_s", {"m/s", 50}},
            {"change_m_s_a_day", {"m/s a day", 25}},
            {"farthest_of_all", {"", 0.96875}},
            {"held", {"", true}},
            {"places_a_revolution", {"", 96}},
            {"least_m", {"m", {-9, -19, -29}}},
            {"most_m", {"m", {8, 18, 28}}},
            {"start_canonical", {"", {4, 8, 12, 2, 2.5, 3}}},
            {"time_s", {"s", 0.5 * 927.6}},
            {"duration_s", {"s", 0.25 * 927.6}},
            {"change_m_s", {"m/s", 20}},
            {"first_m_s", {"m/s", {3, 4, 12}}},
            {"second_m_s", {"m/s", {2, 3, 6}}},
            {"miss_m", {"m", 0.0625}},
            {"farthest", {"", 0.875}},
            {"burns_total_change_m_s", {"m/s", 20.75}},
            {"burns_held", {"", true}},
            {"burns_propellant_kg", {"kg", 0.875}},
            {"burns_farthest_of_all", {"", 0.75}},
            {"first_burn_s", {"s", 0.0390625 * 927.6}},
            {"first_burn_start_s", {"s", (0.5 - 0.03125) * 927.6}},
            {"first_burn_m_s", {"m/s", 13.5}},
            {"first_burn_direction", {"", {0.6, 0, 0.8}}},
            {"second_burn_s", {"s", 0.125 * 927.6}},
            {"second_burn_start_s", {"s", (0.5 + 0.1875) * 927.6}},
            {"second_burn_m_s", {"m/s", 7.25}},
            {"second_burn_direction", {"", {0, 0.28, 0.96}}},
            {"burns_m_s", {"m/s", 20.75}},
            {"burns_miss_m", {"m", 0.03125}},
            {"burns_farthest", {"", 0.75}},
            {"burns_failure", {"", ""}}}}};
}

/// All of these.
inline std::vector<Walk> long_motion_walks() {
  std::vector<Walk> all = poincare_walks();
  all.push_back(event_walk());
  all.push_back(periodic_walk());
  for (Walk& walk : bounded_walks()) all.push_back(std::move(walk));
  return all;
}

}  // namespace hamjet::io::report_tables
