#include "impulse_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "../../../integrators/momentum_unit.hpp"
#include "../../exact_flow.hpp"
#include "../../nominal/nominal_period.hpp"
#include "../keep_out.hpp"
#include "../single_transfer.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "impulse_search.hpp"

namespace hamjet {

double ImpulsePlan::total_change_m_s() const {
  double total = 0;
  for (const Impulse& impulse : impulses) total += impulse.change_m_s.norm();
  return total;
}

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Impulses of the linear theory that make a change, and what proves them the least.
struct FoundImpulses {
  ImpulseOptimum optimum;
  TimedImpulses impulses;
  bool is_limited = false;  ///< whether they are at spaced times, none above the limit
};

/// One deputy's way from the scene's start to its end.
class PlannedTransfer {
  /// Without a gap of the scene's own.
  static constexpr double gaps_in_period = 72;

 public:
  PlannedTransfer(const Scene& scene, const ComputedProblem& problem, const LinearFlow& flow,
                  double duration)
      : scene_(scene),
        problem_(problem),
        flow_(flow),
        duration_(duration),
        units_(metric_units(scene)),
        momentum_unit_(std::ldexp(1.0, problem.momentum_exponent)),
        chief_end_(flow.nominal(duration)),
        start_(frame(problem.nominal).deviation(scene.transfer->start)),
        end_(scene.transfer->end.deviation(chief_end_, units_, scene.transfer->frame)),
        from_end_(symplectic_inverse(flow.at(duration))),
        change_(from_end_ * in_flow_units(end_) - in_flow_units(start_)) {
    const std::optional<double>& limit = scene.transfer->largest_impulse_m_s;
    if (limit) most_ = *limit / metres_per_second(1);
    const double circle = 2 * std::numbers::pi * std::pow(initial_distance(scene.nominal), 1.5);
    gap_ = scene.transfer->impulse_gap.value_or(nominal_period(scene).value_or(circle) /
                                                gaps_in_period);
  }

  /// The cost of the least impulses on a coarse grid, in the linear theory.
  double coarse_cost_m_s() const {
    const ImpulseGrid grid = impulse_grid(flow_, duration_);
    const ImpulseOptimum optimum{grid, least_impulses(grid.effects, change_), {}};
    const FoundImpulses found = within_limit(optimum, change_);
    return metres_per_second(found.is_limited ? found.impulses.sum() : optimum.least.cost);
  }

  /// A sum of magnitudes in the flow's units in m/s.
  double metres_per_second(double momentum) const {
    return momentum * momentum_unit_ * units_.velocity_m_s();
  }

  ImpulsePlan plan() const {
    ImpulsePlan plan;
    plan.duration = duration_;
    FoundImpulses found = find(change_);
    TimedImpulses impulses = found.impulses;
    plan.linear_change_m_s = metres_per_second(impulses.sum());
    correct(plan, impulses, found.is_limited);
    // The flown impulses make another change of the linear theory than the wanted one, since that
    // theory does not hold exactly; others may make that change for less.
    constexpr int most_rounds = 4;
    constexpr double worth_it = 1e-5;
    for (int round = 0; round < most_rounds && plan.failure.empty(); ++round) {
      found = find(change_by(impulses));
      const bool is_least = impulses.sum() <= found.optimum.least.lower_bound * (1 + worth_it);
      if (is_least || round + 1 == most_rounds) break;
      ImpulsePlan other = plan;
      TimedImpulses others = found.impulses;
      correct(other, others, found.is_limited);
      if (!other.failure.empty() || !(others.sum() < impulses.sum())) break;
      plan = std::move(other);
      impulses = std::move(others);
    }
    plan.lower_bound_m_s = metres_per_second(found.optimum.least.lower_bound);
    if (found.is_limited) plan.spacing = duration_ / spaces();
    plan.primer = found.optimum.primer;
    tell(plan, impulses);
    if (plan.failure.empty()) judge_limits(plan, impulses);
    return plan;
  }

