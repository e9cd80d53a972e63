#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../../maps/affine_symplectic_map.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The largest number of midpoint steps over all step sizes; more are refused.
inline constexpr double largest_transformed_step_count = 1e7;

/// A run stops if the condition of A_k, the matrix of f_k, exceeds this: rounding then hides the
/// energy errors that are compared.
inline constexpr double largest_transformation_condition = 1e12;

/// The midpoint scheme in the original coordinates z and in those of a discrete canonical
/// transformation, Z_k = f_k(z_k), with f_k = f composed k times. The study compares the energy
/// errors in both. Source: Guibout and Bloch, section "Applications of the discrete Hamilton-Jacobi
/// theory".
struct CanonicalTransformationStudy {
  std::string name;
  std::string title;
  SystemSettings system;
  CanonicalUnits units;
  double canonical_radius = 0;  ///< radius_km in canonical units
  std::vector<double> nominal;  ///< initial state (q, p), canonical
  double duration = 0;          ///< in canonical units, above 0
  std::vector<double> steps;    ///< canonical step sizes, all different; each has a run of its own
  /// The affine symplectic map f.
  AffineSymplecticMap<Extended> transformation = AffineSymplecticMap<Extended>::identity(1);
  /// If given, a check: the largest allowed difference of the two energy errors, in canonical
  /// units.
  std::optional<double> require_invariance;
};

/// One instant t_k of a run; energies are canonical and absolute.
struct CanonicalTransformationPoint {
  long step = 0;  ///< k
  double time = 0;
  std::vector<double> original;         ///< z_k, computed in z
  std::vector<double> transformed;      ///< Z_k, computed in Z
  double energy_error = 0;              ///< H(z_k) - H(z_0)
  double transformed_energy_error = 0;  ///< K_k(Z_k) - K_0(Z_0)
};

/// The discrete Hamilton-Jacobi equation with one kind of generating function of f_k, at the
/// midpoints of the steps at which that kind exists.
struct HamiltonJacobiCheck {
  long steps = 0;                            ///< number of steps at which the kind exists
  std::optional<double> largest_residual;    ///< absolute; no value if the kind exists nowhere
  std::optional<double> smallest_existence;  ///< existence_measure, by which round-off is divided
};

/// The results of one step size. Extrema are over all steps, including those that are not stored.
struct CanonicalTransformationRun {
  double step = 0;  ///< in canonical units: the duration is divided into equal steps not longer
                    ///< than requested
  double requested_step = 0;
  long steps = 0;
  std::string failure;  ///< if not empty, the reason why the run stopped; the rest covers the run
                        ///< up to there
  double largest_energy_error = 0;              ///< magnitude, in z
  double largest_transformed_energy_error = 0;  ///< magnitude, in Z
  double largest_energy_difference =
      0;  ///< largest difference of the two energy errors at the same instant
  double largest_state_difference = 0;      ///< largest component of f_k^-1(Z_k) - z_k
  double largest_condition = 0;             ///< largest condition of A_k, see AffineSymplecticMap
  double largest_symplecticity_defect = 0;  ///< largest relative defect of A_k
  HamiltonJacobiCheck first_kind;
  HamiltonJacobiCheck second_kind;
  /// The largest absolute residual of the discrete Hamilton-Jacobi equation, where each step uses
  /// the kind that is better conditioned there. No value if no kind exists anywhere.
  std::optional<double> hamilton_jacobi_residual;
  /// Whether q takes both signs and so crosses the barrier of the double well at q = 0. No value
  /// for other models.
  std::optional<bool> crosses_barrier;
  long stored_interval = 1;  ///< steps between stored points; the last point is stored too
  std::vector<CanonicalTransformationPoint> trajectory;
};

/// All results of the study.
struct CanonicalTransformationResult {
  CanonicalTransformationStudy study;
  double energy = 0;  ///< H(z_0)
  std::vector<CanonicalTransformationRun> runs;
};

/// Runs the study. A step without a solution, or a transformation that grows beyond use, ends its
/// run and is recorded there. Throws Error(too_large) for too many steps, Error(usage) for a study
/// whose sizes do not fit or that has no steps, Error(numerical) if the energy of the start is not
/// finite.
CanonicalTransformationResult run_study(const CanonicalTransformationStudy& study,
                                        const ProgressCallback& progress = {});

/// Exit code: 0, 1 (the check failed) or 4 (a run stopped).
int exit_code(const CanonicalTransformationResult& result);

}  // namespace hamjet
