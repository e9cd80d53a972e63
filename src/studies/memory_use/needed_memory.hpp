#pragma once

#include <cstddef>

#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Throws Error(too_large) if the scene's runs would need more memory than is free, with what would
/// need less; see estimate_memory.
void require_memory(const Scene& scene, const DynamicalSystem& system, std::size_t threads);

}  // namespace hamjet
