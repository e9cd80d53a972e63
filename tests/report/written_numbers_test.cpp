#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "../../src/report/paper/paper_reports.hpp"
#include "../../src/report/stability/stability_report.hpp"
#include "bounded_walks.hpp"
#include "hamjet/report/results.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "report_tables.hpp"

// What is written by hand into summary.json and CSV, beside the tables that are walked: of made-up
// results, the numbers that must be there are written down here.

namespace hamjet::io {
namespace {

using namespace report_tables;

const std::string& file_of(const StudyReport& report, const std::string& path) {
  for (const ReportFile& file : report.files) {
    if (file.path == path) return file.content;
  }
  ADD_FAILURE() << "no file " << path;
  return report.files.front().content;
}

/// The field of a CSV text in a row, from 1, that stands below this heading.
std::string field(const std::string& csv, std::size_t row, const std::string& heading) {
  std::istringstream lines(csv);
  std::string line, name, value;
  std::getline(lines, line);
  std::istringstream names(line);
  for (std::size_t i = 0; i < row; ++i) std::getline(lines, line);
  std::istringstream values(line);
  while (std::getline(names, name, ',')) {
    std::getline(values, value, ',');
    if (name == heading) return value;
  }
  ADD_FAILURE() << "no column " << heading;
  return "";
}

TEST(WrittenNumbers, OfARun) {
  PropagationResult result = propagate(parse_scene(R"(schema = 1
[system]
model = "kepler"
mu_km3_s2 = 398600.4415
[nominal]
a_km = 7000
e = 0.1
i_deg = 50
raan_deg = 0
argp_deg = 0
ta_deg = 0
[jet]
order = 1
duration_s = 100
[reference]
)",
                                                   "x"));
  ASSERT_TRUE(result.reference);
  RunResult& run = result.runs.at(0);
  run.statistics.rejected_steps = 37;
  result.reference->statistics.steps = 41;
  run.error_estimate.by_degree = std::vector<double>{1.25e-7, 3.5e-5};
  ArcStatistics& arcs = run.arcs.emplace();
  arcs.plan.nominal_multiply_adds = 1001;
  arcs.plan.step_multiply_adds = 2002;
  arcs.plan.arc_step_multiply_adds = 3003;
  arcs.plan.composition_multiply_adds = 4004;
  arcs.compositions = 5;
  const Json json = Json::parse(summary_json(result));
  EXPECT_EQ(json["reference"]["steps"], 41);
  ASSERT_EQ(json["runs"].size(), 1U);
  const Json& of_run = json["runs"][0];
  EXPECT_EQ(of_run["rejected_steps"], 37);
  EXPECT_EQ(of_run["arcs"]["compositions"], 5);
  EXPECT_EQ(of_run["arcs"]["multiply_adds"], Json({{"nominal_step", 1001},
                                                   {"step", 2002},
                                                   {"step_of_later_arcs", 3003},
                                                   {"composition", 4004}}));
  const std::string details = summary_details(result);
  EXPECT_NE(details.find("37"), std::string::npos) << details;
  EXPECT_NE(details.find("3.5e-05"), std::string::npos) << details;
}

TEST(WrittenNumbers, OfAnEnergyConservingTrajectory) {
  EnergyConservationResult result;
  result.study.units.time_s = 3600;
  result.study.system.model = SystemModel::harmonic_oscillator;
  EnergyConservationPoint point;
  point.state = {0.5, 0.25};
  point.energy_error = 0.0625;
  point.discrete = 0.125;
  result.points = {point, point};
  result.fixed_step.energy_errors = {{2, 0.375}};
  const StudyReport report = study_report(result, Figure::left_out);
  EXPECT_EQ(field(file_of(report, "trajectory.csv"), 1, "energy_error"), "0.0625");
  EXPECT_EQ(field(file_of(report, "trajectory.csv"), 1, "discrete_energy_error"), "0.125");
}

TEST(WrittenNumbers, OfACanonicalTransformation) {
  CanonicalTransformationResult result;
  result.study.system.model = SystemModel::harmonic_oscillator;
  CanonicalTransformationRun& run = result.runs.emplace_back();
  run.requested_step = run.step = 0.5;
  run.largest_energy_error = 0.0625;
  run.largest_transformed_energy_error = 0.03125;
  run.largest_energy_difference = 0.015625;
  run.largest_state_difference = 0.375;
  run.trajectory = {{1, 0.5, {0, 1}, {2, 3}, 0.5, 0.75}};
  const StudyReport report = study_report(result, Figure::left_out);
  Json json;
  const Json& of_run = summary_of(report, json)["runs"][0];
  EXPECT_EQ(of_run["largest_energy_error"], 0.0625);
  EXPECT_EQ(of_run["largest_transformed_energy_error"], 0.03125);
  EXPECT_EQ(of_run["largest_energy_difference"], 0.015625);
  EXPECT_EQ(of_run["largest_state_difference"], 0.375);
  const std::string& csv = file_of(report, of_run["trajectory"]);
  EXPECT_EQ(field(csv, 1, "energy_error"), "0.5");
  EXPECT_EQ(field(csv, 1, "transformed_energy_error"), "0.75");
  EXPECT_EQ(field(csv, 1, "difference"), "0.25");
}

TEST(WrittenNumbers, OfTheTwoRoutesOfOptimalControl) {
  OptimalControlResult result;
  result.study.model = ControlModel::double_integrator;
  DiscreteTrajectory& trajectory = result.solution.trajectory;
  trajectory.states = trajectory.costates = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};
  trajectory.controls = {Eigen::VectorXd::Ones(1)};
  RouteComparison& routes = result.routes.emplace();
  routes.difference = {0.25, 0.5, 0.375};
  routes.cost = 0.125;
  Json json;
  const Json& written = summary_of(study_report(result, Figure::left_out), json)["routes"];
  EXPECT_EQ(written["states"], 0.25);
  EXPECT_EQ(written["costates"], 0.5);
  EXPECT_EQ(written["controls"], 0.375);
  EXPECT_EQ(written["cost"], 0.125);
}

TEST(WrittenNumbers, OfAnEventMap) {
  const std::string& csv = file_of(event_walk().report, "event-map.csv");
  // The time is 7 in units of which the user is told eighths.
  EXPECT_NE(csv.find("time,0,0,0,0,0,0,56"), std::string::npos) << csv;
}

TEST(WrittenNumbers, OfStability) {
  StabilityCase subject{"case", "a case", "group", "why", {}, Scene()};
  StabilityResult result;
  result.subject = &subject;
  result.error = MeasuredError{"state", 0.25, 0.125};
  result.measured = {*result.error};
  const StudyReport report = stability_report({result}, ReportOrigin());
  EXPECT_EQ(field(file_of(report, "stability.csv"), 1, "error"), "0.25");
  EXPECT_EQ(field(file_of(report, "stability.csv"), 1, "floor"), "0.125");
  Json json;
  EXPECT_EQ(summary_of(report, json)["cases"][0]["floor"], 0.125);
}

}  // namespace
}  // namespace hamjet::io
