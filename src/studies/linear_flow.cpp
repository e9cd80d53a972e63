#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "../algebra/matrix_eigenvalues.hpp"
#include "../dynamics/autonomy.hpp"
#include "../integrators/momentum_unit.hpp"
#include "exact_flow.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

// The linear flow along a nominal, from checkpoint to checkpoint.

namespace hamjet {
namespace {

using StateTransition = LinearFlow::StateTransition;

/// A linear flow from a state, and the state that it reaches.
struct LinearArc {
  std::vector<double> state;
  StateTransition matrix;
};

/// The jet to a relative local error of 1e-14. Most arcs are so short that one step suffices, which
/// saves the choice of steps, several times the cost of the step.
FlowJet<double> precise_jet(const FlowProblem<double>& flow) {
  constexpr double local_error = 1e-14;
  IntegrationStatistics statistics;
  GaussSettings one_step;
  one_step.step = std::abs(flow.duration);
  one_step.estimates_step_error = true;
  try {
    FlowJet<double> jet = integrate_gauss<double>(flow, one_step, statistics);
    if (statistics.largest_step_error && *statistics.largest_step_error <= local_error) return jet;
  } catch (const Error& error) {
    // A step that is too long may have no solution.
    if (error.kind() != ErrorKind::numerical) throw;
  }
  GaussSettings adaptive;
  adaptive.tolerance = local_error;
  return integrate_gauss<double>(flow, adaptive, statistics);
}

LinearArc linear_arc(const ComputedProblem& problem, const SpacePointer& space,
                     const std::vector<double>& start, const ClockTime& start_time,
                     double duration) {
  std::vector<std::size_t> variables(start.size());
  std::iota(variables.begin(), variables.end(), std::size_t{0});
  FlowProblem<double> flow{problem.system, space, variables, start, start_time, duration};
  // One step of order 1 is cheaper than leaving a symmetry out and putting it back.
  flow.symmetry = FlowSymmetry::none;
  const FlowJet<double> jet = precise_jet(flow);
  return {nominal_of(jet),
          in_momentum_unit<StateTransition>(linear_part(jet), problem.momentum_exponent)};
}

}  // namespace

LinearFlow::LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
                       const std::function<void(double)>& progress)
    : problem_(&problem), space_(SeriesSpace::create(problem.system->dimension(), 1)) {
  constexpr std::size_t most_checkpoints = 100000;
  const std::size_t dimension = problem.system->dimension();
  if (problem.variables.size() != dimension || !(per_revolution > 0)) {
    throw Error(ErrorKind::usage,
                "linear flow: a map of phase space and a number of checkpoints are needed");
  }
  times_.push_back(0);
  states_.push_back(problem.nominal);
  const auto size = static_cast<Eigen::Index>(dimension);
  matrices_.push_back(StateTransition::Identity(size, size));
  double step = std::abs(duration) / per_revolution;
  while (times_.back() != duration) {
    step = std::min({2 * step, std::abs(duration) / per_revolution,
                     checkpoint_distance(states_.back(), times_.back(), per_revolution)});
    const double left = std::abs(duration - times_.back());
    const double time =
        left <= 1.01 * step ? duration : times_.back() + std::copysign(step, duration);
    LinearArc arc = linear_arc(problem, space_, states_.back(), problem.start_time + times_.back(),
                               time - times_.back());
    matrices_.push_back(arc.matrix * matrices_.back());
    states_.push_back(std::move(arc.state));
    times_.push_back(time);
    // After about ten revolutions it is known whether the whole span is far too long, and soon
    // after whether it is too long at all.
    const double foreseen = static_cast<double>(times_.size()) * (duration / time);
    const double checkpoints = static_cast<double>(times_.size());
    const double error = checkpoints >= 40 * per_revolution ? 1.05
                         : checkpoints >= 10 * per_revolution
                             ? 1.3
                             : std::numeric_limits<double>::infinity();
    if (times_.size() > most_checkpoints ||
        foreseen > error * static_cast<double>(most_checkpoints)) {
      throw Error(ErrorKind::too_large,
                  fmt::format("linear flow: the span takes more than {} checkpoints, some {} "
                              "revolutions; a shorter one is needed",
                              most_checkpoints,
                              std::lround(static_cast<double>(most_checkpoints) / per_revolution)));
    }
    if (progress) progress(time / duration);
  }
}

double LinearFlow::checkpoint_distance(const std::vector<double>& state, double time,
                                       double per_revolution) const {
  std::vector<Series<double>> z;
  for (std::size_t i = 0; i < state.size(); ++i) {
    z.push_back(Series<double>::variable(space_, i, state[i]));
  }
  const auto slope =
      evaluate_on_series(frozen_at(problem_->system->vector_field, problem_->start_time + time), z);
  // Positions and momenta of similar size preserve the digits of the eigenvalues.
  const Matrix<double> linear =
      in_momentum_unit<Matrix<double>>(linear_part(slope), problem_->momentum_exponent);
  const double rate = matrix_eigenvalues("linear flow", linear).cwiseAbs().maxCoeff();
  return 2 * std::numbers::sqrt2 * std::numbers::pi / (rate * per_revolution);
}

std::size_t LinearFlow::checkpoint_before(double time) const {
  const auto behind = std::upper_bound(times_.begin(), times_.end(), time, [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  return behind == times_.begin() ? 0 : static_cast<std::size_t>(behind - times_.begin()) - 1;
}

std::vector<double> LinearFlow::nominal(double time) const {
  const std::size_t before = checkpoint_before(time);
  return exact_flow(problem_->system, states_[before], problem_->start_time + times_[before],
                    time - times_[before]);
}

LinearFlow::StateTransition LinearFlow::at(double time) const {
  const std::size_t before = checkpoint_before(time);
  if (time == times_[before]) return matrices_[before];
  const LinearArc arc = linear_arc(*problem_, space_, states_[before],
                                   problem_->start_time + times_[before], time - times_[before]);
  return arc.matrix * matrices_[before];
}

}  // namespace hamjet
