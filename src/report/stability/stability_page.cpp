#include "stability_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/time_axis.hpp"
#include "../drawing/along_time_charts.hpp"
#include "../drawing/report_page.hpp"

namespace hamjet::io {
namespace {

std::string power_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.1e}", *value) : "-";
}

/// How close the errors come to the rounding floor, one point an error.
Chart ratio_chart(const std::vector<StabilityResult>& results) {
  Chart chart;
  chart.name = "error-over-floor";
  chart.title = "How close to the floor";
  chart.x.label = "errors, sorted by their ratio";
  chart.y = logarithmic_axis("error / floor");
  // How far below the floor an error is says nothing.
  constexpr double least_ratio = 1e-3;
  std::vector<double> ratios;
  for (const StabilityResult& result : results) {
    for (const MeasuredError& error : result.measured) {
      if (error.floor > 0 && error.tolerance == 0) ratios.push_back(error.error / error.floor);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  ChartCurve curve;
  curve.title = "state or matrix of a case";
  for (const double ratio : ratios) {
    curve.points.emplace_back(static_cast<double>(curve.points.size() + 1),
                              std::max(ratio, least_ratio));
  }
  const auto least =
      std::count_if(ratios.begin(), ratios.end(), [](double ratio) { return ratio < least_ratio; });
  if (least > 0) {
    chart.notes.push_back(fmt::format(
        "Errors below {:g} of their floor, zeros too, are drawn at it: {}.", least_ratio, least));
  }
  chart.curves.push_back(std::move(curve));
  chart.rules.push_back({false, 1, "the floor"});
  chart.reading =
      "Errors that have no tolerance of their own. The error against an independent reference, "
      "divided by the largest that random roundings at "
      "the start and in every step, carried along the flow, cause in a sample. Below 1 no program "
      "in double precision can promise to be.";
  return chart;
}

Chart growth_chart(const StabilityResult& result) {
  Chart chart;
  chart.name = "growth-" + result.subject->name;
  chart.title = "Growth: " + result.subject->title;
  const Scene& scene = std::get<Scene>(result.subject->scene);
  double longest = 0;
  for (const GrowthCurve& growth : result.growth) {
    for (const auto& point : growth.points) longest = std::max(longest, std::abs(point.first));
  }
  const TimeAxis axis = time_axis(longest * scene.units.time_s);
  const double unit = scene.units.time_s / axis.seconds;
  chart.x = logarithmic_axis(fmt::format("time ({})", axis.name));
  add_revolutions(scene, axis.seconds, chart.x);
  chart.y = logarithmic_axis("size");
  for (const GrowthCurve& growth : result.growth) {
    ChartCurve curve;
    curve.title = growth.quantity;
    curve.style = chart.curves.size();
    for (const auto& [time, value] : growth.points) {
      curve.points.emplace_back(std::abs(time) * unit, value);
    }
    chart.curves.push_back(std::move(curve));
    chart.reading +=
        fmt::format("{}: {} (expected {}{:g}). ", growth.quantity,
                    growth.exponent ? fmt::format("time to the power {:.2f}", *growth.exponent)
                                    : "never above round-off",
                    growth.is_upper_bound ? "at most " : "", growth.expected);
  }
  return chart;
}

std::string error_cells(const StabilityResult& result) {
  if (!result.error) return cell("-") + cell("-") + cell("-") + cell("-");
  return cell(result.error->quantity) + cell(fmt::format("{:.1e}", result.error->error)) +
         cell(fmt::format("{:.1e}", result.error->floor)) +
         cell(fmt::format("{:.1e}", result.error->allowed()));
}

std::string case_row(const StabilityResult& result) {
  const StabilityCase& subject = *result.subject;
  return "<tr>" + row_name_cell(subject.name) + cell(outcome_name(result.outcome)) +
         error_cells(result) + cell(power_text(result.energy_error)) +
         cell(power_text(result.symplecticity)) + cell(power_text(result.exactness)) +
         cell(power_text(result.condition)) +
         cell(result.steps ? fmt::format("{}", *result.steps) : "-") +
         cell(duration_text(result.seconds)) + "</tr>\n";
}

/// What each case is about, and against what it is compared or how it was answered.
std::string case_entry(const StabilityResult& result) {
  const StabilityCase& subject = *result.subject;
  std::string text = fmt::format("<dt>{}: {}</dt><dd>{}.", escape_html(subject.name),
                                 escape_html(subject.title), escape_html(subject.why));
  if (!subject.expected.source.empty()) {
    text += fmt::format(" Reference: {}.", escape_html(subject.expected.source));
  }
  if (!result.text.empty()) {
    text += fmt::format(" <strong>{}</strong>: {}", outcome_name(result.outcome),
                        escape_html(result.text));
  }
  return text + "</dd>\n";
}

std::vector<std::string> groups_of(const std::vector<StabilityResult>& results) {
  std::vector<std::string> groups;
  for (const StabilityResult& result : results) {
    const std::string& group = result.subject->group;
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  return groups;
}

std::string group_section(const std::vector<StabilityResult>& results, const std::string& group) {
  std::string rows;
  std::string entries;
  for (const StabilityResult& result : results) {
    if (result.subject->group != group) continue;
    rows += case_row(result);
    entries += case_entry(result);
  }
  const std::string head =
      "<tr>" +
      header_cells({"case", "outcome", "compared", "error", "floor", "allowed", "energy error",
                    "symplecticity", "exactness", "condition", "steps", "time"}) +
      "</tr>";
  return fmt::format("<section>\n<h2>{}</h2>\n", escape_html(group)) +
         table_html(
             "Errors are absolute, in canonical units, of the worst component; that of a twin or "
             "a condition number is relative. A dash: not computed.",
             head, rows) +
         "<dl>\n" + entries + "</dl>\n</section>\n";
}

}  // namespace

std::string stability_verdict(const std::vector<StabilityResult>& results) {
  const auto count = [&](CaseOutcome outcome) {
    return std::count_if(results.begin(), results.end(),
                         [&](const auto& result) { return result.outcome == outcome; });
  };
  const auto wrong = count(CaseOutcome::wrong);
  return fmt::format("{}: {} right, {} refused, {} marked, {} wrong.",
                     counted(results.size(), "case"), count(CaseOutcome::right),
                     count(CaseOutcome::refused), count(CaseOutcome::marked),
                     wrong == 0 ? "none" : fmt::format("{}", wrong));
}

std::string stability_page(const std::vector<StabilityResult>& results, const ReportOrigin& origin,
                           ChartDrawer& drawer) {
  ReportPage page;
  page.title = "Stiff and extreme cases";
  page.verdict = stability_verdict(results);
  Chart first = ratio_chart(results);
  fit(first);
  page.first_figure = figure_html(first, drawer);
  double seconds = 0;
  for (const StabilityResult& result : results) seconds += result.seconds;
  page.facts = origin_facts_html(origin) + fact_html("Time", duration_text(seconds)) +
               fact_html("Right", "within tolerance + factor x floor of an independent reference") +
               fact_html("Refused", "a clear error where that is what is right") +
               fact_html("Marked", "a result that carries its own warning, a failed self-check") +
               fact_html("Wrong", "anything else");
  for (const std::string& group : groups_of(results)) {
    page.sections += group_section(results, group);
  }
  for (const StabilityResult& result : results) {
    if (result.growth.empty()) continue;
    Chart chart = growth_chart(result);
    fit(chart);
    page.sections += section_html(chart, drawer);
  }
  return page_html(page, drawer);
}

}  // namespace hamjet::io
