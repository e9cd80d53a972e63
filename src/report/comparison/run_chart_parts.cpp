#include "run_chart_parts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "comparison_view.hpp"

namespace hamjet::io {

ChartAxis error_axis(const ComparisonResult& result) {
  return logarithmic_axis(shown_error_name(result),
                          has_formation_error(result) ? AxisUnit::metres : AxisUnit::power);
}

ChartAxis run_time_axis() { return logarithmic_axis("time of integration", AxisUnit::seconds); }

bool is_claimed(double error, double smallest, std::size_t& below) {
  if (error > 0 && !(error < smallest)) return true;
  if (std::isfinite(error)) ++below;
  return false;
}

void note_below(const ComparisonResult& result, double smallest, std::size_t below, Chart& chart) {
  if (below == 0) return;
  chart.notes.push_back(fmt::format(
      "Not drawn: runs with an error below {}, ten times the reference's uncertainty, "
      "or of exactly zero: {}.",
      has_formation_error(result) ? length_text(smallest) : fmt::format("{:.1e}", smallest),
      below));
}

void add_wanted_error(const ComparisonResult& result, Chart& chart) {
  const double wanted_m = result.scene.comparison.wanted_error_m;
  if (!has_formation_error(result) || !(wanted_m > 0)) return;
  chart.rules.push_back({true, wanted_m, fmt::format("wanted: {}", length_text(wanted_m))});
}

}  // namespace hamjet::io
