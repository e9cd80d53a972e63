#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/dynamics/series_work.hpp"
#include "hamjet/detail/integrators/flow_symmetry.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The flow's jet: component i of the final state as a series in the initial deviations. The
/// constant terms are the nominal's final state.
template <class Real>
using FlowJet = std::vector<Series<Real>>;

/// The problem that every integrator solves: the Taylor expansion of the flow over a duration about
/// one nominal trajectory. Real is double or Extended; all numbers are in the system's own units. A
/// problem owns or shares all of its parts, so that it may be kept, copied and handed to threads.
template <class Real>
struct FlowProblem {
  SharedSystem system;
  SpacePointer space;                  ///< one variable for each variable of the expansion
  std::vector<std::size_t> variables;  ///< index in z = (q, p) of each variable of the space
  std::vector<Real> initial_state;     ///< 2n numbers
  /// The time of the system's clock at which `initial_state` stands. It has no default: a problem
  /// that leaves it out does not compile. A flight backwards starts at the later time.
  ClockTime start_time;
  Real duration = 0;  ///< negative for backwards; zero gives the start exactly
  /// The jet that an earlier integration reached and from which this one continues; its constant
  /// terms are `initial_state`. Without a value the integration starts from the identity.
  std::optional<FlowJet<Real>> initial_jet = {};
  FlowSymmetry symmetry = FlowSymmetry::rotation;  ///< symmetry to be left out of the integration
  /// Whether the observer of steps reads constant terms alone. It may then be given a jet in other
  /// variables, before a symmetry that was left out is put back.
  bool observes_constant_terms = false;
};

/// The flow's jet along a straight line of initial deviations, s times `direction`, as a series in
/// s alone. The direction has an entry for each variable of the problem.
template <class Real>
struct JetAlongLine {
  std::vector<Real> direction;
  FlowJet<Real> jet;
};

/// Integrations of more steps are refused with Error(too_large): they would take hours, and
/// round-off alone would leave little of the result.
inline constexpr double largest_step_count = 1e8;

/// The work and the findings of an integration; every integration fills them anew. Evaluations are
/// counted on series: one stage of one step.
struct IntegrationStatistics {
  long steps = 0;
  long rejected_steps = 0;
  /// Evaluations on series. In a Gauss method rejected steps need none, because steps are tried on
  /// the nominal first.
  long vector_field_evaluations = 0;
  long nominal_evaluations =
      0;  ///< evaluations on plain numbers; for implicit methods, of all stages at once
  double wall_seconds = 0;  ///< time of the integration, without that of its observer
  /// Time of choosing the steps of an adaptive Gauss method (`step_tolerance`); it is part of
  /// wall_seconds.
  double choice_seconds = 0;
  SeriesWork series_work;  ///< products of series in all evaluations and stages
  FlowSymmetry left_out =
      FlowSymmetry::none;  ///< symmetry that was left out of the integration and put back
  /// Largest number of iterations that Newton's method needed for one solution on the nominal. It
  /// is 0 if fixed-point iteration contracted in every step, for explicit methods, and for CVODE,
  /// which has an iteration of its own.
  int most_newton_iterations = 0;
  /// The largest estimate of the relative local error of an accepted step, in the sense in which
  /// the method compares it with its tolerance; no value if the method makes no estimate.
  std::optional<double> largest_step_error;
  double step_error_seconds =
      0;  ///< time of computing largest_step_error; not part of wall_seconds
  /// For Gauss methods, the number of periods of the linearised motion in the duration: the
  /// integral of the largest frequency along the nominal, divided by 2 pi. On a circular orbit it
  /// is 1.2 to 1.4 times the number of revolutions.
  double periods = 0;
  /// The local tolerance of the steps of an adaptive Gauss method; see GaussSettings::tolerance.
  std::optional<double> step_tolerance;
  /// By degree, the relative error that rounding leaves even with very short steps of an adaptive
  /// Gauss method; empty if every degree meets the tolerance.
  std::vector<double> rounding_by_degree;
  /// The relative error by degree along two lines, if none of the step sizes that an adaptive Gauss
  /// method tried met the tolerance in all degrees; otherwise empty.
  std::vector<double> unmet_by_degree;
  /// The flow along lines of deviations with other stages and finer steps, with which an adaptive
  /// Gauss method has checked its tolerance. With them estimate_error needs no second integration.
  /// They have the arithmetic of the integration.
  std::variant<std::vector<JetAlongLine<double>>, std::vector<JetAlongLine<Extended>>> finer_lines;

  void record_step_error(double estimate) {
    largest_step_error = std::max(largest_step_error.value_or(estimate), estimate);
  }
};

/// Called after every accepted step with the time and the present jet. It may throw to stop.
template <class Real>
using StepObserver = std::function<void(const Real& time, const FlowJet<Real>& jet)>;

/// The jet at time zero: that of the problem, or without one the nominal's initial state plus the
/// deviations themselves.
template <class Real>
FlowJet<Real> starting_jet(const FlowProblem<Real>& problem) {
  if (problem.initial_jet) return *problem.initial_jet;
  FlowJet<Real> jet;
  for (const Real& value : problem.initial_state) jet.emplace_back(problem.space, value);
  if (problem.space->order() >= 1) {
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
      jet[problem.variables[k]][problem.space->linear_index(k)] = Real(1);
    }
  }
  return jet;
}

/// The highest degree that needs to be computed; for a linear system the degrees above 1 vanish.
inline int working_order(const DynamicalSystem& system, int order) {
  return system.vector_field.is_linear_system() ? std::min(order, 1) : order;
}
template <class Real>
int working_order(const FlowProblem<Real>& problem) {
  return working_order(*problem.system, problem.space->order());
}

/// Throws Error(usage) if the sizes of a problem do not fit, Error(numerical) if a number is not
/// finite.
template <class Real>
void validate(const FlowProblem<Real>& problem);

/// Throws Error(numerical), naming the time, unless every coefficient is finite.
template <class Real>
void require_finite(const FlowJet<Real>& jet, const Real& time, const char* method);

}  // namespace hamjet
