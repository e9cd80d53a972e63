#pragma once

#include <array>

#include "nodal_flight.hpp"

namespace hamjet {

/// An orbit of a zonal field whose eccentricity and pericentre are the same after each revolution:
/// a fixed point of the first return (q, p) -> (q', p') at its energy and H.
template <class Real>
struct FrozenOrbit {
  SixNumbers<Real> state;        ///< state on the section
  SixNumbers<Real> coordinates;  ///< the nodal chart's
  Real energy;
  Real period;  ///< time from section to section
  Real node;    ///< by how much the node advances in that time
  /// d q'/dq, d q'/dp, d p'/dq, d p'/dp at the energy and H; its determinant is 1.
  std::array<Real, 4> derivative;
  Real residual;       ///< the largest of |q' - q| and |p' - p|
  int iterations = 0;  ///< iterations of Newton's method

  /// The product of the multipliers is 1, and this is their sum; below 2 in size the orbit is
  /// stable to first order.
  Real trace() const { return derivative[0] + derivative[3]; }
};

/// The frozen orbit of the energy and H of `chief`, on its section and with its node, by Newton's
/// method on the return that is integrated at each iteration. The search begins at the chief, or,
/// where `from_circle` is set, at the nearly circular orbit that J2 and J3 freeze to first order,
///
///   e = -(J3 R sin i) / (2 J2 a) ,  pericentre at 90 degrees (270 where that is negative).
///
/// Throws Error(numerical) if none is found, with what was reached, and as first_return.
///
/// Source: G. E. Cook, "Perturbations of near-circular orbits by the Earth's gravitational
/// potential", Planetary and Space Science 14 (1966) 433; R. A. Broucke, "Numerical integration of
/// periodic orbits in the main problem of artificial satellite theory", Celest. Mech. Dyn. Astron.
/// 58 (1994) 99.
template <class Real>
FrozenOrbit<Real> find_frozen_orbit(const ZonalGravity& field, const SixNumbers<Real>& chief,
                                    bool from_circle, const GaussSettings& gauss);

}  // namespace hamjet
