#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "comparison_samples.hpp"
#include "hamjet/error.hpp"
#include "support/text.hpp"

// compare.json is read back as it was written, and compare.csv contains the same numbers.

namespace hamjet::io {
namespace {

void expect_same(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " " << b;
}

void expect_same(const std::optional<double>& a, const std::optional<double>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_same(*a, *b);
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i]);
}

void expect_same(const ExactnessResidual& a, const ExactnessResidual& b) {
  EXPECT_EQ(a.degree, b.degree);
  expect_same(a.absolute, b.absolute);
  expect_same(a.scaled, b.scaled);
  expect_same(a.at_formation_scale, b.at_formation_scale);
}

void expect_same(const ComparedRun& a, const ComparedRun& b) {
  EXPECT_EQ(a.settings.label, b.settings.label);
  EXPECT_EQ(a.settings.method, b.settings.method);
  if (a.settings.method == IntegrationMethod::gauss) {
    EXPECT_EQ(a.settings.stages, b.settings.stages);
  }
  expect_same(a.settings.step_canonical, b.settings.step_canonical);
  expect_same(a.settings.tolerance, b.settings.tolerance);
  expect_same(a.settings.require_relative_error, b.settings.require_relative_error);
  expect_same(a.settings.require_symplecticity, b.settings.require_symplecticity);
  EXPECT_EQ(a.series, b.series);
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.failure, b.failure);
  EXPECT_EQ(a.left_out, b.left_out);
  EXPECT_EQ(a.statistics.steps, b.statistics.steps);
  EXPECT_EQ(a.statistics.rejected_steps, b.statistics.rejected_steps);
  EXPECT_EQ(a.statistics.vector_field_evaluations, b.statistics.vector_field_evaluations);
  EXPECT_EQ(a.statistics.nominal_evaluations, b.statistics.nominal_evaluations);
  expect_same(a.statistics.wall_seconds, b.statistics.wall_seconds);
  expect_same(a.multiply_adds, b.multiply_adds);
  expect_same(a.memory_bytes, b.memory_bytes);
  expect_same(a.seconds, b.seconds);
  expect_same(a.error_by_degree, b.error_by_degree);
  expect_same(a.error_estimate_by_degree, b.error_estimate_by_degree);
  expect_same(a.error_at_formation_m, b.error_at_formation_m);
  ASSERT_EQ(a.exactness.size(), b.exactness.size());
  for (std::size_t i = 0; i < a.exactness.size(); ++i) {
    expect_same(a.exactness[i].residual, b.exactness[i].residual);
    ASSERT_EQ(a.exactness[i].floor.has_value(), b.exactness[i].floor.has_value());
    if (a.exactness[i].floor) expect_same(*a.exactness[i].floor, *b.exactness[i].floor);
  }
  EXPECT_EQ(a.exactness_failure, b.exactness_failure);
  ASSERT_EQ(a.symplecticity.size(), b.symplecticity.size());
  for (std::size_t i = 0; i < a.symplecticity.size(); ++i) {
    EXPECT_EQ(a.symplecticity[i].degree, b.symplecticity[i].degree);
    expect_same(a.symplecticity[i].absolute, b.symplecticity[i].absolute);
    expect_same(a.symplecticity[i].scaled, b.symplecticity[i].scaled);
  }
  expect_same(a.energy_error, b.energy_error);
  EXPECT_EQ(a.corner, b.corner);
}

void expect_same(const std::vector<ComparedRun>& a, const std::vector<ComparedRun>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(a[i].settings.label);
    expect_same(a[i], b[i]);
  }
}

/// The line with which a file is refused.
std::string refusal(const std::string& text) {
  try {
    read_comparison_runs(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_output);
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "";
}

/// The file with one value changed, or removed if the new one is absent.
std::string summary_with(const std::string& pointer, std::optional<nlohmann::json> value) {
  auto json = nlohmann::json::parse(comparison_json(sample_comparison(), sample_origin()));
  const nlohmann::json::json_pointer place(pointer);
  EXPECT_TRUE(json.contains(place)) << pointer;
  if (value) {
    json[place] = *value;
  } else {
    json[place.parent_pointer()].erase(place.back());
  }
  return json.dump();
}

/// The fields of a row; quotes as in RFC 4180.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows = {{""}};
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && is_quoted && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !is_quoted) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  EXPECT_FALSE(is_quoted);
  rows.pop_back();
  return rows;
}