 private:
  ChiefFrame frame(const std::vector<double>& chief) const {
    return {chief, units_, scene_.transfer->frame};
  }

  Vector6 in_flow_units(const std::vector<double>& deviation) const {
    Vector6 z;
    for (Eigen::Index i = 0; i < 6; ++i) {
      z[i] = deviation[static_cast<std::size_t>(i)] / (i < 3 ? 1 : momentum_unit_);
    }
    return z;
  }

  /// How many spaces of at least the gap there are until the end; the time that the least impulses
  /// take grows with their number.
  int spaces() const {
    constexpr double most = 1000;
    const double fit = std::floor(std::abs(duration_) / gap_ * (1 + 1e-12));
    return static_cast<int>(std::clamp(fit, 1.0, most));
  }
  double spaced_time(int k) const { return k == spaces() ? duration_ : duration_ * k / spaces(); }

  FoundImpulses find(const Vector6& change) const {
    return within_limit(search_impulses(flow_, duration_, change), change);
  }

  /// The impulses of an optimum, or where one of them is above the limit the least of those that
  /// are not, at times that are spaced: without a space many small ones would be a large one.
  FoundImpulses within_limit(ImpulseOptimum optimum, const Vector6& change) const {
    TimedImpulses impulses = merged(optimum, change);
    if (impulses.largest() <= most_) return {std::move(optimum), std::move(impulses), false};
    ImpulseGrid grid;
    for (int k = 0; k <= spaces(); ++k) grid.add(spaced_time(k), flow_.at(spaced_time(k)));
    const std::optional<LeastImpulses> least = least_impulses(grid.effects, change, most_);
    if (!least) {
      throw Error(
          ErrorKind::numerical,
          fmt::format("no impulses of at most {:.6g} m/s each, {:.6g} s apart, do it within "
                      "{:.6g} s",
                      metres_per_second(most_),
                      std::abs(duration_) / spaces() * scene_.units.time_s,
                      duration_ * scene_.units.time_s));
    }
    FoundImpulses found{{grid, *least, primer_along(grid, least->costate)}, {}, true};
    for (const ChosenImpulse& impulse : least->impulses) {
      found.impulses.times.push_back(grid.times[impulse.time]);
      found.impulses.changes.push_back(impulse.change);
    }
    return found;
  }

  /// Those of neighbouring times become one impulse, at their mean time.
  TimedImpulses merged(const ImpulseOptimum& optimum, const Vector6& change) const {
    TimedImpulses found;
    auto& [times, changes] = found;
    constexpr std::size_t neighbours = 3;
    std::vector<double> weights;
    std::size_t last = 0;
    for (const ChosenImpulse& impulse : optimum.least.impulses) {
      const double time = optimum.grid.times[impulse.time];
      const double weight = impulse.change.norm();
      if (!times.empty() && impulse.time - last <= neighbours) {
        weights.back() += weight;
        times.back() += (time - times.back()) * weight / weights.back();
        changes.back() += impulse.change;
      } else {
        times.push_back(time);
        weights.push_back(weight);
        changes.push_back(impulse.change);
      }
      last = impulse.time;
    }
    add_change(effects_at(times), changes, weights, change - change_by(found));
    return found;
  }

  /// The change of the deviation at the start that impulses make in the linear theory.
  Vector6 change_by(const TimedImpulses& impulses) const {
    const std::vector<ImpulseEffect> effects = effects_at(impulses.times);
    Vector6 change = Vector6::Zero();
    for (std::size_t k = 0; k < effects.size(); ++k) change += effects[k] * impulses.changes[k];
    return change;
  }

  std::vector<ImpulseEffect> effects_at(const std::vector<double>& times) const {
    std::vector<ImpulseEffect> effects;
    for (const double time : times) effects.push_back(effect_of(flow_.at(time)));
    return effects;
  }

