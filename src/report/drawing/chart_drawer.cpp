#include "chart_drawer.hpp"

#include <fmt/format.h>

#include <string_view>

#include "gnuplot.hpp"

namespace hamjet::io {
namespace {

/// What a drawing begins with; a program that says all is well and draws something else is not
/// believed.
bool is_drawing(std::string_view output, Drawing drawing) {
  switch (drawing) {
    case Drawing::pdf:
      return output.starts_with("%PDF");
    case Drawing::png:
      return output.starts_with("\x89PNG");
    case Drawing::wide_svg:
    case Drawing::narrow_svg:
      break;
  }
  return output.starts_with("<?xml") && output.find("<svg") != output.npos &&
         output.find("</svg>") != output.npos && output.find("<script") == output.npos;
}

}  // namespace

std::string ChartDrawer::draw(const Chart& chart, Drawing drawing, std::string& reason) {
  if (!is_asked_) return "";
  GnuplotOutcome outcome = run_gnuplot(program_, gnuplot_script(chart, drawing));
  if (outcome.problem.empty() && !is_drawing(outcome.output, drawing)) {
    outcome.problem = fmt::format("{} drew something that is no plot", program_);
  }
  if (outcome.problem.empty()) return outcome.output;
  is_asked_ = outcome.is_started && !outcome.is_late;
  if (!problem_) problem_ = outcome.problem;
  if (outcome.is_started) reason = outcome.problem;
  return "";
}

std::string ChartDrawer::draw_inline(const Chart& chart, std::string& reason) {
  std::string html;
  for (const Drawing drawing : {Drawing::wide_svg, Drawing::narrow_svg}) {
    if (chart.is_panel && drawing == Drawing::wide_svg) continue;
    const char* width = chart.is_panel ? "panel" : drawing == Drawing::wide_svg ? "wide" : "narrow";
    const std::string output = draw(chart, drawing, reason);
    if (output.empty()) return "";
    html +=
        fmt::format("<div class=\"{}\">{}</div>\n", width,
                    inline_svg(output, fmt::format("{}-{}-", chart.name, width),
                               chart.title + ": " + chart.y.label + " against " + chart.x.label));
  }
  return html;
}

}  // namespace hamjet::io
