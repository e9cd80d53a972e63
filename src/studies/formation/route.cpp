#include "route.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../../algebra/state_sums.hpp"
#include "../../integrators/momentum_unit.hpp"
#include "../exact_flow.hpp"
#include "hamjet/error.hpp"
#include "impulses/impulse_search.hpp"
#include "keep_out.hpp"
#include "single_transfer.hpp"
#include "two_point_flight.hpp"

namespace hamjet {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

}  // namespace

Route::Route(const Scene& scene, const ComputedProblem& problem, const CompanionFlow& flow)
    : scene_(scene),
      problem_(problem),
      flow_(flow),
      units_(metric_units(scene)),
      momentum_unit_(std::ldexp(1.0, problem.momentum_exponent)) {}

ChiefFrame Route::frame(double time) const {
  return {flow_.chief(time), units_, scene_.transfer->frame};
}

Underway Route::start() const { return {0, frame(0).deviation(scene_.transfer->start)}; }

Underway Route::coast_to(double time) const {
  if (time == 0) return start();
  const std::vector<double> state = state_sum(problem_.nominal, start().deviation);
  return {time, state_difference(exact_flow(problem_.system, state, problem_.start_time, time),
                                 flow_.nominal(time))};
}

Underway Route::linear_coast_to(double time) const {
  const std::vector<double> deviation = start().deviation;
  Vector6 z;
  z << position_of(deviation), momentum_of(deviation) / momentum_unit_;
  z = flow_.at(time) * z;
  z.tail<3>() *= momentum_unit_;
  return {time, {z.begin(), z.end()}};
}

Matrix6 Route::flow_between(double first, double last) const {
  return flow_.at(last) * symplectic_inverse(flow_.at(first));
}

Eigen::Vector3d Route::linear_momentum(const Underway& from, double time, const Matrix6& between,
                                       const Eigen::Vector3d& place) const {
  const Eigen::Matrix3d commanded = between.topRightCorner<3, 3>();
  const Eigen::Vector3d rest = place - between.topLeftCorner<3, 3>() * position_of(from.deviation);
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(commanded);
  const Eigen::Vector3d found = momentum_unit_ * solver.solve(rest);
  const double speed = momentum_of(flow_.nominal(from.time)).norm();
  if (!solver.isInvertible() || !(found.norm() < speed / 2)) {
    throw Error(ErrorKind::numerical,
                fmt::format("from {:.6g} s to {:.6g} s, near a time at which no velocity commands "
                            "a place in one direction, the leg asks for more than half of the "
                            "orbital speed",
                            from.time * scene_.units.time_s, time * scene_.units.time_s));
  }
  return found;
}

double Route::linear_change_m_s(const Underway& from, double time) const {
  const Matrix6 between = flow_between(from.time, time);
  const std::vector<double> wanted = end(time);
  const Eigen::Vector3d begun = linear_momentum(from, time, between, position_of(wanted));
  Vector6 z;
  z << position_of(from.deviation), begun / momentum_unit_;
  const Eigen::Vector3d arrived = momentum_unit_ * (between * z).tail<3>();
  const double total =
      (begun - momentum_of(from.deviation)).norm() + (momentum_of(wanted) - arrived).norm();
  return total * units_.velocity_m_s();
}

std::vector<double> Route::place(double time, const Eigen::Vector3d& position_m) const {
  return state_sum(frame(time).deviation({position_m, Eigen::Vector3d::Zero()}),
                   flow_.chief_deviation(time));
}

std::vector<double> Route::end(double time) const {
  return state_sum(
      scene_.transfer->end.deviation(flow_.chief(time), units_, scene_.transfer->frame),
      flow_.chief_deviation(time));
}

Underway Route::fly_to(const Underway& from, double time, const std::vector<double>& wanted,
                       WaypointPlan& plan) {
  const Eigen::Vector3d begun =
      linear_momentum(from, time, flow_between(from.time, time), position_of(wanted));
  std::vector<double> guess = flow_.nominal(from.time);
  for (std::size_t i = 0; i < 3; ++i) {
    guess[i] += from.deviation[i];
    guess[3 + i] += begun[static_cast<Eigen::Index>(i)];
  }
  return fly_from_guess(from, time, wanted, std::move(guess), plan);
}

