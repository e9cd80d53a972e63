#include "least_impulses.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The dual problem with a logarithmic barrier: largest
///
///   change . y + mu sum_k log(1 - |B_k^T y|^2) .
class BarrierProblem {
 public:
  BarrierProblem(const std::vector<ImpulseEffect>& effects, const Vector6& change)
      : effects_(effects), change_(change) {}

  /// Minus infinity outside of the domain.
  double value(const Vector6& y, double mu) const {
    double logarithms = 0;
    for (const ImpulseEffect& effect : effects_) {
      const double room = 1 - (effect.transpose() * y).squaredNorm();
      if (!(room > 0)) return -std::numeric_limits<double>::infinity();
      logarithms += std::log(room);
    }
    return change_.dot(y) + mu * logarithms;
  }

  /// Newton's method with backtracking until the step promises no more than rounding.
  void climb(Vector6& y, double mu) const {
    constexpr int most_steps = 60;
    double here = value(y, mu);
    for (int step = 0; step < most_steps; ++step) {
      Vector6 slope = change_;
      Matrix6 curvature = Matrix6::Zero();  // of the negative
      for (const ImpulseEffect& effect : effects_) {
        const Eigen::Vector3d primer = effect.transpose() * y;
        const double weight = 2 * mu / (1 - primer.squaredNorm());
        const Vector6 effect_on = effect * primer;
        slope -= weight * effect_on;
        curvature.noalias() += weight * effect * effect.transpose();
        curvature.noalias() += weight * weight / mu * effect_on * effect_on.transpose();
      }
      const Vector6 direction = curvature.llt().solve(slope);
      const double promised = slope.dot(direction);
      if (!(promised > 1e-12 * mu)) return;
      double length = 1;
      while (length > 1e-10) {
        const double there = value(y + length * direction, mu);
        if (there >= here + 0.1 * length * promised) {
          y += length * direction;
          here = there;
          break;
        }
        length /= 2;
      }
      if (length <= 1e-10) return;
    }
  }

 private:
  const std::vector<ImpulseEffect>& effects_;
  const Vector6& change_;
};

/// Leaves of the impulses so many that none is a combination of the others: along each combination
/// that changes nothing, to the side where the sum of the magnitudes does not grow, until one is 0.
/// (Caratheodory's theorem.)
void leave_out_combinations(const std::vector<ImpulseEffect>& effects,
                            std::vector<ChosenImpulse>& impulses) {
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
    Eigen::Index first_zero = 0;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (combination[k] >= 0) continue;
      const double until = impulses[static_cast<std::size_t>(k)].change.norm() / -combination[k];
      if (until < length) {
        length = until;
        first_zero = k;
      }
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      Eigen::Vector3d& change = impulses[static_cast<std::size_t>(k)].change;
      change += change.normalized() * (length * combination[k]);
    }
    impulses.erase(impulses.begin() + first_zero);
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

LeastImpulses least_impulses(const std::vector<ImpulseEffect>& effects, const Vector6& change) {
  LeastImpulses least;
  if (change.isZero(0)) return least;
  // Coordinates in which impulses of all times together reach equally far in all directions.
  Matrix6 reach = Matrix6::Zero();
  for (const ImpulseEffect& effect : effects) reach += effect * effect.transpose();
  reach /= static_cast<double>(effects.size());
  const Vector6 scale = reach.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 scaled = scale.asDiagonal() * reach * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> spread(scaled);
  if (!scale.allFinite() || !(spread.eigenvalues()[0] > 1e-14)) {
    throw Error(ErrorKind::numerical,
                "impulses: at these times they do not reach every deviation; a longer transfer "
                "time is needed");
  }
  const Matrix6 to_even = spread.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal() *
                          spread.eigenvectors().transpose() * scale.asDiagonal();
  std::vector<ImpulseEffect> even_effects;
  even_effects.reserve(effects.size());
  for (const ImpulseEffect& effect : effects) even_effects.emplace_back(to_even * effect);
  const double size = (to_even * change).norm();
  const Vector6 even_change = to_even * change / size;

  // On the barrier's path the costs of both problems differ by less than mu times the number of
  // times; the last mu leaves a relative gap of 1e-9.
  const auto count = static_cast<double>(effects.size());
  const BarrierProblem problem(even_effects, even_change);
  Vector6 y = Vector6::Zero();
  double mu = 1 / count;
  problem.climb(y, mu);
  while (mu * count > 1e-9 * even_change.dot(y)) {
    mu /= 8;
    problem.climb(y, mu);
  }
  double largest_primer = 0;
  std::vector<ChosenImpulse> found;
  double sum = 0;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const Eigen::Vector3d primer = even_effects[k].transpose() * y;
    largest_primer = std::max(largest_primer, primer.norm());
    found.push_back({k, 2 * mu / (1 - primer.squaredNorm()) * primer});
    sum += found.back().change.norm();
  }
  std::erase_if(found, [&](const ChosenImpulse& one) { return !(one.change.norm() > 1e-6 * sum); });
  leave_out_combinations(even_effects, found);

  std::vector<ImpulseEffect> used;
  std::vector<Eigen::Vector3d> impulses;
  std::vector<double> weights;
  Vector6 missing = even_change;
  for (const ChosenImpulse& one : found) {
    used.push_back(even_effects[one.time]);
    impulses.push_back(one.change);
    weights.push_back(one.change.norm());
    missing -= used.back() * one.change;
  }
  // Few impulses may reach some directions only; what the barrier leaves is then left.
  add_change(used, impulses, weights, missing);
  for (std::size_t i = 0; i < found.size(); ++i) {
    least.impulses.push_back({found[i].time, size * impulses[i]});
    least.cost += least.impulses.back().change.norm();
  }
  // The dual value is below every cost but for rounding.
  least.lower_bound = std::min(size * even_change.dot(y) / largest_primer, least.cost);
  least.costate = to_even.transpose() * y / largest_primer;
  return least;
}

}  // namespace hamjet
