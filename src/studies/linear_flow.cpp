#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "../algebra/matrix_eigenvalues.hpp"
#include "../dynamics/frozen_system.hpp"
#include "../integrators/momentum_unit.hpp"
#include "../integrators/step_ends.hpp"
#include "exact_flow.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

// The linear flow along a nominal: from checkpoint to checkpoint, and between them.

namespace hamjet {
namespace {

using StateTransition = LinearFlow::StateTransition;

/// A linear flow from a state, and the state that it reaches after a time.
struct LinearArc {
  double time = 0;
  std::vector<double> state;
  StateTransition matrix;
};

/// The largest relative local error.
constexpr double local_error = 1e-14;

LinearArc arc_of(const ComputedProblem& problem, double time, const FlowJet<double>& jet) {
  return {time, nominal_of(jet),
          in_momentum_unit<StateTransition>(linear_part(jet), problem.momentum_exponent)};
}

/// Whether there is a time within a flow at which the forces have no derivatives.
bool passes_break(const DynamicalSystem& system, const ClockTime& start_time, double duration) {
  return !system.break_times.empty() &&
         StepEnds<double>(system, start_time, duration).after(0) != duration;
}

/// The flow after each of a number of equal steps, of which each is one of the integration; empty
/// where such a step is too long for the local error, or passes a time at which the forces have no
/// derivatives: neither do equal steps end there, nor does the estimate of the error see it.
std::vector<LinearArc> arcs_of_steps(const ComputedProblem& problem,
                                     const FlowProblem<double>& flow, std::size_t count) {
  if (passes_break(*flow.system, flow.start_time, flow.duration)) return {};
  IntegrationStatistics statistics;
  GaussSettings steps;
  steps.step = std::abs(flow.duration) / static_cast<double>(count);
  steps.estimates_step_error = true;
  std::vector<LinearArc> arcs;
  try {
    integrate_gauss<double>(flow, steps, statistics,
                            [&](const double& time, const FlowJet<double>& jet) {
                              arcs.push_back(arc_of(problem, time, jet));
                            });
  } catch (const Error& error) {
    // A step that is too long may have no solution.
    if (error.kind() != ErrorKind::numerical) throw;
    return {};
  }
  const bool is_precise =
      statistics.largest_step_error && *statistics.largest_step_error <= local_error;
  if (!is_precise || arcs.size() != count) return {};
  return arcs;
}

/// The flow over a duration. Most arcs are so short that one step suffices, which saves the choice
/// of steps, several times the cost of the step.
LinearArc linear_arc(const ComputedProblem& problem, const SpacePointer& space,
                     const std::vector<double>& start, const ClockTime& start_time,
                     double duration) {
  const FlowProblem<double> flow =
      linear_problem(problem.system, space, start, start_time, duration);
  std::vector<LinearArc> one = arcs_of_steps(problem, flow, 1);
  if (!one.empty()) return std::move(one.front());
  GaussSettings adaptive;
  adaptive.tolerance = local_error;
  IntegrationStatistics statistics;
  return arc_of(problem, duration, integrate_gauss<double>(flow, adaptive, statistics));
}

/// The flow after each of a number of equal parts of a duration.
std::vector<LinearArc> linear_arcs(const ComputedProblem& problem, const SpacePointer& space,
                                   const std::vector<double>& start, const ClockTime& start_time,
                                   double duration, std::size_t count) {
  if (count == 1) return {linear_arc(problem, space, start, start_time, duration)};
  std::vector<LinearArc> arcs = arcs_of_steps(
      problem, linear_problem(problem.system, space, start, start_time, duration), count);
  if (arcs.empty()) {
    LinearArc last{0, start, {}};
    for (std::size_t k = 1; k <= count; ++k) {
      const double time = duration * static_cast<double>(k) / static_cast<double>(count);
      LinearArc next =
          linear_arc(problem, space, last.state, start_time + last.time, time - last.time);
      if (k > 1) next.matrix = next.matrix * last.matrix;
      next.time = time;
      arcs.push_back(next);
      last = std::move(next);
    }
  }
  return arcs;
}

/// The most checkpoints that a polynomial goes through.
constexpr std::size_t most_nodes = 10;

/// The polynomial through the values at a number of checkpoints, half of them at or before an
/// interval's start and half behind it, at one time of the interval.
class Interpolation {
 public:
  Interpolation(const std::vector<double>& times, std::size_t before, std::size_t count,
                double time)
      : first_(before + 1 - count / 2), count_(count) {
    for (std::size_t k = 0; k < count; ++k) {
      // Lagrange's basis; each ratio is of the size of a number of intervals, in any unit of time.
      double weight = 1;
      for (std::size_t l = 0; l < count; ++l) {
        const double node = times[first_ + l];
        if (l != k) weight *= (time - node) / (times[first_ + k] - node);
      }
      weights_[k] = weight;
    }
  }

  StateTransition matrix(const std::vector<StateTransition>& values) const {
    StateTransition sum = weights_[0] * values[first_];
    for (std::size_t k = 1; k < count_; ++k) sum += weights_[k] * values[first_ + k];
    return sum;
  }

