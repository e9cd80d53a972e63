#include "uncertainty_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "../study_checks.hpp"
#include "collision_section.hpp"
#include "domains_table.hpp"
#include "hamjet/error.hpp"
#include "moments_table.hpp"
#include "safety_section.hpp"
#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

/// Moments of each component of a state: linear, of the highest order, and flown.
std::vector<std::vector<std::string>> moments_rows(const UncertaintyResult& result,
                                                   const UncertainState& state) {
  const int order = result.scene.order;
  std::vector<std::vector<std::string>> rows = {{"component", "linear s", "mean",
                                                 fmt::format("s of order {}", order), "skewness",
                                                 "kurtosis"}};
  if (state.flown) {
    for (const char* name : {"flown mean", "flown s", "flown skew.", "flown kurt."}) {
      rows[0].emplace_back(name);
    }
  }
  const Cumulants& linear = state.cartesian.front();
  const Cumulants full = judged_orders(state).back();
  const auto components = state_components(result);
  for (std::size_t k = 0; k < components.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    rows.push_back({fmt::format("{} ({})", components[k].name, components[k].unit),
                    fmt::format("{:.5g}", linear.standard_deviations()[i]),
                    fmt::format("{:.4g}", full.mean()[i]),
                    fmt::format("{:.5g}", full.standard_deviations()[i]),
                    fmt::format("{:.3f}", full.skewness()[i]),
                    fmt::format("{:.3f}", full.excess_kurtosis()[i])});
    if (!state.flown) continue;
    const FlownMoments& flown = *state.flown;
    const auto value = [&](double number, double error) {
      rows.back().push_back(fmt::format("{:.4g}±{:.1g}", number, error));
    };
    value(flown.cumulants.mean()[i], flown.mean_error[i]);
    value(flown.cumulants.standard_deviations()[i], flown.deviation_error[i]);
    value(flown.cumulants.skewness()[i], flown.skewness_error[i]);
    value(flown.cumulants.excess_kurtosis()[i], flown.kurtosis_error[i]);
  }
  return rows;
}

/// How non-Gaussian a state is by order, in each family of coordinates.
std::vector<std::vector<std::string>> gaussian_rows(const UncertaintyResult& result,
                                                    const UncertaintyAt& at,
                                                    const UncertainState& state) {
  std::vector<std::vector<std::string>> rows = {{"order"}};
  auto families = moments_families(result, at, state);
  // Families that are compared have a table of their own.
  std::erase_if(families, [](const MomentsFamily& family) { return family.is_compared; });
  for (const MomentsFamily& family : families) {
    const std::string where = family.polynomials == family.told_in
                                  ? family.told_in
                                  : family.polynomials + ", " + family.told_in;
    rows[0].push_back(fmt::format("negentropy ({})", where));
    rows[0].push_back(fmt::format("linear wrong by ({})", where));
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(result.scene.order); ++n) {
    rows.push_back({std::to_string(n + 1)});
    for (const MomentsFamily& family : families) {
      const Cumulants& moments = (*family.by_order)[n];
      rows.back().push_back(
          negentropy_text(moments.negentropy(), is_negentropy_sure(*family.by_order, n)));
      const double error =
          largest_error_of_probability(divergence_from_gaussian(moments, *family.linear));
      rows.back().push_back(error < 1e-6 ? "0" : fmt::format("{:.3g}", error));
    }
  }
  return rows;
}

/// The pairs of components that are drawn against each other: positions, or a coordinate and its
/// rate where there is no other.
std::vector<std::array<Eigen::Index, 2>> drawn_planes(const UncertaintyResult& result) {
  const std::size_t coordinates = state_components(result).size() / 2;
  if (coordinates < 3) return {{0, 1}};
  return {{1, 0}, {1, 2}};
}

/// What each uncertain parameter alone does to a state at the last time, linearly.
std::vector<std::vector<std::string>> parameter_rows(const UncertaintyResult& result,
                                                     const UncertainState& state) {
  std::vector<std::vector<std::string>> rows = {{"parameter", "of", "its s"}};
  for (const StateComponent& component : state_components(result)) {
    rows[0].push_back(fmt::format("s of {} ({})", component.name, component.unit));
  }
  for (const ParameterEffect& effect : result.parameter_effects) {
    for (const ParameterEffect::Along& along : effect.along) {
      if (along.state != state.name) continue;
      rows.push_back(
          {effect.parameter, effect.spacecraft, fmt::format("{:.4g}", effect.deviation)});
      for (const double s : along.deviations) rows.back().push_back(fmt::format("{:.4g}", s));
    }
  }
  return rows;
}

