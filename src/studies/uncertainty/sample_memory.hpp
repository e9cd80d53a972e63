#pragma once

#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// Upper bound, in bytes, of the memory of the samples of `hamjet uncertainty`, beside the memory
/// that estimate_memory counts: states that are flown and kept at every time, the moments made of
/// them, and least separations; 0 for a scene without [uncertainty].
double sample_memory(const Scene& scene);

/// Throws Error(too_large), naming the key and the estimate, if this exceeds available_memory().
void require_sample_memory(const Scene& scene);

}  // namespace hamjet
