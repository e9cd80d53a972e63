#include "planned_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "../../../algebra/state_sums.hpp"
#include "../../../integrators/momentum_unit.hpp"
#include "../../nominal/nominal_period.hpp"
#include "../single_transfer.hpp"
#include "../two_point_flight.hpp"
#include "hamjet/error.hpp"
#include "path_flow.hpp"

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

namespace {

/// Distance of the impulses that a limit divides, as a part of a period, if the scene gives none.
constexpr double gaps_in_period = 72;

std::vector<ImpulseEffect> effects_at(const MatrixAt& at, const std::vector<double>& times) {
  std::vector<ImpulseEffect> effects;
  for (const double time : times) effects.push_back(effect_of(at(time)));
  return effects;
}

/// The change of the deviation at the start that impulses make in a linear flow.
Vector6 change_by(const MatrixAt& at, const TimedImpulses& impulses) {
  Vector6 change = Vector6::Zero();
  for (std::size_t k = 0; k < impulses.times.size(); ++k) {
    change += effect_of(at(impulses.times[k])) * impulses.changes[k];
  }
  return change;
}

/// Impulses between two choices, each at its own times.
TimedImpulses blend(const TimedImpulses& from, const TimedImpulses& to, double share) {
  TimedImpulses all;
  for (std::size_t i = 0, j = 0; i < from.times.size() || j < to.times.size();) {
    const bool has_from = i < from.times.size();
    const bool has_to = j < to.times.size();
    const bool takes_from =
        has_from && (!has_to || std::abs(from.times[i]) <= std::abs(to.times[j]));
    const bool takes_to = has_to && (!has_from || std::abs(to.times[j]) <= std::abs(from.times[i]));
    all.times.push_back(takes_from ? from.times[i] : to.times[j]);
    all.changes.push_back(Eigen::Vector3d::Zero());
    if (takes_from) all.changes.back() += (1 - share) * from.changes[i++];
    if (takes_to) all.changes.back() += share * to.changes[j++];
  }
  return all;
}

/// The impulses in which number `k` and the one before it are replaced by one at their mean time.
TimedImpulses with_one_for_two(TimedImpulses impulses, std::size_t k) {
  auto& [times, changes] = impulses;
  const double first = changes[k - 1].norm();
  const double second = changes[k].norm();
  times[k - 1] += (times[k] - times[k - 1]) * second / (first + second);
  changes[k - 1] += changes[k];
  times.erase(times.begin() + static_cast<std::ptrdiff_t>(k));
  changes.erase(changes.begin() + static_cast<std::ptrdiff_t>(k));
  return impulses;
}

}  // namespace

PlannedTransfer::PlannedTransfer(const Scene& scene, const ComputedProblem& problem,
                                 const CompanionFlow& flow, double duration)
    : scene_(scene),
      problem_(problem),
      flow_(flow),
      duration_(duration),
      units_(metric_units(scene)),
      momentum_unit_(std::ldexp(1.0, problem.momentum_exponent)),
      orbit_end_(flow.nominal(duration)),
      start_(frame(problem.nominal).deviation(scene.transfer->start)),
      end_(state_sum(
          scene.transfer->end.deviation(flow.chief(duration), units_, scene.transfer->frame),
          flow.chief_deviation(duration))) {
  const std::optional<double>& limit = scene.transfer->largest_impulse_m_s;
  if (limit) most_ = *limit / metres_per_second(1);
  const double circle = 2 * std::numbers::pi * std::pow(initial_distance(scene.nominal), 1.5);
  gap_ =
      scene.transfer->impulse_gap.value_or(nominal_period(scene).value_or(circle) / gaps_in_period);
}

double PlannedTransfer::metres_per_second(double sum) const {
  return sum * momentum_unit_ * units_.velocity_m_s();
}

ChiefFrame PlannedTransfer::frame(const std::vector<double>& chief) const {
  return {chief, units_, scene_.transfer->frame};
}

Vector6 PlannedTransfer::in_flow_units(const std::vector<double>& deviation) const {
  Vector6 z;
  z << position_of(deviation), momentum_of(deviation) / momentum_unit_;
  return z;
}

TimedImpulses PlannedTransfer::in_flow_units(const std::vector<Impulse>& impulses) const {
  TimedImpulses timed;
  for (const Impulse& impulse : impulses) {
    if (impulse.change_m_s.isZero(0)) continue;
    const std::vector<double> deviation =
        frame(flow_.chief(impulse.time)).deviation({Eigen::Vector3d::Zero(), impulse.change_m_s});
    timed.times.push_back(impulse.time);
    timed.changes.push_back(momentum_of(deviation) / momentum_unit_);
  }
  return timed;
}

