#include "report_page.hpp"

#include <fmt/format.h>

#include "../../text/html_text.hpp"
#include "hamjet/version.hpp"

namespace hamjet::io {

namespace {

/// The drawing of a chart, or why there is none.
std::string drawing_html(const Chart& chart, ChartDrawer& drawer) {
  std::string reason;
  const std::string drawing = drawer.draw_inline(chart, reason);
  if (reason.empty()) return drawing;
  return drawing + fmt::format("<p class=\"problem\">This plot could not be drawn: {}</p>\n",
                               escape_html(reason));
}

std::string notes_html(const Chart& chart) {
  std::string html;
  for (const std::string& note : chart.notes) {
    html += fmt::format("<p class=\"note\">{}</p>\n", escape_html(note));
  }
  return html;
}

std::string reading_html(const Chart& chart, std::string_view element) {
  if (chart.reading.empty()) return "";
  return fmt::format("<{0}><strong>How to read it.</strong> {1}</{0}>\n", element,
                     escape_html(chart.reading));
}

std::size_t column_count(std::string_view head) {
  std::size_t count = 0;
  for (std::size_t i = head.find("<th"); i != head.npos; i = head.find("<th", i + 3)) ++count;
  return count;
}

bool has_drawing(std::string_view html) { return html.find("<svg") != html.npos; }

}  // namespace

std::string figure_html(const Chart& chart, ChartDrawer& drawer) {
  if (!chart.missing.empty()) return fmt::format("<p>{}</p>\n", escape_html(chart.missing));
  std::string html = drawing_html(chart, drawer);
  if (has_drawing(html)) html += notes_html(chart) + reading_html(chart, "figcaption");
  return fmt::format("<figure id=\"figure-{}\">\n{}</figure>\n", chart.name, html);
}

std::string panels_html(const std::vector<Chart>& charts, ChartDrawer& drawer) {
  std::string panels;
  std::string notes;
  for (const Chart& chart : charts) {
    if (!chart.missing.empty()) continue;
    panels += fmt::format("<figure id=\"figure-{}\">\n{}</figure>\n", chart.name,
                          drawing_html(chart, drawer));
    notes += notes_html(chart);
  }
  if (!has_drawing(panels)) return panels + notes;
  return "<div class=\"panels\">\n" + panels + "</div>\n" + notes +
         reading_html(charts.front(), "p");
}

std::string section_html(const Chart& chart, ChartDrawer& drawer) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape_html(chart.title),
                     figure_html(chart, drawer));
}

std::string table_html(std::string_view caption, std::string_view head, std::string_view rows) {
  // A table of so many columns does not fit into a telephone.
  constexpr std::size_t most_narrow_columns = 4;
  const bool is_wide = column_count(head) > most_narrow_columns;
  return fmt::format(
      "<p class=\"caption\">{}{}</p>\n<div class=\"scroll\" tabindex=\"0\"><table>\n"
      "<thead>{}</thead>\n<tbody>{}</tbody></table></div>\n",
      caption, is_wide ? " <span class=\"hint\">The table scrolls sideways \u2192</span>" : "",
      head, rows);
}

std::string table_html(std::string_view caption,
                       const std::vector<std::vector<std::string>>& rows) {
  std::string body;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    body += "<tr>" + row_name_cell(rows[k][0]);
    for (std::size_t i = 1; i < rows[k].size(); ++i) body += cell(rows[k][i]);
    body += "</tr>\n";
  }
  return table_html(caption, "<tr>" + header_cells(rows[0]) + "</tr>", body);
}

std::string header_cells(const std::vector<std::string>& names) {
  std::string cells;
  for (const std::string& name : names) {
    cells += fmt::format("<th scope=\"col\">{}</th>", escape_html(name));
  }
  return cells;
}

std::string row_name_cell(std::string_view text) {
  return fmt::format("<th scope=\"row\">{}</th>", escape_html(text));
}

std::string cell(std::string_view text) { return fmt::format("<td>{}</td>", escape_html(text)); }

std::string fact_html(std::string_view name, std::string_view value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(name), escape_html(value));
}

std::string origin_facts_html(const ReportOrigin& origin) {
  return fmt::format("<dt>Made by</dt><dd><code>{}</code></dd>\n", escape_html(origin.command)) +
         fact_html("Version", fmt::format("hamjet {}", version)) +
         fact_html("Processor", origin.processor) + fact_html("Date", origin.date);
}

std::string page_html(const ReportPage& page, const ChartDrawer& drawer) {
  const std::string title = escape_html(page.title);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n{}",
      title, page_style, title, page.notice);
  html += fmt::format("<p class=\"verdict\">{}</p>\n", escape_html(page.verdict));
  if (drawer.problem()) {
    html += fmt::format("<p class=\"problem\">{}. The tables are complete.</p>\n",
                        escape_html(*drawer.problem()));
  }
  const bool has_plot = has_drawing(page.first_figure);
  html += fmt::format("</header>\n<main>\n<div class=\"first{}\">\n{}<dl>\n{}</dl>\n</div>\n",
                      has_plot ? "" : " without-plot", page.first_figure, page.facts);
  return html + page.sections + "</main>\n</body>\n</html>\n";
}

}  // namespace hamjet::io
