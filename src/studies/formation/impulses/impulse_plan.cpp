#include "impulse_plan.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/error.hpp"
#include "least_impulses.hpp"
#include "planned_transfer.hpp"

namespace hamjet {

double ImpulsePlan::total_change_m_s() const {
  double total = 0;
  for (const Impulse& impulse : impulses) total += impulse.change_m_s.norm();
  return total;
}

bool OptimalImpulses::is_proved() const {
  return std::none_of(by_time.begin(), by_time.end(),
                      [](const LeastChange& one) { return one.is_unproved; });
}

namespace {

/// Impulses that lead to the scene's end, from any method.
struct KnownWay {
  PlanOrigin origin = PlanOrigin::linear_theory;
  double duration = 0;
  std::vector<Impulse> impulses;
};

/// For each kind of transfer, the cheapest one that the scene allows.
std::vector<KnownWay> known_ways(const TransferResult& result) {
  std::vector<KnownWay> ways;
  const auto add_point = [&](const TransferPoint& point) {
    const TransferAnswer& answer = point.best();
    ways.push_back({PlanOrigin::two_impulses,
                    point.time,
                    {{0, answer.start_change_m_s}, {point.time, answer.end_change_m_s}}});
  };
  const auto add_plan = [&](PlanOrigin origin, const WaypointPlan& plan) {
    ways.push_back({origin, plan.duration, plan.impulses});
  };
  if (const auto best = result.best_point()) add_point(result.points[*best]);
  if (result.least_between) add_point(*result.least_between);
  if (result.coasting && result.coasting->plan) {
    add_plan(PlanOrigin::coasting, *result.coasting->plan);
  }
  if (result.waypoints && result.waypoints->best_plan) {
    add_plan(PlanOrigin::waypoints, result.waypoints->plans[*result.waypoints->best_plan]);
  }
  if (result.revolutions && result.revolutions->best) {
    add_plan(PlanOrigin::revolutions,
             result.revolutions->transfers[*result.revolutions->best].plan);
  }
  return ways;
}

/// Impulses from which a plan may start.
struct Start {
  PlanOrigin origin = PlanOrigin::linear_theory;
  PlannedTransfer transfer;
  FlownImpulses flown;
};

class PlanSearch {
 public:
  PlanSearch(const Scene& scene, const ComputedProblem& problem, const CompanionFlow& flow,
             const ProgressCallback& progress)
      : scene_(scene), problem_(problem), flow_(flow), progress_(progress) {}

  OptimalImpulses run(const TransferResult& others) {
    find_by_time();
    plan_for_least();
    for (const KnownWay& way : known_ways(others)) add_start(way);
    if (!theory_holds()) fly_all_times();
    plan_from_least_start();
    if (!optimal_.plan && optimal_.failure.empty()) {
      optimal_.failure = "no transfer time has an answer";
    }
    if (optimal_.plan) optimal_.failure.clear();
    return std::move(optimal_);
  }

 private:
  PlannedTransfer transfer(double time) const { return {scene_, problem_, flow_, time}; }
  void tell(const std::string& what, std::size_t k, std::size_t count) const {
    if (progress_) progress_(what, static_cast<double>(k) / static_cast<double>(count));
  }

  /// Applies the linear theory about the chief on a coarse grid.
  void find_by_time() {
    const std::vector<double> times = some_times(scene_.transfer->times, 24);
    for (std::size_t k = 0; k < times.size(); ++k) {
      tell("optimal impulses", k, times.size());
      LeastChange least;
      least.time = times[k];
      coarse_.emplace_back();
      try {
        const PlannedTransfer planned = transfer(times[k]);
        coarse_.back() = planned.coarse();
        least.change_m_s = planned.metres_per_second(coarse_.back()->impulses.sum());
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::numerical) throw;
        least.failure = optimal_.failure = error.what();
        least.is_unproved = dynamic_cast<const UnprovedLeast*>(&error) != nullptr;
      }
      optimal_.by_time.push_back(std::move(least));
    }
  }

