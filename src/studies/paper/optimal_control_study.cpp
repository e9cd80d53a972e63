#include "optimal_control_study.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../algebra/raise_to.hpp"
#include "../../optimal_control/discrete_maximum_principle.hpp"
#include "../../optimal_control/hamiltonian_discretization.hpp"
#include "../../optimal_control/karush_kuhn_tucker.hpp"
#include "../comparison/convergence_fit.hpp"
#include "hamjet/error.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet {
namespace {

void require_size_of_work(const OptimalControlStudy& study) {
  std::size_t total = study.steps;
  for (const std::size_t steps : study.refinements) {
    total = steps > most_control_steps ? steps : total + steps;
    if (total > most_control_steps) break;
  }
  if (total > most_control_steps) {
    throw Error(ErrorKind::too_large,
                fmt::format("optimal control: too many steps, got at least {} in steps and "
                            "refinements together, must be at most {}",
                            total, most_control_steps));
  }
  if (study.shooting_intervals > most_shooting_intervals) {
    throw Error(ErrorKind::too_large,
                fmt::format("optimal control: too many shooting intervals, got {}, must be at most "
                            "{}, for the shooting matrix is dense",
                            study.shooting_intervals, most_shooting_intervals));
  }
}

/// The error relative to `exact`; absolute if that is 0.
double relative_error(double value, double exact) {
  return std::abs(value - exact) / (exact != 0 ? std::abs(exact) : 1);
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The largest scaled defect {z_i, z_j} - J_ij of the maps' linear parts.
double symplecticity_defect(const std::vector<Eigen::MatrixXd>& jacobians) {
  double largest = 0;
  for (const Eigen::MatrixXd& jacobian : jacobians) {
    const SpacePointer space = SeriesSpace::create(static_cast<std::size_t>(jacobian.cols()), 1);
    std::vector<Series<double>> jet;
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      Series<double> component(space);
      for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
        component[space->linear_index(static_cast<std::size_t>(j))] = jacobian(i, j);
      }
      jet.push_back(std::move(component));
    }
    raise_to(largest, symplecticity_by_degree(jet).front().scaled);
  }
  return largest;
}

/// One solution of the study's problem at some number of steps.
class StepNumber {
 public:
  StepNumber(const OptimalControlStudy& study, std::size_t steps, std::function<void()> watch)
      : study_(&study),
        problem_(make_problem(study)),
        step_(study.duration / static_cast<double>(steps)) {
    shooting_.steps = steps;
    shooting_.intervals = std::min(study.shooting_intervals, steps);
    shooting_.state_guess = vector_of(study.start);
    const Eigen::VectorXd sizes = vector_of(typical_sizes(study));
    shooting_.typical_state = sizes.head(sizes.size() / 2);
    shooting_.typical_costate = sizes.tail(sizes.size() / 2);
    shooting_.control_guess =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(control_count(study.model)));
    shooting_.newton.watch = [watch = std::move(watch)](int, double) { watch(); };
  }

  ShootingSolution solve(const Eigen::VectorXd& costate_guess) {
    DiscreteMaximumPrinciple map(problem_, study_->discretization, step_);
    shooting_.costate_guess = costate_guess;
    return solve_by_shooting(map, problem_, shooting_);
  }

  double cost(const DiscreteTrajectory& trajectory) const {
    return discrete_cost(problem_, study_->discretization, step_, trajectory);
  }

  double squared_control(const DiscreteTrajectory& trajectory) const {
    double sum = 0;
    for (const Eigen::VectorXd& u : trajectory.controls) sum += step_ * u.squaredNorm();
    return sum;
  }

  /// Compares both routes, each by its own equations, starting from a costate that differs by one
  /// per cent from that of the solution. If the solutions form a family, both routes are asked for
  /// the member with the solution's costate along the family.
  RouteComparison compare_routes(const ShootingSolution& solution) {
    constexpr double displacement = 1.01;
    const Eigen::VectorXd& costate = solution.trajectory.costates.front();
    ShootingSettings settings = shooting_;
    settings.costate_guess = displacement * costate;
    if (solution.family.cols() > 0) {
      settings.conditions =
          CostateConditions{solution.family, solution.family.transpose() * costate};
    }
    HamiltonianDiscretization reduced(problem_, study_->discretization, step_);
    const ShootingSolution b = solve_by_shooting(reduced, problem_, settings);

    Eigen::VectorXd point(2 * costate.size());
    point << settings.state_guess, settings.costate_guess;
    DiscreteMaximumPrinciple map(problem_, study_->discretization, step_);
    const DiscreteTrajectory guess =
        trajectory_of(propagate_arc(map, point, settings.control_guess, settings.steps));
    const KarushKuhnTuckerSolution a = solve_karush_kuhn_tucker(
        problem_, study_->discretization, step_, guess, settings.newton, settings.conditions);

    return {difference(a.trajectory, b.trajectory),
            relative_error(cost(a.trajectory), cost(b.trajectory)), a.iterations, b.iterations};
  }

 private:
  const OptimalControlStudy* study_;
  OptimalControlProblem problem_;
  double step_;
  ShootingSettings shooting_;
};

