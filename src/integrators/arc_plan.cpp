#include "arc_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hamjet {
namespace {

/// A flow is not split if the speed-up on this number of threads is below this number: the digits
/// of the jet depend on the arcs, and must not depend on the number of the machine's threads.
constexpr double least_speed_up = 1.5;
constexpr std::size_t threads_of_choice = 4;
/// Largest fraction of the whole work that the composition of more than two arcs may take.
constexpr double composing_share = 0.02;

std::size_t quotient_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// The ratio of unsplit to split time, if tasks of equal cost are shared out among threads.
double speed_up(std::size_t arcs, std::size_t threads, double steps, const ArcCosts& costs) {
  if (arcs <= 1) return 1;
  const double whole = steps * costs.step;
  const double length = steps / static_cast<double>(arcs);
  // Only the first arc is expanded in the scene's variables alone.
  const double rounds = static_cast<double>(quotient_up(arcs, threads));
  double time = steps * costs.nominal + length * rounds * costs.later_arcs;
  if (threads == 1) time += length * (costs.first_arc - costs.later_arcs);
  for (std::size_t maps = arcs; maps > 1; maps = quotient_up(maps, 2)) {
    time += static_cast<double>(quotient_up(maps / 2, threads)) * costs.composition;
  }
  return whole / time;
}

std::size_t choose_arcs(double steps, const ArcCosts& costs, std::string& reason) {
  if (steps < threads_of_choice ||
      speed_up(threads_of_choice, threads_of_choice, steps, costs) < least_speed_up) {
    reason = fmt::format("splitting would not pay on {} threads", threads_of_choice);
    return 1;
  }
  std::size_t arcs = threads_of_choice;
  while (2 * arcs <= most_chosen_arcs && 2 * static_cast<double>(arcs) <= steps &&
         static_cast<double>(2 * arcs - 1) * costs.composition <=
             composing_share * steps * costs.step) {
    arcs *= 2;
  }
  reason =
      fmt::format("composing takes {:.1f} % of the work",
                  100 * static_cast<double>(arcs - 1) * costs.composition / (steps * costs.step));
  return arcs;
}

}  // namespace

ArcPlan make_arc_plan(const std::optional<std::size_t>& asked, long steps, const ArcCosts& costs) {
  ArcPlan plan;
  plan.steps = steps;
  plan.nominal_multiply_adds = costs.nominal;
  plan.step_multiply_adds = costs.step;
  plan.arc_step_multiply_adds = costs.later_arcs;
  plan.composition_multiply_adds = costs.composition;
  const double count = static_cast<double>(steps);
  if (!asked) {
    plan.arcs = choose_arcs(count, costs, plan.reason);
  } else {
    plan.arcs = std::min(*asked, static_cast<std::size_t>(std::max(steps, 1L)));
    plan.reason =
        plan.arcs < *asked ? fmt::format("asked for {}, more than steps", *asked) : "as asked for";
  }
  for (std::size_t i = 0; i < plan.speed_ups.size(); ++i) {
    plan.speed_ups[i] = speed_up(plan.arcs, ArcPlan::thread_counts[i], count, costs);
  }
  return plan;
}

}  // namespace hamjet
