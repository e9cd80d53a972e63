#pragma once

#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/dynamics/differentiable_function.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/energy_conservation.hpp"

namespace hamjet {

std::vector<Extended> extended(const std::vector<double>& state);

/// A flow problem for the trajectory alone: series of order 0.
FlowProblem<double> trajectory_problem(const DynamicalSystem& system,
                                       const std::vector<double>& start, double duration);

/// Energies in extended precision, and errors relative to the energy at the start (absolute where
/// that is 0).
class EnergyError {
 public:
  EnergyError(const DynamicalSystem& system, const std::vector<double>& start);

  Extended value(const std::vector<Extended>& state);
  double relative(const Extended& difference) const;
  double error(const std::vector<double>& state);

 private:
  DifferentiableFunction<Extended> hamiltonian_;
  Extended initial_ = 0;
};

/// The trajectory with fixed steps of this size that stands beside that of `method`, up to the time
/// `end` or to a million steps. A numerical failure is recorded in the result.
FixedStepTrajectory fixed_step_trajectory(const DynamicalSystem& system,
                                          EnergyConservingMethod method,
                                          const std::vector<double>& start, double step, double end,
                                          const ProgressCallback& progress);

}  // namespace hamjet
