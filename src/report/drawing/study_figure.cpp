#include "study_figure.hpp"

#include <fmt/format.h>

#include <utility>

#include "../../text/html_text.hpp"
#include "chart_drawer.hpp"

namespace hamjet::io {

namespace {

constexpr std::size_t line_height = 19;

/// A chart's notes in lines as long as the figure is wide.
std::vector<std::string> note_lines(const Chart& chart) {
  constexpr std::size_t most_characters = 120;
  std::vector<std::string> lines;
  for (std::string note : chart.notes) {
    while (note.size() > most_characters) {
      const std::size_t space = note.rfind(' ', most_characters);
      if (space == std::string::npos) break;
      lines.push_back(note.substr(0, space));
      note.erase(0, space + 1);
    }
    lines.push_back(std::move(note));
  }
  return lines;
}

}  // namespace

std::string draw_figure(std::vector<Chart> charts, std::optional<std::string>& problem,
                        const std::string& program) {
  if (program.empty()) return "";
  constexpr std::size_t title_height = 40;
  std::size_t width = 0;
  std::size_t bottom = 0;
  ChartDrawer drawer(program);
  std::string body;
  for (Chart& chart : charts) {
    fit(chart);
    if (!chart.missing.empty()) continue;
    std::string reason;
    const std::string drawing = drawer.draw(chart, Drawing::wide_svg, reason);
    if (drawer.problem()) break;
    // A drawing has no size of its own: it fills the one that it stands in.
    const auto [chart_width, height] = size_of(chart, Drawing::wide_svg);
    width = chart_width;
    const std::size_t top = std::exchange(bottom, bottom + title_height + height);
    for (const std::string& line : note_lines(chart)) {
      body += fmt::format(
          "<text x=\"16\" y=\"{}\" font-family=\"sans-serif\" font-size=\"13\" "
          "fill=\"#444444\">{}</text>\n",
          bottom + line_height / 2, escape_html(line));
      bottom += line_height;
    }
    body += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-family=\"sans-serif\" "
        "font-size=\"18\">{}</text>\n<svg y=\"{}\" width=\"{}\" height=\"{}\">\n{}</svg>\n",
        width / 2, top + 28, escape_html(chart.title), top + title_height, width, height,
        inline_svg(drawing, chart.name + "-", chart.title));
  }
  problem = drawer.problem();
  if (problem || bottom == 0) return "";
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      width, bottom, body);
}

void add_figure(StudyReport& report, std::vector<Chart> charts, const std::string& program) {
  std::string figure = draw_figure(std::move(charts), report.drawing_problem, program);
  if (!figure.empty()) report.files.push_back({"figure.svg", std::move(figure)});
}

}  // namespace hamjet::io
