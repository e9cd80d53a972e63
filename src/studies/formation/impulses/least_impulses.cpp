#include "least_impulses.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "hamjet/error.hpp"
#include "impulse_program.hpp"

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

bool add_change(const std::vector<ImpulseEffect>& effects, std::vector<Eigen::Vector3d>& impulses,
                const std::vector<double>& weights, const Vector6& change) {
  Matrix6 reach = Matrix6::Zero();
  for (std::size_t k = 0; k < effects.size(); ++k) {
    reach += weights[k] * effects[k] * effects[k].transpose();
  }
  // The matrix is scaled by its diagonal, so that the result does not depend on the unit of length.
  const Vector6 scale = reach.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return false;
  const Matrix6 scaled = scale.asDiagonal() * reach * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(scaled);
  const double smallest = solver.eigenvalues()[0];
  if (solver.info() != Eigen::Success || !(smallest > 1e-12)) return false;
  const Vector6 multiplier = scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * change);
  for (std::size_t k = 0; k < effects.size(); ++k) {
    impulses[k] += weights[k] * (effects[k].transpose() * multiplier);
  }
  return true;
}

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// An impulse counts as being at the limit if its relative distance from `most` is below this.
constexpr double nearness_to_limit = 1e-6;

double sum_of(const std::vector<ChosenImpulse>& impulses) {
  double sum = 0;
  for (const ChosenImpulse& one : impulses) sum += one.change.norm();
  return sum;
}

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
    // An impulse at the limit is only turned, which changes its length to second order.
    if (room > nearness_to_limit) weights[k] *= room;
  }
  return weights;
}

namespace {

/// The problem in coordinates in which the impulses of all times together reach equally far in all
/// directions.
struct EvenProblem {
  Matrix6 to_even;
  std::vector<ImpulseEffect> effects;
  double size = 0;  ///< size of the change in these coordinates
  Vector6 change;   ///< the change divided by its size

