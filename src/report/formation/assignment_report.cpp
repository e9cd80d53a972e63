#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/json_text.hpp"
#include "../../store/json_values.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../study_checks.hpp"
#include "answer_columns.hpp"
#include "hamjet/report/relative_motion_report.hpp"
#include "transfer_json.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;

std::string_view time_choice(const AssignmentResult& result) {
  return result.scene.assignment->time == AssignmentTime::common ? "common" : "per-pair";
}

/// As in "deputies 0 and 2 come to 1.2 km of each other at 3600 s (60.0 min)".
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
             ? fmt::format("its way comes to {:.3g} of the ellipsoid keep_out_m",
                           *point.keep_out_ratio)
             : "";
}

/// Why the exit code is not 0.
std::string failure_line(const AssignmentResult& result) {
  if (exit_code(result) == 0) return "";
  if (!result.failure.empty()) return result.failure;
  for (const AssignedTransfer& assigned : result.transfers) {
    const std::string failure = failure_text(assigned.transfer);
    if (!failure.empty()) {
      return fmt::format("deputy {} to slot {}: {}", assigned.deputy, assigned.slot, failure);
    }
    if (const std::string limit = limit_text(assigned.transfer); !limit.empty()) {
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
    const TransferAnswer* answer = shown_answer(point);
    const std::string name = fmt::format("deputy {} to slot {}", assigned.deputy, assigned.slot);
    const std::string limit = limit_text(point);
    if (answer == nullptr) {
      rows.push_back({name, "", "", "", "no answer"});
      failures += fmt::format("{}: {}\n", name, failure_text(point));
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
    text += fmt::format("\n{}total: {}\n{}{}{}{}{}", aligned_table(rows),
                        velocity_text(result.total_change_m_s),
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
    json.push_back({{"deputy", assigned.deputy},
                    {"slot", assigned.slot},
                    {"transfer", transfer_point_json(assigned.transfer, result.scene)}});
  }
  return json;
}

std::string summary(const AssignmentResult& result) {
  const TransferSettings& settings = *result.scene.transfer;
  const bool is_assigned = !result.transfers.empty();
  Json json = study_head_json(result.scene, "assignment", result.integrator);
  add_coordinates(json, result.coordinates);
  json["frame"] = frame_name(settings.frame);
  json["derivatives"] = text_or_null(std::string(derivatives_name(settings.frame)));
  json["axes"] = axis_letters(settings.frame);
  json["kind"] = uses_kind(result) ? Json(settings.kind) : Json(nullptr);
  json["tolerance_m"] = settings.tolerance_m;
  json["deputies"] = result.scene.assignment->deputies.size();
  json["slots"] = result.scene.assignment->slots.size();
  json["time"] = time_choice(result);
  json["common_time_s"] = nullptr;
  if (result.common_time) {
    json["common_time_s"] = settings.times[*result.common_time] * result.scene.units.time_s;
  }
  json["transfers"] = transfers_json(result);
  json["total_change_m_s"] = is_assigned ? json_number(result.total_change_m_s) : Json(nullptr);
  json["deputies_without_slot"] = is_assigned ? Json(deputies_left(result)) : Json(nullptr);
  json["slots_without_deputy"] = is_assigned ? Json(slots_left(result)) : Json(nullptr);
  json["keep_apart_m"] = json_number(result.scene.assignment->keep_apart_m);
  json["nearest_pair"] = nullptr;
  if (const auto pair = nearest_pair(result)) {
    json["nearest_pair"] = {{"deputies", {pair->first, pair->second}},
                            {"time_s", pair->time * result.scene.units.time_s},
                            {"separation_m", json_number(pair->separation_m)}};
  }
  json["failure"] = text_or_null(result.failure);
  json["flight_floor_m"] = json_number(result.flight_floor_m);
  json["seconds"] = {{"study", result.study_seconds}, {"proof", result.proof_seconds}};
  json["exit_code"] = exit_code(result);
  return json_text(json) + "\n";
}

}  // namespace

std::string assignment_csv(const AssignmentResult& result) {
  using Row = const AssignedTransfer&;
  const double unit = result.scene.units.time_s;
  const auto has_kind = [](Row row) { return row.transfer.kind.has_value(); };
  Columns<AssignedTransfer> columns;
  columns.add("deputy", &AssignedTransfer::deputy);
  columns.add("slot", &AssignedTransfer::slot);
  columns.add("time_canonical",
              [&](Row row) { return told_time(result.scene, row.transfer.time); });
  columns.add("time_s", [=](Row row) { return row.transfer.time * unit; });
  columns.add_if(has_kind, "kind", [](Row row) { return row.transfer.kind->name(); });
  columns.add_if(has_kind, "condition", [](Row row) { return row.transfer.condition; });
  columns.add("near_singular", [](Row row) { return row.transfer.is_near_singular; });
  columns.add("beyond_tolerance", [](Row row) { return row.transfer.is_beyond_tolerance; });
  columns.add("answer", [](Row row) { return answer_name(row.transfer); });
  add_answer_columns<AssignedTransfer>(
      columns, result.scene.transfer->frame,
      [](Row row) -> const TransferPoint& { return row.transfer; });
  columns.add_if([](Row row) { return shown_answer(row.transfer) != nullptr; }, "miss_m",
                 [](Row row) { return shown_answer(row.transfer)->miss_m; });
  columns.add("failure", [](Row row) { return failure_text(row.transfer); });
  return columns.csv(result.transfers);
}

std::string costs_csv(const AssignmentResult& result) {
  const std::vector<double>& times = result.scene.transfer->times;
  std::string text = "deputy,slot,time_canonical,time_s,total_change_m_s\n";
  for (std::size_t i = 0; i < result.costs.size(); ++i) {
    for (std::size_t j = 0; j < result.costs[i].size(); ++j) {
      const AssignmentCost& cost = result.costs[i][j];
      text += fmt::format("{},{},", i, j);
      text += cost.time ? fmt::format("{},{},{}\n",
                                      csv_number(told_time(result.scene, times[*cost.time])),
                                      csv_number(times[*cost.time] * result.scene.units.time_s),
                                      csv_number(cost.total_change_m_s))
                        : ",,\n";
    }
  }
  return text;
}

std::string pairs_csv(const AssignmentResult& result) {
  const double unit = result.scene.units.time_s;
  Columns<DeputyPair> columns;
  columns.add("deputy", &DeputyPair::first);
  columns.add("other_deputy", &DeputyPair::second);
  columns.add("time_canonical",
              [&](const DeputyPair& pair) { return told_time(result.scene, pair.time); });
  columns.add("time_s", [=](const DeputyPair& pair) { return pair.time * unit; });
  columns.add("least_separation_m", &DeputyPair::separation_m);
  return columns.csv(result.pairs);
}

StudyReport assignment_report(const AssignmentResult& result, const ReportOrigin& /*origin*/) {
  StudyReport report;
  report.files = {{"assignment.csv", assignment_csv(result)},
                  {"costs.csv", costs_csv(result)},
                  {"pairs.csv", pairs_csv(result)},
                  {"summary.json", summary(result)}};
  report.table = terminal_table(result);
  report.details = terminal_details(result);
  report.exit_code = exit_code(result);
  report.failure = failure_line(result);
  add_checks(report, result.checks);
  return report;
}

}  // namespace hamjet::io
