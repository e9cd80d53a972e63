#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "independent_runs.hpp"
#include "jet_directions.hpp"
#include "line_restriction.hpp"
#include "lines_side_by_side.hpp"
#include "momentum_unit.hpp"

// The independent runs of an error estimate: the flow along lines of initial deviations, as series
// in one variable.

namespace hamjet {

/// Numbers of directions of the two runs. An error of a high degree d is about (g.x)^d, where g is
/// the deviation that the steps resolve worst, and shows along few directions. Over many steps two
/// directions suffice to see it, over few steps they may not.
inline constexpr std::array<std::size_t, 2> directions_of_runs = {8, 2};

/// The variable of a line has no unit of momentum.
inline constexpr std::array<std::size_t, 1> variable_of_line = {0};

template <class Real>
using Directions = std::vector<Direction<Real>>;

/// Throws Error(usage) unless a jet fits the flow of the problem.
template <class Real>
void require_jet_of(const FlowProblem<Real>& problem, const FlowJet<Real>& jet) {
  if (jet.size() != problem.system->dimension()) {
    throw Error(ErrorKind::usage, "error estimate: the jet has another number of components");
  }
  for (const Series<Real>& component : jet) require_same_space(component.space(), *problem.space);
}

/// The problem along a direction, which is given in the estimate's unit of momentum.
template <class Real>
FlowProblem<Real> problem_along(const FlowProblem<Real>& problem,
                                const std::vector<Real>& direction, int exponent) {
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const std::size_t n = problem.system->degrees_of_freedom;
  std::vector<Real> entries = direction;
  for (std::size_t v = 0; v < entries.size(); ++v) {
    entries[v] *= Real(std::ldexp(1.0, exponent_of_variable(problem.variables[v], n, exponent)));
  }
  return {problem.system,
          line,
          {0},
          problem.initial_state,
          problem.start_time,
          problem.duration,
          restrict_to_line(starting_jet(problem), entries, line)};
}

/// The problem along several directions, side by side.
template <class Real>
FlowProblem<Real> problem_along(const FlowProblem<Real>& problem,
                                std::span<const Direction<Real>> directions, int exponent) {
  std::vector<FlowJet<Real>> starts;
  FlowProblem<Real> all = problem;
  for (const Direction<Real>& direction : directions) {
    all = problem_along(problem, direction.entries, exponent);
    starts.push_back(*all.initial_jet);
  }
  all.initial_jet = side_by_side(starts);
  all.space = (*all.initial_jet)[0].space_pointer();
  all.variables.assign(directions.size(), 0);
  return all;
}

/// The Gauss settings of one of the runs, which integrates all of its directions at once.
template <class Real>
GaussSettings settings_of_run(std::size_t number, const ErrorEstimateSettings& settings) {
  GaussSettings gauss = gauss_of_independent_run<Real>(number, settings.has_smooth_forces);
  if (settings.tolerance) gauss.tolerance = settings.tolerance;
  return gauss;
}

/// Counts the steps of one of the runs.
template <class Real>
StepObserver<Real> observer_of_run(const Real& duration, std::size_t number,
                                   const ErrorEstimateSettings& settings) {
  return [&settings, duration, number, steps = 0L](const Real& time, const FlowJet<Real>&) mutable {
    if (++steps > settings.most_steps) {
      throw Error(ErrorKind::too_large,
                  fmt::format("error estimate: the independent run would take more than {} "
                              "steps",
                              settings.most_steps));
    }
    if (!settings.progress) return;
    const double done = static_cast<double>(Real(time / duration));
    settings.progress((static_cast<double>(number) + done) /
                      static_cast<double>(stages_of_runs.size()));
  };
}

/// The jets along the directions that a run has reached, in the estimate's unit of momentum and
/// without parameters.
template <class Real>
std::vector<FlowJet<Real>> lines_of_run(const FlowJet<Real>& run, std::size_t degrees_of_freedom,
                                        const ErrorEstimateSettings& settings) {
  std::vector<FlowJet<Real>> lines = line_by_line(run);
  for (FlowJet<Real>& line : lines) {
    line = compared_components(std::move(line), variable_of_line, degrees_of_freedom,
                               settings.momentum_exponent);
  }
  return lines;
}

template <class Real>
std::vector<FlowJet<Real>> run_along(const FlowProblem<Real>& problem,
                                     std::span<const Direction<Real>> directions,
                                     std::size_t number, const ErrorEstimateSettings& settings) {
  IntegrationStatistics statistics;
  return lines_of_run<Real>(
      integrate_gauss<Real>(problem_along(problem, directions, settings.momentum_exponent),
                            settings_of_run<Real>(number, settings), statistics,
                            observer_of_run<Real>(problem.duration, number, settings)),
      problem.system->degrees_of_freedom, settings);
}

/// The directions of one run, selected from those that were drawn.
template <class Real>
std::span<const Direction<Real>> directions_of_run(const Directions<Real>& drawn,
                                                   std::size_t number) {
  return std::span(drawn).first(directions_of_runs[number]);
}

}  // namespace hamjet
