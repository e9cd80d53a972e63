#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "../../text/terminal_text.hpp"
#include "comparison_view.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {

namespace {

/// If no run is as good as the scene wants: the one that comes nearest, and what to try.
std::string nearest_text(const ComparisonResult& result) {
  const double wanted = result.scene.comparison.wanted_error_m;
  if (!has_formation_error(result) || !cheapest_runs(result, wanted).empty()) return "";
  const ComparedRun* nearest = nullptr;
  for (const ComparedRun& run : result.runs) {
    if (!run.is_finished() || !std::isfinite(run.error_at_formation_m)) continue;
    if (!nearest || run.error_at_formation_m < nearest->error_at_formation_m) nearest = &run;
  }
  if (!nearest || nearest->error_at_formation_m <= wanted) return "";
  return fmt::format(
      "The nearest is {}, {} wrong; smaller tolerances, shorter steps or more stages in [compare] "
      "may reach it.\n",
      nearest->settings.label, length_text(nearest->error_at_formation_m));
}

}  // namespace

std::string comparison_table(const ComparisonResult& result) {
  std::string text = verdict(result) + "\n" + nearest_text(result);
  if (!result.is_complete) text += "PARTIAL: the comparison was broken off\n";
  const std::vector<SeriesReach> series = times_to_reach(result);
  if (!series.empty()) {
    std::vector<std::vector<std::string>> rows = {{"time to reach an error of"}, {"best"}};
    for (std::size_t k = 0; k < std::size(reached_errors); ++k) {
      rows[0].push_back(fmt::format("{:.0e}", reached_errors[k]));
      const auto best = best_time(series, k);
      rows[1].push_back(best ? duration_text(*best) : "-");
    }
    for (const SeriesReach& row : series) {
      rows.push_back({row.series});
      for (std::size_t k = 0; k < row.seconds.size(); ++k) {
        rows.back().push_back(
            row.seconds[k] ? fmt::format("{:.1f}", *row.seconds[k] / *best_time(series, k)) : "-");
      }
    }
    text +=
        "\n" + aligned_table(rows) +
        "\nEach line is a series: the runs of a method with one number of stages or one order. It "
        "has "
        "the median time of the series' cheapest run with that relative error (largest over all "
        "degrees), as a ratio to the best of all series; - where no run of it reaches that.\n";
  }
  const UnfinishedCount count = count_unfinished(result);
  if (count.failed + count.left_out > 0) {
    text += fmt::format("runs that failed: {}; runs left out: {}; the reasons are in the results\n",
                        count.failed, count.left_out);
    if (count.left_out > 0) {
      text += fmt::format(
          "compare.time_budget_s of {:g} s covers the runs that are compared, with their repeats; "
          "the reference, the errors along time and the fits of orders came on top\n",
          result.scene.comparison.time_budget_s);
    }
  }
  return fitted(text);
}

std::string comparison_details(const ComparisonResult& result) {
  const auto size = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.1e}", *value) : "";
  };
  std::vector<std::vector<std::string>> rows = {
      {"run", "median time", "relative error", "error estimate", "symplecticity"}};
  for (const ComparedRun& run : result.runs) {
    rows.push_back({run.settings.label});
    if (!run.is_finished()) continue;
    const auto seconds = median_seconds(run);
    rows.back().insert(rows.back().end(),
                       {seconds ? duration_text(*seconds) : "", size(largest_error(run)),
                        size(largest_error_estimate(run)), size(largest_symplecticity(run))});
  }
  return rows.size() == 1 ? "" : "\n" + aligned_table(rows);
}

}  // namespace hamjet::io
