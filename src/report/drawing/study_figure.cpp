#include "study_figure.hpp"

#include <fmt/format.h>

#include "../../text/html_text.hpp"
#include "chart_drawer.hpp"

namespace hamjet::io {

std::string draw_figure(std::vector<Chart> charts, std::optional<std::string>& problem) {
  // The size of Drawing::wide_svg.
  constexpr int width = 900;
  constexpr int height = 500;
  constexpr int title_height = 40;
  ChartDrawer drawer("gnuplot");
  std::string body;
  int count = 0;
  for (Chart& chart : charts) {
    fit(chart);
    if (!chart.missing.empty()) continue;
    std::string reason;
    const std::string drawing = drawer.draw(chart, Drawing::wide_svg, reason);
    if (drawer.problem()) break;
    // A drawing has no size of its own: it fills the one that it stands in.
    const int top = count++ * (height + title_height);
    body += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-family=\"sans-serif\" "
        "font-size=\"18\">{}</text>\n<svg y=\"{}\" width=\"{}\" height=\"{}\">\n{}</svg>\n",
        width / 2, top + 28, escape_html(chart.title), top + title_height, width, height,
        inline_svg(drawing, chart.name + "-", chart.title));
  }
  problem = drawer.problem();
  if (problem || count == 0) return "";
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      width, count * (height + title_height), body);
}

void add_figure(StudyReport& report, std::vector<Chart> charts) {
  std::string figure = draw_figure(std::move(charts), report.drawing_problem);
  if (!figure.empty()) report.files.push_back({"figure.svg", std::move(figure)});
}

}  // namespace hamjet::io
