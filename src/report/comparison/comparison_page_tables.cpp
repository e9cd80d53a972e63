#include <fmt/format.h>

#include <algorithm>

#include "../../formats/results_names.hpp"
#include "../../studies/reference.hpp"
#include "../drawing/report_page.hpp"
#include "comparison_page.hpp"
#include "comparison_view.hpp"

namespace hamjet::io {
namespace {

std::string small_number(double value) { return fmt::format("{:.1e}", value); }

std::string run_name(const ComparedRun& run) { return row_name_cell(run.settings.label); }

/// A run without figures: what became of it, over all columns.
std::string reason_row(const ComparedRun& run, std::size_t columns) {
  const bool is_failed = !run.failure.empty();
  return fmt::format("<tr class=\"{}\">{}<td class=\"reason\" colspan=\"{}\">{}: {}</td></tr>\n",
                     is_failed ? "failed" : "left-out", run_name(run), columns,
                     is_failed ? "failed" : "left out",
                     escape_html(is_failed ? run.failure : run.left_out));
}

std::string spread(const ComparedRun& run) {
  if (run.seconds.empty()) return "–";
  const auto [least, most] = std::minmax_element(run.seconds.begin(), run.seconds.end());
  return fmt::format("{} … {}", duration_text(*least), duration_text(*most));
}

std::string cost_cells(const ComparedRun& run) {
  return cell(run.seconds.empty() ? "–" : duration_text(run.median_seconds())) + cell(spread(run)) +
         cell(std::to_string(run.statistics.steps)) +
         cell(std::to_string(run.statistics.rejected_steps)) +
         cell(count_text(static_cast<double>(run.statistics.vector_field_evaluations))) +
         cell(count_text(run.multiply_adds)) + cell(memory_text(run.memory_bytes));
}

/// An error that the reference can vouch for, or the bound below which it cannot.
std::string claimed(double error, double smallest, bool is_metric) {
  const auto text = [&](double x) { return is_metric ? length_text(x) : small_number(x); };
  return error < smallest ? "below " + text(smallest) : text(error);
}

std::string error_cell(const ComparisonResult& result, const ComparedRun& run, std::size_t degree) {
  if (degree >= run.error_by_degree.size()) return cell("–");
  return cell(claimed(run.error_by_degree[degree],
                      result.smallest_claimed_error(static_cast<int>(degree)), false));
}

std::string residual_cell(const ComparedRun& run, std::size_t degree) {
  if (!run.exactness_failure.empty()) return cell("none");
  if (degree >= run.exactness.size()) return cell("–");
  const ExactnessEntry& entry = run.exactness[degree];
  return cell(small_number(entry.residual.scaled) + (is_at_floor(entry) ? " *" : ""));
}

/// Says where a fit was made; empty if from the comparison's own runs.
std::string extended_text(const ConvergenceFit& fit) {
  if (!fit.is_extended) return "";
  if (fit.arc == 1) return "in extended precision: ";
  return fmt::format("in extended precision, over 1/{:.0f} of the duration: ", 1 / fit.arc);
}

}  // namespace

std::string reach_table_html(const ComparisonResult& result) {
  const std::vector<SeriesReach> series = times_to_reach(result);
  if (series.empty()) return "";
  std::string head = "<th scope=\"col\">series</th>";
  std::string best_row = "<th scope=\"row\">best time</th>";
  for (std::size_t k = 0; k < std::size(reached_errors); ++k) {
    const auto best = best_time(series, k);
    head += fmt::format("<th scope=\"col\">{:.0e}</th>", reached_errors[k]);
    best_row += cell(best ? duration_text(*best) : "–");
  }
  std::string rows = "<tr class=\"best\">" + best_row + "</tr>\n";
  for (const SeriesReach& row : series) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", escape_html(row.series));
    for (std::size_t k = 0; k < row.seconds.size(); ++k) {
      rows += cell(row.seconds[k] ? fmt::format("{:.1f}", *row.seconds[k] / *best_time(series, k))
                                  : "–");
    }
    rows += "</tr>\n";
  }
  return table_html(
      "Time to reach a relative error (largest over all degrees), as a ratio to the best series: "
      "median of the series' cheapest run with that error. A dash: no run of it reaches that.",
      "<tr>" + head + "</tr>", rows);
}

