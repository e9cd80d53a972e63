#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../../src/report/formation/drift_view.hpp"
#include "../../src/report/propagation/force_table.hpp"
#include "bounded_walks.hpp"
#include "formation_walks.hpp"
#include "uncertainty_walks.hpp"

// What a person reads on the terminal and in the verdicts: of made-up results, the numbers that
// must be there are written down here.

namespace hamjet::io {
namespace {

using namespace report_tables;

void expect_texts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

/// The words of the first line that begins so, without the blanks between them.
std::string line_of(const std::string& text, const std::string& begin) {
  const std::size_t at = text.find("\n" + begin);
  EXPECT_NE(at, std::string::npos) << begin << " begins no line of\n" << text;
  if (at == std::string::npos) return "";
  std::string words;
  for (const char c : text.substr(at + 1, text.find('\n', at + 1) - at - 1)) {
    if (c != ' ' || (!words.empty() && words.back() != ' ')) words += c;
  }
  while (words.ends_with(' ')) words.pop_back();
  return words;
}

TEST(TerminalNumbers, OfAValidity) {
  const StudyReport report = validity_report(sample_validity(), sample_transfer_origin());
  expect_texts(report.table, {"650 m", "39 km", ">500 km"});
  EXPECT_EQ(report.details, "1234 flights; 500 ms for the jets, 2.5 s to fly (floor 1 μm)\n");
}

TEST(TerminalNumbers, OfTheReachInSeveralCoordinates) {
  ValidityInCoordinates all;
  all.results = {sample_validity(), sample_validity()};
  all.results[0].points[1].entries[1] = {2, 1900, 2000, 0.5, false, {}};
  all.results[1].coordinates.start = all.results[1].coordinates.end = JetCoordinates::flow_box;
  const StudyReport report = coordinates_report(all, sample_transfer_origin());
  expect_texts(report.table,
               {"up to 500 km in flow-box coordinates, 250 times as far as the 2 km"});
  EXPECT_EQ(line_of(report.table, "2 "), "2 2 km >500 km");
}

TEST(TerminalNumbers, OfADrift) {
  RelativeDrift drift;
  drift.per_revolution_m = -73;
  drift.period_difference_s = 0.25;
  const RelativeState state = {{0, -100, 0}, {1, 2, 3}};
  Scene scene;
  EXPECT_EQ(drift_text(scene, drift, state, RelativeFrame::rtn_rotating),
            "Left to itself it drifts 73 m a revolution backwards along the track: its period is "
            "0.25 s longer than that of its chief.");
  scene.system.earth.emplace().drag_m2_kg = 0.02;
  scene.system.earth->atmosphere.emplace();
  scene.deputy.emplace().drag_m2_kg = 0.03;
  EXPECT_EQ(drift_text(scene, drift, state, RelativeFrame::rtn_rotating),
            "Left to itself it drifts 73 m in the first revolution backwards along the track: its "
            "period is 0.25 s longer than that of its chief; it differs from its chief in what air "
            "or light does to it, so that the drift changes with every revolution.");
  nlohmann::ordered_json json;
  add_drift(json, drift, state);
  EXPECT_EQ(json["drift_m_per_revolution"], -73);
  EXPECT_EQ(json["period_difference_s"], 0.25);
  EXPECT_TRUE(json["velocity_without_drift_m_s"].is_null());
}

TEST(TerminalNumbers, OfTransfers) {
  TransferResult result = whole_transfer();
  result.optimal->plan->lower_bound_m_s = 17.5;
  result.primer.emplace().largest = {2, 1.375};
  result.scene.transfer->waypoints.resize(1);
  WaypointPlan& way = result.waypoints->plans[0];
  way.forbidden.clear();
  way.legs[0].start = 0.25;
  way.legs[0].end = 5;
  const StudyReport report = report_of(result);
  // The unit of time is 927.6 s. The best transfer is the refined one of the last time.
  const double least = result.points.back().refined->total_change_m_s();
  expect_texts(
      report.table,
      {"transfer times   6, 927.6 s to 5565.6 s:",
       fmt::format("  least            {:.4g} m/s in 5565.6 s (92.8 min), qqq-qqq, refined:",
                   least),
       "  order 1          1.23 km, 1.23 km", "  order 2          300 mm, 300 mm",
       "  refined          33.3 μm, 33.3 μm",
       "That is the last of the times searched: beyond it the change may fall further, which "
       "longer",
       "no impulses cost less than 17.5 m/s",
       "the primer vector reaches 1.38 at 1855.2 s (30.9 min)",
       "Through 1 waypoint it takes at least 15 m/s with an impulse at each, in 4638 s (77.3 min)",
       "never more than 0.0625 m/s^2; by order 2 alone it misses by 1.5 m.",
       "  lasting thrust   9.5 m/s over 4638 s (77.3 min), at most 0.0625 m/s^2"});
  Json json;
  const Json& leg = summary_of(report, json)["waypoints"]["plan"]["legs"][0];
  EXPECT_EQ(leg["start_s"], 0.25 * 927.6);
  EXPECT_EQ(leg["end_s"], 5 * 927.6);
}

TEST(TerminalNumbers, OfTheForcesThatAreLeftOut) {
  Scene scene;
  scene.system.earth.emplace();
  scene.deputy.emplace();
  const std::string text =
      force_text(scene, {{"Sun", "sun = false", 4.25e-7, 39.9, 0.00175}, {"Moon", "moon = false"}});
  EXPECT_EQ(line_of(text, "    Sun"), "Sun 4.25e-07 39.9 m 1.75 mm sun = false");
  EXPECT_EQ(line_of(text, "    Moon"), "Moon 0.00e+00 0 m moon = false");
}

TEST(TerminalNumbers, OfAnEvent) {
  const std::string table = event_walk().report.table;
  EXPECT_EQ(line_of(table, "100 m "), "100 m 0.5 0.25 5 2.5");
  EXPECT_EQ(line_of(table, "1 km "), "1 km 0.75 0.375 not flown 3.5");
}

// 0.125 of 8750 km are 1094 km, of which the table has three digits; a turn is 16 revolutions; the
// period is 6.25 times 927.6 s. The table is broken in two.
TEST(TerminalNumbers, OfAFrozenOrbit) {
  const std::string table = poincare_walks().front().report.table;
  EXPECT_EQ(line_of(table, "1090 km"), "1090 km -0.0625 16 5797.5");
  EXPECT_EQ(line_of(table, "273 km (chief)"), "273 km (chief) -0.0625 16 5797.5");
  EXPECT_EQ(line_of(table.substr(table.find("miss (50 revolutions)")), "1090 km"),
            "1090 km 90 1.00e-05");
}

TEST(TerminalNumbers, OfDeputiesThatStay) {
  const StudyReport report = bounded_report(sample_bounded(), sample_transfer_origin());
  // The half widths are those of bounded_walks; the drift over the window has its doubt behind it.
  expect_texts(report.table, {"1 km", "990 m to 1.01 km", "200 m", "300 m", "350 m",
                              "1.00e-06+-2e-07", "-5.00e-06+-6e-07", "7.00e-08", "8.00e-09"});
  expect_texts(
      box_verdict(sample_bounded()),
      {"Kept for 2 days in a box of +-10, 20 and 30 m",
       "it takes 2 returns of two impulses, 50 m/s together or 25 m/s a day",
       "burns of the thruster in their place, of at most 116 s, take 20.75 m/s and 0.875 kg, "
       "and lead it at most 0.75 half widths from the middle",
       "never farther from the middle than 0.9688 of the half widths"});
}

TEST(TerminalNumbers, OfPeriodicOrbits) {
  const std::string table = periodic_walk().report.table;
  expect_texts(table, {"between 1 and 2: fold of the energy"});
  EXPECT_EQ(line_of(table, "1  "), "1 48 -0.375 -3 0.5 1.0e-12");
  EXPECT_EQ(line_of(table, "2  "), "2 56 -0.375 -3 0.5 1.0e-12");
}

TEST(TerminalNumbers, OfAnUncertainty) {
  const StudyReport report = uncertainty_report(sample_uncertainty(), sample_transfer_origin());
  // The fifth samples have 0.4 * 5 as the first component's standard deviation.
  expect_texts(report.table, {"2±0.02", "1.5±0.03", "0.25±0.04",
                              "2.700e-01 (Foster, Alfano), 2.800e-01 (Chan)", "0.001 to 0.003",
                              "least separations are within 1.2e-01 m of 64 flights", "49 to 56"});
}

}  // namespace
}  // namespace hamjet::io
