#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/integrators/energy_conserving.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The outcome of the integration that a scene expects.
enum class EnergyConservationOutcome { completes, stops };

/// The outcomes' names in scenes, in the order of the enumeration.
const std::vector<std::string_view>& energy_conservation_outcome_names();

/// Study "energy-conservation": a trajectory by an energy-conserving symplectic method, beside one
/// with fixed steps. All numbers are canonical.
struct EnergyConservationStudy {
  std::string name;
  std::string title;
  SystemSettings system;
  CanonicalUnits units;
  double canonical_radius = 0;  ///< radius_km in canonical units
  std::vector<double> nominal;  ///< initial state (q, p)
  EnergyConservingMethod method = EnergyConservingMethod::midpoint;
  double first_step = 0;  ///< positive
  double duration = 0;    ///< negative is backwards
  EnergyConservationOutcome expected = EnergyConservationOutcome::completes;
  std::optional<double> require_energy_error;  ///< if given, a check: the largest allowed relative
                                               ///< discrete energy error
};

/// A point of a trajectory. Energies are relative to |H(z_0)| (absolute if that is 0) and evaluated
/// in extended precision, so that their own rounding hides nothing.
struct EnergyConservationPoint {
  long step = 0;               ///< number of steps before it
  double time = 0;             ///< in canonical units
  std::optional<double> size;  ///< size of the step that starts here; no value at the last point
  std::vector<double> state;   ///< (q, p)
  std::optional<double> discrete;  ///< (H_d - E) / |H(z_0)| of the step that starts here
  double energy_error = 0;         ///< (H(z_k) - H(z_0)) / |H(z_0)|
  double condition = 0;            ///< StepCondition
  int newton_iterations = 0;       ///< iterations of the step that starts here
};

/// The method with fixed steps for comparison: the midpoint rule, or velocity Verlet for Störmer.
struct FixedStepTrajectory {
  std::string method;
  double step = 0;  ///< the mean step of the energy-conserving trajectory
  long steps = 0;   ///< number of steps taken
  /// Canonical times, and energy errors as in EnergyConservationPoint. The trajectory continues to
  /// the end of the duration, or to a million steps, even if the energy-conserving one stops.
  std::vector<std::pair<double, double>> energy_errors;
  double largest_energy_error = 0;
  std::string failure;  ///< if not empty, the reason why it ended early
};

/// All results of the study.
struct EnergyConservationResult {
  EnergyConservationStudy study;
  EnergyConservingResult<double> run;
  /// At most 20001 points, evenly thinned; the first and the last point are kept.
  std::vector<EnergyConservationPoint> points;
  double largest_discrete_error = 0;  ///< over all steps, as EnergyConservationPoint::discrete
  double largest_energy_error = 0;    ///< over all points
  double smallest_step = 0;           ///< magnitudes; 0 if no step was taken
  double largest_step = 0;
  FixedStepTrajectory fixed_step;
  /// If the trajectory stopped: the time nearest to the stop at which StepCondition changes sign
  /// along the exact flow, where the method is predicted to stop in the limit of small steps. No
  /// value if no such time is near.
  std::optional<double> predicted_time;
  std::vector<std::string> failed_checks;  ///< one line each

  /// Exit code: 0; 1 (a check failed, or another outcome than expected); 4 (an unexpected stop).
  int exit_code() const;
  /// One line with the reason why the exit code is not 0; otherwise empty.
  std::string failure() const;
};

/// Runs the study. A stop is a result; throws Error(too_large) for more than
/// largest_energy_conserving_step_count steps, and what `progress` throws.
EnergyConservationResult run_study(const EnergyConservationStudy& study,
                                   const ProgressCallback& progress = {});

}  // namespace hamjet
