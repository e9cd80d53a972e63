#pragma once

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The unit of the parameter of a time-scaled system. It is large, so that the parameter has no
/// influence where gradients of the force are compared, and a power of two, so that it rounds
/// nothing.
inline constexpr double scale_parameter_unit = 1024;

/// The orbits of a second-order system q' = p, p' = F(q) at another pace: with the time t = c s and
/// v = c p,
///
///   dq/ds = v ,   dv/ds = c^2 F(q) = (1 + m / unit) F(q) ,   m' = 0 ,
///
/// in (q, m; v, 0), four degrees of freedom. Every orbit has a constant pace of its own, so that
/// orbits of different periods can be integrated side by side over the same number of revolutions:
/// their shear along the orbit is contained in c alone, in closed form. Throws Error(usage) for a
/// system that depends on the time, as the next function does.
DynamicalSystem time_scaled(const DynamicalSystem& system);

/// The same orbits as a system of first order, at paces that may be zero at the chief: z' = c f(z),
/// c' = 0, in (q, c; p, 0).
DynamicalSystem time_scaled_first_order(const DynamicalSystem& system);

}  // namespace hamjet
