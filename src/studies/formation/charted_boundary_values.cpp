#include "charted_boundary_values.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

Eigen::Vector3d final_position(const SixNumbers<double>& z) { return {z[0], z[1], z[2]}; }
Eigen::Vector3d momentum_part(const SixNumbers<double>& z) { return {z[3], z[4], z[5]}; }

double distance_of(const SixNumbers<double>& z) { return final_position(z).norm(); }

}  // namespace

Eigen::Matrix3d commanded_positions(DeputyPredictor& predictor, const SixNumbers<double>& deviation,
                                    int degree) {
  // In units of the chief's own speed; the cube of the machine's precision balances rounding
  // against the third derivative.
  const double step = std::cbrt(std::numeric_limits<double>::epsilon()) *
                      momentum_part(predictor.flow().chief_end()).norm();
  std::array<SixNumbers<double>, 6> moved;
  std::array<DeputyPrediction, 6> predicted;
  for (std::size_t i = 0; i < 6; ++i) {
    moved[i] = deviation;
    moved[i][3 + i / 2] += i % 2 == 0 ? step : -step;
  }
  predictor.predict(moved, degree, predicted);
  Eigen::Matrix3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.col(static_cast<Eigen::Index>(i)) = (final_position(predicted[2 * i].deviation) -
                                                final_position(predicted[2 * i + 1].deviation)) /
                                               (2 * step);
  }
  return result;
}

BoundaryMomenta ChartedBoundaryValues::solve(std::span<const double> first,
                                             std::span<const double> last, int degree,
                                             std::span<const double> guess) {
  constexpr int most_iterations = 60;
  constexpr double least_part = 1e-3;  // of a step of Newton's method
  constexpr double least_gain = 0.25;  // of the miss, that is left by a matrix that is kept
  const Eigen::Vector3d wanted(last[0], last[1], last[2]);
  const SixNumbers<double>& chief = predictor_.flow().chief_end();
  const double chief_distance = distance_of(chief);
  const double chief_momentum = momentum_part(chief).norm();
  SixNumbers<double> start = {first[0], first[1], first[2], guess[0], guess[1], guess[2]};
  const auto predict = [&](const SixNumbers<double>& from) {
    ++predictions_;
    return predictor_.predict(from, degree).deviation;
  };
  SixNumbers<double> end = predict(start);
  Eigen::Vector3d miss = final_position(end) - wanted;
  double rounding = 0;
  bool is_fresh = false;  // whether the matrix is that of this start
  for (int i = 0; i < most_iterations && std::isfinite(miss.norm()); ++i) {
    if (!commanded_ || !commanded_->allFinite()) {
      commanded_ = commanded_positions(predictor_, start, degree);
      ++predictions_;
      is_fresh = true;
    }
    // A start that is rounded moves the end by as much times the growth on the way.
    rounding = 64 * std::numeric_limits<double>::epsilon() *
               (chief_distance + commanded_->norm() * chief_momentum);
    if (miss.norm() <= rounding) break;
    const Eigen::Vector3d step = commanded_->partialPivLu().solve(miss);
    double part = 1;
    bool is_nearer = false;
    bool is_slow = false;
    for (; part >= least_part && !is_nearer && !is_slow; part /= 2) {
      SixNumbers<double> next = start;
      for (std::size_t k = 0; k < 3; ++k) next[3 + k] -= part * step[static_cast<Eigen::Index>(k)];
      const SixNumbers<double> reached = predict(next);
      const Eigen::Vector3d left = final_position(reached) - wanted;
      is_nearer = left.norm() < miss.norm();
      is_slow = !is_fresh && !(left.norm() <= least_gain * miss.norm()) && left.norm() > rounding;
      if (!is_nearer) continue;
      const Eigen::Vector3d moved = -part * step;
      *commanded_ += (left - miss - *commanded_ * moved) * moved.transpose() / moved.squaredNorm();
      start = next;
      end = reached;
      miss = left;
    }
    if (is_slow || (!is_nearer && !is_fresh)) {
      commanded_.reset();
    } else if (!is_nearer) {
      // Where no step comes nearer, there is no solution, or rounding is all that is left.
      break;
    }
    is_fresh = false;
  }
  if (!(miss.norm() <= rounding)) {
    commanded_.reset();
    throw Error(ErrorKind::numerical,
                fmt::format("the polynomials of order {} lead to no such place from here", degree));
  }
  return {{start.begin() + 3, start.end()}, {end.begin() + 3, end.end()}};
}

}  // namespace hamjet
