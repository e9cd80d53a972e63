#include <fmt/format.h>

#include "scene_relative_motion.hpp"
#include "starts/scene_manoeuvres.hpp"

namespace hamjet::io {
namespace {

const TableDescription& assigned_deputy_table() {
  static const TableDescription table = {relative_state_keys(), "In the frame of `[transfer]`."};
  return table;
}

const TableDescription& slot_table() {
  static const TableDescription table = {
      arrival_keys(), "In the frame of `[transfer]`, relative to where the chief is at arrival."};
  return table;
}

/// The states in the tables of a key; `read` reads each.
template <class State, class Read>
std::vector<State> read_states(const TableReader& assignment, std::string_view key,
                               const TableDescription& description, const Read& read) {
  const std::vector<TableReader> tables = assignment.tables(key);
  if (tables.size() > static_cast<std::size_t>(most_deputies)) {
    assignment.fail(key,
                    fmt::format("too many, got {} tables [[assignment.{}]], must be at most {}",
                                tables.size(), key, most_deputies));
  }
  std::vector<State> states;
  for (const TableReader& table : tables) {
    table.check_keys({description.names(),
                      {"frame", "derivatives"},
                      fmt::format("a {}, which is in the frame of the table [transfer],", key)});
    states.push_back(read(table));
  }
  return states;
}

}  // namespace

const TableDescription& assignment_table() {
  static const std::string at_most = fmt::format("1 to {} tables", most_deputies);
  const auto tables = [](const TableDescription& description) {
    return form::words(at_most, form::array(form::table(description)));
  };
  static const TableDescription table = {
      {{"time", form::choice({"per-pair", "common"}), absent::value("per-pair"),
        "whether each pair has its own best transfer time, or all pairs have the same one"},
       {"keep_apart_m", form::positive(), absent::other("any"),
        "deputies that come nearer to each other on their ways fail the command"},
       {"deputy", tables(assigned_deputy_table()), absent::refused(), "where the deputies start"},
       {"slot", tables(slot_table()), absent::refused(),
        "where the deputies may end; where there are fewer slots than deputies all slots are "
        "filled, otherwise all deputies find one"}},
      "Transfer times and frame are those of `[transfer]`."};
  return table;
}

AssignmentSettings read_assignment(const TableReader& assignment, const Scene& scene,
                                   const Nominal& nominal) {
  assignment.check_keys();
  require_relative_motion(assignment, scene);
  if (!scene.transfer) {
    assignment.fail("",
                    "no table [transfer], got none, must be there with frame and transfer times "
                    "that deputies and slots share");
  }
  AssignmentSettings settings;
  assignment.read_if_any("time", settings.time);
  assignment.read_if_any("keep_apart_m", settings.keep_apart_m);
  settings.deputies = read_states<RelativeState>(
      assignment, "deputy", assigned_deputy_table(), [&](const auto& table) {
        refuse_manoeuvres(table);
        return read_relative_state(table, nominal, scene.transfer->frame);
      });
  settings.slots =
      read_states<ArrivalState>(assignment, "slot", slot_table(),
                                [&](const auto& table) { return read_arrival(table, nominal); });
  return settings;
}

}  // namespace hamjet::io
