#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../study_checks.hpp"
#include "assignment_tables.hpp"
#include "frame_columns.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_json.hpp"
#include "transfer_tables.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string_view time_choice(const AssignmentResult& result) {
  return result.scene.assignment->time == AssignmentTime::common ? "common" : "per-pair";
}

/// A text such as "deputies 0 and 2 come to 1.2 km of each other at 3600 s (60.0 min)".
std::string pair_text(const AssignmentResult& result, const DeputyPair& pair) {
  return fmt::format("deputies {} and {} come to {} of each other at {}", pair.first, pair.second,
                     length_text(pair.separation_m),
                     time_text(pair.time * result.scene.units.time_s));
}

/// What of a transfer the scene does not allow; empty if it does.
std::string limit_text(const TransferPoint& point) {
  if (point.exceeds_impulse) {
    return fmt::format("an impulse is {}, above largest_impulse_m_s",
                       velocity_text(point.best().largest_impulse_m_s()));
  }
  return point.enters_keep_out()
             ? fmt::format("its way comes within {:.3g} times the ellipsoid keep_out_m",
                           *point.keep_out_ratio)
             : "";
}

std::string limit_of(const AssignmentResult& result, const AssignedTransfer& assigned) {
  if (!assigned.thrust) return limit_text(assigned.transfer);
  if (!assigned.thrust->exceeds_thrust) return "";
  return fmt::format("its thrust comes to {:.3g} m/s^2, above largest_thrust_m_s2 = {:.6g}",
                     assigned.thrust->largest_m_s2, *result.scene.transfer->largest_thrust_m_s2);
}

/// Why the exit code is not 0.
std::string failure_line(const AssignmentResult& result) {
  if (exit_code(result) == 0) return "";
  if (!result.failure.empty()) return result.failure;
  for (const AssignedTransfer& assigned : result.transfers) {
    const std::string failure =
        assigned.thrust ? assigned.thrust->failure : failure_text(assigned.transfer);
    if (!failure.empty()) {
      return fmt::format("deputy {} to slot {}: {}", assigned.deputy, assigned.slot, failure);
    }
    if (const std::string limit = limit_of(result, assigned); !limit.empty()) {
      return fmt::format("deputy {} to slot {}: {}", assigned.deputy, assigned.slot, limit);
    }
  }
  const auto pair = nearest_pair(result);
  const auto& keep_apart = result.scene.assignment->keep_apart_m;
  if (pair && keep_apart && pair->separation_m < *keep_apart) {
    return fmt::format("{}, must keep {} apart", pair_text(result, *pair),
                       length_text(*keep_apart));
  }
  return fmt::format("strict: a transfer misses by more than {}; see assignment.csv",
                     length_text(result.scene.transfer->tolerance_m));
}

std::vector<std::size_t> deputies_left(const AssignmentResult& result) {
  return left_out(result.transfers, result.scene.assignment->deputies.size(),
                  &AssignedTransfer::deputy);
}

std::vector<std::size_t> slots_left(const AssignmentResult& result) {
  return left_out(result.transfers, result.scene.assignment->slots.size(), &AssignedTransfer::slot);
}

/// The deputies or slots that an assignment of unequal numbers leaves out; empty without such.
std::string left_line(std::string_view what, const std::vector<std::size_t>& left) {
  return left.empty() ? "" : fmt::format("{}: {}\n", what, fmt::join(left, ", "));
}

/// A number of the thrust that lasts, by which a deputy comes to its slot.
struct ThrustNumber {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
  double (*value)(const EnergyOptimalTransfer&);

  std::optional<double> of(const AssignedTransfer& one) const {
    return one.thrust && one.thrust->is_found() ? std::optional(value(*one.thrust)) : std::nullopt;
  }
};

constexpr std::array<ThrustNumber, 4> thrust_numbers = {{
    {"thrust_energy_m2_s3", "m^2/s^3",
     "with a thrust that lasts, the integral of |u|^2 / 2 along its flight",
     [](const EnergyOptimalTransfer& one) { return one.energy_m2_s3; }},
    {"thrust_change_m_s", "m/s", "and that of |u|",
     [](const EnergyOptimalTransfer& one) { return one.change_m_s; }},
    {"largest_thrust_m_s2", "m/s^2", "the largest |u| of that flight",
     [](const EnergyOptimalTransfer& one) { return one.largest_m_s2; }},
    {"thrust_miss_m", "m", "the miss of that flight",
     [](const EnergyOptimalTransfer& one) { return one.refined->miss_m; }},
}};

