#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../src/report/formation/transfer_page.hpp"
#include "../../src/report/formation/transfer_tables.hpp"
#include "../../src/report/formation/transfer_view.hpp"
#include "hamjet/dynamics/system_text.hpp"
#include "report_tables.hpp"
#include "transfer_samples.hpp"

// CSV and JSON of the studies of relative motion: the numbers in the files are those of the
// results, bit for bit; what was not computed is empty or null, and nothing is NaN.

namespace hamjet::io {
namespace {

using namespace report_tables;

TEST(TransferCsv, HoldsTheNumbersOfTheResult) {
  const TransferResult result = sample_transfer();
  const Table table = parse(table_csv(transfers_table(result)));
  ASSERT_EQ(table.rows.size(), 6U);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{5}}) {
    const TransferPoint& point = result.points[i];
    EXPECT_EQ(table.number(i, "time_canonical"), point.time);
    EXPECT_EQ(table.number(i, "time_s"), point.time * 927.6);
    EXPECT_EQ(table.at(i, "kind"), "qqq-qqq");
    EXPECT_EQ(table.number(i, "condition"), point.condition);
    EXPECT_EQ(table.number(i, "position_condition"), point.position_condition);
    EXPECT_EQ(table.number(i, "singular_distance_s"), *point.singular_distance * 927.6);
    EXPECT_EQ(table.at(i, "near_singular"), "false");
    EXPECT_EQ(table.at(i, "answer"), "refined");
    const TransferAnswer& refined = *point.refined;
    EXPECT_EQ(table.number(i, "start_change_r_m_s"), refined.start_change_m_s[0]);
    EXPECT_EQ(table.number(i, "start_change_t_m_s"), refined.start_change_m_s[1]);
    EXPECT_EQ(table.number(i, "start_change_n_m_s"), refined.start_change_m_s[2]);
    EXPECT_EQ(table.number(i, "end_change_r_m_s"), refined.end_change_m_s[0]);
    EXPECT_EQ(table.number(i, "end_change_t_m_s"), refined.end_change_m_s[1]);
    EXPECT_EQ(table.number(i, "end_change_n_m_s"), refined.end_change_m_s[2]);
    EXPECT_EQ(table.number(i, "total_change_m_s"), refined.total_change_m_s());
    EXPECT_EQ(table.number(i, "refined_total_change_m_s"), refined.total_change_m_s());
    EXPECT_EQ(table.number(i, "refined_miss_m"), refined.miss_m);
    EXPECT_EQ(table.at(i, "refinement_flights"), "2");
    EXPECT_EQ(table.number(i, "miss_m_order_2"), point.answers[1].miss_m);
    EXPECT_EQ(table.number(i, "hamilton_jacobi_residual"), *point.hamilton_jacobi_residual);
  }
  EXPECT_EQ(table.number(0, "linear_total_change_m_s"),
            result.points[0].answers[0].total_change_m_s());
  EXPECT_EQ(table.number(0, "miss_m_order_1"), 1234.5);
  EXPECT_EQ(table.at(0, "failure"), "");
}

TEST(TransferCsv, WhatWasNotComputedIsEmpty) {
  const Table table = parse(table_csv(transfers_table(sample_transfer())));
  EXPECT_EQ(table.at(1, "linear_total_change_m_s"), "");
  EXPECT_EQ(table.at(1, "miss_m_order_1"), "");
  EXPECT_EQ(table.at(1, "failure"), "order 1: no convergence, \"really\", after 20");
  EXPECT_EQ(table.at(2, "near_singular"), "true");
  EXPECT_EQ(table.at(2, "beyond_tolerance"), "true");
  EXPECT_EQ(table.at(2, "kind"), "qpq-qqp");
  EXPECT_EQ(table.at(2, "position_condition"), "inf");
  EXPECT_EQ(table.at(2, "answer"), "order 2");
  EXPECT_EQ(table.at(2, "refined_miss_m"), "");
  EXPECT_EQ(table.at(2, "refinement_flights"), "");
  EXPECT_EQ(table.at(2, "hamilton_jacobi_residual"), "");
  for (const char* column : {"kind", "condition", "answer", "start_change_r_m_s",
                             "total_change_m_s", "miss_m_order_2", "refined_miss_m"}) {
    EXPECT_EQ(table.at(3, column), "") << column;
  }
  EXPECT_EQ(table.at(3, "failure"), "no kind of generating function exists at this time");
  EXPECT_EQ(table.at(4, "answer"), "order 2");
  EXPECT_EQ(table.at(4, "refined_miss_m"), "");
  EXPECT_EQ(table.at(4, "singular_distance_s"), "");
  EXPECT_EQ(table.at(4, "failure"), "the refinement did not reach 0.001 m");
}

