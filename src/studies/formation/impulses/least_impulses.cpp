#include "least_impulses.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hamjet/error.hpp"
#include "impulse_barriers.hpp"

namespace hamjet {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Leaves of the impulses so many that none is a combination of the others: along each combination
/// that changes nothing, to the side where the sum of the magnitudes does not grow, until one is 0.
/// (Caratheodory's theorem.) One that becomes `most` before that is moved to `full`.
void leave_out_combinations(const std::vector<ImpulseEffect>& effects,
                            std::vector<ChosenImpulse>& impulses, double most,
                            std::vector<ChosenImpulse>& full) {
  while (impulses.size() > 1) {
    const auto count = static_cast<Eigen::Index>(impulses.size());
    Eigen::MatrixXd unit_effects(6, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const ChosenImpulse& impulse = impulses[static_cast<std::size_t>(k)];
      unit_effects.col(k) = effects[impulse.time] * impulse.change.normalized();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> decomposition(unit_effects, Eigen::ComputeFullV);
    const Eigen::VectorXd& values = decomposition.singularValues();
    const bool is_independent = count <= 6 && values[count - 1] > 1e-9 * values[0];
    if (is_independent) return;
    Eigen::VectorXd combination = decomposition.matrixV().col(count - 1);
    if (combination.sum() > 0) combination = -combination;
    double length = std::numeric_limits<double>::infinity();
    Eigen::Index first = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      const double size = impulses[static_cast<std::size_t>(k)].change.norm();
      const double until =
          combination[k] < 0 ? size / -combination[k] : (most - size) / combination[k];
      if (until < length) {
        length = until;
        first = k;
      }
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      Eigen::Vector3d& change = impulses[static_cast<std::size_t>(k)].change;
      change += change.normalized() * (length * combination[k]);
    }
    if (combination[first] > 0) full.push_back(impulses[static_cast<std::size_t>(first)]);
    impulses.erase(impulses.begin() + first);
  }
}

}  // namespace

bool add_change(const std::vector<ImpulseEffect>& effects, std::vector<Eigen::Vector3d>& impulses,
                const std::vector<double>& weights, const Vector6& change) {
  Matrix6 reach = Matrix6::Zero();
  for (std::size_t k = 0; k < effects.size(); ++k) {
    reach += weights[k] * effects[k] * effects[k].transpose();
  }
  // In units of its diagonal, so that the unit of length does not decide.
  const Vector6 scale = reach.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return false;
  const Matrix6 scaled = scale.asDiagonal() * reach * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled);
  const double smallest = solver.eigenvalues()[0];
  if (!(smallest > 1e-12)) return false;
  const Vector6 multiplier = scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * change);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    impulses[k] += weights[k] * (effects[k].transpose() * multiplier);
  }
  return true;
}

namespace {

/// The problem in coordinates in which impulses of all times together reach equally far in all
/// directions.
struct EvenProblem {
  Matrix6 to_even;
  std::vector<ImpulseEffect> effects;
  double size = 0;  ///< of the change there
  Vector6 change;   ///< over its size

  EvenProblem(const std::vector<ImpulseEffect>& given, const Vector6& given_change) {
    Matrix6 reach = Matrix6::Zero();
    for (const ImpulseEffect& effect : given) reach += effect * effect.transpose();
    reach /= static_cast<double>(given.size());
    const Vector6 scale = reach.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6 scaled = scale.asDiagonal() * reach * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6> spread(scaled);
    if (!scale.allFinite() || !(spread.eigenvalues()[0] > 1e-14)) {
      throw Error(ErrorKind::numerical,
                  "impulses: at these times they do not reach every deviation; a longer transfer "
                  "time is needed");
    }
    to_even = spread.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal() *
              spread.eigenvectors().transpose() * scale.asDiagonal();
    effects.reserve(given.size());
    for (const ImpulseEffect& effect : given) effects.emplace_back(to_even * effect);
    size = (to_even * given_change).norm();
    change = to_even * given_change / size;
  }

  /// Lets the impulses, few of them, make the whole change, which the barrier leaves to a small
  /// part. Few may reach some directions only; what is then missing is left.
  void complete(std::vector<ChosenImpulse>& found, double most) const {
    std::sort(found.begin(), found.end(),
              [](const ChosenImpulse& a, const ChosenImpulse& b) { return a.time < b.time; });
    std::vector<ImpulseEffect> used;
    std::vector<Eigen::Vector3d> impulses;
    for (const ChosenImpulse& one : found) {
      used.push_back(effects[one.time]);
      impulses.push_back(one.change);
    }
    // One that is turned at the limit grows by a second order, which a further round makes up for.
    for (int round = 0; round < (std::isfinite(most) ? 3 : 1); ++round) {
      std::vector<double> weights;
      Vector6 missing = change;
      for (std::size_t i = 0; i < used.size(); ++i) {
        if (impulses[i].norm() > most) impulses[i] *= most / impulses[i].norm();
        weights.push_back(impulses[i].norm());
        missing -= used[i] * impulses[i];
      }
      add_change(effects_below(used, impulses, most), impulses,
                 weights_below(weights, impulses, most), missing);
    }
    for (std::size_t i = 0; i < found.size(); ++i) found[i].change = impulses[i];
  }
};

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Relative to `most`, impulses this near to it are at it.
constexpr double nearness_to_limit = 1e-6;

}  // namespace

