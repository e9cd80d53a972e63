#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/self_check_settings.hpp"

namespace hamjet {

struct Scene;
struct RunResult;

enum class SelfCheckState { passed, failed, off, not_applicable };

/// The states' names in results.
std::string_view name_of(SelfCheckState state);

/// The result of one check.
struct SelfCheck {
  SelfCheckName name = SelfCheckName::finite;
  SelfCheckState state = SelfCheckState::off;
  /// No value if the check has no number, or a number that is not finite.
  std::optional<double> value;
  std::optional<double> limit;  ///< a value above the limit fails (for surface: below it)
  double seconds = 0;           ///< time of the check, including measurements during the run
  std::string text;             ///< one sentence: the finding, or the reason why there is none
};

/// Whether one of the checks has failed.
inline bool has_failed(const std::vector<SelfCheck>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const SelfCheck& check) { return check.state == SelfCheckState::failed; });
}

/// The energy along the nominal of a run, in canonical units.
struct EnergyAlongNominal {
  double initial = 0;
  double largest_change = 0;  ///< largest change of H since the start
  double initial_terms = 0;   ///< size of the terms that cancel in H: |H| + sum |z_i dH/dz_i|
  double largest_terms = 0;   ///< largest |H| + sum |z_i dH/dz_i| along the nominal
  double seconds = 0;         ///< time of the evaluation
};

/// The point of a nominal nearest to the centre.
struct LowestPoint {
  double distance = 0;  ///< in canonical units
  double time = 0;      ///< in canonical units
  double seconds = 0;   ///< time of the search
  /// If not empty, the reason why the nominal could not be followed after `time`.
  std::string failure;
  double failure_time = 0;
};

/// The estimated error of a run's jet; see estimate_error.
struct JetErrorEstimate {
  /// No value if the estimate was turned off or failed.
  std::optional<std::vector<double>> by_degree;
  std::string failure;  ///< if not empty, the reason why there is no estimate
  double seconds = 0;   ///< time of the estimate

  /// The largest error over all degrees; `by_degree` must have a value.
  double largest() const { return *std::max_element(by_degree->begin(), by_degree->end()); }
};

/// The worst deviation, over its kinds, of inverted maps from the inverse of a run's map.
struct InversionQuality {
  double miss = 0;             ///< see inversion_miss
  double amplification = 0;    ///< see PartialInversion
  std::string missing_kind;    ///< kind with the largest miss
  std::string amplified_kind;  ///< kind with the largest amplification
  int kinds = 0;               ///< number of kinds that were composed
  double seconds = 0;          ///< time of the compositions
};

/// All checks of one run, in the order of the enumeration. With epsilon the rounding of the run's
/// numbers, they are:
///
/// finite: the number of coefficients (jet, generating functions), residuals and other results that
/// are not finite in the precision in which they are stored; 0 is right.
///
/// convergence: the largest number of iterations of Newton's method in a step; 0 if fixed-point
/// iteration sufficed in all steps. There is no limit by default, because a step whose equations
/// are not solved to round-off is an error anyway.
///
/// step-error: the largest local error estimate of an accepted step. The limit is the tolerance;
/// for Gauss, which repeats steps beyond it, ten times the tolerance; and 5 for fixed steps of
/// Gauss, at which the slope at the start of a step has an error of a sixth and the motion is not
/// resolved.
///
/// energy: the largest change of H along the nominal, relative to max(|H|, T/100), where T is the
/// size of the terms that cancel in H at the start. The limit is 0.1, beyond which the nominal is
/// another orbit. With adaptive steps it is at most 10 (tolerance + epsilon) per step, times the
/// ratio of the largest T to this scale.
///
/// symplecticity: for methods that are symplectic in (q, p), the scaled defect of the Poisson
/// brackets of the degree d that is worst relative to its limit. The limit is 1000 epsilon sqrt((1
/// + steps) M) g^d, at most 1e-6. M >= 1 is the largest coefficient of degree 1, and g >= 1 the
/// ratio of the largest frequency of the linearised motion along the nominal to that at its end.
/// Stiff systems amplify rounding, and so do close passages, where coefficients of degree d are
/// larger by the d-th power of the frequency.
///
/// inversion: the check fails if the composition misses the identity by more than max(1e-20,
/// epsilon) of its terms. Otherwise the value is epsilon times the amplification of rounding in the
/// inverted linear part, and the limit is 1e-4.
///
/// surface: the smallest distance from the centre in km, also between the steps. The limit is
/// radius_km.
///
/// error-estimate: the estimated error of the degree that is worst relative to its limit, see
/// estimate_error. With a tolerance, the limit is the sum of two terms. The first is 100 tolerance
/// n, where n, at least 1, is the number of periods of the linearised motion
/// (IntegrationStatistics::periods) for Gauss, and of steps for other methods. The second is twenty
/// rounding floors, at most 1e-3. A rounding floor is the larger of two numbers: the error that
/// shorter steps did not remove (rounding_by_degree; from four draws if a single one would fail the
/// run), and sqrt(1 + steps) times the change of the degree that half-ulp changes of the start
/// cause. Fixed steps promise no error, and have a limit only if the scene sets one, for all
/// degrees; if a degree has no right digit, the text says so.
std::vector<SelfCheck> self_checks(const Scene& scene, const RunResult& run);

}  // namespace hamjet
