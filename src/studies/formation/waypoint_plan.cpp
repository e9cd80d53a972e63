#include "waypoint_plan.hpp"

#include <cmath>
#include <utility>

#include "hamjet/error.hpp"
#include "route.hpp"

namespace hamjet {

double WaypointPlan::total_change_m_s() const {
  double total = 0;
  for (const Impulse& impulse : impulses) total += impulse.change_m_s.norm();
  return total;
}

WaypointTransfers waypoint_transfers(const Scene& scene, const ComputedProblem& problem,
                                     const CompanionFlow& flow, const ProgressCallback& progress) {
  const TransferSettings& settings = *scene.transfer;
  WaypointTransfers transfers;
  Route route(scene, problem, flow);
  WaypointPlan begun;
  Underway underway = route.start();
  try {
    for (const Waypoint& waypoint : settings.waypoints) {
      underway = route.fly_to(underway, waypoint.time,
                              route.place(waypoint.time, waypoint.position_m), begun);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    transfers.failure = error.what();
    return transfers;
  }
  for (std::size_t k = 0; k < settings.times.size(); ++k) {
    const double time = settings.times[k];
    if (std::abs(time) <= std::abs(underway.time)) continue;
    if (progress) {
      progress("waypoints", static_cast<double>(k) / static_cast<double>(settings.times.size()));
    }
    WaypointPlan plan = begun;
    route.keep_legs(settings.waypoints.size());
    try {
      route.finish(route.fly_to(underway, time, route.end(time), plan), plan);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      transfers.failure = error.what();
      continue;
    }
    if (!plan.forbidden.empty()) transfers.failure = plan.forbidden;
    transfers.plans.push_back(std::move(plan));
    const WaypointPlan& last = transfers.plans.back();
    const bool is_less =
        !transfers.best_plan ||
        last.total_change_m_s() < transfers.plans[*transfers.best_plan].total_change_m_s();
    if (last.forbidden.empty() && is_less) transfers.best_plan = transfers.plans.size() - 1;
  }
  if (transfers.best_plan) transfers.failure.clear();
  return transfers;
}

}  // namespace hamjet
