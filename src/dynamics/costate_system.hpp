#pragma once

#include <span>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The sum lambda . f(x, t) of a system's vector field along its costates. The expressions begin
/// with x and lambda, and end with the time if the field depends on it.
Expression costates_along_field(const DynamicalSystem& system, std::span<const Expression> z);

/// The Hamiltonian system of the states x = (q, p) of a system with n degrees of freedom, which are
/// its 2n positions, and of their costates lambda, its 2n momenta, when a force u is added to p'
/// such that the integral of |u|^2 / 2 between given ends is least. Pontryagin's principle gives
///
///   u = -lambda_p ,   H(x, lambda, t) = lambda . f(x, t) - |lambda_p|^2 / 2
///
/// with the system's vector field f, which need not be Hamiltonian. H is quadratic in the costates,
/// and paths with lambda = 0 are those of the system itself. The generating function F1(x, x0) of
/// its flow is minus the least integral, because lambda . x' - H = -|lambda_p|^2 / 2.
/// Source: Park, Guibout and Scheeres, Solving optimal continuous thrust rendezvous problems with
/// generating functions, J. Guidance, Control, and Dynamics 29 (2006) 321.
/// Throws Error(usage) for a system whose states end with parameters.
DynamicalSystem costate_system(const DynamicalSystem& system);

}  // namespace hamjet
