#include "impulse_tables.hpp"

#include <utility>

#include "frame_columns.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {

TableView impulses_table(const std::string& name, const std::string& place,
                         const std::string& meaning, const Scene& scene,
                         const std::vector<Impulse>& impulses) {
  const double unit = scene.units.time_s;
  ResultTable<Impulse> table(name, place, {"impulses"}, meaning);
  table.add("time_canonical", "", "since the start, in the scene's canonical unit of time",
            [&](const Impulse& impulse) { return told_time(scene, impulse.time); });
  table.add("time_s", "s", "since the start",
            [=](const Impulse& impulse) { return impulse.time * unit; });
  add_along_axes(table, scene, "change_m_s", axis_parts(scene, "change_", "_m_s"), "m/s",
                 "the velocity change, along the frame's axes at that time", &Impulse::change_m_s);
  table.add("magnitude_m_s", "m/s", "the magnitude of the velocity change",
            [](const Impulse& impulse) { return impulse.change_m_s.norm(); });
  return std::move(table).view(impulses, {impulses.size()});
}

TableView optimal_impulses_table(const TransferResult& result) {
  const auto& optimal = result.optimal;
  return impulses_table(
      "impulses", "/optimal_impulses/plan", "The impulses of the optimal plan, as flown.",
      result.scene, optimal && optimal->plan ? optimal->plan->impulses : std::vector<Impulse>());
}

TableView waypoint_impulses_table(const TransferResult& result) {
  const auto& waypoints = result.waypoints;
  return impulses_table(
      "waypoints", "/waypoints/plan",
      "The impulses of the least way through the waypoints, as flown.", result.scene,
      waypoints && waypoints->best_plan ? waypoints->plans[*waypoints->best_plan].impulses
                                        : std::vector<Impulse>());
}

TableView least_by_time_table(const TransferResult& result) {
  using Least = const LeastChange&;
  const double unit = result.scene.units.time_s;
  ResultTable<LeastChange> table("least_by_time", "/optimal_impulses", {"least_by_time"},
                                 "What optimal impulses cost in some of the transfer times.");
  table.add("time_s", "s", "the duration of the transfer",
            [=](Least one) { return one.time * unit; });
  table.add("linear_change_m_s", "m/s",
            "the least sum of velocity changes in the linear theory about the chief",
            &LeastChange::change_m_s);
  table.add("flown_change_m_s", "m/s", "the sum of the same velocity changes, corrected by flying",
            &LeastChange::flown_m_s);
  table.add("failure", "", "the reason why there is no answer", &LeastChange::failure);
  table.add("solver_failed", "",
            "whether the solver failed, so that the least may be less than this",
            &LeastChange::is_unproved);
  table.keep_in_csv({});
  const auto rows = result.optimal ? result.optimal->by_time : std::vector<LeastChange>();
  return std::move(table).view(rows, {rows.size()});
}

TableView total_by_time_table(const TransferResult& result) {
  using Plan = const WaypointPlan&;
  const double unit = result.scene.units.time_s;
  ResultTable<WaypointPlan> table("total_by_time", "/waypoints", {"total_by_time"},
                                  "What the way through the waypoints costs by transfer time.");
  table.add("time_s", "s", "the duration of the whole way",
            [=](Plan plan) { return plan.duration * unit; });
  table.add("total_change_m_s", "m/s", "the sum of the magnitudes of its impulses",
            &WaypointPlan::total_change_m_s);
  table.add("forbidden", "", "why the scene does not allow the way; empty where it does",
            &WaypointPlan::forbidden);
  table.keep_in_csv({});
  const auto rows = result.waypoints ? result.waypoints->plans : std::vector<WaypointPlan>();
  return std::move(table).view(rows, {rows.size()});
}

}  // namespace hamjet::io
