#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../../optimal_control/closed_form_cost.hpp"
#include "../../optimal_control/conjugate_times.hpp"
#include "../../optimal_control/discrete_trajectory.hpp"
#include "../../optimal_control/two_point_boundary_value.hpp"
#include "hamjet/detail/studies/progress.hpp"

namespace hamjet {

/// The optimal-control problems that scenes can name.
enum class ControlModel { heisenberg, double_integrator };

/// The models' names in scenes, in the order of the enumeration.
const std::vector<std::string_view>& control_model_names();
/// Names of a model's states, in order.
const std::vector<std::string_view>& state_names(ControlModel model);
/// Number of a model's controls.
std::size_t control_count(ControlModel model);

/// Largest total number of steps of a study, including its refinements.
inline constexpr std::size_t most_control_steps = 100'000;
/// Largest number of shooting intervals; it is limited because the shooting matrix is dense.
inline constexpr std::size_t most_shooting_intervals = 100;

/// A study of one optimal-control problem by the discrete maximum principle. All numbers are
/// without units.
struct OptimalControlStudy {
  std::string name;
  std::string title;
  ControlModel model = ControlModel::heisenberg;
  Discretization discretization = Discretization::stormer;
  double duration = 1;     ///< positive
  std::size_t steps = 64;  ///< number of equal steps
  /// Numbers of steps for the test of convergence; may be empty.
  std::vector<std::size_t> refinements;
  std::vector<double> start;               ///< n numbers
  std::vector<std::optional<double>> end;  ///< n components; a component without a value is free
  std::vector<double> costate_guess;       ///< n numbers; if empty, guessed_costate is used
  std::size_t shooting_intervals = 1;
  std::optional<double> require_cost_error;  ///< if given, a check: largest relative error against
                                             ///< the discrete closed form
  /// If given, a check: largest relative difference of the two routes.
  std::optional<double> require_equivalence;
};

/// The recorded problem with the study's end conditions.
OptimalControlProblem make_problem(const OptimalControlStudy& study);

/// The least cost over this number of steps; no value if there is no elementary formula.
std::optional<ClosedFormCost> closed_form_cost(const OptimalControlStudy& study, std::size_t steps);

/// A first costate of the right order of magnitude. For the Heisenberg problem it is that of an arc
/// that turns by 6 radians if only z is to change, and by less if (x, y) is to change too; it is
/// zero for the double integrator, which is linear.
std::vector<double> guessed_costate(const OptimalControlStudy& study);

/// Typical sizes of states and costates, 2n numbers, from start, end and duration. Scaled by these,
/// the computation is the same in all units.
std::vector<double> typical_sizes(const OptimalControlStudy& study);

/// The cost at one number of steps.
struct ControlConvergencePoint {
  std::size_t steps = 0;
  double cost = 0;
  std::optional<double> continuous_error;  ///< relative to the continuous closed form
  std::optional<double> discrete_error;    ///< relative to the discrete closed form
  std::string failure;                     ///< if not empty, the reason why it was not solved
};

/// The slope of log error against log step.
struct ControlConvergenceFit {
  double order = 0;
  /// Numbers of steps of the points used: the finest ones, above the rounding floor.
  std::vector<std::size_t> steps;
};

/// Both routes through the paper's diagram: discretise then optimise (Karush-Kuhn-Tucker), and
/// optimise then discretise (reduced Hamiltonian, shooting).
struct RouteComparison {
  TrajectoryDifference difference;  ///< relative
  double cost = 0;                  ///< relative difference of the costs
  int karush_kuhn_tucker_iterations = 0;
  int reduced_hamiltonian_iterations = 0;

  double largest() const;
};

/// All results of the study.
struct OptimalControlResult {
  OptimalControlStudy study;
  ShootingSolution solution;  ///< solution of the discrete maximum principle
  double cost = 0;
  double squared_control = 0;  ///< sum of tau <u, u>
  std::optional<ClosedFormCost> closed_form;
  std::optional<double> continuous_error;
  std::optional<double> discrete_error;
  /// Rank of dx(T)/dp(0), the matrix of plain shooting between fixed end points.
  Eigen::Index end_point_rank = 0;
  ConjugateTimes conjugate;         ///< conjugate times of the solution before its end
  double symplecticity_defect = 0;  ///< largest scaled Poisson-bracket defect of a step's map
  std::optional<RouteComparison> routes;
  std::string routes_failure;  ///< if not empty, the reason why one of the routes failed
  std::vector<ControlConvergencePoint> convergence;
  std::optional<ControlConvergenceFit> fit;
  std::vector<std::string> failed_checks;

  /// Whether the solution costs less than all neighbours between the same ends, by Jacobi's
  /// condition. It is false if the solution has a conjugate time. No value if this cannot be
  /// decided, because the steps are too long, an end is free, or the end itself is conjugate.
  std::optional<bool> is_local_least() const;

  /// Exit code: 0, 1 (a check failed) or 4 (a numerical failure left something out).
  int exit_code() const;
};

/// Solves the study's problem by shooting, then along both routes of the paper's diagram, then at
/// each refinement. Throws Error(too_large) for more than `most_control_steps` steps or
/// `most_shooting_intervals` intervals, Error(usage) for sizes that do not fit, Error(numerical) if
/// the problem itself cannot be solved; failures of the other parts are recorded.
OptimalControlResult run_study(const OptimalControlStudy& study, const ProgressCallback& progress);

}  // namespace hamjet