PlannedTransfer::Linearization PlannedTransfer::about_chief() const {
  return {[this](double time) -> Matrix6 { return flow_.at(time); }, impulse_grid(flow_, duration_),
          symplectic_inverse(flow_.at(duration_))};
}

PlannedTransfer::Linearization PlannedTransfer::about(const TimedImpulses& impulses) const {
  const auto flow =
      std::make_shared<PathFlow>(problem_, start_state(), impulses, momentum_unit_, duration_);
  return {[flow](double time) { return flow->at(time); }, flow->grid(),
          symplectic_inverse(flow->at(duration_))};
}

int PlannedTransfer::spaces() const {
  constexpr double most = 1000;  // the linear program grows with their number
  const double fit = std::floor(std::abs(duration_) / gap_ * (1 + 1e-12));
  return static_cast<int>(std::clamp(fit, 1.0, most));
}

double PlannedTransfer::spaced_time(int k) const {
  return k == spaces() ? duration_ : duration_ * k / spaces();
}

LinearImpulses PlannedTransfer::coarse() const {
  const Linearization linear = about_chief();
  const Vector6 change = change_about_chief();
  const ImpulseOptimum optimum{linear.grid, least_impulses(linear.grid.effects, change), {}};
  return within_limit(linear, optimum, change);
}

LinearImpulses PlannedTransfer::by_linear_theory() const {
  return find(about_chief(), change_about_chief());
}

Vector6 PlannedTransfer::change_about_chief() const {
  return symplectic_inverse(flow_.at(duration_)) * in_flow_units(end_) - in_flow_units(start_);
}

PlannedTransfer::FoundImpulses PlannedTransfer::find(const Linearization& linear,
                                                     const Vector6& change) const {
  return within_limit(linear, search_impulses(linear.grid, linear.at, change), change);
}

/// The impulses of an optimum or, if one of them is above the limit, the least ones at spaced times
/// of which none is. Without spacing, many small impulses in a row would amount to a large one.
PlannedTransfer::FoundImpulses PlannedTransfer::within_limit(const Linearization& linear,
                                                             ImpulseOptimum optimum,
                                                             const Vector6& change) const {
  TimedImpulses impulses = merged(linear, optimum, change);
  if (impulses.largest() <= most_) return {{std::move(impulses)}, std::move(optimum)};
  ImpulseGrid grid;
  for (int k = 0; k <= spaces(); ++k) grid.add(spaced_time(k), linear.at(spaced_time(k)));
  const LimitedImpulses limited = least_impulses(grid.effects, change, most_);
  if (!limited.least) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("no impulses of at most {:.6g} m/s each, {:.6g} s apart, do it within "
                    "{:.6g} s: there they need to be of {:.3g} m/s at least",
                    metres_per_second(most_), std::abs(duration_) / spaces() * scene_.units.time_s,
                    duration_ * scene_.units.time_s, metres_per_second(limited.limit_needed)));
  }
  FoundImpulses found{{{}, true},
                      {grid, *limited.least, primer_along(grid, limited.least->costate)}};
  for (const ChosenImpulse& impulse : limited.least->impulses) {
    found.impulses.times.push_back(grid.times[impulse.time]);
    found.impulses.changes.push_back(impulse.change);
  }
  return found;
}

/// Merges impulses that are close together into one at their mean time, if that costs nothing.
TimedImpulses PlannedTransfer::merged(const Linearization& linear, const ImpulseOptimum& optimum,
                                      const Vector6& change) const {
  TimedImpulses all;
  for (const ChosenImpulse& impulse : optimum.least.impulses) {
    all.times.push_back(optimum.grid.times[impulse.time]);
    all.changes.push_back(impulse.change);
  }
  constexpr double nothing = 1e-6;
  for (std::size_t k = 1; k < all.times.size();) {
    TimedImpulses fewer = with_one_for_two(all, k);
    auto& [times, changes] = fewer;
    std::vector<double> weights;
    for (const Eigen::Vector3d& one : changes) weights.push_back(one.norm());
    const bool is_close = std::abs(all.times[k] - all.times[k - 1]) <= gap_ / 2;
    if (is_close &&
        add_change(effects_at(linear.at, times), changes, weights,
                   change - change_by(linear.at, fewer)) &&
        fewer.sum() <= all.sum() * (1 + nothing)) {
      all = std::move(fewer);
    } else {
      ++k;
    }
  }
  return all;
}

