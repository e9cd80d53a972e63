#pragma once

#include "hamjet/dynamics/osculating_elements.hpp"

namespace hamjet {

/// A planet in the theory of mean elements: a point mass and its flattening.
struct OblateBody {
  double mu_km3_s2 = 0;
  double radius_km = 0;  ///< reference radius of J2
  double J2 = 0;
};

/// The osculating state that belongs to a mean state. Mean elements are the osculating elements
/// without the periodic terms of first order in J2, both those with the period of the orbit and
/// those with the period of the perigee. A mean state is the Cartesian state that
/// state_from_elements makes of mean elements.
///
/// The periodic terms are Brouwer's, written in Lyddane's sense without division by e or sin i: the
/// canonical generating functions, with k = mu J2 R^2/2, p = G^2/mu, eta = G/L, u = f + g,
///
///   W_s = -k/(mu p G ... ) ,
///
/// are differentiated by Cartesian coordinates,
///
///   x = X + dW/dP ,   v = V - dW/dX .
///
/// Near 63.43 and 116.57 degrees, where 1 - 5 cos^2 i vanishes, the terms of long period have a
/// small divisor x. There (1 - exp(-100 x^2))/x takes the place of 1/x. It differs from 1/x by a
/// hundredth 2.7 degrees away and vanishes at the critical inclination, where these terms therefore
/// stay in the mean elements.
///
/// Terms of second order are left out: for the Earth they are some 1e-6 of the elements, or metres
/// in the semi-major axis. J3 and higher harmonics, whose terms are as large, are left out too.
/// Sources: D. Brouwer, The Astronomical Journal 64 (1959) 378; R. H. Lyddane, The Astronomical
/// Journal 68 (1963) 555; the divisor: W. E. Phipps, Parallelization of the Navy Space Surveillance
/// Center Satellite Model, thesis, Naval Postgraduate School (1992).
///
/// Throws Error(numerical) unless the orbit is an ellipse.
CartesianState osculating_of_mean(const CartesianState& mean, const OblateBody& body);

/// The mean state that belongs to an osculating state: the inverse of osculating_of_mean, to
/// rounding. Throws Error(numerical) unless the orbit is an ellipse, and if J2 is too large for the
/// iteration to converge.
CartesianState mean_of_osculating(const CartesianState& osculating, const OblateBody& body);

}  // namespace hamjet
