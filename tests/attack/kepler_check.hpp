#pragma once

#include <cstdint>

namespace hamjet::attack {

/// A check of the attack's own integrator: the largest relative difference, over all degrees,
/// between its integration of Kepler's problem and the closed form, beyond its own uncertainty. The
/// lines are random, on ellipses with eccentricities to 0.95 over up to three revolutions.
double difference_from_closed_form(std::uint64_t seed, int lines);

}  // namespace hamjet::attack