/// How far from Gaussian a state is at the last time in the coordinates that are compared.
std::vector<std::vector<std::string>> coordinates_rows(const UncertaintyResult& result,
                                                       const UncertainState& state) {
  std::vector<std::vector<std::string>> rows = {
      {"coordinates", fmt::format("negentropy of order {}", result.scene.order),
       "linear wrong by"}};
  for (const GaussianityInCoordinates& one : gaussianity_in_coordinates(result, state)) {
    if (one.refusal.empty()) {
      rows.push_back({one.coordinates, negentropy_text(one.negentropy, one.is_sure),
                      fmt::format("{:.3g}", one.error_of_linear)});
    } else {
      rows.push_back({one.coordinates, "-", "-"});
    }
  }
  return rows;
}

/// What the sections have in one of their lists, in order.
std::vector<std::string> all_of(const std::vector<UncertaintySection>& sections,
                                std::vector<std::string> UncertaintySection::*list) {
  std::vector<std::string> all;
  for (const UncertaintySection& section : sections) {
    all.insert(all.end(), (section.*list).begin(), (section.*list).end());
  }
  return all;
}

std::string terminal_table(const UncertaintyResult& result,
                           const std::vector<UncertaintySection>& sections) {
  const UncertaintyAt& at = result.points.back();
  const UncertainState& state = judged_state(at);
  // What a scene asks for beside the moments comes first.
  std::string text = result.scene.title + "\n";
  for (const UncertaintySection& section : sections) {
    if (!section.verdict.empty()) text += section.verdict + "\n";
  }
  text += uncertainty_answer(result) + "\n";
  text += uncertainty_judgement(result) + "\n";
  for (const std::string& warning : all_of(sections, &UncertaintySection::warnings)) {
    text += "warning: " + warning + "\n";
  }
  for (const std::string& failed : all_of(sections, &UncertaintySection::failed_checks)) {
    text += "check failed: " + failed + "\n";
  }
  text += fmt::format(
      "frame {}; order {}; {} after {}\n\n{}\n{}",
      frame_text(result.scene.uncertainty->frame) + coordinates_text(result.coordinates),
      result.scene.order, state.name, time_text(result, at),
      aligned_table(moments_rows(result, state)), aligned_table(gaussian_rows(result, at, state)));
  text += fmt::format(
      "s: standard deviation; skewness and excess kurtosis are 0 of a Gaussian;\nlinear wrong by: "
      "the largest error of a probability by the linear covariance\n");
  if (!result.parameter_effects.empty()) {
    text += "\nwhat each uncertain parameter does alone, linearly:\n" +
            aligned_table(parameter_rows(result, state));
  }
  if (!result.in_coordinates.empty()) {
    text += "\n" + aligned_table(coordinates_rows(result, state));
  }
  for (const std::string& note : uncertainty_notes(result)) text += note + "\n";
  for (const UncertaintySection& section : sections) text += "\n" + section.table;
  return text;
}