ImpulsePlan PlannedTransfer::plan(const FlownImpulses& given) const {
  FlownImpulses flown = given;
  ImpulsePlan plan;
  plan.duration = duration_;
  plan.flights = flown.flights;
  if (flown.failure.empty() && !flown.impulses.times.empty()) {
    improve(flown, plan);
    tidy(flown, plan);
  }
  plan.forbidden = flown.failure.empty() ? forbidden_by_limits(flown.impulses) : "";
  if (!plan.forbidden.empty() && forbidden_by_limits(given.impulses).empty()) {
    // Impulses that the linear theory makes cheaper may lead through the region that the scene
    // keeps free.
    flown = given;
    plan.forbidden.clear();
    plan.lower_bound_m_s.reset();
  }
  if (plan.lower_bound_m_s) {
    plan.lower_bound_m_s = std::min(*plan.lower_bound_m_s, metres_per_second(flown.impulses.sum()));
  }
  plan.failure = flown.failure;
  plan.miss_m = flown.miss_m;
  plan.velocity_miss_m_s = flown.velocity_miss_m_s;
  plan.flight_floor_m = flight_floor_m(flown.impulses);
  for (std::size_t k = 0; k < flown.impulses.times.size(); ++k) {
    const double time = flown.impulses.times[k];
    const Eigen::Vector3d canonical = flown.impulses.changes[k] * momentum_unit_;
    plan.impulses.push_back({time, frame(flow_.chief(time)).velocity_change_m_s(canonical)});
  }
  return plan;
}

/// The linear theory about the flown trajectory finds cheaper impulses, or proves that to first
/// order there are none. Steps to them are shortened until flights confirm that they are cheaper.
void PlannedTransfer::improve(FlownImpulses& flown, ImpulsePlan& plan) const {
  constexpr int most_rounds = 8;
  constexpr double worth_it = 1e-5;
  // If theory and flights disagree by more than this, the bound means nothing.
  constexpr double disagreement = 1e-2;
  try {
    for (int round = 0; round < most_rounds; ++round) {
      const Linearization linear = about(flown.impulses);
      const FoundImpulses found = find(linear, change_by(linear.at, flown.impulses));
      const double sum = flown.impulses.sum();
      const double bound = found.optimum.least.lower_bound;
      plan.lower_bound_m_s.reset();
      plan.spacing.reset();
      plan.primer = found.optimum.primer;
      if (bound <= sum * (1 + 1e-9) && sum <= bound * (1 + disagreement)) {
        plan.lower_bound_m_s = metres_per_second(std::min(bound, sum));
        if (found.is_spaced) plan.spacing = duration_ / spaces();
      }
      if (sum <= bound * (1 + worth_it) || round + 1 == most_rounds) return;
      std::optional<FlownImpulses> cheaper;
      for (double share = 1; share > 0.1 && !cheaper; share /= 2) {
        // At a mixture of times the impulses would not be spaced.
        if (share < 1 && found.is_spaced && !flown.is_spaced) break;
        FlownImpulses next =
            corrected(linear, blend(flown.impulses, found.impulses, share), found.is_spaced);
        plan.flights += next.flights;
        if (next.failure.empty() && next.impulses.sum() < sum * (1 - worth_it / 10)) {
          cheaper = std::move(next);
        }
      }
      if (!cheaper) return;
      flown = std::move(*cheaper);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    plan.lower_bound_m_s.reset();
  }
}

/// Removes impulses that are negligible beside the others, and merges impulses that are close
/// together, if flights confirm that this costs nothing.
void PlannedTransfer::tidy(FlownImpulses& flown, ImpulsePlan& plan) const {
  constexpr double nothing = 1e-6;
  const auto take_if_as_cheap = [&](const TimedImpulses& fewer) {
    FlownImpulses other = corrected(about_chief(), fewer, flown.is_spaced);
    plan.flights += other.flights;
    const bool is_as_cheap = other.failure.empty() &&
                             other.impulses.times.size() < flown.impulses.times.size() &&
                             other.impulses.sum() <= flown.impulses.sum() * (1 + nothing);
    if (is_as_cheap) flown = std::move(other);
    return is_as_cheap;
  };
  TimedImpulses large;
  for (std::size_t k = 0; k < flown.impulses.times.size(); ++k) {
    if (flown.impulses.changes[k].norm() <= 10 * nothing * flown.impulses.sum()) continue;
    large.times.push_back(flown.impulses.times[k]);
    large.changes.push_back(flown.impulses.changes[k]);
  }
  if (large.times.size() < flown.impulses.times.size()) take_if_as_cheap(large);
  if (flown.is_spaced) return;
  for (std::size_t k = 1; k < flown.impulses.times.size();) {
    const auto& times = flown.impulses.times;
    const bool is_close = std::abs(times[k] - times[k - 1]) <= gap_ / 2;
    if (!is_close || !take_if_as_cheap(with_one_for_two(flown.impulses, k))) ++k;
  }
}

}  // namespace hamjet