TEST(TransferCsv, ColumnsNameTheAxesOfTheFrame) {
  TransferResult result = sample_transfer();
  EXPECT_NE(table_csv(transfers_table(result)).find(",end_change_n_m_s,"), std::string::npos);
  result.scene.transfer->frame = RelativeFrame::inertial;
  EXPECT_NE(table_csv(transfers_table(result)).find(",end_change_z_m_s,"), std::string::npos);
}

TEST(TransferCsv, SingularTimesAndConditions) {
  const TransferResult result = sample_transfer();
  const Table singular = parse(table_csv(singular_times_table(result)));
  ASSERT_EQ(singular.rows.size(), 3U);
  EXPECT_EQ(singular.at(2, "kind"), "qqq-ppp");
  EXPECT_EQ(singular.number(0, "time_canonical"), 3.01);
  EXPECT_EQ(singular.number(0, "time_s"), 3.01 * 927.6);
  EXPECT_EQ(singular.number(1, "smallest_ratio"), 2e-17);
  EXPECT_EQ(singular.number(1, "second_ratio"), 1e-9);
  EXPECT_EQ(singular.number(0, "direction_inertial_x"), 0);
  EXPECT_EQ(singular.number(0, "direction_inertial_y"), 0.6);
  EXPECT_EQ(singular.number(0, "direction_inertial_z"), -0.8);
  EXPECT_EQ(singular.number(0, "direction_n"), 1);
  const Table conditions = parse(table_csv(conditions_table(result)));
  ASSERT_EQ(conditions.rows.size(), 6U);
  EXPECT_EQ(conditions.columns.size(), 66U);
  EXPECT_EQ(conditions.number(1, "qqq-qqq"), 10.0 / 3);
  EXPECT_EQ(conditions.at(3, "qqq-qqq"), "inf");
  EXPECT_EQ(conditions.number(3, "ppp-ppp"), 23);
}

// A coordinate of an own system may be called r; the chief has no R, T and N there.
TEST(TransferCsv, SingularTimesOfOwnSystemsAreAlongItsCoordinates) {
  TransferResult result = sample_transfer();
  result.scene.transfer->frame = RelativeFrame::coordinates;
  result.scene.system.own_text = SystemText{};
  result.scene.system.own_text->coordinates = {"r", "theta"};
  result.scene.system.own_text->momenta = {"pr", "ptheta"};
  const Table singular = parse(table_csv(singular_times_table(result)));
  EXPECT_EQ(singular.number(0, "direction_inertial_r"), 0);
  EXPECT_EQ(singular.number(0, "direction_inertial_theta"), 0.6);
  for (const std::string& column : singular.columns) {
    EXPECT_NE(column, "direction_r");
    EXPECT_NE(column, "direction_t");
    EXPECT_NE(column, "direction_n");
  }
  const std::string page = singular_table_html(result);
  EXPECT_EQ(page.find("RTN"), std::string::npos) << page;
  EXPECT_NE(page.find("(+0.000000, +0.600000)"), std::string::npos) << page;
}

