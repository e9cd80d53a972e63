#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../../../algebra/state_sums.hpp"
#include "../../exact_flow.hpp"
#include "../keep_out.hpp"
#include "../two_point_flight.hpp"
#include "hamjet/error.hpp"
#include "planned_transfer.hpp"

// How a planned transfer is flown, corrected and judged.

namespace hamjet {

std::vector<double> PlannedTransfer::start_state() const {
  return state_sum(problem_.nominal, start_);
}

/// The final deviation from the orbit of a deputy that flies the impulses.
std::vector<double> PlannedTransfer::fly(const TimedImpulses& impulses, const OnLeg& on_leg) const {
  std::vector<double> state = start_state();
  double now = 0;
  const auto fly_to = [&](double time) {
    if (time == now) return;
    if (on_leg) on_leg(now, time - now, state);
    state = exact_flow(problem_.system, state, problem_.start_time + now, time - now);
    now = time;
  };
  for (std::size_t k = 0; k < impulses.times.size(); ++k) {
    fly_to(impulses.times[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      state[3 + i] += impulses.changes[k][static_cast<Eigen::Index>(i)] * momentum_unit_;
    }
  }
  fly_to(duration_);
  return state_difference(std::move(state), orbit_end_);
}

FlownImpulses PlannedTransfer::corrected(const LinearImpulses& impulses) const {
  return corrected(about_chief(), impulses.impulses, impulses.is_spaced);
}

FlownImpulses PlannedTransfer::corrected(Linearization linear, TimedImpulses impulses,
                                         bool is_spaced) const {
  constexpr int most_flights = 16;
  // If a flight leaves more than this fraction of the previous miss, its linear flow does not hold.
  constexpr double slow = 0.3;
  const double most_miss = scene_.transfer->refined_miss_m / units_.length_m;
  // The corresponding limit for velocities: times the mean motion on a circle, to a factor of two.
  const double most_velocity_miss = most_miss * momentum_unit_;
  FlownImpulses flown{std::move(impulses), is_spaced, 0, 0, 0, ""};
  auto& [times, changes] = flown.impulses;
  const auto effects_now = [&] {
    std::vector<ImpulseEffect> effects;
    for (const double time : times) effects.push_back(effect_of(linear.at(time)));
    return effects;
  };
  std::vector<double> weights;
  for (const Eigen::Vector3d& change : changes) weights.push_back(change.norm());
  double last = std::numeric_limits<double>::infinity();
  try {
    std::vector<ImpulseEffect> effects = effects_now();
    while (flown.flights < most_flights) {
      ++flown.flights;
      const std::vector<double> end = fly(flown.impulses);
      const std::vector<double> missing = state_difference(end_, end);
      const double miss = std::hypot(missing[0], missing[1], missing[2]);
      const double velocity_miss = std::hypot(missing[3], missing[4], missing[5]);
      flown.miss_m = miss * units_.length_m;
      flown.velocity_miss_m_s = velocity_miss * units_.velocity_m_s();
      const double size = std::max(miss / most_miss, velocity_miss / most_velocity_miss);
      if (size <= 1) return flown;
      if (size > slow * last) {
        linear = about(flown.impulses);
        effects = effects_now();
      }
      last = size;
      const Vector6 mend = linear.from_end * in_flow_units(missing);
      if (!add_below_limit(effects, changes, weights, mend)) {
        add_trims(flown.impulses, weights, is_spaced);
        effects = effects_now();
        if (!add_below_limit(effects, changes, weights, mend)) break;
      }
    }
    flown.failure = fmt::format(
        "the last of {} misses by {:.3g} m",
        flown.flights == 1 ? "1 flight" : fmt::format("{} flights", flown.flights), flown.miss_m);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    flown.failure = error.what();
  }
  return flown;
}

/// As add_change, but leaves no impulse above the limit; the next flight shows the part that is cut
/// off.
bool PlannedTransfer::add_below_limit(const std::vector<ImpulseEffect>& effects,
                                      std::vector<Eigen::Vector3d>& changes,
                                      const std::vector<double>& weights,
                                      const Vector6& mend) const {
  const bool is_added = add_change(effects_below(effects, changes, most_), changes,
                                   weights_below(weights, changes, most_), mend);
  for (Eigen::Vector3d& change : changes) {
    if (change.norm() > most_) change *= most_ / change.norm();
  }
  return is_added;
}

/// Adds times, evenly from start to end, at which small impulses may make corrections that the
/// plan's impulses cannot, for example out of the plane of an orbit when these are half a
/// revolution apart.
void PlannedTransfer::add_trims(TimedImpulses& impulses, std::vector<double>& weights,
                                bool is_spaced) const {
  // If impulses are spaced, a quarter of a revolution may lie between those of the plan.
  const int trims = is_spaced ? 9 : 5;
  constexpr double share = 1e-2;
  const double weight = share * impulses.sum() / trims;
  const double nearest = is_spaced ? 0 : std::abs(duration_) / 50;
  auto& [times, changes] = impulses;
  for (int k = 0; k < trims; ++k) {
    const double time =
        is_spaced ? spaced_time(k * spaces() / (trims - 1)) : duration_ * k / (trims - 1);
    const bool is_there = std::any_of(times.begin(), times.end(), [&](double other) {
      return std::abs(other - time) <= nearest;
    });
    if (is_there) continue;
    const auto place = std::lower_bound(times.begin(), times.end(), time, [](double a, double b) {
      return std::abs(a) < std::abs(b);
    });
    const auto at = place - times.begin();
    times.insert(place, time);
    changes.insert(changes.begin() + at, Eigen::Vector3d::Zero());
    weights.insert(weights.begin() + at, weight);
  }
}

/// The flight of a leg ends with a rounded state, and the next one begins with one to which an
/// impulse was added: each of them is wrong by an ulp of its distance from the centre, as in
/// rounding_of_flights, which the linear flow about the chief carries to the end.
double PlannedTransfer::flight_floor_m(const TimedImpulses& impulses) const {
  const Eigen::Matrix<double, 6, 6> whole = flow_.at(duration_);
  const auto carried = [&](double time) {
    const Eigen::Matrix<double, 6, 6> rest = whole * symplectic_inverse(flow_.at(time));
    return rest.norm() * position_of(flow_.nominal(time)).norm();
  };
  double sum = carried(0) + position_of(orbit_end_).norm();
  for (const double time : impulses.times) {
    if (time != 0 && time != duration_) sum += 2 * carried(time);
  }
  return std::numeric_limits<double>::epsilon() * sum * units_.length_m;
}

/// The reason why the scene's limits forbid the flown impulses; empty if they do not.
std::string PlannedTransfer::forbidden_by_limits(const TimedImpulses& impulses) const {
  // Impulses at the limit may exceed it by rounding.
  if (impulses.largest() > most_ * (1 + 1e-12)) {
    return fmt::format("an impulse is {:.4g} m/s, above largest_impulse_m_s",
                       metres_per_second(impulses.largest()));
  }
  WayLimits limits(scene_);
  fly(impulses, [&](double time, double duration, const std::vector<double>& state) {
    const std::vector<double> chief = flow_.chief(time);
    limits.fly(chief, state_difference(state, chief), problem_.start_time + time, duration);
  });
  return limits.forbidden();
}

}  // namespace hamjet
