#pragma once

#include <array>
#include <cstddef>
#include <experimental/simd>

#include "../gauss/component_units.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/instruction_set.hpp"

namespace hamjet {

/// The number of orbits that are integrated side by side, each in a lane of the machine's vectors.
inline constexpr std::size_t orbit_lanes = 8;
/// One number of each orbit, as a vector.
using Orbits = Pack<double, static_cast<int>(orbit_lanes)>;
/// One number of each orbit, as an array.
using EachOrbit = std::array<double, orbit_lanes>;

inline Orbits together(const EachOrbit& values) {
  return Orbits::of_lanes([&](auto i) { return values[i]; });
}
inline EachOrbit apart(const Orbits& values) {
  EachOrbit result{};
  for (std::size_t i = 0; i < orbit_lanes; ++i) result[i] = values.lane(static_cast<int>(i));
  return result;
}

/// GradientBlocks::inverse_sigma, lane by lane.
inline Orbits inverse_sigma(const GradientBlocks<Orbits>& blocks) {
  const EachOrbit velocity = apart(blocks.velocity);
  const EachOrbit force = apart(blocks.force);
  return Orbits::of_lanes([&](auto i) {
    return GradientBlocks<double>{0, velocity[i], force[i]}.inverse_sigma();
  });
}

/// Lane by lane, `chosen` if `flags` is not zero, otherwise `other`. The content of a lane never
/// depends on another lane.
inline Orbits choose(const Orbits& flags, const Orbits& chosen, const Orbits& other) {
  Orbits result = other;
  if constexpr (std::experimental::is_simd_v<Orbits::Vector>) {
    for (std::size_t p = 0; p < Orbits::parts; ++p) {
      where(flags.part[p] != 0, result.part[p]) = chosen.part[p];
    }
  } else {
    for (int i = 0; i < Orbits::lanes; ++i) {
      if (flags.lane(i) != 0) result.set_lane(i, chosen.lane(i));
    }
  }
  return result;
}

}  // namespace hamjet