TEST(TransferView, CountsAndMisses) {
  const TransferCounts counts = count_points(sample_transfer());
  EXPECT_EQ(counts.times, 6U);
  EXPECT_EQ(counts.compared, 4U);
  EXPECT_EQ(counts.answered, 5U);
  EXPECT_EQ(counts.near_singular, 1U);
  EXPECT_EQ(counts.beyond_tolerance, 1U);
  EXPECT_EQ(counts.beyond_tolerance_away, 0U);
  EXPECT_EQ(counts.unanswered_away, 1U);
  EXPECT_EQ(counts.refined, 3U);
  EXPECT_EQ(counts.refinement_failed, 1U);
  TransferResult result = sample_transfer();
  result.points[0].answers[0].miss_m = 1;
  result.points[4].answers[0].miss_m = 3;
  const auto misses = miss_statistics(result);
  ASSERT_EQ(misses.size(), 3U);
  // Points 0, 4 and 5; the linear answer of 1 failed, 2 is near a singularity, 3 has none.
  EXPECT_EQ(misses[0].count, 3U);
  EXPECT_EQ(misses[0].median_m, 3);
  EXPECT_EQ(misses[0].largest_m, 1234.5);
  EXPECT_EQ(misses[2].answer, "refined");
  EXPECT_EQ(misses[2].count, 3U);
  EXPECT_EQ(*costliest_point(result), 4U);
  EXPECT_EQ(time_text(5432), "5432 s (90.5 min)");
}

// Every time has exactly one outcome, so that the counts add up to the number of times.
TEST(TransferView, OutcomesAddUpAndSayWhatToDo) {
  TransferResult result = sample_transfer();
  result.points[4].is_beyond_tolerance = true;  // the refinement of this point failed
  result.points[5].is_beyond_tolerance = true;  // this point is refined
  const auto outcomes = transfer_outcomes(result);
  ASSERT_EQ(outcomes.size(), 4U);
  std::size_t sum = 0;
  for (const TransferOutcome& outcome : outcomes) sum += outcome.count;
  EXPECT_EQ(sum, result.points.size());
  EXPECT_EQ(outcomes[0].count, 3U);
  EXPECT_EQ(outcomes[0].text,
            "with an answer within 1 m, 1 of them only after correction by flying");
  EXPECT_EQ(outcomes[2].text, "missing by more than 1 m, which flying did not correct");
  const std::string verdict = transfer_verdict(result);
  for (const char* words :
       {"Of 6 times it compares 3 and leaves out 1 nearer to a singularity than the margin, 1 "
        "missing",
        "1 without an answer, which transfers.csv has, marked.", "A higher jet.order",
        "Why a time has no answer is in the column failure"}) {
    EXPECT_NE(verdict.find(words), std::string::npos) << words << "\n" << verdict;
  }
}

TEST(TransferSummary, HoldsTheBestPointCountsAndSeconds) {
  const TransferResult result = sample_transfer();
  Json json;
  summary_of(transfer_report(with_validity(result), sample_trajectory(), sample_transfer_origin()),
             json);
  EXPECT_EQ(json["study"], "transfer");
  EXPECT_EQ(json["frame"], "RTN");
  EXPECT_EQ(json["derivatives"], "rotating");
  EXPECT_EQ(json["verdict"], transfer_verdict(result));
  const TransferPoint& point = result.points[5];
  const Json& best = json["best"];
  EXPECT_EQ(best["time_canonical"], point.time);
  EXPECT_EQ(best["time_s"], point.time * 927.6);
  EXPECT_EQ(best["kind"], "qqq-qqq");
  EXPECT_EQ(best["start_change_m_s"][1], point.refined->start_change_m_s[1]);
  EXPECT_EQ(best["end_change_m_s"][2], point.refined->end_change_m_s[2]);
  EXPECT_EQ(best["total_change_m_s"], point.refined->total_change_m_s());
  EXPECT_EQ(best["miss_m"], point.refined->miss_m);
  EXPECT_EQ(best["linear_miss_m"], 1234.5);
  EXPECT_EQ(best["miss_m_by_order"], (std::vector<double>{1234.5, 0.1 + 0.2}));
  EXPECT_TRUE(best["failure"].is_null());
  EXPECT_EQ(json["counts"]["unanswered_away_from_singularities"], 1);
  ASSERT_EQ(json["position_singular_times"].size(), 2U);
  EXPECT_EQ(json["position_singular_times"][0]["time_canonical"], 3.01);
  EXPECT_EQ(json["position_singular_times"][0]["direction_inertial"][2], -0.8);
  EXPECT_EQ(json["flight_floor_m"], 2e-6);
  EXPECT_EQ(json["largest_hamilton_jacobi_residual"], 1e-14 / 3);
  EXPECT_EQ(json["hamilton_jacobi_floor"], 1e-15);
  EXPECT_EQ(json["seconds"]["study"], 0.9375);
  EXPECT_EQ(json["seconds"]["proof"], 3);
  EXPECT_EQ(json["validity"]["times"][0]["orders"][0]["predicted_m"], 2000.0 / 3);
  EXPECT_EQ(json["exit_code"], 0);
}

