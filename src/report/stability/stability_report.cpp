#include "stability_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../store/csv_values.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/html_text.hpp"
#include "../drawing/chart_drawer.hpp"
#include "hamjet/version.hpp"
#include "stability_page.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(const MeasuredError& error) {
  return {{"quantity", error.quantity},
          {"error", json_number(error.error)},
          {"floor", json_number(error.floor)},
          {"tolerance", json_number(error.tolerance)},
          {"allowed", json_number(error.allowed())}};
}

Json growth_json(const GrowthCurve& curve) {
  Json points = Json::array();
  for (const auto& [time, value] : curve.points) {
    points.push_back({json_number(time), json_number(value)});
  }
  return {{"quantity", curve.quantity},
          {"exponent", json_number(curve.exponent)},
          {"expected", json_number(curve.expected)},
          {"is_upper_bound", curve.is_upper_bound},
          {"is_as_expected", curve.is_as_expected},
          {"points", points}};
}

Json case_json(const StabilityResult& result) {
  const StabilityCase& subject = *result.subject;
  Json json = {{"case", subject.name},
               {"group", subject.group},
               {"title", subject.title},
               {"why", subject.why},
               {"outcome", outcome_name(result.outcome)},
               {"expected", outcome_name(subject.expected.outcome)},
               {"text", text_or_null(result.text)},
               {"error", nullptr},
               {"floor", nullptr},
               {"tolerance", nullptr},
               {"allowed", nullptr},
               {"seconds", result.seconds},
               {"source", text_or_null(subject.expected.source)},
               {"measured", Json::array()},
               {"steps", or_null(result.steps)},
               {"energy_error", json_number(result.energy_error)},
               {"symplecticity", json_number(result.symplecticity)},
               {"exactness", json_number(result.exactness)},
               {"condition", json_number(result.condition)},
               {"growth", Json::array()}};
  if (result.error) {
    json["error"] = json_number(result.error->error);
    json["floor"] = json_number(result.error->floor);
    json["tolerance"] = json_number(result.error->tolerance);
    json["allowed"] = json_number(result.error->allowed());
  }
  for (const MeasuredError& error : result.measured) json["measured"].push_back(error_json(error));
  for (const GrowthCurve& curve : result.growth) json["growth"].push_back(growth_json(curve));
  return json;
}

std::string stability_csv(const std::vector<StabilityResult>& results) {
  std::string text = "case,group,outcome,quantity,error,floor,tolerance,allowed,seconds,text\n";
  for (const StabilityResult& result : results) {
    const auto& error = result.error;
    text += csv_field(result.subject->name) + ',' + csv_field(result.subject->group) + ',' +
            outcome_name(result.outcome) + ',' + (error ? csv_field(error->quantity) : "") + ',' +
            (error ? csv_number(error->error) : "") + ',' +
            (error ? csv_number(error->floor) : "") + ',' +
            (error ? csv_number(error->tolerance) : "") + ',' +
            (error ? csv_number(error->allowed()) : "") + ',' + csv_number(result.seconds) + ',' +
            csv_field(result.text) + '\n';
  }
  return text;
}

/// The exponents that were fitted, for the terminal.
std::string growth_text(const StabilityResult& result) {
  std::string text;
  for (const GrowthCurve& curve : result.growth) {
    text += fmt::format("; {} ~ t^{}", curve.quantity,
                        curve.exponent ? fmt::format("{:.2f}", *curve.exponent) : "0 (round-off)");
  }
  return text;
}

}  // namespace

std::string stability_line(const StabilityResult& result, std::size_t name_width) {
  std::string text = fmt::format("{:<8} {:<{}} {:>8}  ", outcome_name(result.outcome),
                                 result.subject->name, name_width, duration_text(result.seconds));
  if (result.outcome == CaseOutcome::right && result.error) {
    text += fmt::format("{}: error {:.1e}, floor {:.1e}, allowed {:.1e}", result.error->quantity,
                        result.error->error, result.error->floor, result.error->allowed());
  } else {
    text += result.text;
  }
  return text + growth_text(result) + '\n';
}

StudyReport stability_report(const std::vector<StabilityResult>& results,
                             const ReportOrigin& origin) {
  StudyReport report;
  ChartDrawer drawer(origin.gnuplot);
  Json list = Json::array();
  std::string wrong;
  for (const StabilityResult& result : results) {
    list.push_back(case_json(result));
    if (result.outcome == CaseOutcome::wrong) wrong += " " + result.subject->name;
  }
  report.files = {{"stability.csv", stability_csv(results)},
                  {"stability.html", stability_page(results, origin, drawer)}};
  report.json = json_text(list) + "\n";
  report.drawing_problem = drawer.problem();
  report.table = stability_verdict(results) + "\n";
  if (!wrong.empty()) {
    report.exit_code = static_cast<int>(ErrorKind::check_failed);
    report.failure = "wrong:" + wrong;
  }
  const Json summary = {{"study", "stability"},
                        {"version", version},
                        {"verdict", stability_verdict(results)},
                        {"exit_code", report.exit_code},
                        {"cases", list}};
  report.files.push_back({"summary.json", json_text(summary) + "\n"});
  return report;
}

}  // namespace hamjet::io
