#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/integrators/gauss_many.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The flows of one scene from many initial states.
struct ManyFlows {
  Scene scene;
  ComputedProblem problem;
  IntegratorSettings settings;
  std::vector<std::vector<double>> states;  ///< initial ones of the model, canonical
  std::vector<ManyFlowsOutcome> outcomes;   ///< jets of the problem's components

  /// What a run of the scene from one of the states has of it: jet, nominal and statistics, without
  /// checks, error estimate and kinds. Precondition: it has not failed.
  PropagationResult result_of(std::size_t orbit) const;
};

/// Integrates from each of the states, numbers of the model in canonical units, or in km and km/s
/// if `is_in_km`, in the place of the scene's own: with the scene's integrator of this label, or
/// its first Gauss method where that is empty. Throws Error(usage) if there is none of this label,
/// for states of another size, or in km of a model that has none; Error(scene) for an integrator
/// that is no Gauss method, extended precision, and a scene in arcs or with a list of times; and as
/// make_problem and integrate_gauss_many.
ManyFlows study_many_flows(const Scene& scene, std::string_view label,
                           std::vector<std::vector<double>> states, bool is_in_km,
                           std::size_t threads, const ProgressCallback& progress);

}  // namespace hamjet