std::string run_table_html(const ComparisonResult& result) {
  const bool is_metric = has_formation_error(result);
  std::vector<std::string> names = {"run",          "series",        "median time",
                                    "least … most", "steps",         "rejected",
                                    "evaluations",  "multiply-adds", "memory"};
  if (is_metric) names.push_back(shown_error_name(result));
  for (const char* name : {"largest relative error", "error estimate", "symplecticity defect",
                           "energy error", "corner"}) {
    names.emplace_back(name);
  }
  const double smallest = largest_claimed_error(result);
  const double smallest_metric = smallest_shown_error(result);
  std::string rows;
  for (const ComparedRun& run : result.runs) {
    if (!run.is_finished()) {
      rows += reason_row(run, names.size() - 1);
      continue;
    }
    rows += "<tr>" + run_name(run) + cell(run.series) + cost_cells(run);
    if (is_metric) rows += cell(claimed(run.error_at_formation_m, smallest_metric, true));
    rows +=
        cell(run.error_by_degree.empty() ? "–" : claimed(run.largest_error(), smallest, false)) +
        cell(run.error_estimate_by_degree.empty() ? "–"
                                                  : small_number(run.largest_error_estimate())) +
        cell(run.symplecticity.empty() ? "–" : small_number(run.largest_symplecticity())) +
        cell(small_number(run.energy_error)) + cell(run.corner ? corner_text(*run.corner) : "–") +
        "</tr>\n";
  }
  return table_html(
      "All runs at the scene's order. Evaluations of the vector field are on series. The error "
      "estimate is made without the reference, from independent runs along two "
      "directions.",
      "<tr>" + header_cells(names) + "</tr>", rows);
}

std::string degree_table_html(const ComparisonResult& result) {
  const auto degrees = static_cast<std::size_t>(result.scene.order) + 1;
  std::string head = "<tr><th scope=\"col\" rowspan=\"2\">run</th>";
  std::string second = "<tr>";
  for (std::size_t d = 0; d < degrees; ++d) {
    head += fmt::format("<th scope=\"colgroup\" colspan=\"2\">degree {}</th>", d);
    second += "<th scope=\"col\">error</th><th scope=\"col\">residual</th>";
  }
  std::string rows;
  for (const ComparedRun& run : result.runs) {
    if (!run.is_finished()) {
      rows += reason_row(run, 2 * degrees);
      continue;
    }
    rows += "<tr>" + run_name(run);
    for (std::size_t d = 0; d < degrees; ++d) {
      rows += error_cell(result, run, d) + residual_cell(run, d);
    }
    rows += "</tr>\n";
  }
  return table_html(
      "Relative error and scaled exactness residual of each degree. A star: the residual is at its "
      "floor, where the inversion's round-off hides the integrator. “none”: the generating "
      "function "
      "does not exist for this map.",
      head + "</tr>" + second + "</tr>", rows);
}

std::string cost_table_html(const ComparisonResult& result) {
  if (result.cost_runs.empty()) return "";
  const std::vector<std::string> names = {"run",          "order",         "median time",
                                          "least … most", "steps",         "rejected",
                                          "evaluations",  "multiply-adds", "memory"};
  std::string rows;
  for (const ComparedRun& run : result.cost_runs) {
    rows += run.is_finished() ? "<tr>" + run_name(run) + cell(std::to_string(run.order)) +
                                    cost_cells(run) + "</tr>\n"
                              : reason_row(run, names.size() - 1);
  }
  return table_html("Cost against order.", "<tr>" + header_cells(names) + "</tr>", rows);
}

std::string fit_table_html(const ComparisonResult& result) {
  if (result.fits.empty()) return "<p>No order of convergence was fitted.</p>\n";
  std::string rows;
  for (const ConvergenceFit& fit : result.fits) {
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{:.2f}</td><td>{:g}</td><td>{}</td>"
        "<td class=\"reason\">{}{}</td></tr>\n",
        escape_html(fit.series), fit.degree, fit.slope, fit.expected,
        fit.agrees() ? "yes" : "not yet", extended_text(fit),
        escape_html(fmt::format("{}", fmt::join(fit.labels, ", "))));
  }
  return table_html(
      "Fitted orders of convergence, by degree of the jet. Not yet within 0.3: the leading term "
      "does not dominate at the steps that lie above the rounding floor of double precision, and "
      "runs in extended precision would take too long.",
      "<tr>" + header_cells({"series", "degree", "fitted", "theory", "within 0.3"}) +
          "<th scope=\"col\" class=\"text\">runs used</th>" + "</tr>",
      rows);
}

std::string reference_html(const ComparisonResult& result) {
  const ReferenceResult& reference = result.reference;
  std::string rows;
  for (std::size_t d = 0; d < reference.uncertainty_by_degree.size(); ++d) {
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", d) +
            cell(small_number(reference.uncertainty_by_degree[d])) +
            cell(small_number(result.smallest_claimed_error(static_cast<int>(d)))) + "</tr>\n";
  }
  return fmt::format(
             "<p>The errors are differences from a jet that was integrated with {} significant "
             "bits by the Gauss method with {} stages, local tolerance {:g}, in {} steps, {}. A "
             "second run of different step size agrees with it as the table says: that is the "
             "reference’s own uncertainty, and no error below ten times it is plotted or claimed. "
             "{}</p>\n",
             reference_arithmetic(result.scene.precision, reference.tolerance).bits,
             reference.stages, reference.tolerance, reference.statistics.steps,
             duration_text(reference.statistics.wall_seconds),
             result.is_reference_cached ? "It was taken from the cache of an earlier comparison."
                                        : "It was computed for this comparison.") +
         table_html(
             "Uncertainty of the reference, relative to the largest coefficient of the degree.",
             "<tr>" + header_cells({"degree", "uncertainty", "smallest error claimed"}) + "</tr>",
             rows);
}

}  // namespace hamjet::io
