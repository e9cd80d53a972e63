#pragma once

#include <optional>
#include <string>

#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// Whether a method's flow can be split into arcs: its steps follow from the nominal alone.
bool can_be_split(IntegrationMethod method);

/// Why the scene's key jet.arcs = "auto" leaves a run in one piece whatever the counts; none where
/// the counts decide.
std::optional<std::string> reason_not_to_split(const Scene& scene,
                                               const IntegratorSettings& settings);

/// The method of an integrator that can be split.
SplittableMethod splittable_method(const IntegratorSettings& settings);

/// Into how many arcs a run will be split. Integrates its nominal; throws as that does.
ArcPlan plan_arcs(const Scene& scene, const ComputedProblem& problem,
                  const IntegratorSettings& settings, const ProgressCallback& progress = {});

/// Throws Error(scene), naming the key, if the scene asks for arcs: `who` needs jets at many times
/// of one unsplit propagation.
void require_unsplit(const Scene& scene, const std::string& who);

}  // namespace hamjet
