#pragma once

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Bytes that the samples of `hamjet uncertainty` take at most, beside what estimate_memory counts:
/// states that are flown and kept at every time, those of the moments that are made of them, and
/// least separations; 0 for a scene without [uncertainty].
double sample_memory(const Scene& scene);

/// Throws Error(too_large), naming the key and the estimate, where that is more than
/// available_memory().
void require_sample_memory(const Scene& scene);

}  // namespace hamjet
