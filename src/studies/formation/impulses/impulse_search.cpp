#include "impulse_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix6 symplectic_inverse(const Matrix6& flow) {
  Matrix6 inverse;
  inverse.topLeftCorner<3, 3>() = flow.bottomRightCorner<3, 3>().transpose();
  inverse.topRightCorner<3, 3>() = -flow.topRightCorner<3, 3>().transpose();
  inverse.bottomLeftCorner<3, 3>() = -flow.bottomLeftCorner<3, 3>().transpose();
  inverse.bottomRightCorner<3, 3>() = flow.topLeftCorner<3, 3>().transpose();
  return inverse;
}

ImpulseEffect effect_of(const Matrix6& flow) { return symplectic_inverse(flow).rightCols<3>(); }

void ImpulseGrid::add(double time, const Matrix6& flow) {
  times.push_back(time);
  effects.push_back(effect_of(flow));
}

ImpulseGrid impulse_grid(const LinearFlow& flow, double time) {
  constexpr std::size_t every = 5;
  constexpr std::size_t most = 4000;
  const std::size_t last = flow.checkpoint_before(time);
  const std::size_t stride = std::max(every, last / most + 1);
  ImpulseGrid grid;
  for (std::size_t k = 0; k <= last && std::abs(flow.times()[k]) < std::abs(time); k += stride) {
    grid.add(flow.times()[k], flow.checkpoint(k));
  }
  grid.add(time, flow.at(time));
  return grid;
}

ImpulseGrid impulse_grid(const LinearFlow& flow, double first, double last) {
  const ImpulseGrid whole = impulse_grid(flow, last);
  ImpulseGrid grid;
  grid.add(first, flow.at(first));
  for (std::size_t k = 0; k < whole.times.size(); ++k) {
    if (std::abs(whole.times[k]) <= std::abs(first)) continue;
    grid.times.push_back(whole.times[k]);
    grid.effects.push_back(whole.effects[k]);
  }
  return grid;
}

std::vector<double> some_times(const std::vector<double>& times, std::size_t most) {
  const std::size_t count = std::min(most, times.size());
  std::vector<double> some;
  for (std::size_t k = 1; k <= count; ++k) some.push_back(times[times.size() * k / count - 1]);
  return some;
}

std::vector<PrimerMagnitude> primer_along(const ImpulseGrid& grid, const Vector6& costate) {
  std::vector<PrimerMagnitude> primer;
  for (std::size_t k = 0; k < grid.times.size(); ++k) {
    primer.push_back({grid.times[k], (grid.effects[k].transpose() * costate).norm()});
  }
  return primer;
}

namespace {

/// The grid with finer times added about those at which the primer has a local maximum close to 1.
ImpulseGrid refined(const MatrixAt& at, const ImpulseGrid& grid, const LeastImpulses& least,
                    double nearness) {
  constexpr std::size_t most_maxima = 64;
  constexpr int parts = 7;
  const std::size_t last = grid.times.size() - 1;
  const std::vector<PrimerMagnitude> primer = primer_along(grid, least.costate);
  std::vector<std::size_t> maxima;
  for (const ChosenImpulse& impulse : least.impulses) maxima.push_back(impulse.time);
  for (std::size_t k = 1; k < last && maxima.size() < most_maxima; ++k) {
    const double here = primer[k].magnitude;
    const bool is_maximum = here > primer[k - 1].magnitude && here >= primer[k + 1].magnitude;
    if (is_maximum && here >= 1 - nearness) maxima.push_back(k);
  }
  std::set<std::size_t> gaps;
  for (const std::size_t k : maxima) {
    if (k > 0) gaps.insert(k - 1);
    if (k < last) gaps.insert(k);
  }
  ImpulseGrid finer;
  for (std::size_t k = 0; k <= last; ++k) {
    finer.times.push_back(grid.times[k]);
    finer.effects.push_back(grid.effects[k]);
    if (!gaps.contains(k)) continue;
    for (int i = 1; i < parts; ++i) {
      const double time = grid.times[k] + (grid.times[k + 1] - grid.times[k]) * i / parts;
      finer.add(time, at(time));
    }
  }
  return finer;
}

}  // namespace

ImpulseOptimum search_impulses(const ImpulseGrid& coarse, const MatrixAt& at,
                               const Vector6& change) {
  ImpulseOptimum optimum{coarse, least_impulses(coarse.effects, change), {}};
  // Between the times of a grid the primer may exceed 1, and an impulse there would cost less by
  // this excess: 1e-3 for the coarse grid, 1e-8 for the finest.
  for (const double nearness : {1e-2, 2e-4, 4e-6}) {
    optimum.grid = refined(at, optimum.grid, optimum.least, nearness);
    optimum.least = least_impulses(optimum.grid.effects, change);
  }
  optimum.primer = primer_along(coarse, optimum.least.costate);
  return optimum;
}

}  // namespace hamjet