std::string page(const UncertaintyResult& result, const ReportOrigin& origin,
                 const std::vector<UncertaintySection>& sections, ChartDrawer& drawer) {
  const UncertaintyAt& last = result.points.back();
  const UncertainState& judged = judged_state(last);
  ReportPage page;
  page.title = result.scene.title + ": uncertainty";
  for (const UncertaintySection& section : sections) {
    if (!section.verdict.empty()) page.verdict += section.verdict + " ";
  }
  page.verdict += uncertainty_answer(result) + " " + uncertainty_judgement(result);
  for (const std::string& warning : all_of(sections, &UncertaintySection::warnings)) {
    page.verdict += " Warning: " + warning + ".";
  }
  for (const std::string& failed : all_of(sections, &UncertaintySection::failed_checks)) {
    page.verdict += " Check failed: " + failed + ".";
  }
  const std::vector<std::array<Eigen::Index, 2>> planes = drawn_planes(result);
  Chart first = ellipse_chart(result, last, judged, planes[0][0], planes[0][1]);
  first.is_panel = false;
  fit(first);
  page.first_figure = figure_html(first, drawer);
  page.facts =
      origin_facts_html(origin) +
      fact_html("Scene", fmt::format("{}, order {}", result.scene.name, result.scene.order)) +
      fact_html("Frame", frame_text(result.scene.uncertainty->frame) +
                             coordinates_text(result.coordinates)) +
      fact_html("Times", std::to_string(result.points.size())) +
      fact_html("Time", fmt::format("{} for the jets, {} for the moments, {} to fly",
                                    duration_text(result.propagation_seconds),
                                    duration_text(result.moments_seconds),
                                    duration_text(result.flight_seconds)));
  if (result.points.size() > 1 && result.scene.order > 1) {
    Chart misleading = misleading_chart(result);
    fit(misleading);
    page.sections += section_html(misleading, drawer);
  }
  for (const UncertainState& state : last.states) {
    std::vector<Chart> charts;
    for (const auto& [across, up] : planes) {
      charts.push_back(ellipse_chart(result, last, state, across, up));
    }
    std::vector<Chart> histograms;
    for (std::size_t i = 0; i < state_components(result).size() / 2; ++i) {
      histograms.push_back(histogram_chart(result, last, state, static_cast<Eigen::Index>(i)));
    }
    for (std::vector<Chart>* list : {&charts, &histograms}) {
      for (Chart& chart : *list) fit(chart);
    }
    page.sections += fmt::format(
        "<section>\n<h2>{}</h2>\n{}{}{}{}</section>\n",
        escape_html(fmt::format("The {} after {}", state.name, time_text(result, last))),
        panels_html(charts, drawer), panels_html(histograms, drawer),
        table_html("Moments of each component", moments_rows(result, state)),
        table_html("How far the distribution is from Gaussian, and the linear theory from the "
                   "distribution",
                   gaussian_rows(result, last, state)) +
            (result.parameter_effects.empty()
                 ? ""
                 : table_html("What each uncertain parameter does alone, linearly",
                              parameter_rows(result, state))) +
            (result.in_coordinates.empty()
                 ? ""
                 : table_html("In other coordinates, the nearest to Gaussian first",
                              coordinates_rows(result, state))));
  }
  for (const UncertaintySection& section : sections) {
    std::vector<Chart> charts = section.charts;
    for (Chart& chart : charts) fit(chart);
    page.sections +=
        fmt::format("<section>\n<h2>{}</h2>\n{}{}</section>\n", escape_html(section.title),
                    section.html, charts.empty() ? "" : panels_html(charts, drawer));
  }
  std::string notes;
  for (const std::string& note : uncertainty_notes(result)) {
    notes += "<p>" + escape_html(note) + "</p>\n";
  }
  if (!notes.empty()) page.sections += "<section>\n<h2>Notes</h2>\n" + notes + "</section>\n";
  return page_html(page, drawer);
}

}  // namespace

StudyReport uncertainty_report(const UncertaintyResult& result, const ReportOrigin& origin) {
  std::vector<UncertaintySection> sections;
  if (result.collision) sections.push_back(collision_section(result.scene, *result.collision));
  if (result.safety) sections.push_back(safety_section(*result.safety));
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"moments.csv", table_csv(moments_table(result))},
                  {"report.html", page(result, origin, sections, drawer)}};
  if (!result.domains.empty()) {
    report.files.push_back({"domains.csv", table_csv(domains_table(result))});
  }
  for (const UncertaintySection& section : sections) {
    report.files.insert(report.files.end(), section.files.begin(), section.files.end());
  }
  report.drawing_problem = drawer.problem();
  nlohmann::ordered_json summary = uncertainty_json(result);
  auto exit_code = summary["exit_code"];
  summary.erase("exit_code");
  for (const UncertaintySection& section : sections) summary[section.key] = section.json;
  const std::vector<std::string> failed = all_of(sections, &UncertaintySection::failed_checks);
  if (!failed.empty()) {
    report.exit_code = static_cast<int>(ErrorKind::check_failed);
    report.failure = "a check that the scene asks for failed: " + failed.front();
    if (failed.size() > 1) report.failure += fmt::format(" (and {} more)", failed.size() - 1);
    exit_code = report.exit_code;
  }
  summary["failed_checks"] = failed;
  summary["exit_code"] = exit_code;
  report.files.push_back({"summary.json", json_text(summary) + "\n"});
  report.table = terminal_table(result, sections);
  report.details =
      fmt::format("{}; {} for the jets, {} for the moments, {} to fly\n",
                  counted(result.points.size(), "time"), duration_text(result.propagation_seconds),
                  duration_text(result.moments_seconds), duration_text(result.flight_seconds));
  add_checks(report, result.checks);
  return report;
}

}  // namespace hamjet::io
