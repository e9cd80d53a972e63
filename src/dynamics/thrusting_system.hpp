#pragma once

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// What the thrust of a system with costates depends on.
enum class ThrustForm {
  linear,    ///< u = -c lambda_v
  directed,  ///< u = -(c - b / |lambda_v|) lambda_v, which is not defined where lambda_v = 0
  falling,   ///< u = -a exp(w k) lambda_v / |lambda_v|, with the change w = integral of |u|
};

/// A system of three degrees of freedom with its costates, as costate_system has them, under a
/// thrust u that acts on the momenta: the Hamiltonian
///
///   H = lambda_x . f(x, t) - c |lambda_v|^2 / 2 + b |lambda_v| ,
///
/// in (x, lambda_x), whose states end with the parameters c and, of a directed thrust, b. A coast
/// has c = 0, and a thrust of the size a along the primer vector -lambda_v has c = 0 and b = -a.
/// Where the mass falls, the acceleration a grows by the change w that was spent, k being one over
/// the speed of the exhaust: positions end with w, momenta with its costate, and
///
///   H = lambda_x . f(x, t) + a exp(w k) (lambda_w - |lambda_v|) ,
///
/// whose states end with the parameters a and k.
/// Throws Error(usage) for a system with parameters.
DynamicalSystem thrusting_system(const DynamicalSystem& system, ThrustForm form);

}  // namespace hamjet