  /// Called with the time at which a leg of the flight begins, its duration, and the state then.
  using OnLeg = std::function<void(double, double, const std::vector<double>&)>;

  /// The deviation from the chief at the end of a deputy that flies the impulses.
  std::vector<double> fly(const std::vector<double>& times,
                          const std::vector<Eigen::Vector3d>& changes,
                          const OnLeg& on_leg = {}) const {
    std::vector<double> state = problem_.nominal;
    for (std::size_t i = 0; i < 6; ++i) state[i] += start_[i];
    double now = 0;
    const auto fly_to = [&](double time) {
      if (time == now) return;
      if (on_leg) on_leg(now, time - now, state);
      state = exact_flow(problem_.system, state, time - now);
      now = time;
    };
    for (std::size_t k = 0; k < times.size(); ++k) {
      fly_to(times[k]);
      for (std::size_t i = 0; i < 3; ++i) {
        state[3 + i] += changes[k][static_cast<Eigen::Index>(i)] * momentum_unit_;
      }
    }
    fly_to(duration_);
    for (std::size_t i = 0; i < 6; ++i) state[i] -= chief_end_[i];
    return state;
  }

  /// Says what of the plan the scene does not allow.
  void judge_limits(ImpulsePlan& plan, const TimedImpulses& impulses) const {
    const TransferSettings& settings = *scene_.transfer;
    double largest = 0;
    for (const Impulse& impulse : plan.impulses) {
      largest = std::max(largest, impulse.change_m_s.norm());
    }
    // At the limit they are there to rounding.
    if (settings.largest_impulse_m_s && largest > *settings.largest_impulse_m_s * (1 + 1e-12)) {
      plan.forbidden = fmt::format("an impulse is {:.4g} m/s, above largest_impulse_m_s", largest);
      return;
    }
    WayLimits limits(scene_);
    fly(impulses.times, impulses.changes,
        [&](double time, double duration, const std::vector<double>& state) {
          const std::vector<double> chief = flow_.nominal(time);
          std::vector<double> deviation = state;
          for (std::size_t i = 0; i < 6; ++i) deviation[i] -= chief[i];
          limits.fly(chief, deviation, duration);
        });
    plan.forbidden = limits.forbidden();
  }

  /// Flies the plan and takes the linear flow's word on how to mend what it misses by.
  void correct(ImpulsePlan& plan, TimedImpulses& impulses, bool is_limited) const {
    constexpr int most_flights = 16;
    const double most_miss = scene_.transfer->refined_miss_m / units_.length_m;
    // The same times the mean motion of a circle, to a factor of two.
    const double most_velocity_miss = most_miss * momentum_unit_;
    auto& [times, changes] = impulses;
    std::vector<ImpulseEffect> effects = effects_at(times);
    std::vector<double> weights;
    for (const Eigen::Vector3d& change : changes) weights.push_back(change.norm());
    double miss = 0;
    try {
      for (int flight = 0; flight < most_flights; ++flight) {
        ++plan.flights;
        const std::vector<double> flown = fly(times, changes);
        std::vector<double> missing(6);
        for (std::size_t i = 0; i < 6; ++i) missing[i] = end_[i] - flown[i];
        miss = std::hypot(missing[0], missing[1], missing[2]);
        const double velocity_miss = std::hypot(missing[3], missing[4], missing[5]);
        plan.miss_m = miss * units_.length_m;
        plan.velocity_miss_m_s = velocity_miss * units_.velocity_m_s();
        if (miss <= most_miss && velocity_miss <= most_velocity_miss) return;
        const Vector6 mend = from_end_ * in_flow_units(missing);
        if (!add_below_limit(effects, changes, weights, mend)) {
          add_trims(impulses, weights, is_limited);
          effects = effects_at(times);
          if (!add_below_limit(effects, changes, weights, mend)) break;
        }
      }
      plan.failure = fmt::format("the last of {} flights misses by {:.3g} m", most_flights,
                                 miss * units_.length_m);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      plan.failure = error.what();
    }
  }