Underway Route::fly_from_guess(const Underway& from, double time, const std::vector<double>& wanted,
                               std::vector<double> guess, WaypointPlan& plan) {
  const std::vector<double> orbit = flow_.nominal(from.time);
  const std::vector<double> orbit_then = flow_.nominal(time);
  const TwoPointFlight flight =
      fly_between(problem_.system, std::move(guess), problem_.start_time + from.time,
                  position_of(orbit_then) + position_of(wanted), time - from.time,
                  scene_.transfer->refined_miss_m / units_.length_m);
  if (!flight.is_found()) {
    throw Error(
        ErrorKind::numerical,
        fmt::format("the leg from {:.6g} s to {:.6g} s was not found: {}",
                    from.time * scene_.units.time_s, time * scene_.units.time_s, flight.failure));
  }
  ways_.push_back(state_difference(flight.start, orbit));
  add_impulse(plan, from.time, ways_.back(), from.deviation);
  WaypointLeg leg;
  leg.start = from.time;
  leg.end = time;
  leg.flights = flight.flights;
  leg.miss_m = flight.miss * units_.length_m;
  plan.legs.push_back(leg);
  return {time, state_difference(flight.end, orbit_then)};
}

void Route::finish(const Underway& there, WaypointPlan& plan, bool has_primer) const {
  plan.duration = there.time;
  add_impulse(plan, there.time, end(there.time), there.deviation);
  for (std::size_t k = 0; has_primer && k < plan.legs.size(); ++k) {
    plan.legs[k].primer = primer_of_leg(plan, k);
  }
  judge_limits(plan);
}

void Route::add_impulse(WaypointPlan& plan, double time, const std::vector<double>& after,
                        const std::vector<double>& before) const {
  plan.impulses.push_back(
      {time, frame(time).velocity_change_m_s(momentum_of(after) - momentum_of(before))});
}

/// The direction of an impulse in the inertial axes.
Eigen::Vector3d Route::direction(const Impulse& impulse) const {
  return momentum_of(frame(impulse.time).deviation({Eigen::Vector3d::Zero(), impulse.change_m_s}))
      .normalized();
}

std::optional<PrimerMagnitude> Route::primer_of_leg(const WaypointPlan& plan, std::size_t k) const {
  const Impulse& first = plan.impulses[k];
  const Impulse& last = plan.impulses[k + 1];
  if (first.change_m_s.isZero(0) || last.change_m_s.isZero(0)) return std::nullopt;
  const auto history =
      primer_between(impulse_grid(flow_, first.time, last.time), direction(first), direction(last));
  if (!history) return std::nullopt;
  return history->largest;
}

void Route::judge_limits(WaypointPlan& plan) const {
  const TransferSettings& settings = *scene_.transfer;
  for (const Impulse& impulse : plan.impulses) {
    const double size = impulse.change_m_s.norm();
    if (!settings.largest_impulse_m_s || size <= *settings.largest_impulse_m_s) continue;
    plan.forbidden = fmt::format("the impulse at {:.6g} s is {:.4g} m/s, above largest_impulse_m_s",
                                 impulse.time * scene_.units.time_s, size);
    return;
  }
  WayLimits limits(scene_);
  const double begun = plan.legs.front().start;
  if (begun != 0) limits.fly(problem_.nominal, start().deviation, problem_.start_time, begun);
  for (std::size_t k = 0; k < plan.legs.size(); ++k) {
    const WaypointLeg& leg = plan.legs[k];
    limits.fly(flow_.chief(leg.start), state_difference(ways_[k], flow_.chief_deviation(leg.start)),
               problem_.start_time + leg.start, leg.end - leg.start);
  }
  plan.forbidden = limits.forbidden();
}

}  // namespace hamjet
