#pragma once

#include <cstdint>

namespace hamjet::attack {

/// The largest relative difference, over all degrees, between the attack's own integration of
/// Kepler's problem and its closed form, beyond what it calls its uncertainty, along random lines
/// of ellipses with eccentricities to 0.95 over up to three revolutions: a check of the attacker
/// itself.
double difference_from_closed_form(std::uint64_t seed, int lines);

}  // namespace hamjet::attack
