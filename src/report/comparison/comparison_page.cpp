#include "comparison_page.hpp"

#include <fmt/format.h>

#include "../../text/quantity_text.hpp"
#include "../drawing/chart_drawer.hpp"
#include "../drawing/report_page.hpp"
#include "comparison_charts.hpp"
#include "comparison_view.hpp"

namespace hamjet::io {
namespace {

std::string facts_html(const ComparisonResult& result, const ReportOrigin& origin) {
  const Scene& scene = result.scene;
  const UnfinishedCount count = count_unfinished(result);
  return origin_facts_html(origin) +
         fact_html("Scene",
                   fmt::format("{}, order {} in {} of {}", scene.name, scene.order,
                               scene.variables.size(), counted(scene.nominal.size(), "variable"))) +
         fact_html("Duration", fmt::format("{:.6g} canonical = {:.6g} s", scene.duration,
                                           scene.duration * scene.units.time_s)) +
         fact_html("Wanted",
                   has_formation_error(result)
                       ? fmt::format("{} of {}", length_text(scene.comparison.wanted_error_m),
                                     shown_error_name(result))
                       : "no formation in the scene: errors are relative") +
         fact_html("Runs", fmt::format("{} and {} of cost against order; {} failed, {} left out",
                                       result.runs.size(), result.cost_runs.size(), count.failed,
                                       count.left_out));
}

std::string page(const ComparisonResult& result, const ReportOrigin& origin,
                 const std::vector<Chart>& charts, ChartDrawer& drawer) {
  ReportPage page;
  page.title = result.scene.title + ": error against run time";
  if (!result.is_complete) {
    page.notice =
        "<p class=\"partial\" role=\"status\"><strong>Partial result:</strong> the comparison was "
        "broken off; the runs that were finished are here.</p>\n";
  }
  page.verdict = verdict(result);
  page.first_figure = figure_html(charts.front(), drawer);
  page.facts = facts_html(result, origin);
  std::string& html = page.sections;
  html += "<section>\n<h2>Time to reach an error</h2>\n" + reach_table_html(result);
  if (const std::string text = advice(result); !text.empty()) {
    html += fmt::format("<p>Ready for the scene:</p>\n<pre>{}</pre>\n", escape_html(text));
  }
  html += "</section>\n";
  for (std::size_t i = 1; i < charts.size(); ++i) {
    html += section_html(charts[i], drawer);
    if (charts[i].name == "convergence") html += fit_table_html(result);
  }
  html +=
      "<section>\n<h2>How the reference was made</h2>\n" + reference_html(result) + "</section>\n";
  html += "<section>\n<h2>All runs</h2>\n" + run_table_html(result) + degree_table_html(result) +
          cost_table_html(result) + "</section>\n";
  return page_html(page, drawer);
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
  report.drawing_problem = drawer.problem();
  return report;
}

std::string write_report(const ComparisonReport& report, OutputDirectory& output) {
  for (const ReportFile& file : report.files) output.write(file.path, file.content);
  return output.commit();
}

}  // namespace hamjet::io
