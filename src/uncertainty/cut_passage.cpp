#include "cut_passage.hpp"

#include <algorithm>
#include <cmath>

#include "encounter_trajectories.hpp"

namespace hamjet {
namespace {

/// A time is in a passage if it is within this many standard deviations along the relative
/// velocity; what lies outside has a probability of 6e-7.
constexpr double within = 5;
/// An encounter that takes longer than this fraction of a local period does not count as a passage.
constexpr double longest_part = 1.0 / 8;

struct Interval {
  double from;
  double to;
};

std::optional<Interval> passage_at(const EncounterTrajectories& linear, double radius,
                                   double time) {
  const LinearRelativeState state = linear.linear(time);
  const Eigen::Vector3d position = state.mean.head<3>();
  const Eigen::Vector3d velocity = state.mean.tail<3>();
  const double speed = velocity.norm();
  const auto spread = state.by_deviation.topRows(3);
  const double along = (velocity.transpose() / speed * spread).norm();
  const double ahead = -position.dot(velocity) / (speed * speed);
  const double half = (radius + farthest_deviation * along) / speed;
  const double miss = (position + ahead * velocity).norm();
  const double period = std::min(linear.local_period(0, time), linear.local_period(1, time));
  if (!(std::abs(ahead) < (radius + within * along) / speed) ||
      !(std::abs(ahead) + half < longest_part * period) ||
      !(miss < radius + farthest_deviation * spread.norm())) {
    return std::nullopt;
  }
  return Interval{time + ahead - half, time + ahead + half};
}

}  // namespace

std::optional<EncounterProblem> with_whole_passages(const EncounterProblem& problem) {
  validate(problem);
  EncounterProblem first_order = problem;
  first_order.order = 1;
  const EncounterTrajectories linear(first_order);
  EncounterProblem whole = problem;
  for (const double edge : {problem.from, problem.to}) {
    if (const auto passage = passage_at(linear, problem.radius, edge)) {
      whole.from = std::min(whole.from, passage->from);
      whole.to = std::max(whole.to, passage->to);
    }
  }
  if (whole.from == problem.from && whole.to == problem.to) return std::nullopt;
  return whole;
}

}  // namespace hamjet