  /// Plans for the shortest of the times whose cost is at most a thousandth above the least cost.
  void plan_for_least() {
    std::optional<double> least;
    for (const LeastChange& one : optimal_.by_time) {
      if (one.change_m_s) least = std::min(least.value_or(*one.change_m_s), *one.change_m_s);
    }
    if (!least) return;
    const auto best =
        std::find_if(optimal_.by_time.begin(), optimal_.by_time.end(), [&](const LeastChange& one) {
          return one.change_m_s && *one.change_m_s <= 1.001 * *least;
        });
    attempt([&] {
      const PlannedTransfer planned = transfer(best->time);
      // A deputy that arrives by itself needs no impulses.
      FlownImpulses flown = planned.corrected({});
      if (!flown.failure.empty()) {
        const LinearImpulses linear = planned.by_linear_theory();
        flown = planned.corrected(linear);
        linear_m_s_ = planned.metres_per_second(linear.impulses.sum());
        if (flown.failure.empty()) {
          best->flown_m_s = planned.metres_per_second(flown.impulses.sum());
        }
      }
      take(PlanOrigin::linear_theory, planned.plan(flown));
    });
  }

  void add_start(const KnownWay& way) {
    attempt([&] {
      PlannedTransfer planned = transfer(way.duration);
      FlownImpulses flown = planned.corrected({planned.in_flow_units(way.impulses), false});
      if (flown.failure.empty()) starts_.push_back({way.origin, planned, std::move(flown)});
    });
  }

  double cost_m_s(const Start& start) const {
    return start.transfer.metres_per_second(start.flown.impulses.sum());
  }

  /// Whether flights cost what the linear theory predicts, and no other transfer costs less.
  bool theory_holds() const {
    constexpr double disagreement = 1e-2;
    if (!optimal_.is_found()) return false;
    const double found = optimal_.plan->total_change_m_s();
    if (std::abs(found - linear_m_s_) > disagreement * linear_m_s_) return false;
    return std::none_of(starts_.begin(), starts_.end(),
                        [&](const Start& start) { return cost_m_s(start) < found * (1 - 1e-3); });
  }

  void fly_all_times() {
    for (std::size_t k = 0; k < coarse_.size(); ++k) {
      LeastChange& one = optimal_.by_time[k];
      if (!coarse_[k] || one.flown_m_s) continue;
      tell("flown impulses", k, coarse_.size());
      attempt([&] {
        PlannedTransfer planned = transfer(one.time);
        FlownImpulses flown = planned.corrected(*coarse_[k]);
        if (!flown.failure.empty()) return;
        one.flown_m_s = planned.metres_per_second(flown.impulses.sum());
        starts_.push_back({PlanOrigin::linear_theory, planned, std::move(flown)});
      });
    }
  }

  void plan_from_least_start() {
    starts_.sort([&](const Start& a, const Start& b) { return cost_m_s(a) < cost_m_s(b); });
    for (const Start& start : starts_) {
      const bool is_dearer =
          optimal_.is_found() && cost_m_s(start) >= optimal_.plan->total_change_m_s();
      if (is_dearer) return;
      attempt([&] { take(start.origin, start.transfer.plan(start.flown)); });
    }
  }

  void take(PlanOrigin origin, ImpulsePlan plan) {
    plan.origin = origin;
    const bool is_good = plan.failure.empty() && plan.forbidden.empty();
    const bool is_less = !optimal_.plan ||
                         (is_good && (!optimal_.is_found() ||
                                      plan.total_change_m_s() < optimal_.plan->total_change_m_s()));
    if (is_less) optimal_.plan = std::move(plan);
  }

  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      if (optimal_.failure.empty()) optimal_.failure = error.what();
    }
  }

  const Scene& scene_;
  const ComputedProblem& problem_;
  const CompanionFlow& flow_;
  const ProgressCallback& progress_;
  std::vector<std::optional<LinearImpulses>> coarse_;  ///< for each of the times
  double linear_m_s_ = 0;                              ///< sum of the linear theory's plan
  std::list<Start> starts_;
  OptimalImpulses optimal_;
};

}  // namespace

OptimalImpulses optimal_impulses(const Scene& scene, const ComputedProblem& problem,
                                 const CompanionFlow& flow, const TransferResult& others,
                                 const ProgressCallback& progress) {
  return PlanSearch(scene, problem, flow, progress).run(others);
}

}  // namespace hamjet
