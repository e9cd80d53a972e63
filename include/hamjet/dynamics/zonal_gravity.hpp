#pragma once

#include "hamjet/detail/dynamics/zonal_coefficients.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Constants of a zonal gravity field, in any consistent units (canonical: mu = 1).
struct ZonalGravity {
  double mu = 1;
  double radius = 0;         ///< reference radius of the zonal coefficients
  ZonalCoefficients J = {};  ///< the Earth's J_2 is positive, its J_3 negative
};

/// The system in z = (x, y, z, p_x, p_y, p_z), momenta per unit mass, with
///
///   H = |p|^2/2 - mu/r [1 - sum_n J_n (R/r)^n P_n(z/r)],
///
/// P_n the Legendre polynomials, z along the axis of the body; without zonal coefficients it is
/// Kepler's problem. Source: Guibout and Bloch, section "Earth orbit", for n = 2 and 3; the sign
/// convention is theirs. No term above the highest n that is present is computed.
DynamicalSystem zonal_gravity(const ZonalGravity& field);

/// Kepler's problem, H = |p|^2/2 - mu/r, in three dimensions.
DynamicalSystem kepler(double mu = 1);

}  // namespace hamjet
