#pragma once

#include <string_view>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Throws Error(scene) unless a study of formation flight can be made on the scene: its table is
/// there, an orbit, all variables, double precision, a symplectic integrator.
void require_formation_problem(const Scene& scene, bool has_table, std::string_view table);

/// The scene's first integrator that keeps the symplectic structure in (q, p), which generating
/// functions need.
const IntegratorSettings& symplectic_integrator(const Scene& scene);

}  // namespace hamjet
