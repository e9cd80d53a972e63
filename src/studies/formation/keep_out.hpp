#pragma once

#include <vector>

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The least of |(R/a, T/b, N/c)| along the flight of a deputy, with the semi-axes of the scene's
/// `keep_out_m`: below 1 it enters the ellipsoid. Both start now, the chief in `chief`, the deputy
/// with this deviation from it (canonical), and fly for a time without impulses. Throws as
/// exact_flow, and Error(numerical) for a chief without an orbital plane.
double keep_out_ratio(const Scene& scene, const std::vector<double>& chief,
                      const std::vector<double>& deviation, double time);

}  // namespace hamjet