bool is_thrusted(const AssignmentResult& result) {
  return result.scene.transfer->thrust == TransferThrust::energy_optimal;
}

/// What the assignment makes least where the thrust lasts.
std::string energy_text(const AssignmentResult& result) {
  if (!is_thrusted(result)) return "";
  return fmt::format(
      ", by a thrust that lasts, of which half the square integrates to the least, "
      "{:.6g} m^2/s^3",
      result.total_energy_m2_s3);
}

std::string terminal_table(const AssignmentResult& result) {
  std::string text =
      fmt::format("{}\n{} to {}, {} time\nframe {}, order {}\n", result.scene.title,
                  counted(result.scene.assignment->deputies.size(), "deputy"),
                  counted(result.scene.assignment->slots.size(), "slot"), time_choice(result),
                  frame_text(result.scene.transfer->frame) + coordinates_text(result.coordinates),
                  result.scene.order);
  if (!result.failure.empty()) text += fmt::format("NOT ASSIGNED: {}\n", result.failure);
  const double unit = result.scene.units.time_s;
  const TimeAxis axis = time_axis(result.scene.transfer->times.back() * unit);
  std::vector<std::vector<std::string>> rows = {
      {"transfer", "velocity change", fmt::format("time ({})", axis.name), "miss", "verdict"}};
  std::string failures;
  for (const AssignedTransfer& assigned : result.transfers) {
    const TransferPoint& point = assigned.transfer;
    const std::string name = fmt::format("deputy {} to slot {}", assigned.deputy, assigned.slot);
    const std::string limit = limit_of(result, assigned);
    if (assigned.thrust && assigned.thrust->is_found()) {
      const EnergyOptimalTransfer& thrust = *assigned.thrust;
      rows.push_back({name, velocity_text(thrust.change_m_s),
                      fmt::format("{:.6g}", thrust.time * unit / axis.seconds),
                      length_text(thrust.refined->miss_m), limit.empty() ? "ok" : "NOT ALLOWED"});
      if (!limit.empty()) failures += fmt::format("{}: {}\n", name, limit);
      continue;
    }
    const TransferAnswer* answer = shown_answer(point);
    if (answer == nullptr) {
      rows.push_back({name, "", "", "", "no answer"});
      failures += fmt::format("{}: {}\n", name,
                              assigned.thrust ? assigned.thrust->failure : failure_text(point));
      continue;
    }
    rows.push_back({name, velocity_text(answer->total_change_m_s()),
                    fmt::format("{:.6g}", point.time * unit / axis.seconds),
                    miss_text(answer->miss_m, result.flight_floor_m),
                    limit.empty() ? (point.is_beyond_tolerance ? "BEYOND" : "ok") : "NOT ALLOWED"});
    if (!limit.empty()) failures += fmt::format("{}: {}\n", name, limit);
    if (point.is_beyond_tolerance) {
      failures += fmt::format("{}: misses by more than the tolerance of {}\n", name,
                              length_text(result.scene.transfer->tolerance_m));
    }
  }
  if (!result.transfers.empty()) {
    const auto pair = nearest_pair(result);
    text += fmt::format("\n{}total: {}{}\n{}{}{}{}{}", aligned_table(rows),
                        velocity_text(result.total_change_m_s), energy_text(result),
                        pair ? "nearest: " + pair_text(result, *pair) + "\n" : "",
                        left_line("deputies without a slot", deputies_left(result)),
                        left_line("slots without a deputy", slots_left(result)),
                        failures.empty() ? "" : "\n", failures);
  }
  return text;
}

std::string terminal_details(const AssignmentResult& result) {
  return fmt::format("time: {} for costs and assignment, {} to prove it by flying (floor {})\n",
                     duration_text(result.study_seconds), duration_text(result.proof_seconds),
                     length_text(result.flight_floor_m));
}

/// Whether generating functions answer: in other coordinates than Cartesian no kind is used.
bool uses_kind(const AssignmentResult& result) {
  return result.coordinates == JetCoordinates::cartesian;
}