  /// add_change that leaves no impulse above the limit; what is cut off the next flight shows.
  bool add_below_limit(const std::vector<ImpulseEffect>& effects,
                       std::vector<Eigen::Vector3d>& changes, const std::vector<double>& weights,
                       const Vector6& mend) const {
    const bool is_added = add_change(effects_below(effects, changes, most_), changes,
                                     weights_below(weights, changes, most_), mend);
    for (Eigen::Vector3d& change : changes) {
      if (change.norm() > most_) change *= most_ / change.norm();
    }
    return is_added;
  }

  /// Adds times, evenly from start to end, at which small impulses may correct what those of the
  /// plan cannot, such as a way out of the plane of an orbit by impulses half a revolution apart.
  void add_trims(TimedImpulses& impulses, std::vector<double>& weights, bool is_limited) const {
    // At spaced times a quarter of a revolution may lie between those of the plan.
    const int trims = is_limited ? 9 : 5;
    constexpr double share = 1e-2;
    const double weight = share * impulses.sum() / trims;
    auto& [times, changes] = impulses;
    for (int k = 0; k < trims; ++k) {
      const double time =
          is_limited ? spaced_time(k * spaces() / (trims - 1)) : duration_ * k / (trims - 1);
      const auto place = std::lower_bound(times.begin(), times.end(), time, [](double a, double b) {
        return std::abs(a) < std::abs(b);
      });
      if (place != times.end() && *place == time) continue;
      const auto at = place - times.begin();
      times.insert(place, time);
      changes.insert(changes.begin() + at, Eigen::Vector3d::Zero());
      weights.insert(weights.begin() + at, weight);
    }
  }

  void tell(ImpulsePlan& plan, const TimedImpulses& impulses) const {
    const auto& [times, changes] = impulses;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Eigen::Vector3d canonical = changes[k] * momentum_unit_;
      plan.impulses.push_back(
          {times[k], frame(flow_.nominal(times[k])).velocity_change_m_s(canonical)});
    }
  }

  const Scene& scene_;
  const ComputedProblem& problem_;
  const LinearFlow& flow_;
  double duration_;
  MetricUnits units_;
  double momentum_unit_;
  std::vector<double> chief_end_;
  std::vector<double> start_;  ///< canonical (dq, dp)
  std::vector<double> end_;
  Matrix6 from_end_;  ///< the flow from the end to the start
  Vector6 change_;    ///< of the deviation at the start that impulses must make
  double most_ = std::numeric_limits<double>::infinity();  ///< that an impulse may be
  double gap_ = 0;  ///< between impulses that the limit divides; canonical
};

}  // namespace

OptimalImpulses optimal_impulses(const Scene& scene, const ComputedProblem& problem,
                                 const LinearFlow& flow, const ProgressCallback& progress) {
  OptimalImpulses optimal;
  const std::vector<double> times = some_times(scene.transfer->times, 24);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (progress) {
      progress("optimal impulses", static_cast<double>(k) / static_cast<double>(times.size()));
    }
    try {
      const PlannedTransfer transfer(scene, problem, flow, times[k]);
      optimal.by_time.push_back({times[k], transfer.coarse_cost_m_s()});
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      optimal.failure = error.what();
    }
  }
  if (optimal.by_time.empty()) return optimal;
  optimal.failure.clear();
  double least = optimal.by_time.front().change_m_s;
  for (const LeastChange& one : optimal.by_time) least = std::min(least, one.change_m_s);
  const auto best =
      std::find_if(optimal.by_time.begin(), optimal.by_time.end(),
                   [&](const LeastChange& one) { return one.change_m_s <= 1.001 * least; });
  try {
    optimal.plan = PlannedTransfer(scene, problem, flow, best->time).plan();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    optimal.failure = error.what();
  }
  return optimal;
}

}  // namespace hamjet
