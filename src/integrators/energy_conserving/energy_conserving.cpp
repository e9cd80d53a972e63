#include "hamjet/integrators/energy_conserving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "../../algebra/instantiated_real.hpp"
#include "../compensated_addition.hpp"
#include "energy_conserving_midpoint.hpp"
#include "energy_conserving_stormer.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

template <class Real>
class StepCondition<Real>::Evaluation {
 public:
  Evaluation(const DynamicalSystem& system, EnergyConservingMethod method)
      : n_(system.degrees_of_freedom), method_(method), field_(system.vector_field) {}

  Real operator()(const std::vector<Real>& state) {
    field_.evaluate(state);
    return method_ == EnergyConservingMethod::stormer ? potential_rate() : curvature();
  }

 private:
  /// The rate grad V . M^-1 p = -p' . q'.
  Real potential_rate() const {
    Real sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum -= field_.value(n_ + i) * field_.value(i);
    return sum;
  }

  /// The curvature f^T H'' f = (J f)^T Df f, for Df = J H''.
  Real curvature() const {
    Real sum = 0;
    for (std::size_t i = 0; i < 2 * n_; ++i) {
      Real change = 0;
      for (std::size_t j = 0; j < 2 * n_; ++j) {
        change += field_.derivative(i, j) * field_.value(j);
      }
      sum += (i < n_ ? field_.value(n_ + i) : Real(-field_.value(i - n_))) * change;
    }
    return sum;
  }

  std::size_t n_;
  EnergyConservingMethod method_;
  DifferentiableFunction<Real> field_;
};

template <class Real>
StepCondition<Real>::StepCondition(const DynamicalSystem& system, EnergyConservingMethod method)
    : evaluation_(std::make_unique<Evaluation>(system, method)) {}
template <class Real>
StepCondition<Real>::~StepCondition() = default;
template <class Real>
Real StepCondition<Real>::operator()(const std::vector<Real>& state) {
  return (*evaluation_)(state);
}

template <class Real>
std::vector<Real> discrete_energy_point(EnergyConservingMethod method,
                                        const std::vector<Real>& start,
                                        const std::vector<Real>& end) {
  std::vector<Real> point = start;
  const std::size_t n = start.size() / 2;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    if (method == EnergyConservingMethod::midpoint) {
      point[i] = (start[i] + end[i]) / 2;
    } else if (i >= n) {
      point[i] = end[i];
    }
  }
  return point;
}

