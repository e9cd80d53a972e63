#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../../text/html_text.hpp"
#include "hamjet/studies/comparison.hpp"

// What the page, the plots and the terminal's table derive from a comparison, so that all say the
// same.

namespace hamjet::io {

/// What a run shows of its lists; none where they are empty.
std::optional<double> median_seconds(const ComparedRun& run);
std::optional<double> largest_error(const ComparedRun& run);
std::optional<double> largest_error_estimate(const ComparedRun& run);
std::optional<double> largest_symplecticity(const ComparedRun& run);

/// The largest ComparisonResult::smallest_claimed_error over the degrees of the scene's order.
double largest_claimed_error(const ComparisonResult& result);

/// Whether errors are stated at formation scale, in metres; otherwise the largest relative error
/// over all degrees takes their place.
bool has_formation_error(const ComparisonResult& result);

/// The error that plots and tables show: metres at formation scale, or relative.
double shown_error(const ComparisonResult& result, const ComparedRun& run);

/// Errors below this are not claimed: what ten times the reference's uncertainty makes of the shown
/// error at most.
double smallest_shown_error(const ComparisonResult& result);

/// The name of the error that is shown: "error at 10 km separation (m)" or "largest relative
/// error".
std::string shown_error_name(const ComparisonResult& result);

/// The names of all series, in the order in which they first occur.
std::vector<std::string> series_names(const std::vector<ComparedRun>& runs);

/// The separation at which errors are stated; none where they are relative.
std::optional<double> shown_separation_m(const ComparisonResult& result);

/// How a series looks in all plots, no two alike: a colour for the method, a shape for the place
/// among those of the method, filled where steps are fixed.
struct SeriesLook {
  std::size_t colour = 0;
  std::size_t shape = 0;
  bool is_filled = true;
};
SeriesLook series_look(const ComparisonResult& result, std::string_view series);

/// The kind whose exactness is stated, as "F1 (qqq-qqq)" or the notation alone; empty without a
/// kind.
std::string kind_text(const ComparisonResult& result);

/// The corner's name in words.
std::string_view corner_text(Corner corner);

/// Failed and left-out runs, main and cost runs together.
struct UnfinishedCount {
  std::size_t failed = 0;
  std::size_t left_out = 0;
};
UnfinishedCount count_unfinished(const ComparisonResult& result);

/// Relative errors, largest over all degrees, that tables state the time for.
inline constexpr double reached_errors[] = {1e-6, 1e-9, 1e-12};

/// A series and the least median time (s) of its runs that reach each of `reached_errors`.
struct SeriesReach {
  std::string series;
  std::vector<std::optional<double>> seconds;
};
std::vector<SeriesReach> times_to_reach(const ComparisonResult& result);

/// The least of all series for the k-th of `reached_errors`; none if no run reaches it.
std::optional<double> best_time(const std::vector<SeriesReach>& series, std::size_t k);

}  // namespace hamjet::io