std::vector<ImpulseEffect> effects_below(const std::vector<ImpulseEffect>& effects,
                                         const std::vector<Eigen::Vector3d>& impulses,
                                         double most) {
  std::vector<ImpulseEffect> below = effects;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    if (impulses[k].norm() < most * (1 - nearness_to_limit)) continue;
    const Eigen::Vector3d direction = impulses[k].normalized();
    below[k] -= effects[k] * direction * direction.transpose();
  }
  return below;
}

std::vector<double> weights_below(std::vector<double> weights,
                                  const std::vector<Eigen::Vector3d>& impulses, double most) {
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double room = 1 - impulses[k].norm() / most;
    // One at the limit is turned, which makes it longer by a second order alone.
    if (room > nearness_to_limit) weights[k] *= room;
  }
  return weights;
}

LeastImpulses least_impulses(const std::vector<ImpulseEffect>& effects, const Vector6& change) {
  LeastImpulses least;
  if (change.isZero(0)) return least;
  const EvenProblem even(effects, change);

  // On the barrier's path the costs of both problems differ by less than mu times the number of
  // times; the last mu leaves a relative gap of 1e-9.
  const auto count = static_cast<double>(effects.size());
  const BarrierProblem problem(even.effects, even.change);
  Vector6 y = Vector6::Zero();
  double mu = 1 / count;
  problem.climb(y, mu);
  while (mu * count > 1e-9 * even.change.dot(y)) {
    mu /= 8;
    problem.climb(y, mu);
  }
  double largest_primer = 0;
  std::vector<ChosenImpulse> found;
  double sum = 0;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const Eigen::Vector3d primer = even.effects[k].transpose() * y;
    largest_primer = std::max(largest_primer, primer.norm());
    found.push_back({k, 2 * mu / (1 - primer.squaredNorm()) * primer});
    sum += found.back().change.norm();
  }
  std::erase_if(found, [&](const ChosenImpulse& one) { return !(one.change.norm() > 1e-6 * sum); });
  std::vector<ChosenImpulse> full;
  leave_out_combinations(even.effects, found, no_limit, full);
  even.complete(found, no_limit);
  for (const ChosenImpulse& one : found) {
    least.impulses.push_back({one.time, even.size * one.change});
    least.cost += least.impulses.back().change.norm();
  }
  // The dual value is below every cost but for rounding.
  least.lower_bound = std::min(even.size * even.change.dot(y) / largest_primer, least.cost);
  least.costate = even.to_even.transpose() * y / largest_primer;
  return least;
}

std::optional<LeastImpulses> least_impulses(const std::vector<ImpulseEffect>& effects,
                                            const Vector6& change, double most) {
  LeastImpulses least;
  if (change.isZero(0)) return least;
  const EvenProblem even(effects, change);
  const double limit = most / even.size;
  const auto count = static_cast<double>(effects.size());
  LimitedBarrierProblem problem(even.effects, even.change, limit);
  // Each time has three barriers: the cone's counts twice. Beyond this gap rounding leaves the
  // path: impulses are quotients of mu and the room that is left.
  constexpr double gap = 3e-8;
  double mu = limit / 2;
  problem.climb(mu);
  while (problem.without_barrier() <= problem.greatest_cost() &&
         3 * mu * count > gap * problem.without_barrier()) {
    mu /= 8;
    problem.climb(mu);
  }
  if (problem.without_barrier() > problem.greatest_cost()) return std::nullopt;
  std::vector<ChosenImpulse> found;
  std::vector<ChosenImpulse> full;
  double sum = 0;
  double bound = even.change.dot(problem.costate());
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const Eigen::Vector3d impulse = problem.impulse(k, mu);
    const bool is_full = impulse.norm() > limit * (1 - nearness_to_limit);
    if (is_full) full.push_back({k, limit * impulse.normalized()});
    if (!is_full) found.push_back({k, impulse});
    sum += impulse.norm();
    bound -= limit * std::max(0.0, (even.effects[k].transpose() * problem.costate()).norm() - 1);
  }
  std::erase_if(found, [&](const ChosenImpulse& one) { return !(one.change.norm() > 1e-6 * sum); });
  leave_out_combinations(even.effects, found, limit, full);
  found.insert(found.end(), full.begin(), full.end());
  even.complete(found, limit);
  for (const ChosenImpulse& one : found) {
    least.impulses.push_back({one.time, even.size * one.change});
    least.cost += least.impulses.back().change.norm();
  }
  least.lower_bound = std::min(even.size * bound, least.cost);
  least.costate = even.to_even.transpose() * problem.costate();
  return least;
}

}  // namespace hamjet