namespace {

template <class Real>
void validate(const EnergyConservingProblem<Real>& problem) {
  const auto fail = [](const char* what) {
    throw Error(ErrorKind::usage, fmt::format("energy-conserving integration: {}", what));
  };
  if (!problem.system) fail("no system");
  if (!problem.system->is_hamiltonian) {
    fail(
        "the system has forces that are not those of its Hamiltonian, which these methods take "
        "alone; the Gauss methods take any system");
  }
  if (!problem.system->is_autonomous()) {
    fail(
        "the Hamiltonian depends on the time, so that the flow does not keep the energy, by which "
        "these methods choose their steps; the Gauss methods take any system");
  }
  if (problem.initial_state.size() != problem.system->dimension()) {
    fail("the initial state has not as many numbers as the system");
  }
  for (const Real& x : problem.initial_state) {
    if (!is_finite(x)) fail("the initial state is not finite");
  }
  if (!(problem.first_step > 0) || !is_finite(problem.first_step)) {
    fail("the first step must be positive");
  }
  if (!is_finite(problem.duration)) fail("the duration is not finite");
  if (problem.method == EnergyConservingMethod::stormer && !problem.system->second_order) {
    fail(
        "Störmer needs a second-order form: q' = M^-1 p with a constant mass matrix M and "
        "p' = F(q); midpoint takes any system");
  }
}

/// The end of a step of size h by which the energy is ignored; the condition of a stop is evaluated
/// there.
template <class Real>
std::vector<Real> step_ahead(const DynamicalSystem& system, const std::vector<Real>& z,
                             const Real& h) {
  DifferentiableFunction<Real> field(system.vector_field);
  field.evaluate(z);
  std::vector<Real> middle = z;
  for (std::size_t i = 0; i < z.size(); ++i) middle[i] += h / 2 * field.value(i);
  field.evaluate(middle);
  std::vector<Real> end = z;
  for (std::size_t i = 0; i < z.size(); ++i) end[i] += h * field.value(i);
  return end;
}

const char* method_name(EnergyConservingMethod method) {
  return energy_conserving_method_names()[static_cast<std::size_t>(method)].data();
}

std::string condition_text(const DynamicalSystem& system, EnergyConservingMethod method,
                           const EnergyConservingStop& stop) {
  const char* quantity = "G = f.H''f, f = J grad H,";
  if (method == EnergyConservingMethod::stormer) {
    quantity = "p.M^-1 g = dV/dt";
  } else if (system.second_order) {
    quantity = "G = p.M^-1 V'' M^-1 p + g.M^-1 g, g = grad V,";
  }
  if (!std::isfinite(stop.condition)) return {};
  std::string text = fmt::format("; {} is {:.6g} here", quantity, stop.condition);
  if (const auto& distance = stop.steps_to_sign_change) {
    text += fmt::format(
        " and on a line through its value one step ahead changes sign {:.3g} steps "
        "of the last size {}; no step crosses a change of sign",
        std::abs(*distance), *distance < 0 ? "back" : "ahead");
  }
  return text;
}

template <class Real>
EnergyConservingStop make_stop(const EnergyConservingProblem<Real>& problem,
                               const StepAttempt<Real>& attempt, long step, const Real& time,
                               const std::vector<Real>& state, const Real& last) {
  const DynamicalSystem& system = *problem.system;
  StepCondition<Real> condition(system, problem.method);
  const auto here = static_cast<double>(condition(state));
  const auto ahead = static_cast<double>(condition(step_ahead(system, state, last)));
  EnergyConservingStop stop;
  stop.cause = attempt.cause;
  stop.step = step;
  stop.time = static_cast<double>(time);
  stop.condition = here;
  const double distance = here / (here - ahead);
  // If the first step is too large, its size gives no distance to a change of sign.
  if (step > 0 && std::isfinite(distance)) stop.steps_to_sign_change = distance;
  stop.message =
      fmt::format("energy-conserving {}: step {} at t = {:.10g}: {}{}", method_name(problem.method),
                  step, stop.time, attempt.reason, condition_text(system, problem.method, stop));
  return stop;
}

template <class Real>
bool all_finite(const std::vector<Real>& state) {
  return std::all_of(state.begin(), state.end(), [](const Real& x) { return is_finite(x); });
}

template <class Real, class Equation>
EnergyConservingResult<Real> integrate(const EnergyConservingProblem<Real>& problem,
                                       const EnergyConservingObserver<Real>& observer) {
  const DynamicalSystem& system = *problem.system;
  const int direction = problem.duration < 0 ? -1 : 1;
  const Real span = magnitude(problem.duration);
  Equation equation(system);
  StepCondition<Real> condition(system, problem.method);
  EnergyConservingResult<Real> result;
  result.state = problem.initial_state;
  Real size = problem.first_step * direction;
  Real lost = 0;  // rounding residue of the time
  while (magnitude(result.time) < span) {
    if (static_cast<double>(result.steps) >= largest_energy_conserving_step_count) {
      throw Error(
          ErrorKind::too_large,
          fmt::format("energy-conserving {}: after {:.0e} steps, the most that are taken, "
                      "the time is {:.6g} of {:.6g}; a shorter duration or a larger first "
                      "step would do",
                      method_name(problem.method), largest_energy_conserving_step_count,
                      static_cast<double>(result.time), static_cast<double>(problem.duration)));
    }
    StepAttempt<Real> attempt = result.steps == 0 ? equation.start(result.state, size)
                                                  : equation.advance(result.state, size);
    if (attempt.is_taken && !(is_finite(equation.energy()) && all_finite(attempt.end))) {
      attempt = refused<Real>(EnergyConservingStopCause::not_finite,
                              "the end of the step, or its energy, is not finite");
    }
    if (!attempt.is_taken) {
      result.stop = make_stop(problem, attempt, result.steps, result.time, result.state, size);
      break;
    }
    EnergyConservingStep<Real> step{
        result.steps,           result.time, attempt.size,      std::move(result.state),
        std::move(attempt.end), 0,           attempt.iterations};
    step.condition = condition(step.start);
    size = step.size;
    add_compensated(result.time, lost, size);
    ++result.steps;
    result.newton_iterations += step.newton_iterations;
    if (observer) observer(step);
    result.state = std::move(step.end);
  }
  result.energy = equation.energy();
  result.last_step = size;
  return result;
}

}  // namespace

template <class Real>
EnergyConservingResult<Real> integrate_energy_conserving(
    const EnergyConservingProblem<Real>& problem, const EnergyConservingObserver<Real>& observer) {
  validate(problem);
  if (problem.method == EnergyConservingMethod::stormer) {
    return integrate<Real, EnergyConservingStormer<Real>>(problem, observer);
  }
  return integrate<Real, EnergyConservingMidpoint<Real>>(problem, observer);
}

template class StepCondition<InstantiatedReal>;
template EnergyConservingResult<InstantiatedReal> integrate_energy_conserving(
    const EnergyConservingProblem<InstantiatedReal>&,
    const EnergyConservingObserver<InstantiatedReal>&);
template std::vector<InstantiatedReal> discrete_energy_point(EnergyConservingMethod,
                                                             const std::vector<InstantiatedReal>&,
                                                             const std::vector<InstantiatedReal>&);

}  // namespace hamjet
