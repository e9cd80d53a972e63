#include <fmt/format.h>

#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

std::vector<RelativeState> read_states(const TableReader& assignment, std::string_view key,
                                       const Nominal& nominal) {
  const std::vector<TableReader> tables = assignment.tables(key);
  if (tables.size() > static_cast<std::size_t>(most_deputies)) {
    assignment.fail(key,
                    fmt::format("too many, got {} tables [[assignment.{}]], must be at most {}",
                                tables.size(), key, most_deputies));
  }
  std::vector<RelativeState> states;
  for (const TableReader& table : tables) {
    table.check_keys({{"position_m", "velocity_m_s"},
                      {"frame", "derivatives"},
                      fmt::format("a {}, which is in the frame of the table [transfer],", key)});
    states.push_back(read_relative_state(table, nominal));
  }
  return states;
}

}  // namespace

AssignmentSettings read_assignment(const TableReader& assignment, const Scene& scene,
                                   const Nominal& nominal) {
  assignment.check_keys({{"time", "deputy", "slot"}});
  require_relative_motion(assignment, scene);
  if (!scene.transfer) {
    assignment.fail("",
                    "no table [transfer], got none, must be there with frame and transfer times "
                    "that deputies and slots share");
  }
  AssignmentSettings settings;
  if (assignment.has("time")) {
    settings.time = assignment.choice("time", {"per-pair", "common"}) == 0
                        ? AssignmentTime::per_pair
                        : AssignmentTime::common;
  }
  settings.deputies = read_states(assignment, "deputy", nominal);
  settings.slots = read_states(assignment, "slot", nominal);
  if (settings.deputies.size() != settings.slots.size()) {
    assignment.fail("slot",
                    fmt::format("as many slots as deputies are needed, got {} deputies and {} "
                                "slots, must be the same number",
                                settings.deputies.size(), settings.slots.size()));
  }
  return settings;
}

}  // namespace hamjet::io
