#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "least_impulses.hpp"

// The dual problems of least impulses with logarithmic barriers, climbed by Newton's method (Boyd
// and Vandenberghe, Convex Optimization, chapter 11).

namespace hamjet {

/// The dual problem with a logarithmic barrier: largest
///
///   change . y + mu sum_k log(1 - |B_k^T y|^2) .
class BarrierProblem {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

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

/// The dual problem with a limit of the impulses and a logarithmic barrier: with p_k = B_k^T y,
/// largest
///
///   change . y - most sum_k s_k + mu sum_k (log((1 + s_k)^2 - |p_k|^2) + log s_k) .
class LimitedBarrierProblem {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

 public:
  LimitedBarrierProblem(const std::vector<ImpulseEffect>& effects, const Vector6& change,
                        double most)
      : effects_(effects), change_(change), most_(most), excess_(effects.size(), 1) {}

  const Vector6& costate() const { return y_; }
  double without_barrier() const { return objective(y_, excess_); }
  /// No impulses cost more than this, but for rounding.
  double greatest_cost() const { return most_ * static_cast<double>(effects_.size()) * (1 + 1e-9); }

  /// The impulses whose sum is the change on the barrier's path.
  Eigen::Vector3d impulse(std::size_t k, double mu) const {
    const Eigen::Vector3d primer = effects_[k].transpose() * y_;
    return 2 * mu / room(primer, excess_[k]) * primer;
  }

  /// Newton's method with backtracking until the step promises no more than rounding, or the value
  /// is above every cost.
  void climb(double mu) {
    constexpr int most_steps = 80;
    double here = value(y_, excess_, mu);
    for (int step = 0; step < most_steps && without_barrier() <= greatest_cost(); ++step) {
      std::vector<double> turn(excess_.size());
      const auto [direction, promised] = newton(mu, turn);
      if (!(promised > 1e-12 * mu)) return;
      double length = 1;
      while (length > 1e-10) {
        const Vector6 y = y_ + length * direction;
        std::vector<double> excess = excess_;
        for (std::size_t k = 0; k < excess.size(); ++k) excess[k] += length * turn[k];
        const double there = value(y, excess, mu);
        if (there >= here + 0.1 * length * promised) {
          y_ = y;
          excess_ = std::move(excess);
          here = there;
          break;
        }
        length /= 2;
      }
      if (length <= 1e-10) return;
    }
  }

 private:
  static double room(const Eigen::Vector3d& primer, double excess) {
    // (1 + s)^2 - |p|^2 without cancellation.
    const double size = primer.norm();
    return (1 + excess - size) * (1 + excess + size);
  }

  double objective(const Vector6& y, const std::vector<double>& excess) const {
    return change_.dot(y) - most_ * std::accumulate(excess.begin(), excess.end(), 0.0);
  }

  /// Minus infinity outside of the domain.
  double value(const Vector6& y, const std::vector<double>& excess, double mu) const {
    double logarithms = 0;
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      const double size = (effects_[k].transpose() * y).norm();
      const double above = 1 + excess[k] - size;
      if (!(above > 0) || !(excess[k] > 0)) return -std::numeric_limits<double>::infinity();
      logarithms += std::log(above) + std::log(1 + excess[k] + size) + std::log(excess[k]);
    }
    return objective(y, excess) + mu * logarithms;
  }

  /// Newton's step in y, with that of the excesses in `turn`, each of which one equation gives; and
  /// what it promises.
  std::pair<Vector6, double> newton(double mu, std::vector<double>& turn) const {
    Vector6 slope = change_;
    Vector6 reduced_slope = Vector6::Zero();
    Matrix6 curvature = Matrix6::Zero();  // of the negative, the excesses eliminated
    std::vector<Eigen::Vector3d> mixed(turn.size());
    std::vector<double> own(turn.size());
    for (std::size_t k = 0; k < turn.size(); ++k) {
      const Eigen::Vector3d primer = effects_[k].transpose() * y_;
      const double above = 1 + excess_[k];
      const double left = room(primer, excess_[k]);
      const double weight = 2 * mu / left;
      slope -= weight * (effects_[k] * primer);
      turn[k] = -most_ + weight * above + mu / excess_[k];
      mixed[k] = -2 * weight * above / left * primer;
      // 4 (1 + s)^2 / D^2 - 2 / D = 2 ((1 + s)^2 + |p|^2) / D^2
      own[k] =
          weight * (above * above + primer.squaredNorm()) / left + mu / (excess_[k] * excess_[k]);
      Eigen::Matrix3d inner = weight * Eigen::Matrix3d::Identity();
      inner += 2 * weight / left * primer * primer.transpose();
      inner -= mixed[k] * mixed[k].transpose() / own[k];
      curvature.noalias() += effects_[k] * inner * effects_[k].transpose();
      reduced_slope -= effects_[k] * mixed[k] * (turn[k] / own[k]);
    }
    reduced_slope += slope;
    const Vector6 direction = curvature.llt().solve(reduced_slope);
    double promised = slope.dot(direction);
    for (std::size_t k = 0; k < turn.size(); ++k) {
      const double of_excess = turn[k];
      turn[k] = (turn[k] - mixed[k].dot(effects_[k].transpose() * direction)) / own[k];
      promised += of_excess * turn[k];
    }
    return {direction, promised};
  }

  const std::vector<ImpulseEffect>& effects_;
  const Vector6& change_;
  double most_;
  Vector6 y_ = Vector6::Zero();
  std::vector<double> excess_;
};

}  // namespace hamjet