TEST(ComparisonJson, IsReadBackBitForBit) {
  ComparisonResult result = sample_comparison();
  result.runs[0].error_by_degree = {std::numeric_limits<double>::infinity(),
                                    -std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::denorm_min(),
                                    std::numeric_limits<double>::max(),
                                    0.1,
                                    -0.0};
  const EarlierRuns earlier = read_comparison_runs(comparison_json(result, sample_origin()));
  expect_same(result.runs, earlier.runs);
  expect_same(result.cost_runs, earlier.cost_runs);
  EXPECT_EQ(earlier.determinants, sample_origin().determinants);
  EXPECT_TRUE(earlier.is_complete);
  ASSERT_EQ(earlier.along_time.size(), result.along_time.size());
  for (std::size_t i = 0; i < result.along_time.size(); ++i) {
    const RunAlongTime& a = result.along_time[i];
    const RunAlongTime& b = earlier.along_time[i];
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.failure, b.failure);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k) {
      expect_same(a.points[k].time, b.points[k].time);
      expect_same(a.points[k].exactness, b.points[k].exactness);
      expect_same(a.points[k].condition, b.points[k].condition);
      expect_same(a.points[k].energy_error, b.points[k].energy_error);
    }
  }
}

TEST(ComparisonJson, KeepsThatANumberIsNone) {
  ComparisonResult result = sample_comparison();
  result.runs[0].energy_error = std::numeric_limits<double>::quiet_NaN();
  const EarlierRuns earlier = read_comparison_runs(comparison_json(result, sample_origin()));
  EXPECT_TRUE(std::isnan(earlier.runs[0].energy_error));
}

TEST(ComparisonJson, SaysWhereItComesFromAndWhetherItIsComplete) {
  ComparisonResult result = sample_comparison();
  result.is_complete = false;
  const std::string text = comparison_json(result, sample_origin());
  EXPECT_FALSE(read_comparison_runs(text).is_complete);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["complete"], false);
  EXPECT_EQ(json["command"], sample_origin().command);
  EXPECT_EQ(json["processor"], sample_origin().processor);
  EXPECT_EQ(json["date"], sample_origin().date);
  EXPECT_EQ(json["verdict"], verdict(result));
  EXPECT_EQ(json["runs"][3]["corner"], corner_names()[3]);
  EXPECT_EQ(json["runs"][3]["error_by_degree"][2], "inf");
}

TEST(ComparisonJson, AMalformedFileIsRefusedInOneLine) {
  const std::string good = comparison_json(sample_comparison(), sample_origin());
  EXPECT_EQ(refusal(good), "");
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("not valid JSON"), std::string::npos);
  EXPECT_NE(refusal("").find("not valid JSON"), std::string::npos);
  EXPECT_NE(refusal("[]").find("must be an object"), std::string::npos);
  EXPECT_NE(refusal("{}").find("schema: is missing"), std::string::npos);
  EXPECT_NE(refusal("{\"schema\": 1e999}"), "");
  EXPECT_NE(refusal(summary_with("/schema", 2)).find("another version"), std::string::npos);
  EXPECT_NE(
      refusal(summary_with("/runs/1/settings/method", "euler")).find("runs[1].settings.method"),
      std::string::npos);
  EXPECT_NE(refusal(summary_with("/runs/1/statistics/steps", 0.5)).find("runs[1].statistics.steps"),
            std::string::npos);
  EXPECT_NE(refusal(summary_with("/runs/0/order", 5000000000)).find("out of range"),
            std::string::npos);
  EXPECT_NE(refusal(summary_with("/runs/0/seconds/1", "fast")).find("runs[0].seconds[1]"),
            std::string::npos);
  EXPECT_NE(
      refusal(summary_with("/runs/0/corner", std::nullopt)).find("runs[0].corner: is missing"),
      std::string::npos);
  EXPECT_NE(refusal(summary_with("/along_time/0/points", 3)).find("along_time[0].points"),
            std::string::npos);
}

/// One run of each method that has a parameter of its own, and one of a method that has none.
std::vector<ComparedRun> runs_with_parameters() {
  std::vector<ComparedRun> runs(4, sample_run("a series", "a run", 1e-9));
  runs[1].settings.method = IntegrationMethod::velocity_verlet;
  runs[1].settings.order = 6;
  runs[2].settings.method = IntegrationMethod::newmark;
  runs[2].settings.beta = 0.125;
  runs[3].settings.method = IntegrationMethod::cvode_bdf;
  return runs;
}

