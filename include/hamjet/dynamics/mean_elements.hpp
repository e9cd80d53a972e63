#pragma once

#include "hamjet/dynamics/osculating_elements.hpp"

namespace hamjet {

/// A planet as the theory of mean elements knows it: a point mass and its flattening.
struct OblateBody {
  double mu_km3_s2 = 0;
  double radius_km = 0;  ///< that J2 refers to
  double J2 = 0;
};

/// The osculating state of a mean one: mean elements are what is left of the osculating ones
/// without the periodic terms of first order in J2, those of the period of the orbit and those of
/// the period of the perigee. Mean states are Cartesian, of the same formulas as osculating ones;
/// their elements, by state_from_elements and its inverse, are the mean elements.
///
/// The terms are Brouwer's, with e, i and the anomaly nowhere divided by, in Lyddane's sense: the
/// canonical generating functions, with k = mu J2 R^2/2, p = G^2/mu, eta = G/L, u = f + g,
///
///   W_s = -k/(mu p G ... ) ,
///
/// are differentiated by Cartesian coordinates,
///
///   x = X + dW/dP ,   v = V - dW/dX .
///
/// Where 1 - 5 cos^2 i vanishes the terms of long period have a small divisor; (1 - exp(-100
/// x^2))/x stands for 1/x, which differs from it near 63.43 and 116.57 degrees only, by a hundredth
/// of it 2.7 degrees away and by all there, so that at the critical inclination these terms stay in
/// the mean elements.
///
/// What is left out is of second order: for the Earth some 1e-6 of the elements, metres of the
/// semi-major axis. J3 and higher harmonics, whose terms are as large, are left out too. Sources:
/// D. Brouwer, The Astronomical Journal 64 (1959) 378; R. H. Lyddane, The Astronomical Journal 68
/// (1963) 555; the divisor: W. E. Phipps, Parallelization of the Navy Space Surveillance Center
/// Satellite Model, thesis, Naval Postgraduate School (1992).
///
/// Throws Error(numerical) unless the orbit is an ellipse.
CartesianState osculating_of_mean(const CartesianState& mean, const OblateBody& body);

/// The mean state of an osculating one: the inverse of osculating_of_mean, to rounding. Throws
/// Error(numerical) likewise, and if J2 is too large for the iteration to converge.
CartesianState mean_of_osculating(const CartesianState& osculating, const OblateBody& body);

}  // namespace hamjet
