#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

namespace hamjet {

/// The shadow of a sphere about the origin in the light of the Sun, itself a sphere: lines that
/// touch both on the same side bound the umbra, and its continuation beyond the apex, the antumbra,
/// from which the whole sphere is seen before the Sun; those that touch them on opposite sides
/// bound the penumbra. Light goes straight and takes no time, and there is no air. All lengths are
/// in one unit, and positions are outside the sphere. Source: Montenbruck and Gill, Satellite
/// Orbits, section 3.4.2.
struct Shadow {
  double radius = 0;      ///< radius of the sphere
  double sun_radius = 0;  ///< radius of the Sun
};

/// The fraction of the Sun's disc that is seen from a position, 0 to 1: discs of the angular radii
/// of both bodies, as if they were plane, overlap.
double sunlit_fraction(const Shadow& shadow, const std::array<double, 3>& position,
                       const std::array<double, 3>& sun);

/// The boundaries of the shadow.
enum class ShadowEdge : std::size_t { penumbra, umbra, antumbra };

/// The distances of a position from the three boundaries, in the order of ShadowEdge, negative
/// inside. Each is that from the cone behind the sphere, or from the plane through the centre
/// across the Sun's direction if that is farther, so that no value changes by more than the
/// position is moved. A position at which one passes through zero is on that boundary, exactly.
std::array<double, 3> distances_to_shadow(const Shadow& shadow,
                                          const std::array<double, 3>& position,
                                          const std::array<double, 3>& sun);

/// A part of a path through the shadow, as functions of the time.
struct ShadowedPath {
  std::function<std::array<double, 3>(double)> position;
  std::function<std::array<double, 3>(double)> sun;
  /// A bound of the speed at which the position moves relative to axes that turn with the Sun's
  /// direction: by no more than that times the time the distances change.
  double greatest_speed = 0;
};

/// An edge on a path.
struct ShadowCrossing {
  double time = 0;
  ShadowEdge edge = ShadowEdge::penumbra;
};

/// The first crossing of a boundary after the time `from` on the way to `to`, which may be earlier;
/// no value if there is none. `inside` says of each boundary on which side the path is just after
/// `from`, which may be a crossing itself. No step of the search is longer than the least distance
/// allows at the greatest speed, or `least_step`: what is passed over without notice is a boundary
/// that is met twice within that time, by a path that touches it. Throws Error(numerical) for
/// positions that are not finite.
std::optional<ShadowCrossing> next_crossing(const Shadow& shadow, const ShadowedPath& path,
                                            const std::array<bool, 3>& inside, double from,
                                            double to, double least_step);

}  // namespace hamjet
