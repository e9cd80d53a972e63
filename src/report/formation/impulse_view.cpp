#include "impulse_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/along_time_charts.hpp"
#include "../drawing/report_page.hpp"
#include "impulse_tables.hpp"
#include "transfer_json.hpp"
#include "transfer_tables.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

const ImpulsePlan* plan_of(const TransferResult& result) {
  return result.optimal && result.optimal->plan ? &*result.optimal->plan : nullptr;
}

std::string end_text(const ImpulsePlan& plan) {
  return fmt::format("{} and {:.2g} m/s", miss_text(plan.miss_m, plan.flight_floor_m),
                     plan.velocity_miss_m_s);
}

/// What the linear theory about the chief said for the plan's time, if it is one of those that it
/// was asked for.
const LeastChange* linear_change_of(const TransferResult& result, const ImpulsePlan& plan) {
  for (const LeastChange& one : result.optimal->by_time) {
    if (one.time == plan.duration && one.change_m_s) return &one;
  }
  return nullptr;
}

std::string_view origin_name(PlanOrigin origin) {
  switch (origin) {
    case PlanOrigin::linear_theory:
      return "linear-theory";
    case PlanOrigin::two_impulses:
      return "two-impulses";
    case PlanOrigin::coasting:
      return "coasting-start";
    case PlanOrigin::waypoints:
      return "waypoints";
    case PlanOrigin::revolutions:
      return "other-revolutions";
  }
  return "";
}

std::string origin_text(PlanOrigin origin) {
  switch (origin) {
    case PlanOrigin::linear_theory:
      return "the linear theory about the chief";
    case PlanOrigin::two_impulses:
      return "the transfer of two";
    case PlanOrigin::coasting:
      return "the transfer that drifts first";
    case PlanOrigin::waypoints:
      return "the way through the waypoints";
    case PlanOrigin::revolutions:
      return "the transfer with other revolutions";
  }
  return "";
}

/// The times for which the solver failed, among which the least may be.
std::string times_left_out_text(const TransferResult& result) {
  const auto& by_time = result.optimal->by_time;
  const auto is_unproved = [](const LeastChange& one) { return one.is_unproved; };
  const auto first = std::find_if(by_time.begin(), by_time.end(), is_unproved);
  if (first == by_time.end()) return "";
  return fmt::format(" For {} the solver failed, and the least may be there: at {} {}.",
                     counted(std::count_if(first, by_time.end(), is_unproved), "transfer time"),
                     time_text(seconds(result, first->time)), first->failure);
}

/// A velocity of an impulse of this size. Below a tenth of a millimetre per second six decimals
/// would leave too few digits, or none.
std::string velocity_number(double x, double size) {
  if (size < 1e-4 && size > 0) return fmt::format("{:.4e}", x);
  const bool rounds_to_zero = std::abs(x) < 5e-7;  // and would keep its sign
  return fmt::format("{:.6f}", rounds_to_zero ? 0.0 : x);
}

std::vector<std::string> axis_names(const TransferResult& result) {
  std::vector<std::string> names;
  for (const std::string_view axis : axis_letters(result.scene.transfer->frame)) {
    names.push_back(fmt::format("{} (m/s)", axis));
  }
  return names;
}

}  // namespace

std::string primer_text(const TransferResult& result) {
  if (!result.primer) return "";
  const PrimerMagnitude& largest = result.primer->largest;
  return result.primer->calls_for_impulse()
             ? fmt::format(
                   "the primer vector reaches {:.3g} at {}: a further impulse there makes "
                   "it cheaper",
                   largest.magnitude, time_text(seconds(result, largest.time)))
             : "the primer vector is at most 1: to first order no further impulse makes it cheaper";
}

std::string optimal_impulses_failure(const TransferResult& result) {
  if (!result.optimal) return "";
  const ImpulsePlan* plan = plan_of(result);
  if (plan == nullptr) return result.optimal->failure;
  if (!plan->failure.empty()) {
    return "the plan of the linear theory was not brought to its end by flying: " + plan->failure;
  }
  return plan->forbidden.empty() ? ""
                                 : "the plan of the least sum is not allowed: " + plan->forbidden;
}

