#pragma once

#include <span>
#include <string_view>

namespace hamjet {

/// A body that orbits are flown about.
struct CelestialBody {
  std::string_view name;  ///< in capitals, as in CENTER_NAME of an orbit message
  double mu_km3_s2;       ///< gravitational parameter, with moons except for the Earth
  double equator_radius_km;
};

/// The Sun, the Moon and the planets. Sources: gravitational parameters of JPL's DE440 (R. S. Park
/// et al., The Astronomical Journal 161 (2021) 105, table 2); radii of the IAU Working Group on
/// Cartographic Coordinates and Rotational Elements 2015 (B. A. Archinal et al., Celestial
/// Mechanics and Dynamical Astronomy 130 (2018) 22).
std::span<const CelestialBody> celestial_bodies();

/// A gravitational parameter within this relative distance is taken for that of a body: its
/// published values, and those with and without its moons, differ by less (Saturn's by 2.5e-4).
inline constexpr double body_mu_tolerance = 1e-3;

/// The body with this name, in capitals or not, or with this name less "BARYCENTER"; null for any
/// other name, and for the barycentre of Earth and Moon, which is not the Earth.
const CelestialBody* body_named(std::string_view name);

/// The body that has this gravitational parameter; null if none has.
const CelestialBody* body_with_mu(double mu_km3_s2);

}  // namespace hamjet
