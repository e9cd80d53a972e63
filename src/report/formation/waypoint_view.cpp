#include "waypoint_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/html_text.hpp"
#include "../../text/quantity_text.hpp"
#include "impulse_tables.hpp"
#include "impulse_view.hpp"
#include "transfer_tables.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

const WaypointPlan* best_of(const TransferResult& result) {
  const auto& transfers = result.waypoints;
  return transfers && transfers->best_plan ? &transfers->plans[*transfers->best_plan] : nullptr;
}

double largest_miss_m(const WaypointPlan& plan) {
  double largest = 0;
  for (const WaypointLeg& leg : plan.legs) largest = std::max(largest, leg.miss_m);
  return largest;
}

/// What the primer vectors of the legs say.
std::string primer_sentence(const TransferResult& result, const WaypointPlan& plan) {
  const WaypointLeg* most = nullptr;
  for (const WaypointLeg& leg : plan.legs) {
    if (!leg.primer) continue;
    if (most == nullptr || leg.primer->magnitude > most->primer->magnitude) most = &leg;
  }
  if (most == nullptr) return "";
  return most->primer->magnitude > 1 + 1e-6
             ? fmt::format(
                   "the primer vector of a leg reaches {:.3g} at {}: a further impulse "
                   "there makes it cheaper",
                   most->primer->magnitude, time_text(seconds(result, most->primer->time)))
             : "the primer vectors of the legs are at most 1: to first order no further impulse "
               "makes it cheaper";
}

Json plan_json(const TransferResult& result, const WaypointPlan& plan) {
  Json legs = Json::array();
  for (const WaypointLeg& leg : plan.legs) {
    Json json = {{"start_s", seconds(result, leg.start)},
                 {"end_s", seconds(result, leg.end)},
                 {"miss_m", json_number(leg.miss_m)},
                 {"flights", leg.flights},
                 {"primer_vector", nullptr}};
    if (leg.primer) {
      json["primer_vector"] = {{"largest_magnitude", json_number(leg.primer->magnitude)},
                               {"time_s", seconds(result, leg.primer->time)}};
    }
    legs.push_back(std::move(json));
  }
  return {{"duration_s", seconds(result, plan.duration)},
          {"total_change_m_s", json_number(plan.total_change_m_s())},
          {"forbidden", text_or_null(plan.forbidden)},
          {"impulses", impulses_json(result, plan.impulses)},
          {"legs", std::move(legs)}};
}

}  // namespace

std::string waypoint_failure(const TransferResult& result) {
  return result.waypoints ? result.waypoints->failure : "";
}

std::string waypoint_verdict(const TransferResult& result) {
  if (!result.waypoints) return "";
  const WaypointPlan* plan = best_of(result);
  if (plan == nullptr) {
    return fmt::format("No way through the waypoints can be named: {}.", waypoint_failure(result));
  }
  return fmt::format(
      "Through {} it takes at least {} with an impulse at each, in {}, flown with misses of at "
      "most {}.",
      counted(result.scene.transfer->waypoints.size(), "waypoint"),
      velocity_text(plan->total_change_m_s()), time_text(seconds(result, plan->duration)),
      miss_text(largest_miss_m(*plan), result.flight_floor_m));
}

std::string waypoint_lines(const TransferResult& result) {
  if (!result.waypoints) return "";
  const WaypointPlan* plan = best_of(result);
  if (plan == nullptr) {
    return fmt::format("  waypoints        no way found: {}\n", waypoint_failure(result));
  }
  std::string text = fmt::format("  waypoints        {} in {}: misses by at most {}\n",
                                 velocity_text(plan->total_change_m_s()),
                                 time_text(seconds(result, plan->duration)),
                                 miss_text(largest_miss_m(*plan), result.flight_floor_m));
  const std::string primer = primer_sentence(result, *plan);
  if (!primer.empty()) text += fmt::format("{:19}{}\n", "", primer);
  return text + impulse_rows(result, plan->impulses);
}

std::string waypoint_section_html(const TransferResult& result) {
  if (!result.waypoints) return "";
  std::string html = "<section>\n<h2>Through the waypoints</h2>\n<p>" +
                     escape_html(waypoint_verdict(result)) + "</p>\n";
  if (const WaypointPlan* plan = best_of(result)) {
    if (const std::string primer = primer_sentence(result, *plan); !primer.empty()) {
      html += "<p>Of this way " + escape_html(primer) + ", the places kept.</p>\n";
    }
    html += impulse_rows_html(
        result, plan->impulses,
        fmt::format(
            "Velocity changes at the start, at the waypoints and at the end, along the axes "
            "of the frame {} at their times.",
            frame_text(result.scene.transfer->frame)));
  }
  return html + "</section>\n";
}

Json waypoints_json(const TransferResult& result) {
  if (!result.waypoints) return nullptr;
  Json json = {{"failure", text_or_null(waypoint_failure(result))},
               {"total_by_time", table_json(total_by_time_table(result))["total_by_time"]},
               {"plan", nullptr}};
  if (const WaypointPlan* plan = best_of(result)) json["plan"] = plan_json(result, *plan);
  return json;
}

std::string coasting_failure(const TransferResult& result) {
  return result.coasting ? result.coasting->failure : "";
}

