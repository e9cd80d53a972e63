#pragma once

#include "hamjet/detail/studies/system_settings.hpp"

namespace hamjet {

/// Whether the forces have all derivatives, but for the edges of light: densities are splines
/// between the heights of their tables.
inline bool has_smooth_forces(const SystemSettings& settings) {
  return !settings.earth || !settings.earth->atmosphere;
}

}  // namespace hamjet