TEST(TransferSummary, SaysWhetherTheLeastIsAtAnEndOrBetweenTheListedTimes) {
  TransferResult result = sample_transfer();
  const auto summary = [&] {
    Json json;
    return summary_of(transfer_report(result, {}, sample_transfer_origin()), json);
  };
  // The best is the last of the six, and nothing was searched between them.
  EXPECT_EQ(summary()["is_first_or_last_time"], true);
  EXPECT_TRUE(summary()["least_between_listed_times"].is_null());
  EXPECT_EQ(summary()["times_between_listed"], 0);
  result.points[1] = sample_point(2, 1);
  result.least_between = sample_point(2.5, 0.5);
  result.times_between = 17;
  EXPECT_EQ(summary()["best"]["time_canonical"], 2);
  EXPECT_EQ(summary()["is_first_or_last_time"], false);
  EXPECT_EQ(summary()["times_between_listed"], 17);
  const Json between = summary()["least_between_listed_times"];
  EXPECT_EQ(between["time_canonical"], 2.5);
  EXPECT_EQ(between["time_s"], 2.5 * 927.6);
  EXPECT_EQ(between["total_change_m_s"], result.least_between->refined->total_change_m_s());
  EXPECT_EQ(between["miss_m"], result.least_between->refined->miss_m);
  result.points[0] = sample_point(1, 0.75);
  EXPECT_EQ(summary()["is_first_or_last_time"], true);
  // A single time has no times before or after it.
  result.points.resize(1);
  EXPECT_EQ(summary()["is_first_or_last_time"], false);
}

TEST(TransferSummary, WithoutAnAnswerTheBestIsNullAndTheFailureIsNamed) {
  TransferResult result = sample_transfer();
  result.points.assign(2, result.points[3]);
  const StudyReport report = transfer_report(result, {}, sample_transfer_origin());
  Json json;
  summary_of(report, json);
  EXPECT_TRUE(json["best"].is_null());
  EXPECT_EQ(json["is_first_or_last_time"], false);
  EXPECT_TRUE(json["validity"].is_null());
  EXPECT_TRUE(json["largest_hamilton_jacobi_residual"].is_null());
  EXPECT_EQ(json["exit_code"], 4);
  EXPECT_EQ(report.exit_code, 4);
  EXPECT_NE(report.failure.find("no transfer time has an answer"), std::string::npos);
  EXPECT_NE(report.failure.find("no kind of generating function"), std::string::npos);
  EXPECT_NE(report.table.find("No velocity change can be named"), std::string::npos);
}

TEST(TransferView, SaysWhatToTryForWhatIsLeftOut) {
  TransferResult result = sample_transfer();
  const auto has = [&](const std::string& words) {
    return transfer_verdict(result).find(words) != std::string::npos;
  };
  EXPECT_FALSE(has("A higher jet.order"));
  // The fifth time has no refined answer: now it is also beyond the tolerance.
  result.points[4].is_beyond_tolerance = true;
  EXPECT_TRUE(has("1 missing by more than 1 m, which flying did not correct"));
  EXPECT_TRUE(has("A higher jet.order reaches further"));
  result.points[4].is_beyond_tolerance = false;
  EXPECT_FALSE(has("The kind auto"));
  result.scene.transfer->kind = "F1";
  EXPECT_TRUE(has("the kind auto may have one"));
  EXPECT_TRUE(has("the last of the times searched"));
  EXPECT_TRUE(has("longer times"));
  result.points[0] = sample_point(1, 0.5);
  EXPECT_TRUE(has("the first of the times searched"));
  EXPECT_TRUE(has("shorter times"));
  result.points[0] = sample_point(1, 3);
  result.points[1] = sample_point(2, 0.5);
  EXPECT_FALSE(has("of the times searched"));
}

