#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../src/report/formation/validity_table.hpp"
#include "../../src/report/formation/validity_view.hpp"
#include "report_tables.hpp"
#include "support/text.hpp"
#include "transfer_samples.hpp"

// CSV and JSON of validity and assignment: the numbers in the files are those of the results, bit
// for bit.

namespace hamjet::io {
namespace {

using namespace report_tables;

TEST(ValidityReport, HoldsTheNumbersOfTheResult) {
  const ValidityResult result = sample_validity();
  const Table table = parse(table_csv(validity_table(result)));
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(table.number(0, "predicted_m"), 2000.0 / 3);
  EXPECT_EQ(table.number(1, "proved_m"), 3.9e4);
  EXPECT_EQ(table.number(2, "time_s"), 2 * 927.6);
  EXPECT_EQ(table.number(2, "proved_m"), 0);
  EXPECT_EQ(table.at(3, "at_limit"), "true");
  EXPECT_EQ(table.number(3, "miss_m"), 0.2);
  const StudyReport report = validity_report(result, sample_transfer_origin());
  Json json;
  summary_of(report, json);
  EXPECT_EQ(json["study"], "validity");
  const Json& validity = json["validity"];
  EXPECT_EQ(validity["times"][1]["orders"][1]["proved_m"], 5e5);
  EXPECT_EQ(validity["times"][1]["orders"][1]["at_limit"], true);
  EXPECT_EQ(validity["flights"], 1234);
  EXPECT_EQ(validity["seconds"]["proof"], 2.5);
  EXPECT_NE(report.table.find(">500 km"), std::string::npos) << report.table;
}

TEST(ValidityReport, SaysWhatLimitsTheHighestOrder) {
  const ValidityResult result = sample_validity();
  const Table table = parse(table_csv(validity_table(result)));
  EXPECT_EQ(table.number(3, "limit_degree"), 2.96875);
  EXPECT_EQ(table.at(3, "limit_start_coordinate"), "period");
  EXPECT_EQ(table.number(3, "limit_end_share"), 0.90625);
  EXPECT_EQ(table.at(0, "limit_end_coordinate"), "");
  const StudyReport report = validity_report(result, sample_transfer_origin());
  Json json;
  const Json& orders = summary_of(report, json)["validity"]["times"][1]["orders"];
  EXPECT_EQ(orders[1]["limit_start_degree"], 2.1875);
  EXPECT_EQ(orders[1]["limit_end_coordinate"], "tau");
  EXPECT_TRUE(orders[0]["limit_degree"].is_null());
  EXPECT_NE(report.table.find("order 2 is limited at 500 km, where the miss grows as degree 3.0 of "
                              "the deviation, 2.2 by period, and 91 % in tau at the end\n"),
            std::string::npos)
      << report.table;
}

// Whichever were chosen, the Cartesian ones too.
TEST(ValidityReport, SaysByWhatAutomaticCoordinatesWereChosen) {
  ValidityResult result = sample_validity();
  const auto table = [&] { return validity_report(result, sample_transfer_origin()).table; };
  EXPECT_EQ(table().find("coordinates"), std::string::npos) << table();
  result.coordinates.reaches = {{JetCoordinates::cartesian, 2500}, {JetCoordinates::nodal, 1250}};
  EXPECT_NE(table().find("; cartesian coordinates (auto: the furthest, 2.5 km; nodal 1.25 km)\n"),
            std::string::npos)
      << table();
  Json json;
  const StudyReport report = validity_report(result, sample_transfer_origin());
  EXPECT_EQ(summary_of(report, json)["validity"]["chosen_by_reach_m"]["nodal"], 1250);
}

TEST(ValidityReport, SaysWhereNothingIsProved) {
  ValidityResult result = sample_validity();
  const std::string words = "The flights themselves are right to";
  for (ValidityEntry& entry : result.points.back().entries) entry.proved_m = 10;
  EXPECT_EQ(validity_verdict(result).find(words), std::string::npos) << validity_verdict(result);
  result.points.back().entries.front().proved_m = 0;
  EXPECT_NE(validity_verdict(result).find(words), std::string::npos) << validity_verdict(result);
}

TEST(ValidityReport, NamesTheFrameInEveryFile) {
  struct Names {
    RelativeFrame frame;
    std::string name;
    std::string derivatives;  ///< empty: there are no axes that could turn
  };
  ValidityResult result = sample_validity();
  for (const Names& names : {Names{RelativeFrame::rtn_rotating, "RTN", "rotating"},
                             Names{RelativeFrame::rtn_inertial, "RTN", "inertial"},
                             Names{RelativeFrame::inertial, "inertial", ""}}) {
    const bool is_rtn = names.name == "RTN";
    result.scene.validity->frame = names.frame;
    const StudyReport report = validity_report(result, sample_transfer_origin());
    const std::string kind = is_rtn ? " with " + names.derivatives + " derivatives" : "";
    EXPECT_NE(report.table.find("\nframe " + names.name + kind + "\n"), std::string::npos)
        << report.table;
    Json json;
    const Json& validity = summary_of(report, json)["validity"];
    EXPECT_EQ(validity["frame"], names.name);
    EXPECT_EQ(validity["derivatives"], is_rtn ? Json(names.derivatives) : Json(nullptr));
    EXPECT_EQ(validity["axes"], is_rtn ? Json({"R", "T", "N"}) : Json({"x", "y", "z"}));
    const Table table = parse(table_csv(validity_table(result)));
    ASSERT_EQ(table.rows.size(), 4U);
    for (std::size_t row = 0; row < 4; ++row) {
      EXPECT_EQ(table.at(row, "frame"), names.name);
      EXPECT_EQ(table.at(row, "derivatives"), names.derivatives);
    }
  }
}

TEST(AssignmentReport, HoldsTheNumbersOfTheResult) {
  const AssignmentResult result = sample_assignment();
  const Table costs = parse(costs_csv(result));
  ASSERT_EQ(costs.rows.size(), 4U);
  EXPECT_EQ(costs.number(1, "total_change_m_s"), 1.0 / 3);
  EXPECT_EQ(costs.number(2, "time_canonical"), 6);
  EXPECT_EQ(costs.number(2, "time_s"), 6 * 927.6);
  EXPECT_EQ(costs.at(3, "time_s"), "");
  EXPECT_EQ(costs.at(3, "total_change_m_s"), "");
  const Table table = parse(assignment_csv(result));
  ASSERT_EQ(table.rows.size(), 2U);
  const TransferPoint& point = result.transfers[1].transfer;
  EXPECT_EQ(table.at(1, "deputy"), "1");
  EXPECT_EQ(table.at(1, "slot"), "0");
  EXPECT_EQ(table.number(1, "end_change_n_m_s"), point.refined->end_change_m_s[2]);
  EXPECT_EQ(table.number(1, "total_change_m_s"), point.refined->total_change_m_s());
  EXPECT_EQ(table.number(1, "miss_m"), point.refined->miss_m);
  Json json;
  const StudyReport report = assignment_report(result);
  summary_of(report, json);
  EXPECT_EQ(json["study"], "assignment");
  EXPECT_EQ(json["total_change_m_s"], 1.0 / 3 + 2.25);
  EXPECT_EQ(json["transfers"][1]["slot"], 0);
  EXPECT_EQ(json["transfers"][1]["transfer"]["miss_m"], point.refined->miss_m);
  EXPECT_TRUE(json["common_time_s"].is_null());
  EXPECT_TRUE(json["failure"].is_null());
  EXPECT_NE(report.table.find("deputy 1 to slot 0"), std::string::npos) << report.table;
  EXPECT_LE(test::widest_line(report.table), 80U) << report.table;
}

TEST(AssignmentReport, WithoutAnAssignmentNothingIsMadeUp) {
  AssignmentResult result = sample_assignment();
  result.transfers.clear();
  result.total_change_m_s = 0;
  result.failure = "deputy 1 has no answer for any slot, at any time";
  EXPECT_TRUE(parse(assignment_csv(result)).rows.empty());
  const StudyReport report = assignment_report(result);
  Json json;
  summary_of(report, json);
  EXPECT_TRUE(json["total_change_m_s"].is_null());
  EXPECT_EQ(json["failure"], result.failure);
  EXPECT_EQ(report.exit_code, 4);
  EXPECT_EQ(report.failure, result.failure);
}

}  // namespace
}  // namespace hamjet::io
