#pragma once

#include <functional>
#include <string>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A fixed-step method on a linear system, in the form that the search for its stability limit
/// needs.
struct LinearSteps {
  std::string method;  ///< name for the message
  /// The matrix of one step of this size in z = (q, p). The size has the sign of the duration.
  std::function<Matrix<double>(double step)> matrix;
  double step = 0;      ///< step of the run, with the sign of the duration
  double duration = 0;  ///< duration of the run
  /// Whether the map preserves a two-form (in any variables). Then no eigenvalue of a stable step
  /// leaves the unit circle. Other methods may damp or grow slowly, which is part of their error.
  bool preserves_a_two_form = true;
};

/// Throws Error(numerical) if the run's step exceeds the method's limit of linear stability on a
/// system with a constant Jacobian: some amplitude that the flow preserves would grow without bound
/// for almost any start. The message names omega tau, the frequency of the fastest oscillation
/// times the step, with its limit, and the step at the limit.
///
/// A step is unstable if the spectral radius of its matrix, found by the matrix itself and not from
/// a table, exceeds the growth of the flow by more than the rounding of its eigenvalues; for a
/// method that preserves no two-form, by more than 1 % over the whole run.
///
/// Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, section I.5.2 (linear
/// stability of explicit symplectic methods).
void require_stable_steps(const DynamicalSystem& system, const LinearSteps& steps);

}  // namespace hamjet
