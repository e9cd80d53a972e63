#pragma once

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The family of multistep formulas.
enum class CvodeMethod {
  adams,  ///< Adams-Moulton, orders 1 to 12, solved by fixed-point iteration
  bdf,    ///< backward differentiation, orders 1 to 5, solved by Newton's iteration
};

/// Counts of the work of CVODE's solvers, for tests and benchmarks.
struct CvodeCounts {
  long error_test_failures = 0;
  long nonlinear_iterations = 0;
  long nonlinear_failures =
      0;  ///< iterations that did not converge, including those that were then repeated
  long jacobian_evaluations = 0;  ///< evaluations on series
  long factorisations = 0;        ///< factorisations of the matrix of one degree
  long linear_solves = 0;
};

/// How CVODE integrates.
struct CvodeSettings {
  CvodeMethod method = CvodeMethod::adams;
  double tolerance = 1e-6;        ///< relative and absolute tolerance, see integrate_cvode
  CvodeCounts* counts = nullptr;  ///< receives the counts, if given
  /// Whether to record the error estimates of the accepted steps, which takes one pass over the
  /// coefficients per step.
  bool records_step_error = false;
};

/// Whether this build contains CVODE.
bool cvode_available() noexcept;

/// Integrates the flow's jet with SUNDIALS CVODE: variable-order, variable-step multistep methods
/// on the coefficient equations. They are not symplectic: the exactness residual follows the
/// tolerance.
///
/// The linear systems (I - gamma J) x = b of Newton's iteration are solved exactly, degree by
/// degree: J couples a degree to lower ones only, and within a degree it is the Jacobian of the
/// vector field at the nominal, a 2n x 2n matrix, for every monomial.
///
/// The tolerance is both CVODE's relative and its absolute tolerance, for all coefficients. In each
/// step CVODE keeps the root mean square, over all coefficients c of all components, of
///
///   error estimate of c / (tolerance (1 + |c|))
///
/// below 1, so that the error of a single coefficient can exceed the tolerance by a factor up to
/// the square root of the number of coefficients. The absolute part is needed because coefficients
/// of degree 2 and more start from zero, where CVODE refuses a relative tolerance alone; where
/// coefficients grow large the relative part takes over. The tolerance is in the system's own
/// units.
///
/// The time runs to `duration` exactly, backwards too; duration 0 gives the identity exactly. The
/// observer sees every step. In `statistics`, rejected steps are steps that were repeated because
/// the error test or the nonlinear iteration failed.
///
/// Throws Error(usage) for a tolerance outside [2.3e-16, 1) or a build without CVODE,
/// Error(too_large) after 1e8 steps, Error(numerical), naming the time and CVODE's own flag, if
/// CVODE fails, if the vector field is not finite, if the step size underflows, or if the nominal's
/// energy shows that CVODE stepped over a singularity (which CVODE reports as success). This is a
/// change of the energy by more than 1 % + 1e3 tolerance (at most 10 %) of the energy itself or of
/// a hundredth of the terms that cancel in it.
///
/// Source: Hindmarsh et al., SUNDIALS, ACM TOMS 31 (2005) 363; CVODE 6 User Documentation.
FlowJet<double> integrate_cvode(const FlowProblem<double>& problem, const CvodeSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<double>& observer = {});

}  // namespace hamjet