TEST(TransferSummary, StrictSaysHowManyAreAtFault) {
  TransferResult result = sample_transfer();
  result.scene.transfer->strict = true;
  const StudyReport report = transfer_report(result, {}, sample_transfer_origin());
  EXPECT_EQ(report.exit_code, 1);
  EXPECT_EQ(report.failure,
            "strict: of 5 transfer times away from singularities 1 have no answer, 0 miss by more "
            "than 1 m, and the refinement of 1 failed");
  result.scene.transfer->strict = false;
  EXPECT_EQ(transfer_report(result, {}, sample_transfer_origin()).failure, "");
}

TEST(TransferTable, HoldsBestWorstAndSingularTimes) {
  const TransferResult result = sample_transfer();
  const std::string table = transfer_report(result, {}, sample_transfer_origin()).table;
  EXPECT_NE(table.find(transfer_verdict(result)), std::string::npos) << table;
  EXPECT_NE(
      table.find(
          "F1 singular      at 2792.0760, 5843.8800 (double, or a pair closer than 7e-06 s) s"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find(":\n                   4 with an answer within 1 m\n"
                       "                   1 nearer to a singularity than the margin\n"
                       "                   1 without an answer\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("greatest"), std::string::npos) << table;
}

// A change of a tenth of a micrometre per second is not six zeros.
TEST(TransferTable, ImpulsesHaveDigitsOfAnySize) {
  TransferResult result = sample_transfer();
  result.optimal = OptimalImpulses{};
  result.optimal->plan = ImpulsePlan{};
  ImpulsePlan& plan = *result.optimal->plan;
  plan.duration = 6;
  plan.impulses = {{0, {0.3, -1e-9, 0}}, {6, {0, 1.25e-7, -2.5e-10}}};
  const auto table = [&] { return transfer_report(result, {}, sample_transfer_origin()).table; };
  EXPECT_NE(table().find(" 0.300000 "), std::string::npos) << table();
  EXPECT_EQ(table().find("-0.000000"), std::string::npos) << table();
  EXPECT_NE(table().find("1.2500e-07  -2.5000e-10"), std::string::npos) << table();
  // Without a bound no bound is printed; a time at which the solver failed is printed.
  EXPECT_EQ(table().find("no impulses cost less"), std::string::npos) << table();
  EXPECT_NE(table().find("is not known"), std::string::npos) << table();
  EXPECT_EQ(table().find("the solver failed"), std::string::npos) << table();
  LeastChange failed;
  failed.time = 3;
  failed.failure = "the simplex method found no optimum";
  failed.is_unproved = true;
  result.optimal->by_time = {failed};
  EXPECT_NE(table().find("For 1 transfer time the solver failed"), std::string::npos) << table();
  EXPECT_EQ(exit_code(result), 1);
  EXPECT_NE(transfer_failure(result), "");
}

TEST(TransferTable, TellsTheResidualFromWhatAnUlpMakesOfIt) {
  TransferResult result = sample_transfer();
  const std::string line =
      "  Hamilton-Jacobi  residual 3.3e-15 at worst, at the transfers' own ends";
  const auto table = [&] { return transfer_report(result, {}, sample_transfer_origin()).details; };
  EXPECT_NE(table().find(line + " (an ulp in the coefficients makes 1.0e-15)\n"), std::string::npos)
      << table();
  result.hamilton_jacobi_floor.reset();
  EXPECT_NE(table().find(line + "\n"), std::string::npos) << table();
  Json json;
  summary_of(transfer_report(result, {}, sample_transfer_origin()), json);
  EXPECT_TRUE(json["hamilton_jacobi_floor"].is_null());
}

}  // namespace
}  // namespace hamjet::io