  Vector<double> state(const std::vector<std::vector<double>>& values) const {
    const auto value = [&](std::size_t k) {
      const std::vector<double>& state = values[first_ + k];
      return Eigen::Map<const Vector<double>>(state.data(),
                                              static_cast<Eigen::Index>(state.size()));
    };
    Vector<double> sum = weights_[0] * value(0);
    for (std::size_t k = 1; k < count_; ++k) sum += weights_[k] * value(k);
    return sum;
  }

 private:
  std::size_t first_;
  std::size_t count_;
  std::array<double, most_nodes> weights_;
};

/// Whether two polynomials, one of two degrees less than the other, differ so little that the
/// higher one is right to rounding: on a circle of 240 checkpoints a revolution they differ by
/// 4e-15, and the higher one from the flow by 1e-18.
template <class Values>
bool differ_little(const Values& a, const Values& b) {
  return (a - b).norm() <= 1e-13 * a.norm();
}

}  // namespace

LinearFlow::LinearFlow(const ComputedProblem& problem, double duration, double per_revolution,
                       const std::function<void(double)>& progress)
    : problem_(&problem), space_(SeriesSpace::create(problem.system->dimension(), 1)) {
  constexpr std::size_t most_checkpoints = 500000;
  const std::size_t dimension = problem.system->dimension();
  if (problem.variables.size() != dimension || !(per_revolution > 0)) {
    throw Error(ErrorKind::usage,
                "linear flow: a map of phase space and a number of checkpoints are needed");
  }
  times_.push_back(0);
  states_.push_back(problem.nominal);
  const auto size = static_cast<Eigen::Index>(dimension);
  matrices_.push_back(StateTransition::Identity(size, size));
  // Checkpoints of a thirtieth of a revolution are as far apart as the first of them asks for.
  const double most_together = std::max(1.0, std::floor(per_revolution / 30));
  double step = std::abs(duration) / per_revolution;
  while (times_.back() != duration) {
    step = std::min({2 * step, std::abs(duration) / per_revolution,
                     checkpoint_distance(states_.back(), times_.back(), per_revolution)});
    if (!(step > std::numeric_limits<double>::epsilon() * std::abs(duration))) {
      throw Error(
          ErrorKind::numerical,
          fmt::format("linear flow: the nominal changes without bound {:.6g} canonical units "
                      "of time after its start; a collision or another singularity lies "
                      "ahead",
                      times_.back()));
    }
    // Of what is left, steps of equal length are integrated together.
    const double left = std::abs(duration - times_.back());
    const bool is_end = left <= 1.01 * step * most_together;
    const double count = is_end ? std::ceil(left / (1.01 * step)) : most_together;
    const double start = times_.back();
    const double end = is_end ? duration : start + std::copysign(count * step, duration);
    const StateTransition before = matrices_.back();
    for (LinearArc& arc : linear_arcs(problem, space_, states_.back(), problem.start_time + start,
                                      end - start, static_cast<std::size_t>(count))) {
      matrices_.push_back(arc.matrix * before);
      states_.push_back(std::move(arc.state));
      times_.push_back(start + arc.time);
    }
    times_.back() = end;
    // After about ten revolutions it is known whether the whole span is far too long, and soon
    // after whether it is too long at all.
    const double foreseen = static_cast<double>(times_.size()) * (duration / end);
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
    if (progress) progress(end / duration);
  }
  find_interpolated();
}

void LinearFlow::find_interpolated() {
  is_interpolated_.assign(times_.size(), false);
  for (std::size_t before = most_nodes / 2 - 1; before + most_nodes / 2 < times_.size(); ++before) {
    const double first = times_[before + 1 - most_nodes / 2];
    const double last = times_[before + most_nodes / 2];
    if (passes_break(*problem_->system, problem_->start_time + first, last - first)) continue;
    const double middle = 0.5 * (times_[before] + times_[before + 1]);
    const Interpolation all(times_, before, most_nodes, middle);
    const Interpolation fewer(times_, before, most_nodes - 2, middle);
    if (!differ_little(all.matrix(matrices_), fewer.matrix(matrices_))) continue;
    const Vector<double> state = all.state(states_);
    const Vector<double> other = fewer.state(states_);
    const auto n = static_cast<Eigen::Index>(problem_->system->degrees_of_freedom);
    is_interpolated_[before] =
        differ_little<Vector<double>>(state.head(n), other.head(n)) &&
        differ_little<Vector<double>>(state.segment(n, n), other.segment(n, n));
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
  if (is_interpolated_[before]) {
    const Vector<double> state = Interpolation(times_, before, most_nodes, time).state(states_);
    return {state.begin(), state.end()};
  }
  return exact_flow(problem_->system, states_[before], problem_->start_time + times_[before],
                    time - times_[before]);
}

LinearFlow::StateTransition LinearFlow::at(double time) const {
  const std::size_t before = checkpoint_before(time);
  if (time == times_[before]) return matrices_[before];
  if (is_interpolated_[before]) {
    return Interpolation(times_, before, most_nodes, time).matrix(matrices_);
  }
  const LinearArc arc = linear_arc(*problem_, space_, states_[before],
                                   problem_->start_time + times_[before], time - times_[before]);
  return arc.matrix * matrices_[before];
}

}  // namespace hamjet
