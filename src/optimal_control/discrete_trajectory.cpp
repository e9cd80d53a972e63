#include "discrete_trajectory.hpp"

#include <algorithm>

#include "../algebra/raise_to.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

double largest_difference(const std::vector<Eigen::VectorXd>& a,
                          const std::vector<Eigen::VectorXd>& b) {
  if (a.size() != b.size()) {
    throw Error(ErrorKind::usage, "difference of trajectories: their numbers of steps differ");
  }
  double largest = 0;
  double scale = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double here = (a[k] - b[k]).lpNorm<Eigen::Infinity>();
    raise_to(largest, here);
    scale = std::max(scale, a[k].lpNorm<Eigen::Infinity>());
  }
  return scale > 0 ? largest / scale : largest;
}

}  // namespace

double discrete_cost(const OptimalControlProblem& problem, Discretization discretization,
                     double step, const DiscreteTrajectory& trajectory) {
  DifferentiableFunction<double> cost(problem.running_cost);
  double sum = 0;
  for (std::size_t k = 0; k < trajectory.steps(); ++k) {
    const Eigen::VectorXd x =
        trajectory.states[k] +
        state_weight(discretization) * (trajectory.states[k + 1] - trajectory.states[k]);
    std::vector<double> inputs(x.begin(), x.end());
    inputs.insert(inputs.end(), trajectory.controls[k].begin(), trajectory.controls[k].end());
    cost.evaluate(inputs);
    sum += step * cost.value(0);
  }
  return sum;
}

double TrajectoryDifference::largest() const {
  double largest = states;
  for (const double other : {costates, controls}) raise_to(largest, other);
  return largest;
}

TrajectoryDifference difference(const DiscreteTrajectory& a, const DiscreteTrajectory& b) {
  return {largest_difference(a.states, b.states), largest_difference(a.costates, b.costates),
          largest_difference(a.controls, b.controls)};
}

}  // namespace hamjet
