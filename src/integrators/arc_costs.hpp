#pragma once

#include <cstddef>
#include <optional>

#include "../dynamics/operation_count.hpp"
#include "arc_integrator.hpp"
#include "arc_plan.hpp"
#include "hamjet/algebra/composition.hpp"
#include "symmetry/symmetry_reduction.hpp"

namespace hamjet {

/// The space of an arc after the first one, in which all components vary.
template <class Real>
SpacePointer arc_space(const FlowProblem<Real>& problem) {
  const std::size_t dimension = problem.system->dimension();
  if (problem.space->variables() == dimension) return problem.space;
  return SeriesSpace::create(dimension, problem.space->order());
}

/// Multiply-adds of numbers in one composition. They include Horner's scheme, whose lanes are
/// filled up, the energy along the inner map, and the rotation.
template <class Real>
double composition_cost(const FlowProblem<Real>& problem) {
  const double components = static_cast<double>(problem.system->dimension());
  const int order = working_order(problem);
  double lanes = 0;
  for (double left = components; left > 0; left -= 8) {
    lanes += left <= 2 ? 2 : (left <= 4 ? 4 : 8);
  }
  return lanes * composition_multiply_adds(problem.system->dimension(), order, *problem.space) +
         series_multiply_adds(problem.system->hamiltonian, *problem.space, order) +
         components * components * static_cast<double>(problem.space->size());
}

/// The plan for arcs of a problem whose nominal takes this number of steps.
template <class Real>
ArcPlan plan_for(const FlowProblem<Real>& problem, const ArcIntegrator<Real>& arcs,
                 const std::optional<std::size_t>& asked, long steps) {
  const StepCost first = arcs.cost(*problem.space);
  const StepCost later = arcs.cost(*arc_space(problem));
  // An unsplit integration leaves symmetries out; arcs that start from a cut cannot.
  const auto reduction = SymmetryReduction<Real>::of(problem);
  const StepCost unsplit = reduction ? arcs.cost(*reduction->problem().space) : first;
  // Updating the nominal and keeping checkpoints adds a fifth to the nominal's time.
  return make_arc_plan(asked, steps,
                       {first.nominal, 0.8 * first.nominal + unsplit.series, first.arc, later.arc,
                        composition_cost(problem)});
}

}  // namespace hamjet
