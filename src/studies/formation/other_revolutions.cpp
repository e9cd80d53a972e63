#include "other_revolutions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "../../algebra/state_sums.hpp"
#include "../flights/flight_arcs.hpp"
#include "hamjet/error.hpp"
#include "lambert.hpp"
#include "route.hpp"
#include "two_point_flight.hpp"

namespace hamjet {
namespace {

constexpr double turn = 2 * std::numbers::pi;

Eigen::Vector3d angular_momentum(const std::vector<double>& state) {
  return position_of(state).cross(momentum_of(state));
}

/// The angle between two successive positions of one motion, which are less than half a revolution
/// apart.
double angle_between(const std::vector<double>& a, const std::vector<double>& b) {
  const double cosine = position_of(a).normalized().dot(position_of(b).normalized());
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// The angle through which a state turns in a time, by flying; no step of a flight is half a
/// revolution.
double turned_angle(const SharedSystem& system, const std::vector<double>& state,
                    const ClockTime& start_time, double time) {
  double angle = 0;
  fly_arcs(system, {state}, start_time, time, [&](const FlightArc& arc) {
    const std::vector<double> middle = arc.state(0, 0.5);
    angle += angle_between(arc.state(0, 0), middle) + angle_between(middle, arc.state(0, 1));
  });
  return angle;
}

/// The angle through which the chief turns, along its motion, until each checkpoint of the flow.
std::vector<double> turned_angles(const LinearFlow& flow) {
  std::vector<double> angles = {0};
  std::vector<double> last = flow.nominal(0);
  for (std::size_t k = 1; k < flow.times().size(); ++k) {
    const std::vector<double> state = flow.nominal(flow.times()[k]);
    angles.push_back(angles.back() + angle_between(last, state));
    last = state;
  }
  return angles;
}

/// The transfers for one transfer time.
class TransfersOfTime {
 public:
  TransfersOfTime(const ComputedProblem& problem, const Route& route, const LinearFlow& flow,
                  double time, double chief_angle)
      : problem_(problem),
        chief_(flow.nominal(0)),
        from_(route.start()),
        time_(time),
        wanted_(route.end(time)),
        first_(state_sum(chief_, from_.deviation)),
        last_(state_sum(flow.nominal(time), wanted_)),
        sense_((time > 0 ? 1 : -1) * angular_momentum(chief_)),
        angle_(angle_about(position_of(first_), position_of(last_), sense_)),
        own_(static_cast<int>(std::lround((chief_angle - angle_) / turn))) {}

  /// Adds the transfers that make this many revolutions more than the chief.
  void add(Route& route, int difference, std::vector<RevolutionTransfer>& transfers) const {
    const int revolutions = own_ + difference;
    if (revolutions < 0) return;
    // Backwards in time the same ellipses are flown with the opposite velocity.
    const std::vector<LambertEllipse> ellipses = lambert_ellipses(
        position_of(first_), position_of(last_), std::abs(time_), revolutions, sense_);
    const double sign = time_ > 0 ? 1 : -1;
    std::size_t own = ellipses.size();
    if (difference == 0) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < ellipses.size(); ++k) {
        const double change = (sign * ellipses[k].start_velocity - momentum_of(first_)).norm();
        if (change < nearest) own = k;
        nearest = std::min(nearest, change);
      }
    }
    for (std::size_t k = 0; k < ellipses.size(); ++k) {
      if (k == own) continue;
      RevolutionTransfer transfer;
      transfer.time = time_;
      transfer.difference = difference;
      transfer.is_higher = k + 1 == ellipses.size();
      fly(route, sign * ellipses[k].start_velocity, transfer);
      transfers.push_back(std::move(transfer));
    }
  }

 private:
  void fly(Route& route, const Eigen::Vector3d& start_velocity,
           RevolutionTransfer& transfer) const {
    std::vector<double> guess = first_;
    for (std::size_t i = 0; i < 3; ++i) {
      guess[3 + i] = start_velocity[static_cast<Eigen::Index>(i)];
    }
    route.keep_legs(0);
    try {
      const Underway there =
          route.fly_from_guess(from_, time_, wanted_, std::move(guess), transfer.plan);
      // Newton's method may have arrived at a trajectory with another number of revolutions.
      const double wanted = own_ + transfer.difference + angle_ / turn;
      const double found = turned_angle(problem_.system, state_sum(chief_, route.begun()),
                                        problem_.start_time, time_) /
                           turn;
      if (std::abs(found - wanted) > 0.5) {
        throw Error(ErrorKind::numerical,
                    fmt::format("from the ellipse of {:.2f} revolutions no way of as many was "
                                "found, but one of {:.2f}",
                                wanted, found));
      }
      // The linear flow about the chief does not apply to a trajectory so far from it.
      route.finish(there, transfer.plan, false);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      transfer.failure = error.what();
      transfer.plan = {};
    }
  }

  const ComputedProblem& problem_;
  std::vector<double> chief_;  ///< chief's state at the start
  Underway from_;
  double time_;
  std::vector<double> wanted_;  ///< deviation at the end
  std::vector<double> first_;   ///< states of the deputy: before the first impulse, and at the end
  std::vector<double> last_;
  Eigen::Vector3d sense_;  ///< angular momentum of the motion in the direction of increasing time
  double angle_;           ///< angle from the first position to the last, less than a revolution
  int own_;                ///< number of whole revolutions of a deputy that stays beside its chief
};

}  // namespace

OtherRevolutions other_revolutions(const Scene& scene, const ComputedProblem& problem,
                                   const CompanionFlow& flow, const ProgressCallback& progress) {
  const TransferSettings& settings = *scene.transfer;
  OtherRevolutions result;
  Route route(scene, problem, flow);
  const std::vector<double> angles = turned_angles(flow);
  for (std::size_t k = 0; k < settings.times.size(); ++k) {
    if (progress) {
      progress("revolutions", static_cast<double>(k) / static_cast<double>(settings.times.size()));
    }
    const double time = settings.times[k];
    try {
      const std::size_t before = flow.checkpoint_before(time);
      const double chief_angle =
          angles[before] + angle_between(flow.nominal(flow.times()[before]), flow.nominal(time));
      const TransfersOfTime transfers(problem, route, flow, time, chief_angle);
      for (const int difference : settings.revolutions) {
        transfers.add(route, difference, result.transfers);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      result.failure = error.what();
    }
  }
  for (std::size_t i = 0; i < result.transfers.size(); ++i) {
    const RevolutionTransfer& one = result.transfers[i];
    const std::string& problem_with = one.failure.empty() ? one.plan.forbidden : one.failure;
    if (!problem_with.empty()) {
      result.failure = problem_with;
      continue;
    }
    const bool is_less = !result.best || one.plan.total_change_m_s() <
                                             result.transfers[*result.best].plan.total_change_m_s();
    if (is_less) result.best = i;
  }
  if (result.best) {
    result.failure.clear();
  } else if (result.failure.empty()) {
    result.failure = "no ellipse makes so many revolutions in any of the transfer times";
  }
  return result;
}

}  // namespace hamjet
