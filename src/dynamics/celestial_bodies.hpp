#pragma once

#include <span>
#include <string_view>

namespace hamjet {

/// A body about which orbits are flown.
struct CelestialBody {
  std::string_view name;  ///< in capitals, as in CENTER_NAME of an orbit message
  double mu_km3_s2;       ///< gravitational parameter; it includes the moons, except for the Earth
  double equator_radius_km;
};

/// The Sun, the Moon and the planets. Sources: gravitational parameters of JPL's DE440 (R. S. Park
/// et al., The Astronomical Journal 161 (2021) 105, table 2); radii of the IAU Working Group on
/// Cartographic Coordinates and Rotational Elements 2015 (B. A. Archinal et al., Celestial
/// Mechanics and Dynamical Astronomy 130 (2018) 22).
std::span<const CelestialBody> celestial_bodies();

/// A gravitational parameter within this relative distance of a body's counts as the body's.
/// Published values, and values with and without moons, differ by less (Saturn's by 2.5e-4).
inline constexpr double body_mu_tolerance = 1e-3;

/// The body with this name, in any case of letters and with or without "BARYCENTER". Null for any
/// other name, and for the barycentre of Earth and Moon, which is not the Earth.
const CelestialBody* body_named(std::string_view name);

/// The body that has this gravitational parameter; null if no body has it.
const CelestialBody* body_with_mu(double mu_km3_s2);

}  // namespace hamjet
