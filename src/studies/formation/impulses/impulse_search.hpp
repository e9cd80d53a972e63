#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "hamjet/detail/studies/impulse_plan.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "least_impulses.hpp"

namespace hamjet {

/// The inverse of a symplectic matrix.
Eigen::Matrix<double, 6, 6> symplectic_inverse(const Eigen::Matrix<double, 6, 6>& flow);

ImpulseEffect effect_of(const Eigen::Matrix<double, 6, 6>& flow);

/// The times at which impulses are possible, moving away from 0, and their effects.
struct ImpulseGrid {
  std::vector<double> times;  ///< in canonical units
  std::vector<ImpulseEffect> effects;

  void add(double time, const Eigen::Matrix<double, 6, 6>& flow);
};

/// Every fifth checkpoint of the flow before a time, that is 48 per revolution (fewer if this would
/// be more than some thousands), and the time itself.
ImpulseGrid impulse_grid(const LinearFlow& flow, double time);
/// The grid from one time to another, both included.
ImpulseGrid impulse_grid(const LinearFlow& flow, double first, double last);

/// This many of the listed times, evenly spread over the list and including the last.
std::vector<double> some_times(const std::vector<double>& times, std::size_t most);

/// The magnitude of the primer vector along a grid.
std::vector<PrimerMagnitude> primer_along(const ImpulseGrid& grid,
                                          const Eigen::Matrix<double, 6, 1>& costate);

/// The primer vector along a grid that equals these unit vectors, in inertial axes, at its ends;
/// absent if positions cannot be commanded in the flow.
std::optional<PrimerHistory> primer_between(const ImpulseGrid& grid, const Eigen::Vector3d& first,
                                            const Eigen::Vector3d& last);

/// Impulses in the order of time, in the units of the linear flow.
struct TimedImpulses {
  std::vector<double> times;
  std::vector<Eigen::Vector3d> changes;

  double sum() const {
    double total = 0;
    for (const Eigen::Vector3d& change : changes) total += change.norm();
    return total;
  }
  double largest() const {
    double size = 0;
    for (const Eigen::Vector3d& change : changes) size = std::max(size, change.norm());
    return size;
  }
};

/// The least impulses on a grid, and the primer vector along the coarse one.
struct ImpulseOptimum {
  ImpulseGrid grid;
  LeastImpulses least;
  std::vector<PrimerMagnitude> primer;
};

/// The matrix of a linear flow from time 0 to a canonical time.
using MatrixAt = std::function<Eigen::Matrix<double, 6, 6>(double)>;

/// The least impulses for a change of the deviation at the start, in the units of the flow, on a
/// grid that becomes fine about them. Throws as least_impulses.
ImpulseOptimum search_impulses(const ImpulseGrid& coarse, const MatrixAt& at,
                               const Eigen::Matrix<double, 6, 1>& change);

}  // namespace hamjet
