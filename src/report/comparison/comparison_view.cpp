#include "comparison_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../drawing/along_time_charts.hpp"

namespace hamjet::io {
namespace {

void add_new_names(const std::vector<ComparedRun>& runs, std::vector<std::string>& names) {
  for (const ComparedRun& run : runs) {
    if (std::find(names.begin(), names.end(), run.series) == names.end()) {
      names.push_back(run.series);
    }
  }
}

template <class List>
std::optional<double> unless_empty(const List& list, const ComparedRun& run,
                                   double (ComparedRun::*value)() const) {
  return list.empty() ? std::nullopt : std::optional((run.*value)());
}

}  // namespace

std::optional<double> median_seconds(const ComparedRun& run) {
  return unless_empty(run.seconds, run, &ComparedRun::median_seconds);
}

std::optional<double> largest_error(const ComparedRun& run) {
  return unless_empty(run.error_by_degree, run, &ComparedRun::largest_error);
}

std::optional<double> largest_error_estimate(const ComparedRun& run) {
  return unless_empty(run.error_estimate_by_degree, run, &ComparedRun::largest_error_estimate);
}

std::optional<double> largest_symplecticity(const ComparedRun& run) {
  return unless_empty(run.symplecticity, run, &ComparedRun::largest_symplecticity);
}

double largest_claimed_error(const ComparisonResult& result) {
  double largest = 0;
  for (int d = 0; d <= result.scene.order; ++d)
    largest = std::max(largest, result.smallest_claimed_error(d));
  return largest;
}

bool has_formation_error(const ComparisonResult& result) {
  return result.scene.separation.has_value() && result.separation_points > 0;
}

double shown_error(const ComparisonResult& result, const ComparedRun& run) {
  return has_formation_error(result) ? run.error_at_formation_m : run.largest_error();
}

double smallest_shown_error(const ComparisonResult& result) {
  return has_formation_error(result) ? result.smallest_claimed_error_m()
                                     : largest_claimed_error(result);
}

std::string shown_error_name(const ComparisonResult& result) {
  const std::optional<double> separation_m = shown_separation_m(result);
  if (!separation_m) return "largest relative error";
  return fmt::format("position error at {} separation", length_text(*separation_m));
}

std::optional<double> shown_separation_m(const ComparisonResult& result) {
  if (!has_formation_error(result)) return std::nullopt;
  return *result.scene.separation * result.scene.units.length_km * 1000;
}

std::vector<std::string> series_names(const std::vector<ComparedRun>& runs) {
  std::vector<std::string> names;
  add_new_names(runs, names);
  return names;
}

SeriesLook series_look(const ComparisonResult& result, std::string_view series) {
  std::vector<IntegrationMethod> methods;
  std::vector<std::string> names;
  // Shapes used so far, for each method that of fixed and that of adaptive steps.
  std::vector<std::array<std::size_t, 2>> shapes;
  SeriesLook look;
  for (const auto* runs : {&result.runs, &result.cost_runs}) {
    for (const ComparedRun& run : *runs) {
      if (std::find(names.begin(), names.end(), run.series) != names.end()) continue;
      names.push_back(run.series);
      const auto method = std::find(methods.begin(), methods.end(), run.settings.method);
      look.colour = static_cast<std::size_t>(method - methods.begin());
      if (method == methods.end()) {
        methods.push_back(run.settings.method);
        shapes.push_back({0, 0});
      }
      look.is_filled = !run.settings.tolerance;
      look.shape = shapes[look.colour][look.is_filled ? 0 : 1]++;
      if (run.series == series) return look;
    }
  }
  return look;
}

std::string kind_text(const ComparisonResult& result) {
  return result.kind ? kind_text(*result.kind) : "";
}

std::string_view corner_text(Corner corner) {
  return corner_names()[static_cast<std::size_t>(corner)];
}

UnfinishedCount count_unfinished(const ComparisonResult& result) {
  UnfinishedCount count;
  for (const auto* runs : {&result.runs, &result.cost_runs}) {
    for (const ComparedRun& run : *runs) {
      if (!run.failure.empty()) {
        ++count.failed;
      } else if (!run.left_out.empty()) {
        ++count.left_out;
      }
    }
  }
  return count;
}

std::vector<SeriesReach> times_to_reach(const ComparisonResult& result) {
  const double smallest = largest_claimed_error(result);
  std::vector<SeriesReach> table;
  for (const std::string& name : series_names(result.runs)) {
    SeriesReach row{name, {}};
    for (const double wanted : reached_errors) {
      std::optional<double> least;
      for (const ComparedRun& run : result.runs) {
        if (run.series != name || !run.is_finished() || run.seconds.empty()) continue;
        // A reference that is too coarse to tell whether the error is reached claims nothing.
        if (wanted < smallest || !(run.largest_error() <= wanted)) continue;
        if (!least || run.median_seconds() < *least) least = run.median_seconds();
      }
      row.seconds.push_back(least);
    }
    table.push_back(row);
  }
  return table;
}

std::optional<double> best_time(const std::vector<SeriesReach>& series, std::size_t k) {
  std::optional<double> best;
  for (const SeriesReach& row : series) {
    if (row.seconds[k] && (!best || *row.seconds[k] < *best)) best = row.seconds[k];
  }
  return best;
}

}  // namespace hamjet::io