TEST(ComparisonCsv, HasTheParametersOfEveryMethodAndNoOthers) {
  using Words = std::vector<std::string>;
  ComparisonResult result = sample_comparison();
  result.runs = runs_with_parameters();
  const auto rows = parse_csv(comparison_csv(result));
  const auto column = [&](const std::string& name) {
    const auto found = std::find(rows[0].begin(), rows[0].end(), name);
    const auto place = static_cast<std::size_t>(found - rows[0].begin());
    Words words;
    for (std::size_t r = 1; r <= 4; ++r) words.push_back(rows[r].at(place));
    return words;
  };
  EXPECT_EQ(column("stages"), (Words{"4", "", "", ""}));
  EXPECT_EQ(column("method_order"), (Words{"", "6", "", ""}));
  EXPECT_EQ(column("beta"), (Words{"", "", "0.125", ""}));
}

TEST(ComparisonJson, HasTheParametersOfEveryMethodAndNoOthers) {
  ComparisonResult result = sample_comparison();
  result.runs = runs_with_parameters();
  const std::string text = comparison_json(result, sample_origin());
  const auto runs = nlohmann::json::parse(text)["runs"];
  const char* const keys[] = {"stages", "order", "beta"};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(runs[r]["settings"][keys[k]].is_null(), r != k) << r << " " << keys[k];
    }
    EXPECT_EQ(runs[r]["settings"]["compensated_summation"].is_null(), r != 0);
  }
}

TEST(ComparisonCsv, SaysTheNumbersOfTheRuns) {
  const ComparisonResult result = sample_comparison();
  const auto rows = parse_csv(comparison_csv(result));
  ASSERT_EQ(rows.size(), 1 + result.runs.size() + result.cost_runs.size());
  for (std::size_t r = 1; r < rows.size(); ++r) {
    ASSERT_EQ(rows[r].size(), rows[0].size()) << r;
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < rows[0].size(); ++i) row[rows[0][i]] = rows[r][i];
    EXPECT_EQ(row.size(), rows[0].size()) << "two columns have one name";
    const bool is_cost = r > result.runs.size();
    const ComparedRun& run =
        is_cost ? result.cost_runs[r - 1 - result.runs.size()] : result.runs[r - 1];
    SCOPED_TRACE(run.settings.label);
    const auto number = [&](const char* column) {
      return std::strtod(row.at(column).c_str(), nullptr);
    };
    EXPECT_EQ(row["part"], is_cost ? "cost" : "comparison");
    EXPECT_EQ(row["series"], run.series);
    EXPECT_EQ(row["label"], run.settings.label);
    if (!run.is_finished()) {
      EXPECT_EQ(row["status"], run.failure.empty() ? "left out" : "failed");
      EXPECT_EQ(row["reason"], run.failure + run.left_out);
      EXPECT_EQ(row["steps"], "");
      EXPECT_EQ(row["largest_error"], "");
      EXPECT_EQ(row["corner"], "");
      continue;
    }
    EXPECT_EQ(row["status"], "finished");
    EXPECT_EQ(row["steps"], std::to_string(run.statistics.steps));
    expect_same(number("multiply_adds"), run.multiply_adds);
    expect_same(number("median_seconds"), run.median_seconds());
    EXPECT_EQ(row["repeats"], std::to_string(run.seconds.size()));
    expect_same(number("least_seconds"), 0.002);
    expect_same(number("most_seconds"), 1.0 / 300);
    expect_same(number("error_at_formation_m"), run.error_at_formation_m);
    expect_same(number("largest_error"), run.largest_error());
    expect_same(number("error_degree_0"), run.error_by_degree[0]);
    expect_same(number("error_degree_2"), run.error_by_degree[2]);
    if (run.error_estimate_by_degree.empty()) {
      EXPECT_EQ(row["largest_error_estimate"], "");
      EXPECT_EQ(row["error_estimate_degree_1"], "");
    } else {
      expect_same(number("largest_error_estimate"), run.error_estimate_by_degree[1]);
      expect_same(number("error_estimate_degree_2"), run.error_estimate_by_degree[2]);
    }
    expect_same(number("symplecticity_scaled_degree_0"), run.symplecticity[0].scaled);
    expect_same(number("largest_symplecticity"), run.largest_symplecticity());
    expect_same(number("energy_error"), run.energy_error);
    EXPECT_EQ(row["corner"], corner_names()[static_cast<std::size_t>(*run.corner)]);
    EXPECT_EQ(row["exactness_failure"], run.exactness_failure);
    if (run.exactness.empty()) {
      EXPECT_EQ(row["exactness_scaled_degree_0"], "");
      continue;
    }
    expect_same(number("exactness_scaled_degree_0"), run.exactness[0].residual.scaled);
    expect_same(number("exactness_floor_scaled_degree_0"), run.exactness[0].floor->scaled);
    EXPECT_EQ(row["exactness_floor_scaled_degree_1"], "");
    EXPECT_EQ(row["exactness_at_formation_scale_degree_1"], "");
  }
}