Json transfers_json(const AssignmentResult& result) {
  Json json = Json::array();
  for (const AssignedTransfer& assigned : result.transfers) {
    Json transfer = transfer_point_json(assigned.transfer, result.scene);
    for (const ThrustNumber& one : thrust_numbers) {
      transfer[std::string(one.name)] = json_number(one.of(assigned));
    }
    json.push_back(
        {{"deputy", assigned.deputy}, {"slot", assigned.slot}, {"transfer", std::move(transfer)}});
  }
  return json;
}

std::string summary(const AssignmentResult& result) {
  const TransferSettings& settings = *result.scene.transfer;
  const bool is_assigned = !result.transfers.empty();
  Json json = study_head_json(result.scene, "assignment", result.integrator);
  json.update(table_json(assignment_table(result)));
  add_chosen_by(json, result.coordinates);
  json["kind"] = uses_kind(result) ? Json(settings.kind) : Json(nullptr);
  json["tolerance_m"] = settings.tolerance_m;
  json["deputies"] = result.scene.assignment->deputies.size();
  json["slots"] = result.scene.assignment->slots.size();
  json["time"] = time_choice(result);
  json["transfers"] = transfers_json(result);
  json["total_change_m_s"] = is_assigned ? json_number(result.total_change_m_s) : Json(nullptr);
  json["total_energy_m2_s3"] =
      is_assigned && is_thrusted(result) ? json_number(result.total_energy_m2_s3) : Json(nullptr);
  json["keep_apart_m"] = json_number(result.scene.assignment->keep_apart_m);
  json["nearest_pair"] = nullptr;
  if (const auto pair = nearest_pair(result)) {
    json["nearest_pair"] = {{"deputies", {pair->first, pair->second}},
                            {"time_s", pair->time * result.scene.units.time_s},
                            {"separation_m", json_number(pair->separation_m)}};
  }
  json["failure"] = text_or_null(result.failure);
  json["seconds"] = {{"study", result.study_seconds}, {"proof", result.proof_seconds}};
  return json_text(json) + "\n";
}

}  // namespace

TableView assignment_table(const AssignmentResult& result) {
  const Scene& scene = result.scene;
  const bool is_assigned = !result.transfers.empty();
  const auto if_assigned = [&](auto left) {
    return is_assigned ? std::optional(left(result)) : std::nullopt;
  };
  ResultTable<AssignedTransfer> table("assignment", "", {"transfers"},
                                      "The transfer of each deputy that has a slot.");
  table.leave_rows_out_of_json();
  table.add("deputy", "", "the number of the deputy, from 0", &AssignedTransfer::deputy)
      .is_in_json = false;
  table.add("slot", "", "the number of the slot, from 0", &AssignedTransfer::slot).is_in_json =
      false;
  table.add_columns(transfer_columns(scene), &AssignedTransfer::transfer);
  for (const ThrustNumber& one : thrust_numbers) {
    table.add(std::string(one.name), std::string(one.unit), std::string(one.meaning),
              [one](const AssignedTransfer& assigned) { return one.of(assigned); });
  }
  std::set<std::string> in_csv = {"deputy",         "slot",
                                  "time_canonical", "time_s",
                                  "kind",           "condition",
                                  "near_singular",  "beyond_tolerance",
                                  "answer",         "start_change_m_s",
                                  "end_change_m_s", "total_change_m_s",
                                  "miss_m",         "failure"};
  if (is_thrusted(result)) {
    in_csv = {"deputy",
              "slot",
              "time_canonical",
              "time_s",
              "thrust_energy_m2_s3",
              "thrust_change_m_s",
              "largest_thrust_m_s2",
              "thrust_miss_m",
              "failure"};
  }
  table.keep_in_csv(in_csv);
  add_frame(table, scene.system, scene.transfer->frame, result.coordinates);
  const auto& common = result.common_time;
  table.add_scalar(
      "common_time_s", "s", "the time of all transfers, where the scene asks for a common one",
      common ? std::optional(scene.transfer->times[*common] * scene.units.time_s) : std::nullopt);
  table.add_scalars("deputies_without_slot", "", "the numbers of these deputies, from 0",
                    if_assigned(deputies_left));
  table.add_scalars("slots_without_deputy", "", "the numbers of these slots, from 0",
                    if_assigned(slots_left));
  table.add_scalar("flight_floor_m", "m", "misses below this say nothing", result.flight_floor_m);
  table
      .add_scalar("not_assigned", "", "why there is no assignment; nothing if there is one",
                  result.failure)
      .is_in_json = false;  // there it is the failure of the whole
  table.add_scalar("exit_code", "", "the exit code of the command",
                   static_cast<int>(exit_code(result)));
  TableView view = std::move(table).view(result.transfers, {result.transfers.size()});
  for (std::size_t i = 0; i < result.transfers.size(); ++i) {
    view.places_of_rows.emplace_back(i, fmt::format("/transfers/{}/transfer", i));
  }
  return view;
}

