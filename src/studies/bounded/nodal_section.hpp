#pragma once

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Refuses a chief that has no nodal section, as the studies of frozen orbits and of bounded
/// formations need: one that is no ellipse, or lies nearly in the equatorial plane. Throws
/// Error(scene) about the nominal.
void require_nodal_section(const Scene& scene);

}  // namespace hamjet
