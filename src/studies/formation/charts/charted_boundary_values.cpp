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
  // The step is in units of the chief's own speed. The cube root of the machine's precision
  // balances rounding against the third derivative.
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
  constexpr double least_part = 1e-3;  // least fraction of a step of Newton's method
  constexpr double least_gain = 0.25;  // largest fraction of the miss that a kept matrix may leave
  const Eigen::Vector3d wanted(last[0], last[1], last[2]);
  const SixNumbers<double>& chief = predictor_.flow().chief_end();
  const double chief_distance = distance_of(chief);
  const double chief_momentum = momentum_part(chief).norm();
  struct Trial {
    SixNumbers<double> start;
    SixNumbers<double> end;
    Eigen::Vector3d miss;
  };
  const auto tried = [&](const SixNumbers<double>& start) -> Trial {
    const SixNumbers<double> end = predictor_.predict(start, degree).deviation;
    return {start, end, final_position(end) - wanted};
  };
  const auto moved = [](SixNumbers<double> start, const Eigen::Vector3d& by) {
    for (std::size_t k = 0; k < 3; ++k) start[3 + k] += by[static_cast<Eigen::Index>(k)];
    return start;
  };
  Trial best = tried({first[0], first[1], first[2], guess[0], guess[1], guess[2]});
  double rounding = 0;
  bool is_fresh = false;  // whether the matrix was made at this start
  for (int i = 0; i < most_iterations && std::isfinite(best.miss.norm()); ++i) {
    if (!commanded_ || !commanded_->allFinite()) {
      commanded_ = commanded_positions(predictor_, best.start, degree);
      is_fresh = true;
    }
    // Rounding of the start moves the end by as much, times the growth on the way.
    rounding = 64 * std::numeric_limits<double>::epsilon() *
               (chief_distance + commanded_->norm() * chief_momentum);
    const Eigen::Vector3d step = -commanded_->partialPivLu().solve(best.miss);
    if (best.miss.norm() <= rounding) {
      // With a kept matrix the miss is only just below the bound: one more step leaves rounding
      // alone.
      const Trial next = tried(moved(best.start, step));
      if (next.miss.norm() < best.miss.norm()) best = next;
      break;
    }
    bool is_nearer = false;
    bool is_slow = false;
    for (double part = 1; part >= least_part && !is_nearer && !is_slow; part /= 2) {
      const Eigen::Vector3d change = part * step;
      const Trial next = tried(moved(best.start, change));
      is_nearer = next.miss.norm() < best.miss.norm();
      is_slow = !is_fresh && !(next.miss.norm() <= least_gain * best.miss.norm()) &&
                next.miss.norm() > rounding;
      if (!is_nearer) continue;
      *commanded_ += (next.miss - best.miss - *commanded_ * change) * change.transpose() /
                     change.squaredNorm();
      best = next;
    }
    if (is_slow || (!is_nearer && !is_fresh)) {
      commanded_.reset();
    } else if (!is_nearer) {
      // If no step comes nearer, there is no solution, or only rounding is left.
      break;
    }
    is_fresh = false;
  }
  if (!(best.miss.norm() <= rounding)) {
    commanded_.reset();
    throw Error(ErrorKind::numerical,
                fmt::format("the polynomials of order {} lead to no such place from here", degree));
  }
  return {{best.start.begin() + 3, best.start.end()}, {best.end.begin() + 3, best.end.end()}};
}

}  // namespace hamjet
