#include "comparison_page.hpp"

#include <fmt/format.h>

#include "chart_drawer.hpp"
#include "comparison_charts.hpp"
#include "comparison_view.hpp"
#include "hamjet/version.hpp"

namespace hamjet::io {
namespace {

std::string figure(const Chart& chart, ChartDrawer& drawer) {
  if (!chart.missing.empty()) return fmt::format("<p>{}</p>\n", escape_html(chart.missing));
  std::string reason;
  const std::string drawing = drawer.draw_inline(chart, reason);
  std::string html = fmt::format("<figure id=\"figure-{}\">\n{}", chart.name, drawing);
  if (!reason.empty()) {
    html += fmt::format("<p class=\"problem\">This plot could not be drawn: {}</p>\n",
                        escape_html(reason));
  }
  if (!drawing.empty()) {
    for (const std::string& note : chart.notes) {
      html += fmt::format("<p class=\"note\">{}</p>\n", escape_html(note));
    }
    html += fmt::format("<figcaption><strong>How to read it.</strong> {}</figcaption>\n",
                        escape_html(chart.reading));
  }
  return html + "</figure>\n";
}

std::string origin_html(const ComparisonResult& result, const ReportOrigin& origin) {
  const Scene& scene = result.scene;
  const auto entry = [](std::string_view name, std::string_view value) {
    return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, escape_html(value));
  };
  std::string html = "<dl>\n" + fmt::format("<dt>Made by</dt><dd><code>{}</code></dd>\n",
                                            escape_html(origin.command));
  html += entry("Version", fmt::format("hamjet {}", version)) +
          entry("Processor", origin.processor) + entry("Date", origin.date);
  html += entry("Scene", fmt::format("{}, order {} in {} of {} variables", scene.name, scene.order,
                                     scene.variables.size(), scene.nominal.size()));
  html += entry("Duration", fmt::format("{:.6g} canonical = {:.6g} s", scene.duration,
                                        scene.duration * scene.units.time_s));
  html +=
      entry("Wanted", has_formation_error(result)
                          ? fmt::format("{} of {}", length_text(scene.comparison.wanted_error_m),
                                        shown_error_name(result))
                          : "no formation in the scene: errors are relative");
  const UnfinishedCount count = count_unfinished(result);
  html += entry("Runs", fmt::format("{} and {} of cost against order; {} failed, {} left out",
                                    result.runs.size(), result.cost_runs.size(), count.failed,
                                    count.left_out));
  return html + "</dl>\n";
}

std::string section(const Chart& chart, ChartDrawer& drawer) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape_html(chart.title),
                     figure(chart, drawer));
}

std::string page(const ComparisonResult& result, const ReportOrigin& origin,
                 const std::vector<Chart>& charts, ChartDrawer& drawer) {
  const std::string first_figure = figure(charts.front(), drawer);
  std::string sections;
  for (std::size_t i = 1; i < charts.size(); ++i) {
    sections += section(charts[i], drawer);
    if (charts[i].name == "convergence") sections += fit_table_html(result);
  }
  const std::string title = escape_html(result.scene.title);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}: error against run time</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n"
      "<h1>{}: error against run time</h1>\n",
      title, page_style, title);
  if (!result.is_complete) {
    html +=
        "<p class=\"partial\" role=\"status\"><strong>Partial result:</strong> the comparison was "
        "broken off; the runs that were finished are here.</p>\n";
  }
  html += fmt::format("<p class=\"verdict\">{}</p>\n", escape_html(verdict(result)));
  if (drawer.problem()) {
    html += fmt::format("<p class=\"problem\">{}. The tables are complete.</p>\n",
                        escape_html(*drawer.problem()));
  }
  html += fmt::format("</header>\n<main>\n<div class=\"first{}\">\n",
                      first_figure.find("<svg") == std::string::npos ? " without-plot" : "") +
          first_figure + origin_html(result, origin) + "</div>\n";
  html += "<section>\n<h2>Time to reach an error</h2>\n" + reach_table_html(result);
  if (const std::string text = advice(result); !text.empty()) {
    html += fmt::format("<p>Ready for the scene:</p>\n<pre>{}</pre>\n", escape_html(text));
  }
  html += "</section>\n" + sections;
  html +=
      "<section>\n<h2>How the reference was made</h2>\n" + reference_html(result) + "</section>\n";
  html += "<section>\n<h2>All runs</h2>\n" + run_table_html(result) + degree_table_html(result) +
          cost_table_html(result) + "</section>\n</main>\n</body>\n</html>\n";
  return html;
}

std::vector<ReportFile> plot_files(const std::vector<Chart>& charts, PlotFormat format,
                                   ChartDrawer& drawer) {
  std::vector<ReportFile> files;
  if (format == PlotFormat::none || drawer.problem()) return files;
  const bool is_pdf = format == PlotFormat::pdf;
  for (const Chart& chart : charts) {
    if (!chart.missing.empty()) continue;
    std::string reason;
    std::string content = drawer.draw(chart, is_pdf ? Drawing::pdf : Drawing::png, reason);
    if (content.empty()) continue;
    files.push_back({"plots/" + chart.name + (is_pdf ? ".pdf" : ".png"), std::move(content)});
  }
  return files;
}

}  // namespace

std::string comparison_html(const ComparisonResult& result, const ReportOrigin& origin,
                            std::optional<std::string>& drawing_problem) {
  ChartDrawer drawer(origin.gnuplot);
  std::string html = page(result, origin, comparison_charts(result), drawer);
  drawing_problem = drawer.problem();
  return html;
}

ComparisonReport make_report(const ComparisonResult& result, const ReportOrigin& origin,
                             PlotFormat format) {
  ChartDrawer drawer(origin.gnuplot);
  const std::vector<Chart> charts = comparison_charts(result);
  ComparisonReport report;
  report.files.push_back({"compare.csv", comparison_csv(result)});
  report.files.push_back({"report.html", page(result, origin, charts, drawer)});
  for (ReportFile& plot : plot_files(charts, format, drawer)) {
    report.files.push_back(std::move(plot));
  }
  report.files.push_back({"compare.json", comparison_json(result, origin)});
  // Those of an earlier comparison must not be taken for plots of this one.
  for (const Chart& chart : charts) {
    for (const char* extension : {".pdf", ".png"}) {
      report.earlier.push_back("plots/" + chart.name + extension);
    }
  }
  report.drawing_problem = drawer.problem();
  return report;
}

void write_report(const ComparisonReport& report, OutputDirectory& output) {
  for (const std::filesystem::path& file : report.earlier) output.replace(file);
  for (const ReportFile& file : report.files) output.write(file.path, file.content);
  output.commit();
}

}  // namespace hamjet::io