std::string optimal_impulses_verdict(const TransferResult& result) {
  if (!result.optimal) return "";
  if (const std::string failure = optimal_impulses_failure(result); !failure.empty()) {
    return fmt::format("No optimal impulses can be named: {}.", failure);
  }
  const ImpulsePlan& plan = *plan_of(result);
  const std::string which =
      plan.spacing ? fmt::format(" of at most {} each at times {:.4g} s apart",
                                 velocity_text(*result.scene.transfer->largest_impulse_m_s),
                                 std::abs(seconds(result, *plan.spacing)))
                   : "";
  const LeastChange* linear = linear_change_of(result, plan);
  std::string text = fmt::format(
      "With {} in {} the same takes {}, flown with a miss of {}{}{}; ",
      counted(plan.impulses.size(), "impulse"), time_text(seconds(result, plan.duration)),
      velocity_text(plan.total_change_m_s()), end_text(plan),
      linear == nullptr ? ""
                        : fmt::format(" ({} in the linear theory about the chief)",
                                      velocity_text(*linear->change_m_s)),
      plan.origin == PlanOrigin::linear_theory ? "" : ", found from " + origin_text(plan.origin));
  text += plan.lower_bound_m_s
              ? fmt::format("to first order about this plan no impulses{} cost less than {}.",
                            which, velocity_text(*plan.lower_bound_m_s))
              : "whether others cost less is not known, for flights did not confirm the linear "
                "theory about it.";
  return text + times_left_out_text(result);
}

std::string impulse_lines(const TransferResult& result) {
  std::string text;
  if (const std::string primer = primer_text(result); !primer.empty()) {
    text += fmt::format("  another impulse  {}\n", primer);
  }
  if (const std::string failure = optimal_impulses_failure(result); !failure.empty()) {
    return text + fmt::format("  optimal          not found: {}\n", failure);
  }
  const ImpulsePlan* plan = plan_of(result);
  if (plan == nullptr) return text;
  text += fmt::format("  optimal          {} by {} in {}: misses by {}\n",
                      velocity_text(plan->total_change_m_s()),
                      counted(plan->impulses.size(), "impulse"),
                      time_text(seconds(result, plan->duration)), end_text(*plan));
  return text + impulse_rows(result, plan->impulses);
}

std::string impulse_rows(const TransferResult& result, const std::vector<Impulse>& impulses) {
  if (impulses.empty()) return "";
  std::vector<std::vector<std::string>> rows = {{"at time (s)", "change (m/s)"}};
  for (std::string& name : axis_names(result)) rows[0].push_back(std::move(name));
  for (const Impulse& impulse : impulses) {
    const double size = impulse.change_m_s.norm();
    rows.push_back(
        {fmt::format("{:.1f}", seconds(result, impulse.time)), velocity_number(size, size)});
    for (const double x : impulse.change_m_s) rows.back().push_back(velocity_number(x, size));
  }
  std::istringstream table(aligned_table(rows));
  std::string text;
  for (std::string line; std::getline(table, line);) text += "    " + line + "\n";
  return text;
}

std::string impulse_table_html(const TransferResult& result) {
  std::string html = "<section>\n<h2>Number of impulses</h2>\n";
  if (const std::string primer = primer_text(result); !primer.empty()) {
    html += "<p>Of the best transfer with two impulses " + escape_html(primer) + ".</p>\n";
  }
  html += "<p>" + escape_html(optimal_impulses_verdict(result)) + "</p>\n";
  const ImpulsePlan* plan = plan_of(result);
  if (plan == nullptr || !plan->failure.empty()) return html + "</section>\n";
  return html +
         impulse_rows_html(
             result, plan->impulses,
             fmt::format("Velocity changes of the optimal plan, flown {} times to correct them, "
                         "along the axes of the frame {} at their times.",
                         plan->flights, frame_text(result.scene.transfer->frame))) +
         "</section>\n";
}