// A family of methods and its series of runs are different things: the report does not deny a
// result that the table has.
TEST(ComparisonVerdict, TellsAFamilyFromItsSeries) {
  ComparisonResult result = sample_comparison();
  ComparedRun coarse = sample_run("gauss, 2 stages", "gauss2", 1e-9);
  coarse.settings.stages = 2;
  coarse.seconds = {0.03};
  result.runs = {result.runs[1], coarse};
  std::string text = verdict(result);
  EXPECT_NE(
      text.find("next is gauss, 2 stages (step 0.1 canonical), of the same family, with 30 ms"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("no method of another family than gauss that was run reaches it"),
            std::string::npos)
      << text;
  // A run of another family that was not timed is not denied either.
  result.runs.push_back(sample_run("fehlberg78", "fehlberg", 1e-9));
  result.runs.back().settings.method = IntegrationMethod::fehlberg78;
  result.runs.back().seconds.clear();
  text = verdict(result);
  EXPECT_EQ(text.find("no method"), std::string::npos) << text;
  EXPECT_NE(text.find("were not timed"), std::string::npos) << text;
}

TEST(ComparisonTable, StatesRatiosToTheBest) {
  ComparisonResult result = sample_comparison();
  result.runs[1].error_by_degree = {4e-12, 8e-12, 1e-12};
  result.runs[2].error_by_degree = {2e-12, 2e-12, 2e-12};
  result.runs[3].error_by_degree = {1e-7, 1e-7, 1e-7};
  result.runs[3].seconds = {0.009};
  for (int i : {0, 1, 2}) result.runs[static_cast<std::size_t>(i)].seconds = {0.003};
  const std::string table = comparison_table(result);
  EXPECT_EQ(test::in_one_line(table).find(verdict(result)), 0U) << table;
  // gauss reaches the first two, fehlberg78 the first at three times the price, bdf none.
  const auto line = [&](const std::string& start) {
    const std::size_t begin = table.find("\n" + start);
    EXPECT_NE(begin, std::string::npos) << start;
    return table.substr(begin + 1, table.find('\n', begin + 1) - begin - 1);
  };
  const auto fields = [](std::string text) {
    std::vector<std::string> words;
    for (std::size_t i; (i = text.find_last_not_of(' ')) != std::string::npos;) {
      const std::size_t before = text.find_last_of(' ', i);
      words.insert(words.begin(), text.substr(before + 1, i - before));
      text.resize(before == std::string::npos ? 0 : before);
    }
    return std::vector<std::string>(words.end() - 3, words.end());
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(fields(line("gauss, 4 stages")), (Words{"1.0", "1.0", "-"}));
  EXPECT_EQ(fields(line("fehlberg78")), (Words{"3.0", "-", "-"}));
  EXPECT_EQ(fields(line("cvode-bdf")), (Words{"-", "-", "-"}));
  EXPECT_NE(table.find("runs that failed: 1; runs left out: 1"), std::string::npos) << table;
  EXPECT_NE(table.find(" covers the runs that are compared"), std::string::npos) << table;
}

TEST(ComparisonTable, NamesTheNearestRunWhereNoneIsGoodEnough) {
  ComparisonResult result = sample_comparison();
  const auto text = [&] { return test::in_one_line(comparison_table(result)); };
  EXPECT_EQ(text().find("The nearest is"), std::string::npos) << text();
  // The best of the sample's errors is 3e-15 times 1e6 m.
  result.scene.comparison.wanted_error_m = 1e-9;
  EXPECT_NE(text().find("The nearest is gauss4-0.01, 3 nm wrong; "), std::string::npos) << text();
}

TEST(ComparisonDetails, HaveARowForEveryRun) {
  const ComparisonResult result = sample_comparison();
  const std::string details = comparison_details(result);
  for (const ComparedRun& run : result.runs) {
    EXPECT_NE(details.find("\n" + run.settings.label + " "), std::string::npos) << details;
  }
  EXPECT_LE(test::widest_line(details), 80U) << details;
}

}  // namespace
}  // namespace hamjet::io
