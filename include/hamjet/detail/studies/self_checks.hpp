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

/// What came out of one check.
struct SelfCheck {
  SelfCheckName name = SelfCheckName::finite;
  SelfCheckState state = SelfCheckState::off;
  std::optional<double> value;  ///< none where there is no such number, or it is not finite
  std::optional<double> limit;  ///< a value above it fails (surface: below it)
  double seconds = 0;           ///< that the check took, the measuring during the run included
  std::string text;             ///< one sentence: what was found, or why nothing was
};

/// Whether one of them has failed.
inline bool has_failed(const std::vector<SelfCheck>& checks) {
  return std::any_of(checks.begin(), checks.end(),
                     [](const SelfCheck& check) { return check.state == SelfCheckState::failed; });
}

/// The energy along a run's nominal, canonical units.
struct EnergyAlongNominal {
  double initial = 0;
  double largest_change = 0;  ///< of H, since the start
  double initial_terms = 0;   ///< size of the terms that cancel in H: |H| + sum |z_i dH/dz_i|
  double largest_terms = 0;   ///< largest |H| + sum |z_i dH/dz_i| along the nominal
  double seconds = 0;         ///< that the evaluation took
};

/// The point of a nominal nearest to the centre.
struct LowestPoint {
  double distance = 0;  ///< canonical
  double time = 0;      ///< canonical
  double seconds = 0;   ///< that the search took
  /// Not empty: after this time the nominal could not be followed down, and why.
  std::string failure;
  double failure_time = 0;
};

/// The estimated error of a run's jet; see estimate_error.
struct JetErrorEstimate {
  std::optional<std::vector<double>> by_degree;  ///< none if it was turned off or failed
  std::string failure;                           ///< not empty: there is none, and why
  double seconds = 0;                            ///< that it took

  /// The largest error over all degrees; `by_degree` must have a value.
  double largest() const { return *std::max_element(by_degree->begin(), by_degree->end()); }
};

/// How far inverted maps are from the inverses of a run's map, the worst of its kinds.
struct InversionQuality {
  double miss = 0;             ///< see inversion_miss
  double amplification = 0;    ///< see PartialInversion
  std::string missing_kind;    ///< that has the largest miss
  std::string amplified_kind;  ///< that has the largest amplification
  int kinds = 0;               ///< that were composed
  double seconds = 0;          ///< that the composition took
};

/// All checks of one run, in the order of the enumeration. In detail, with epsilon the rounding of
/// the run's numbers:
///
/// finite: the number of coefficients (jet, generating functions), residuals and other results that
/// are not finite in the precision in which they are stored; 0 is right.
///
/// convergence: the most iterations that Newton's method took in a step, 0 where fixed-point
/// iteration sufficed in all of them. No limit by default, for a step whose equations are not
/// solved to round-off is an error.
///
/// step-error: the largest local error estimate of an accepted step. Limits: the tolerance, ten
/// times that for Gauss, which repeats a step beyond that; 5 for fixed steps of Gauss: the slope
/// at the start of a step is then missed by a sixth, and the motion is not resolved.
///
/// energy: the largest change of H along the nominal, relative to max(|H|, T/100), T being the
/// terms that cancel in H at the start. Limit: 0.1, beyond which the nominal is another orbit; with
/// adaptive steps at most 10 (tolerance + epsilon) a step, times the largest T over that scale.
///
/// symplecticity: scaled defect of the Poisson brackets of the degree d that exceeds its limit
/// most, of methods that are symplectic in (q, p). Limit: 1000 epsilon sqrt((1 + steps) M) g^d, at
/// most 1e-6, M >= 1 being the largest coefficient of degree 1 and g >= 1 the largest frequency of
/// the linearised motion along the nominal over that at its end: stiff systems amplify rounding,
/// and so do close passages, where coefficients of degree d are larger by the d-th power of the
/// frequency.
///
/// inversion: fails where the composition misses the identity by more than max(1e-20, epsilon) of
/// its terms; else the value is epsilon times the amplification of rounding in the inverted linear
/// part, and the limit 1e-4.
///
/// surface: smallest distance from the centre in km, between steps too. Limit: radius_km.
///
/// error-estimate: the estimated error of the degree that exceeds its limit most, see
/// estimate_error. Limit with a tolerance: error_estimate_safety times the sum of 100 tolerance n,
/// n being the periods of the linearised motion (IntegrationStatistics::periods) for Gauss and the
/// steps for other methods, at least 1; and of twenty rounding floors, at most 1e-3, a rounding
/// floor being the larger of what shorter steps did not take away (rounding_by_degree, of four
/// draws where one would fail the run) and sqrt(1 + steps) times what half-ulp changes of the start
/// change in the degree. Fixed steps promise nothing, and have a limit only where the scene sets
/// one, for all degrees; where a degree has not one right digit the text says so.
std::vector<SelfCheck> self_checks(const Scene& scene, const RunResult& run);

}  // namespace hamjet
