#include <fmt/format.h>

#include <algorithm>

#include "comparison_view.hpp"
#include "hamjet/report/comparison_report.hpp"

namespace hamjet::io {
namespace {

/// Places that a text takes: bytes that continue a character of UTF-8 take none.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string fill(widths[i] - width(row[i]), ' ');
      text += i == 0 ? row[i] + fill : "  " + fill + row[i];
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string comparison_table(const ComparisonResult& result) {
  std::string text = verdict(result) + "\n";
  if (!result.is_complete) text += "PARTIAL: the comparison was broken off\n";
  const std::vector<SeriesReach> series = times_to_reach(result);
  if (!series.empty()) {
    std::vector<std::vector<std::string>> rows = {{"time to reach relative error"}, {"best"}};
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
        "\n" + aligned(rows) +
        "\nEach line: median time of the series' cheapest run with that error (largest over all "
        "degrees),\nas a ratio to the best of all series; - where no run of it reaches that.\n";
  }
  const UnfinishedCount count = count_unfinished(result);
  if (count.failed + count.left_out > 0) {
    text += fmt::format("runs that failed: {}; runs left out: {}; the reasons are in the results\n",
                        count.failed, count.left_out);
  }
  return text;
}

}  // namespace hamjet::io
