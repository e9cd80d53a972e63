#include "coasting_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "../../algebra/scalar_search.hpp"
#include "../flights/paced_times.hpp"
#include "../flown_span.hpp"
#include "hamjet/error.hpp"
#include "impulses/impulse_search.hpp"
#include "route.hpp"

namespace hamjet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A transfer of two impulses in the linear flow.
struct Candidate {
  double change_m_s = infinity;
  double coast = 0;  ///< in canonical units
  double time = 0;   ///< time between the impulses
};

double change_m_s(const Route& route, const Underway& from, double time) {
  try {
    return route.linear_change_m_s(from, from.time + time);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    return infinity;
  }
}

/// The least for one transfer time: on the grid of starts, and between the neighbours of its
/// minimum.
Candidate least_for(const Route& route, const std::vector<Underway>& starts, double time) {
  Candidate least;
  std::size_t place = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const double change = change_m_s(route, starts[k], time);
    if (!(change < least.change_m_s)) continue;
    least = {change, starts[k].time, time};
    place = k;
  }
  if (!std::isfinite(least.change_m_s)) return least;
  const double first = starts[place > 0 ? place - 1 : 0].time;
  const double last = starts[std::min(place + 1, starts.size() - 1)].time;
  constexpr std::uintmax_t most_steps = 40;
  constexpr int bits = 26;  // half of the digits, as a minimum is flat
  const auto [part, change] = minimum_between(
      "start times",
      [&](double share) {
        const Underway from = route.linear_coast_to(first + share * (last - first));
        // The value must be finite, because parabolas go through it.
        return std::min(1e9 * least.change_m_s, change_m_s(route, from, time));
      },
      0.0, 1.0, bits, most_steps);
  if (change < least.change_m_s) return {change, first + part * (last - first), time};
  return least;
}

std::vector<Underway> grid_of_starts(const Scene& scene, const Route& route, double longest) {
  constexpr IntervalCount wanted = {24, 8, 480};
  std::vector<Underway> starts;
  for (const double time : paced_times(scene, longest, interval_count(scene, longest, wanted))) {
    starts.push_back(route.linear_coast_to(time));
  }
  return starts;
}

}  // namespace

CompanionFlow coasting_flow(const Scene& scene, const ComputedProblem& problem) {
  try {
    return CompanionFlow(scene, problem, last_arrival(*scene.transfer), checkpoints_per_revolution);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::too_large) throw;
    throw Error(error.kind(), fmt::format("transfer.longest_coast_s: {}", error.what()));
  }
}

CoastingTransfer coasting_transfer(const Scene& scene, const ComputedProblem& problem,
                                   const CompanionFlow& flow, const ProgressCallback& progress) {
  constexpr std::size_t most_times = 48;
  constexpr std::size_t most_flown = 12;
  const TransferSettings& settings = *scene.transfer;
  const double longest = std::copysign(*settings.longest_coast, settings.times.back());
  Route route(scene, problem, flow);
  const std::vector<Underway> starts = grid_of_starts(scene, route, longest);
  const std::vector<double> times = some_times(settings.times, most_times);
  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (progress) {
      progress("start times", static_cast<double>(k) / static_cast<double>(times.size()));
    }
    candidates.push_back(least_for(route, starts, times[k]));
  }
  std::erase_if(candidates, [](const Candidate& one) { return !std::isfinite(one.change_m_s); });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.change_m_s < b.change_m_s; });
  if (candidates.size() > most_flown) candidates.resize(most_flown);
  CoastingTransfer result;
  result.failure = "no velocity commands the end, whenever it starts";
  for (const Candidate& one : candidates) {
    WaypointPlan plan;
    route.keep_legs(0);
    try {
      const double arrival = one.coast + one.time;
      const Underway there =
          route.fly_to(route.coast_to(one.coast), arrival, route.end(arrival), plan);
      route.finish(there, plan);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      result.failure = error.what();
      continue;
    }
    if (!plan.forbidden.empty()) {
      result.failure = plan.forbidden;
    } else if (!result.plan || plan.total_change_m_s() < result.plan->total_change_m_s()) {
      result.plan = std::move(plan);
    }
  }
  if (result.plan) result.failure.clear();
  return result;
}

}  // namespace hamjet
