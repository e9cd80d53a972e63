#include "comparison_page.hpp"

#include <fmt/format.h>

#include "comparison_chart.hpp"
#include "comparison_view.hpp"
#include "gnuplot.hpp"
#include "hamjet/version.hpp"

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

/// Draws charts, and stops asking a program that is not there or does not answer.
class Drawer {
 public:
  Drawer(const ReportOrigin& origin, std::optional<std::string>& problem)
      : program_(origin.gnuplot), problem_(problem) {}

  /// The chart in both widths, or an empty text and the reason.
  std::string draw(const Chart& chart, std::string& reason) {
    std::string html;
    for (const Drawing drawing : {Drawing::wide_svg, Drawing::narrow_svg}) {
      const char* width = drawing == Drawing::wide_svg ? "wide" : "narrow";
      const std::string output = draw(chart, drawing, reason);
      if (output.empty()) return "";
      html +=
          fmt::format("<div class=\"{}\">{}</div>\n", width,
                      inline_svg(output, fmt::format("{}-{}-", chart.name, width),
                                 chart.title + ": " + chart.y.label + " against " + chart.x.label));
    }
    return html;
  }

  /// The chart as a file, or an empty text and the reason.
  std::string draw(const Chart& chart, Drawing drawing, std::string& reason) {
    if (!is_asked_) return "";
    GnuplotOutcome outcome = run_gnuplot(program_, gnuplot_script(chart, drawing));
    if (outcome.problem.empty() && !is_drawing(outcome.output, drawing)) {
      outcome.problem = fmt::format("{} drew something that is no plot", program_);
    }
    if (outcome.problem.empty()) return outcome.output;
    is_asked_ = outcome.is_installed && !outcome.is_late;
    if (!problem_) problem_ = outcome.problem;
    if (outcome.is_installed) reason = outcome.problem;
    return "";
  }

 private:
  std::string program_;
  std::optional<std::string>& problem_;
  bool is_asked_ = true;
};

std::string figure(const Chart& chart, Drawer& drawer) {
  if (!chart.missing.empty()) return fmt::format("<p>{}</p>\n", escape_html(chart.missing));
  std::string reason;
  const std::string drawing = drawer.draw(chart, reason);
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

std::string section(const Chart& chart, Drawer& drawer) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape_html(chart.title),
                     figure(chart, drawer));
}

}  // namespace

std::string comparison_html(const ComparisonResult& result, const ReportOrigin& origin,
                            std::optional<std::string>& drawing_problem) {
  Drawer drawer(origin, drawing_problem);
  const std::vector<Chart> charts = comparison_charts(result);
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
  if (drawing_problem) {
    html += fmt::format("<p class=\"problem\">{}. The tables are complete.</p>\n",
                        escape_html(*drawing_problem));
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

std::vector<ReportFile> comparison_plots(const ComparisonResult& result, const ReportOrigin& origin,
                                         PlotFormat format,
                                         std::optional<std::string>& drawing_problem) {
  std::vector<ReportFile> files;
  if (format == PlotFormat::none || drawing_problem) return files;
  Drawer drawer(origin, drawing_problem);
  const bool is_pdf = format == PlotFormat::pdf;
  for (const Chart& chart : comparison_charts(result)) {
    if (!chart.missing.empty()) continue;
    std::string reason;
    std::string content = drawer.draw(chart, is_pdf ? Drawing::pdf : Drawing::png, reason);
    if (content.empty()) continue;
    files.push_back({"plots/" + chart.name + (is_pdf ? ".pdf" : ".png"), std::move(content)});
  }
  return files;
}

ComparisonReport make_report(const ComparisonResult& result, const ReportOrigin& origin,
                             PlotFormat format) {
  ComparisonReport report;
  report.files.push_back({"compare.csv", comparison_csv(result)});
  report.files.push_back({"report.html", comparison_html(result, origin, report.drawing_problem)});
  for (ReportFile& plot : comparison_plots(result, origin, format, report.drawing_problem)) {
    report.files.push_back(std::move(plot));
  }
  report.files.push_back({"compare.json", comparison_json(result, origin)});
  // Those of an earlier comparison must not be taken for plots of this one.
  for (const Chart& chart : comparison_charts(result)) {
    for (const char* extension : {".pdf", ".png"}) {
      report.earlier.push_back("plots/" + chart.name + extension);
    }
  }
  return report;
}

void write_report(const ComparisonReport& report, OutputDirectory& output) {
  for (const std::filesystem::path& file : report.earlier) output.replace(file);
  for (const ReportFile& file : report.files) output.write(file.path, file.content);
  output.commit();
}

}  // namespace hamjet::io