  EvenProblem(const std::vector<ImpulseEffect>& given, const Vector6& given_change) {
    Matrix6 reach = Matrix6::Zero();
    for (const ImpulseEffect& effect : given) reach += effect * effect.transpose();
    reach /= static_cast<double>(given.size());
    const Vector6 scale = reach.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6 scaled = scale.asDiagonal() * reach * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6> spread(scaled);
    if (!scale.allFinite() || spread.info() != Eigen::Success ||
        !(spread.eigenvalues()[0] > 1e-14)) {
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
    if (!change.allFinite()) {
      throw Error(ErrorKind::numerical, "impulses: the change that they are to make is not finite");
    }
  }

  std::vector<double> primer(const Vector6& costate) const {
    std::vector<double> magnitudes;
    for (const ImpulseEffect& effect : effects) {
      magnitudes.push_back((effect.transpose() * costate).norm());
    }
    return magnitudes;
  }

  /// A lower bound of the cost of all impulses, from any costate, divided by the size of the
  /// change.
  double bound(const Vector6& costate, double most) const {
    const std::vector<double> magnitudes = primer(costate);
    const double value = change.dot(costate);
    if (!std::isfinite(most)) {
      return value / *std::max_element(magnitudes.begin(), magnitudes.end());
    }
    double above = 0;
    for (const double magnitude : magnitudes) above += std::max(0.0, magnitude - 1);
    return value - most * above;
  }

  /// An upper bound, from any costate, of the fraction of the change that impulses below a limit
  /// can make.
  double share(const Vector6& costate, double most) const {
    const std::vector<double> magnitudes = primer(costate);
    const double value = change.dot(costate);
    return value > 0 ? most * std::accumulate(magnitudes.begin(), magnitudes.end(), 0.0) / value
                     : std::numeric_limits<double>::infinity();
  }

  /// The part of the change that the impulses leave.
  Vector6 missing(const std::vector<ChosenImpulse>& impulses) const {
    Vector6 left = change;
    for (const ChosenImpulse& one : impulses) left -= effects[one.time] * one.change;
    return left;
  }

  /// Lets the impulses make the whole change, apart from which the solver's tolerance leaves a
  /// rest. A few impulses may reach some directions only; the rest in other directions stays.
  void complete(std::vector<ChosenImpulse>& found, double most) const {
    std::vector<ImpulseEffect> used;
    std::vector<Eigen::Vector3d> impulses;
    std::vector<double> weights;
    for (ChosenImpulse& one : found) {
      if (one.change.norm() > most) one.change *= most / one.change.norm();
      used.push_back(effects[one.time]);
      impulses.push_back(one.change);
      weights.push_back(one.change.norm());
    }
    add_change(effects_below(used, impulses, most), impulses,
               weights_below(weights, impulses, most), missing(found));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double length = impulses[i].norm();
      found[i].change = impulses[i] * (length > most ? most / length : 1);
    }
  }
};

/// The wanted and the required distance of the cost from its bound, relative to the cost.
constexpr double wanted_gap = 1e-9;
constexpr double largest_gap = 1e-7;
constexpr double largest_residual = 1e-9;
constexpr int most_rounds = 400;

/// Whether impulses below the limit can make the change; if not, the least limit that they need, as
/// a fraction of the change's size.
std::optional<double> limit_needed(const EvenProblem& even, DirectedImpulses& program,
                                   double most) {
  double possible = no_limit;
  for (int round = 0; round < most_rounds; ++round) {
    if (program.solve_share() >= 1 - 1e-12) return std::nullopt;
    possible = std::min(possible, even.share(program.costate(), most));
    if (possible < 1) return most / possible;
    if (!program.add_directions()) break;
  }
  throw UnprovedLeast(
      "impulses: the solver's rounding hides whether impulses below the limit suffice");
}

LimitedImpulses found_impulses(const std::vector<ImpulseEffect>& effects, const Vector6& change,
                               double most) {
  if (change.isZero(0)) return {LeastImpulses(), 0};
  const EvenProblem even(effects, change);
  const double limit = most / even.size;
  DirectedImpulses program(even.effects, even.change, limit);
  if (const auto needed = limit_needed(even, program, limit)) {
    return {std::nullopt, even.size * *needed};
  }
  double bound = -no_limit;
  Vector6 costate = Vector6::Zero();
  std::vector<ChosenImpulse> found;
  for (int round = 0; round < most_rounds; ++round) {
    program.solve_sum();
    const Vector6 y = program.costate();
    if (const double proved = even.bound(y, limit); proved > bound) {
      bound = proved;
      costate = y;
    }
    found = program.impulses();
    if (sum_of(found) - bound <= wanted_gap * bound || !program.add_directions()) break;
  }
  even.complete(found, limit);
  if (!std::isfinite(most)) {
    const std::vector<double> primer = even.primer(costate);
    costate /= *std::max_element(primer.begin(), primer.end());
  }
  LeastImpulses least;
  for (const ChosenImpulse& one : found) {
    least.impulses.push_back({one.time, even.size * one.change});
  }
  least.cost = sum_of(least.impulses);
  // Apart from rounding, the bound is below every cost.
  least.lower_bound = std::min(even.size * bound, least.cost);
  least.costate = even.to_even.transpose() * costate;
  require_least(effects, change, most, least);
  return {std::move(least), 0};
}

}  // namespace

void require_least(const std::vector<ImpulseEffect>& effects, const Vector6& change, double most,
                   const LeastImpulses& least) {
  const EvenProblem even(effects, change);
  std::vector<ChosenImpulse> impulses = least.impulses;
  double largest = 0;
  for (ChosenImpulse& one : impulses) {
    largest = std::max(largest, one.change.norm());
    one.change /= even.size;
  }
  const double residual = even.missing(impulses).norm();
  if (!(residual <= largest_residual)) {
    throw UnprovedLeast(
        fmt::format("impulses: those that were found leave {:.2g} of the change", residual));
  }
  if (!(largest <= most * (1 + 1e-12))) {
    throw UnprovedLeast("impulses: one that was found is above the limit");
  }
  const Vector6 costate = even.to_even.transpose().partialPivLu().solve(least.costate);
  // Without a limit a costate proves the same at any scale, but only one scale gives the primer
  // vector.
  const double bound = std::min(even.bound(costate, most / even.size), even.change.dot(costate));
  const double cost = sum_of(impulses);
  const bool is_told = std::abs(least.cost / even.size - cost) <= 1e-12 * cost &&
                       least.lower_bound / even.size <= bound * (1 + 1e-8);
  if (!is_told || !(cost - bound <= largest_gap * cost)) {
    throw UnprovedLeast(
        fmt::format("impulses: those that were found are proved to be the least to {:.2g} "
                    "of their sum only",
                    (cost - bound) / cost));
  }
}

LeastImpulses least_impulses(const std::vector<ImpulseEffect>& effects, const Vector6& change) {
  return *found_impulses(effects, change, no_limit).least;
}

LimitedImpulses least_impulses(const std::vector<ImpulseEffect>& effects, const Vector6& change,
                               double most) {
  return found_impulses(effects, change, most);
}

}  // namespace hamjet
