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
  std::vector<std::vector<double>> states;  ///< initial states of the model, in canonical units
  std::vector<ManyFlowsOutcome> outcomes;   ///< jets of the problem's components

  /// The result of a run of the scene from one of the states: jet, nominal and statistics, without
  /// checks, error estimate and kinds. Precondition: the orbit has not failed.
  PropagationResult result_of(std::size_t orbit) const;
};

/// Integrates from each of the states instead of the scene's own start. States are numbers of the
/// model in canonical units or, if `is_in_km`, in km and km/s. The integrator is the one with this
/// label or, if the label is empty, the scene's first Gauss method. Throws Error(usage) if no
/// integrator has this label, for states of another size, or for km with a model that has none;
/// Error(scene) for an integrator that is not a Gauss method, extended precision, and a scene in
/// arcs or with a list of times; and as make_problem and integrate_gauss_many.
ManyFlows study_many_flows(const Scene& scene, std::string_view label,
                           std::vector<std::vector<double>> states, bool is_in_km,
                           std::size_t threads, const ProgressCallback& progress);

}  // namespace hamjet
