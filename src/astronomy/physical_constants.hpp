#pragma once

namespace hamjet {

/// The Earth's angular velocity, rad/s (Geodetic Reference System 1980; IERS Conventions 2010,
/// table 1.2).
inline constexpr double earth_rate = 7.292115e-5;

/// IAU 2012 Resolution B2.
inline constexpr double astronomical_unit_km = 149597870.7;

/// The Sun's nominal radius (IAU 2015 Resolution B3).
inline constexpr double sun_radius_km = 695700;

/// The pressure of the Sun's light on what absorbs it, at one astronomical unit, N/m^2: the nominal
/// total solar irradiance of 1361 W/m^2 (IAU 2015 Resolution B3) over the speed of light.
inline constexpr double pressure_of_sun = 1361.0 / 299792458;

}  // namespace hamjet
