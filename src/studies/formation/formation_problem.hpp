#pragma once

#include <string_view>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Throws Error(scene) unless a study of formation flight can be made on the scene: it needs the
/// study's table, an orbit, all variables, double precision and a symplectic integrator.
void require_formation_problem(const Scene& scene, bool has_table, std::string_view table);

/// The scene's first integrator that is symplectic in (q, p), as generating functions require.
const IntegratorSettings& symplectic_integrator(const Scene& scene);

}  // namespace hamjet