std::string coasting_verdict(const TransferResult& result) {
  if (!result.coasting) return "";
  if (!result.coasting->plan) {
    return fmt::format("No transfer that waits can be named: {}.", coasting_failure(result));
  }
  const WaypointPlan& plan = *result.coasting->plan;
  const double start = plan.legs.front().start;
  return fmt::format(
      "With up to {} to drift before the first impulse the least found is {}, {} after the start "
      "and {} later, flown with a miss of {}.",
      time_text(std::abs(seconds(result, *result.scene.transfer->longest_coast))),
      velocity_text(plan.total_change_m_s()), time_text(seconds(result, start)),
      time_text(seconds(result, plan.duration - start)),
      miss_text(largest_miss_m(plan), result.flight_floor_m));
}

std::string coasting_lines(const TransferResult& result) {
  if (!result.coasting) return "";
  if (!result.coasting->plan) {
    return fmt::format("  drift first      not found: {}\n", coasting_failure(result));
  }
  const WaypointPlan& plan = *result.coasting->plan;
  return fmt::format("  drift first      {} after {}: misses by {}\n",
                     velocity_text(plan.total_change_m_s()),
                     time_text(seconds(result, plan.legs.front().start)),
                     miss_text(largest_miss_m(plan), result.flight_floor_m)) +
         impulse_rows(result, plan.impulses);
}

std::string coasting_section_html(const TransferResult& result) {
  if (!result.coasting) return "";
  std::string html =
      "<section>\n<h2>Drifting first</h2>\n<p>" + escape_html(coasting_verdict(result)) + "</p>\n";
  if (result.coasting->plan) {
    html += impulse_rows_html(
        result, result.coasting->plan->impulses,
        fmt::format("Its velocity changes, along the axes of the frame {} at their times.",
                    frame_text(result.scene.transfer->frame)));
  }
  return html + "</section>\n";
}

Json coasting_json(const TransferResult& result) {
  if (!result.coasting) return nullptr;
  Json json = {{"failure", text_or_null(coasting_failure(result))}, {"plan", nullptr}};
  if (result.coasting->plan) json["plan"] = plan_json(result, *result.coasting->plan);
  return json;
}

namespace {

const RevolutionTransfer* best_of_revolutions(const TransferResult& result) {
  const auto& others = result.revolutions;
  return others && others->best ? &others->transfers[*others->best] : nullptr;
}

std::string revolutions_text(const RevolutionTransfer& transfer) {
  if (transfer.difference == 0) return "as many revolutions as the chief on the other orbit";
  return fmt::format("{} {} than the chief{}",
                     counted(static_cast<std::size_t>(std::abs(transfer.difference)), "revolution"),
                     transfer.difference > 0 ? "more" : "fewer",
                     transfer.is_higher ? ", on the higher orbit" : "");
}

}  // namespace

std::string revolutions_failure(const TransferResult& result) {
  return result.revolutions ? result.revolutions->failure : "";
}

std::string revolutions_verdict(const TransferResult& result) {
  if (!result.revolutions) return "";
  const RevolutionTransfer* best = best_of_revolutions(result);
  if (best == nullptr) {
    return fmt::format("No transfer with other revolutions can be named: {}.",
                       revolutions_failure(result));
  }
  return fmt::format("With {} it takes {} in {}, flown with a miss of {}.", revolutions_text(*best),
                     velocity_text(best->plan.total_change_m_s()),
                     time_text(seconds(result, best->time)),
                     miss_text(largest_miss_m(best->plan), result.flight_floor_m));
}

std::string revolutions_lines(const TransferResult& result) {
  if (!result.revolutions) return "";
  const RevolutionTransfer* best = best_of_revolutions(result);
  if (best == nullptr) {
    return fmt::format("  revolutions      not found: {}\n", revolutions_failure(result));
  }
  return fmt::format("  revolutions      {} in {}, {}: misses by {}\n",
                     velocity_text(best->plan.total_change_m_s()),
                     time_text(seconds(result, best->time)), revolutions_text(*best),
                     miss_text(largest_miss_m(best->plan), result.flight_floor_m)) +
         impulse_rows(result, best->plan.impulses);
}

std::string revolutions_section_html(const TransferResult& result) {
  if (!result.revolutions) return "";
  std::string html = "<section>\n<h2>Other revolutions</h2>\n<p>" +
                     escape_html(revolutions_verdict(result)) + "</p>\n";
  if (const RevolutionTransfer* best = best_of_revolutions(result)) {
    html += impulse_rows_html(
        result, best->plan.impulses,
        fmt::format("Its velocity changes, along the axes of the frame {} at their times.",
                    frame_text(result.scene.transfer->frame)));
  }
  return html + "</section>\n";
}

Json revolutions_json(const TransferResult& result) {
  if (!result.revolutions) return nullptr;
  Json json = {{"failure", text_or_null(revolutions_failure(result))},
               {"best", nullptr},
               {"transfers", Json::array()}};
  if (result.revolutions->best) json["best"] = *result.revolutions->best;
  for (const RevolutionTransfer& one : result.revolutions->transfers) {
    json["transfers"].push_back(
        {{"difference", one.difference},
         {"is_higher", one.is_higher},
         {"time_s", seconds(result, one.time)},
         {"failure", text_or_null(one.failure)},
         {"plan", one.failure.empty() ? plan_json(result, one.plan) : Json(nullptr)}});
  }
  return json;
}

}  // namespace hamjet::io
