#pragma once

#include <optional>
#include <string>

#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The reason why a run with jet.arcs = "auto" stays in one piece for any counts; no value if the
/// counts decide.
std::optional<std::string> reason_not_to_split(const Scene& scene,
                                               const IntegratorSettings& settings);

/// The method of an integrator in the form that integrations in arcs use. Throws Error(usage) if it
/// cannot be split.
SplittableMethod splittable_method(const IntegratorSettings& settings);

/// Decides into how many arcs a run is split, for which its nominal is integrated. Throws as this
/// integration does.
ArcPlan plan_arcs(const Scene& scene, const ComputedProblem& problem,
                  const IntegratorSettings& settings, const ProgressCallback& progress = {});

/// Throws Error(scene), naming the key, if the scene asks for arcs; `who` needs jets at many times
/// of one unsplit propagation.
void require_unsplit(const Scene& scene, const std::string& who);

}  // namespace hamjet
