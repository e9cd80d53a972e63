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
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The flow's jet: component i of the final state as a series in the initial deviations. The
/// constant terms are the nominal's final state.
template <class Real>
using FlowJet = std::vector<Series<Real>>;

/// What every integrator is asked for: the Taylor expansion of the flow over a duration about one
/// nominal trajectory. Real is double or Extended; all numbers are in the system's own units. It
/// owns or shares all that it names, so that it may be kept, copied and handed to threads.
template <class Real>
struct FlowProblem {
  SharedSystem system;
  SpacePointer space;                  ///< as many variables as are expanded in
  std::vector<std::size_t> variables;  ///< index in z = (q, p) of each variable of the space
  std::vector<Real> initial_state;     ///< 2n numbers
  Real duration = 0;                   ///< negative: backwards; zero: the start, exactly
  /// The jet that an earlier integration reached, to go on from; its constant terms are
  /// `initial_state`. None: the identity.
  std::optional<FlowJet<Real>> initial_jet = {};
  FlowSymmetry symmetry = FlowSymmetry::rotation;  ///< to be left out of the integration
  /// The observer of steps looks at constant terms alone, so that it may be given a jet in other
  /// variables, before a symmetry that was left out is put back.
  bool observes_constant_terms = false;
};

/// The flow's jet along a straight line of initial deviations, s times `direction`, which has an
/// entry for each variable of the problem: a series in s alone.
template <class Real>
struct JetAlongLine {
  std::vector<Real> direction;
  FlowJet<Real> jet;
};

/// More steps than this are refused with Error(too_large): they would take hours, and their
/// round-off alone would leave little of a result.
inline constexpr double largest_step_count = 1e8;

/// What an integration took; every integration fills it anew. Evaluations are counted on series:
/// one stage of one step.
struct IntegrationStatistics {
  long steps = 0;
  long rejected_steps = 0;
  /// Evaluations on series. Rejected steps cost a Gauss method none: it tries steps on the nominal
  /// first.
  long vector_field_evaluations = 0;
  long nominal_evaluations = 0;  ///< on plain numbers, of all stages at once for implicit methods
  double wall_seconds = 0;       ///< of the integration, without what its observer takes
  /// Of choosing the steps of an adaptive Gauss method (`step_tolerance`); in wall_seconds.
  double choice_seconds = 0;
  SeriesWork series_work;  ///< products of series, of all evaluations and stages
  FlowSymmetry left_out = FlowSymmetry::none;  ///< of the integration, and put back
  /// Most iterations of Newton's method that one solution on the nominal took; 0 where fixed-point
  /// iteration contracted in every step, for explicit methods, and for CVODE, which has an
  /// iteration of its own.
  int most_newton_iterations = 0;
  /// The largest estimate of the relative local error of an accepted step, in the sense in which
  /// the method compares it with its tolerance; none where the method makes none.
  std::optional<double> largest_step_error;
  double step_error_seconds = 0;  ///< taken by largest_step_error alone; not in wall_seconds
  /// Periods of the linearised motion in the duration, for Gauss methods: the integral of the
  /// largest frequency along the nominal, divided by 2 pi. On a circular orbit 1.2 to 1.4 times the
  /// revolutions.
  double periods = 0;
  /// The local tolerance of the steps of an adaptive Gauss method; see GaussSettings::tolerance.
  std::optional<double> step_tolerance;
  /// By degree, the relative error that rounding leaves however short the steps of an adaptive
  /// Gauss method are; empty where every degree meets the tolerance.
  std::vector<double> rounding_by_degree;
  /// By degree, the relative error along two lines where none of the step sizes that an adaptive
  /// Gauss method tried kept all degrees to the tolerance; empty otherwise.
  std::vector<double> unmet_by_degree;
  /// The flow along lines of deviations by other stages and finer steps, where an adaptive Gauss
  /// method has made sure of its tolerance with them: estimate_error needs no second integration.
  /// They are in the arithmetic of the integration.
  std::variant<std::vector<JetAlongLine<double>>, std::vector<JetAlongLine<Extended>>> finer_lines;

  void record_step_error(double estimate) {
    largest_step_error = std::max(largest_step_error.value_or(estimate), estimate);
  }
};

/// Called after every accepted step with the time and the jet so far. May throw to stop.
template <class Real>
using StepObserver = std::function<void(const Real& time, const FlowJet<Real>& jet)>;

/// The jet at time zero: where the problem gives none, the nominal's initial state plus the
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

/// The highest degree whose slices are not zero throughout: a linear system has none above 1.
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
