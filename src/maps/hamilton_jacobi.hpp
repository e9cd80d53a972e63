#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/maps/generating_function.hpp"

// The Hamilton-Jacobi equation of the generating functions of a flow's deviations from its nominal:
//
//   dS/dt|_w + H^h(z(w), t) = 0 ,
//
// H^h the relative Hamiltonian (degree 2..N+1 about the nominal), z(w) the final deviations as
// series in the kind's variables w: the chosen ones are variables themselves, the others
// `remaining_final`. It holds for every kind, for dS = sigma dw - H^h dt. Source:
// Goldstein, Classical Mechanics (1980), sections 9-1 and 10-1; H^h from Guibout and Bloch, eq.
// l_hamilton_n.
//
// Notation: w = (w_f, w_c), the chosen final and initial variables; R(w, t) and D(w, t) the
// remaining final and initial ones; X = (X_f, X_R) the relative vector field, split alike.

namespace hamjet {

/// The derivatives d/dt|_w of the remaining variables of an inverted jet: `kind` and `condition`
/// are copied, `remaining_final` is dR/dt and `remaining_initial` dD/dt, of degree N in w per unit
/// of time. They come from the differential equations, not from differences: along a trajectory D
/// and w_c are constants, and so
///
///   w_f' = X_f(z(w)),   R(w, t)' = X_R(z(w)),   D(w, t)' = 0   give
///   dR/dt|_w = X_R(z(w)) - (dR/dw_f) X_f(z(w)),   dD/dt|_w = -(dD/dw_f) X_f(z(w)) .
///
/// X is the system's own vector field about `nominal`, the nominal's state at the jet's time (the
/// jet's constants), in the system's units. Since X begins at degree 1, the degree N of the
/// derivatives of R and D, which is unknown, is not needed. Throws Error(usage) if the sizes of
/// system, nominal and inversion do not fit.
template <class T>
PartialInversion<T> time_derivative(const DynamicalSystem& system, std::span<const T> nominal,
                                    const PartialInversion<T>& inversion);

/// The relative Hamiltonian in the variables w, H^h(z(w)), of degree 2..N+1: z(w) is known to
/// degree N, which suffices because H^h begins at degree 2. Throws what time_derivative throws.
template <class T>
Series<T> hamiltonian_in_variables(const DynamicalSystem& system, std::span<const T> nominal,
                                   const PartialInversion<T>& inversion);

/// How far a generating function is from solving the Hamilton-Jacobi equation at one degree: the
/// largest coefficient of dS/dt|_w + H^h(z(w)).
struct HamiltonJacobiResidual {
  int degree = 0;
  double absolute = 0;
  /// The absolute residual divided by the largest coefficient of H^h(z(w)) of this degree, of which
  /// dS/dt is the negative. This is stricter than a division by the sum of the absolute values of
  /// all terms, which is larger by a factor of 2 to 10 on the paper's orbit.
  double scaled = 0;
};

/// Residual and Hamiltonian of the Hamilton-Jacobi equation at one point w, by degree 2..N+1.
struct HamiltonJacobiTerms {
  std::vector<double> residual;     ///< contribution of dS/dt|_w + H^h(z(w)), by degree
  std::vector<double> hamiltonian;  ///< contribution of H^h(z(w)), by degree

  /// Sum of the magnitudes of the residuals over that of the Hamiltonian's contributions: how far
  /// the equation fails for these boundary values. Unlike the largest coefficient of a degree, this
  /// ratio ignores coefficients that contribute nothing at w, in which the inversion has amplified
  /// round-off. It is 0 where both sums vanish.
  double scaled() const {
    const auto size = [](const std::vector<double>& terms) {
      double sum = 0;
      for (const double term : terms) sum += std::abs(term);
      return sum;
    };
    const double scale = size(hamiltonian);
    return scale > 0 ? size(residual) / scale : size(residual);
  }
};

/// Evaluates the Hamilton-Jacobi equation at `w`, the kind's chosen final deviations, then the
/// chosen initial ones. Throws what time_derivative throws.
template <class T>
HamiltonJacobiTerms hamilton_jacobi_terms(const DynamicalSystem& system, std::span<const T> nominal,
                                          const PartialInversion<T>& inversion,
                                          std::span<const double> w);

/// Residuals of the degrees 2..N+1 for an inverted jet of any kind. dS/dt is the homotopy integral,
/// as for S, of the one-form of time_derivative.
///
/// With c_ij = d sigma_i / d w_j - d sigma_j / d w_i and j over the final pairs, the residual is
///
///   (dS/dt + H^h)_(d+1) = (1/(d+1)) sum over i and j of w_i (c_ji X_j)_d ,
///
/// plus any difference between vector field and Hamiltonian. The residual vanishes for every
/// symplectic jet, however inaccurate. It therefore checks the signs of the one-form, the
/// Hamiltonian against the equations of motion, and that the one-form is closed, except in pairs of
/// two initial variables. It says nothing about the jet's accuracy. As with exactness_residual, the
/// inversion's conditioning amplifies round-off. Throws what time_derivative throws.
template <class T>
std::vector<HamiltonJacobiResidual> hamilton_jacobi_by_degree(const DynamicalSystem& system,
                                                              std::span<const T> nominal,
                                                              const PartialInversion<T>& inversion);

}  // namespace hamjet