std::string impulse_rows_html(const TransferResult& result, const std::vector<Impulse>& impulses,
                              const std::string& caption) {
  std::vector<std::string> names = {"time (s)", "change (m/s)"};
  for (std::string& name : axis_names(result)) names.push_back(std::move(name));
  std::string rows;
  for (const Impulse& impulse : impulses) {
    rows += "<tr>" + row_name_cell(fmt::format("{:.6g}", seconds(result, impulse.time))) +
            cell(fmt::format("{:.5g}", impulse.change_m_s.norm()));
    for (const double x : impulse.change_m_s) rows += cell(fmt::format("{:.5g}", x));
    rows += "</tr>\n";
  }
  return table_html(escape_html(caption), "<tr>" + header_cells(names) + "</tr>", rows);
}

Chart primer_chart(const TransferResult& result) {
  Chart chart;
  chart.name = "primer-vector";
  chart.title = "Primer vector along the transfer";
  const TimeAxis axis = time_axis(seconds(result, result.scene.transfer->times.back()));
  chart.x.label = fmt::format("time since the start ({})", axis.name);
  add_revolutions(result.scene, axis.seconds, chart.x);
  chart.y.label = "magnitude of the primer vector";
  chart.y.includes = {0, 1};
  const auto add = [&](std::string title, std::size_t style, const auto& magnitudes) {
    ChartCurve curve;
    curve.title = std::move(title);
    curve.style = style;
    curve.has_markers = false;
    for (const PrimerMagnitude& one : magnitudes) {
      curve.points.emplace_back(seconds(result, one.time) / axis.seconds, one.magnitude);
    }
    chart.curves.push_back(std::move(curve));
  };
  if (result.primer) add("best transfer with two impulses", 0, result.primer->magnitudes);
  if (const ImpulsePlan* plan = plan_of(result)) {
    add("optimal impulses", 1, plan->primer);
    ChartCurve impulses;
    impulses.title = "optimal impulses are here";
    impulses.style = 1;
    impulses.has_line = false;
    for (const Impulse& impulse : plan->impulses) {
      impulses.points.emplace_back(seconds(result, impulse.time) / axis.seconds, 1.0);
    }
    chart.curves.push_back(std::move(impulses));
  }
  chart.rules.push_back({false, 1, "1: the cost of an impulse"});
  chart.reading =
      "By how much a small velocity change at a time lowers the cost of the rest, for each m/s of "
      "its own: above 1 it is worth its cost, and a further impulse makes the transfer cheaper. A "
      "transfer whose primer vector is at most 1, and 1 at its impulses, is the cheapest of all in "
      "the linear theory, with any number of impulses. It exceeds 1 where the scene's largest "
      "impulse allows no more.";
  return chart;
}

Json primer_json(const TransferResult& result) {
  if (!result.primer) return nullptr;
  const PrimerMagnitude& largest = result.primer->largest;
  return {{"largest_magnitude", json_number(largest.magnitude)},
          {"time_s", seconds(result, largest.time)},
          {"further_impulse_helps", result.primer->calls_for_impulse()}};
}

Json impulses_json(const TransferResult& result, const std::vector<Impulse>& impulses) {
  return table_json(impulses_table("", "", "", result.scene, impulses))["impulses"];
}

Json optimal_impulses_json(const TransferResult& result) {
  if (!result.optimal) return nullptr;
  Json json = {{"failure", text_or_null(optimal_impulses_failure(result))},
               {"least_by_time", table_json(least_by_time_table(result))["least_by_time"]},
               {"plan", nullptr}};
  const ImpulsePlan* plan = plan_of(result);
  if (plan == nullptr) return json;
  const LeastChange* linear = linear_change_of(result, *plan);
  json["plan"] = {
      {"duration_s", seconds(result, plan->duration)},
      {"impulses", impulses_json(result, plan->impulses)},
      {"total_change_m_s", json_number(plan->total_change_m_s())},
      {"linear_change_m_s", linear == nullptr ? Json(nullptr) : json_number(linear->change_m_s)},
      {"found_from", origin_name(plan->origin)},
      {"lower_bound_m_s", json_number(plan->lower_bound_m_s)},
      {"spacing_s",
       plan->spacing ? Json(std::abs(seconds(result, *plan->spacing))) : Json(nullptr)},
      {"miss_m", json_number(plan->miss_m)},
      {"velocity_miss_m_s", json_number(plan->velocity_miss_m_s)},
      {"flight_floor_m", json_number(plan->flight_floor_m)},
      {"flights", plan->flights}};
  return json;
}

}  // namespace hamjet::io
