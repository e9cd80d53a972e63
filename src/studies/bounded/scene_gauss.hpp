#pragma once

#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The Gauss method that a study of returns and events flies with: the first one with a tolerance
/// among the scene's integrators. A search for a root needs
/// flights that are right to `most_tolerance`; a larger tolerance is replaced by it. Throws
/// Error(scene) if the scene names integrators and none is such a method.
GaussSettings scene_gauss(const Scene& scene, double most_tolerance);

/// The label of that integrator.
const std::string& scene_gauss_label(const Scene& scene);

}  // namespace hamjet