/// The fit through the finest points at which the leading term dominates the error.
std::optional<ControlConvergenceFit> fit_order(const OptimalControlResult& result) {
  constexpr double rounding_floor = 1e-11;  // well above the round-off of a cost over many steps
  constexpr double largest_error = 1e-2;
  constexpr std::size_t fewest_points = 3;
  constexpr std::size_t most_points = 4;
  std::vector<ConvergencePoint> points;
  ControlConvergenceFit fit;
  std::vector<ControlConvergencePoint> finest = result.convergence;
  std::sort(finest.begin(), finest.end(),
            [](const auto& a, const auto& b) { return a.steps > b.steps; });
  for (const ControlConvergencePoint& point : finest) {
    if (!point.continuous_error || points.size() == most_points) continue;
    if (*point.continuous_error < rounding_floor || *point.continuous_error > largest_error) {
      continue;
    }
    if (!fit.steps.empty() && fit.steps.back() == point.steps) continue;
    points.push_back(
        {result.study.duration / static_cast<double>(point.steps), *point.continuous_error, ""});
    fit.steps.push_back(point.steps);
  }
  if (points.size() < fewest_points) return std::nullopt;
  fit.order = fit_logarithms(points, 0).slope;
  return fit;
}

void check(OptimalControlResult& result) {
  const OptimalControlStudy& study = result.study;
  if (study.require_cost_error &&
      !(result.discrete_error && *result.discrete_error <= *study.require_cost_error)) {
    result.failed_checks.push_back(
        result.discrete_error
            ? fmt::format("require_cost_error: {:.3g} is above {:.3g}", *result.discrete_error,
                          *study.require_cost_error)
            : "require_cost_error: there is no closed form of the discrete problem");
  }
  if (study.require_equivalence && result.routes &&
      !(result.routes->largest() <= *study.require_equivalence)) {
    result.failed_checks.push_back(fmt::format("require_equivalence: {:.3g} is above {:.3g}",
                                               result.routes->largest(),
                                               *study.require_equivalence));
  }
}

ControlConvergencePoint convergence_point(const OptimalControlStudy& study, std::size_t steps,
                                          const Eigen::VectorXd& costate,
                                          const std::function<void()>& watch) {
  ControlConvergencePoint point;
  point.steps = steps;
  try {
    StepNumber refined(study, steps, watch);
    point.cost = refined.cost(refined.solve(costate).trajectory);
    if (const auto exact = closed_form_cost(study, steps)) {
      point.continuous_error = relative_error(point.cost, exact->continuous);
      point.discrete_error = relative_error(point.cost, exact->discrete);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    point.failure = error.what();
  }
  return point;
}

}  // namespace

double RouteComparison::largest() const { return std::max(difference.largest(), cost); }

std::optional<bool> OptimalControlResult::is_local_least() const {
  if (!conjugate.is_resolved) return std::nullopt;
  if (!conjugate.passed_after.empty()) return false;
  const bool is_end_fixed =
      std::all_of(study.end.begin(), study.end.end(), [](const auto& x) { return x.has_value(); });
  const bool is_end_conjugate = end_point_rank < static_cast<Eigen::Index>(study.start.size());
  return is_end_fixed && !is_end_conjugate ? std::optional(true) : std::nullopt;
}

int OptimalControlResult::exit_code() const {
  const bool is_incomplete =
      !routes_failure.empty() ||
      std::any_of(convergence.begin(), convergence.end(),
                  [](const ControlConvergencePoint& point) { return !point.failure.empty(); });
  if (is_incomplete) return static_cast<int>(ErrorKind::numerical);
  return failed_checks.empty() ? 0 : static_cast<int>(ErrorKind::check_failed);
}

OptimalControlResult run_study(const OptimalControlStudy& study, const ProgressCallback& progress) {
  require_size_of_work(study);
  const double total = static_cast<double>(
      std::accumulate(study.refinements.begin(), study.refinements.end(), 3 * study.steps));
  double done = 0;
  std::string task = fmt::format("shooting, {} steps", study.steps);
  const auto watch = [&] {
    if (progress) progress(task, done / total);
  };
  watch();
  OptimalControlResult result;
  result.study = study;
  StepNumber nominal(study, study.steps, watch);
  result.solution = nominal.solve(
      vector_of(study.costate_guess.empty() ? guessed_costate(study) : study.costate_guess));
  const DiscreteTrajectory& trajectory = result.solution.trajectory;
  result.cost = nominal.cost(trajectory);
  result.squared_control = nominal.squared_control(trajectory);
  result.closed_form = closed_form_cost(study, study.steps);
  if (result.closed_form) {
    result.continuous_error = relative_error(result.cost, result.closed_form->continuous);
    result.discrete_error = relative_error(result.cost, result.closed_form->discrete);
  }
  const auto n = static_cast<Eigen::Index>(study.start.size());
  Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  for (const Eigen::MatrixXd& jacobian : result.solution.jacobians) whole = jacobian * whole;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(NewtonSettings{}.rank_threshold);
  result.end_point_rank = decomposition.compute(whole.topRightCorner(n, n)).rank();
  result.conjugate = conjugate_times(result.solution.jacobians, vector_of(typical_sizes(study)));
  result.symplecticity_defect = symplecticity_defect(result.solution.jacobians);
  done += static_cast<double>(study.steps);

  task = fmt::format("both routes, {} steps", study.steps);
  try {
    result.routes = nominal.compare_routes(result.solution);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    result.routes_failure = error.what();
  }
  done += 2 * static_cast<double>(study.steps);
  for (const std::size_t steps : study.refinements) {
    task = fmt::format("convergence, {} steps", steps);
    watch();
    result.convergence.push_back(
        convergence_point(study, steps, trajectory.costates.front(), watch));
    done += static_cast<double>(steps);
  }
  result.fit = fit_order(result);
  check(result);
  return result;
}

}  // namespace hamjet