TableView costs_table(const AssignmentResult& result) {
  struct Row {
    std::size_t deputy, slot;
    AssignmentCost cost;
  };
  const Scene& scene = result.scene;
  const std::vector<double>& times = scene.transfer->times;
  const auto has_time = [](const Row& row) { return row.cost.time.has_value(); };
  ResultTable<Row> table("costs", "", {"deputies", "slots"},
                         "The least velocity change of each deputy to each slot.");
  table.leave_rows_out_of_json();
  table.add("deputy", "", "the number of the deputy, from 0", &Row::deputy);
  table.add("slot", "", "the number of the slot, from 0", &Row::slot);
  table.add_if(has_time, "time_canonical", "",
               "the duration of the transfer, in the canonical unit of time",
               [&](const Row& row) { return told_time(scene, times[*row.cost.time]); });
  table.add_if(has_time, "time_s", "s", "the duration of the transfer",
               [&](const Row& row) { return times[*row.cost.time] * scene.units.time_s; });
  const bool is_energy = is_thrusted(result);
  table.add_if([=](const Row& row) { return row.cost.time && !is_energy; }, "total_change_m_s",
               "m/s", "the sum of the magnitudes of both velocity changes",
               [](const Row& row) { return row.cost.total_change_m_s; });
  table.add_if([=](const Row& row) { return row.cost.time && is_energy; }, "energy_m2_s3",
               "m^2/s^3", "with a thrust that lasts, the integral of |u|^2 / 2 by the polynomials",
               [](const Row& row) { return row.cost.energy_m2_s3; });
  std::vector<Row> rows;
  for (std::size_t i = 0; i < result.costs.size(); ++i) {
    for (std::size_t j = 0; j < result.costs[i].size(); ++j) {
      rows.push_back({i, j, result.costs[i][j]});
    }
  }
  const std::size_t slots = result.costs.empty() ? 0 : result.costs.front().size();
  return std::move(table).view(rows, {result.costs.size(), slots});
}

TableView pairs_table(const AssignmentResult& result) {
  const double unit = result.scene.units.time_s;
  ResultTable<DeputyPair> table("pairs", "", {"pairs"},
                                "How near two deputies come to each other while they fly.");
  table.leave_rows_out_of_json();
  table.add("deputy", "", "the number of the deputy, from 0", &DeputyPair::first);
  table.add("other_deputy", "", "the number of the other deputy of the pair, from 0",
            &DeputyPair::second);
  table.add("time_canonical", "",
            "the time at which they are nearest, in the scene's canonical unit of time",
            [&](const DeputyPair& pair) { return told_time(result.scene, pair.time); });
  table.add("time_s", "s", "the time at which they are nearest",
            [=](const DeputyPair& pair) { return pair.time * unit; });
  table.add("least_separation_m", "m", "the least separation of the two deputies",
            &DeputyPair::separation_m);
  return std::move(table).view(result.pairs, {result.pairs.size()});
}

std::vector<TableView> assignment_tables(const AssignmentResult& result) {
  return {assignment_table(result), costs_table(result), pairs_table(result)};
}

StudyReport assignment_report(const AssignmentResult& result, const ReportOrigin& /*origin*/) {
  StudyReport report;
  report.files = {{"assignment.csv", table_csv(assignment_table(result))},
                  {"costs.csv", table_csv(costs_table(result))},
                  {"pairs.csv", table_csv(pairs_table(result))},
                  {"summary.json", summary(result)}};
  report.table = terminal_table(result);
  report.details = terminal_details(result);
  report.exit_code = exit_code(result);
  report.failure = failure_line(result);
  add_checks(report, result.checks);
  return report;
}

}  // namespace hamjet::io
