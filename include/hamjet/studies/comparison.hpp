#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// What a comparison finds of a run: whether its map is exact (symplectic), and whether its
/// coefficients are accurate.
enum class Corner {
  exact_and_accurate,
  exact_but_wrong,
  accurate_not_symplectic,
  neither,
};

/// The corners' names in results, in the order of the enumeration.
const std::vector<std::string_view>& corner_names();

/// A run is called exact if its scaled symplecticity defect, over all degrees, is at most this. A
/// method that is not symplectic comes below it too where its error is at round-off: no measurement
/// can then tell the two apart.
inline constexpr double largest_exact_defect = 1e-13;

/// One integrator with one step or tolerance at one order, and all that was measured of it.
struct ComparedRun {
  IntegratorSettings settings;  ///< the label is unique among the runs of one order
  std::string series;           ///< runs that differ in step or tolerance alone share it
  int order = 0;                ///< of the jet
  std::string failure;          ///< not empty: a numerical failure, and which
  std::string left_out;         ///< not empty: not run, and why
  IntegrationStatistics statistics;
  double multiply_adds = 0;             ///< of the products of series, all evaluations together
  double memory_bytes = 0;              ///< of the integrator's series, estimated
  std::vector<double> seconds;          ///< of the integration alone, one entry a repeat
  std::vector<double> error_by_degree;  ///< see relative_error_by_degree
  /// Errors estimated without the reference, see estimate_error; empty where the independent run
  /// failed.
  std::vector<double> error_estimate_by_degree;
  double error_at_formation_m = 0;        ///< see ComparisonResult::separation_points
  std::vector<ExactnessEntry> exactness;  ///< of ComparisonResult::kind; empty if there is none
  std::string exactness_failure;          ///< not empty: the kind does not exist for this run's map
  std::vector<SymplecticityDefect> symplecticity;  ///< by degree; degree 0 is the linear part
  double energy_error = 0;                         ///< largest magnitude along the nominal
  std::optional<Corner> corner;  ///< none where the jet is not a full map of phase space

  bool is_finished() const { return failure.empty() && left_out.empty(); }
  double median_seconds() const;          ///< 0 before the first timing
  double largest_error() const;           ///< of all degrees
  double largest_error_estimate() const;  ///< of all degrees; infinite without estimate
  double largest_symplecticity() const;   ///< scaled, of all degrees
};

/// A fitted order of convergence: slope of log error against log step.
struct ConvergenceFit {
  std::string series;
  int degree = 0;
  double slope = 0;
  double expected = 0;              ///< what theory predicts
  std::vector<std::string> labels;  ///< of the runs used: those above the rounding floor
  /// Step (canonical) and relative error of the runs used, the finest first.
  std::vector<std::pair<double, double>> points = {};
  /// Whether the runs were made for the fit in extended precision, with smaller steps than double
  /// precision resolves, and the next term of the error's expansion is fitted too.
  bool is_extended = false;
  /// The fraction of the duration, from its start, over which the fitted runs went.
  double arc = 1;

  /// Whether the slope is within 0.3 of theory. Where it is not, the leading term does not yet
  /// dominate at the steps that could be run.
  bool agrees() const { return std::abs(slope - expected) <= 0.3; }
};

/// Result of a comparison. Every number of the report comes from here.
struct ComparisonResult {
  Scene scene;
  bool is_complete = false;
  ReferenceResult reference;  ///< of the largest order that is compared
  bool is_reference_cached = false;
  std::optional<GeneratingFunctionKind> kind;  ///< whose exactness is stated: the scene's first, or
                                               ///< the best conditioned; none without a full jet
  double kind_condition = 0;
  std::size_t separation_points =
      0;                          ///< deviations over which error_at_formation_m is the greatest
  std::vector<ComparedRun> runs;  ///< at the scene's order
  std::vector<ComparedRun> cost_runs;    ///< one configuration a method over the orders
  std::vector<RunAlongTime> along_time;  ///< the scene's own integrators
  std::vector<ConvergenceFit> fits;

  /// Relative errors below this are the reference's own as well: ten times its uncertainty. 0 for a
  /// degree that the reference does not have.
  double smallest_claimed_error(int degree) const;
  /// Values of error_at_formation_m below this, in metres, are not claimed: it is the most that
  /// smallest_claimed_error adds up to at that separation. 0 before there is a reference.
  double smallest_claimed_error_m() const;
};

/// An integrator to compare. Without `integrate` the settings name the method.
struct Candidate {
  IntegratorSettings settings;
  std::function<FlowJet<double>(const FlowProblem<double>&, IntegrationStatistics&,
                                const StepObserver<double>&)>
      integrate = {};
};

/// Candidates that differ in step or tolerance alone, the coarsest first.
struct CandidateSeries {
  std::string name;
  double order = 0;  ///< of convergence, for fixed steps; 0 where it is not to be fitted
  bool stops_at_round_off = false;  ///< finer ones are not run once the error no longer falls
  std::vector<Candidate> candidates;
};

/// What the scene's `[compare]` table asks for, its defaults filled in. Labels are unique.
std::vector<CandidateSeries> candidate_series(const Scene& scene);

/// Keeps references from one comparison to the next. A reference is found again by a text that
/// holds all that determines it.
class ReferenceStore {
 public:
  virtual ~ReferenceStore() = default;
  /// The reference stored under a key, in the series of `space`; none if there is none that can be
  /// read.
  virtual std::optional<ReferenceResult> load(const std::string& key,
                                              const SpacePointer& space) = 0;
  /// Stores a reference. Best effort: a failure is ignored.
  virtual void save(const std::string& key, const ReferenceResult& reference) = 0;
};

/// Everything that determines a scene's reference of one order, as text.
std::string reference_key(const Scene& scene, int order);

/// Everything that determines a comparison's figures apart from times, as text: two comparisons may
/// be merged only if theirs agree.
std::string comparison_key(const Scene& scene);

/// What a comparison is given beside its scene.
struct ComparisonOptions {
  ProgressCallback progress = {};
  ReferenceStore* references = nullptr;
  /// Called between integrations, when `result` holds whole entries only: the place to save it.
  std::function<void()> checkpoint = {};
  std::vector<CandidateSeries> series = {};  ///< empty: candidate_series(scene)
};

/// Compares integrators on a scene: every candidate is integrated and judged against the reference
/// once, then all are timed in turns, so that a noisy machine hurts all alike. `result` may hold
/// what an interrupted comparison of the same scene had finished, which is not done again; it is
/// filled as the work goes on, and is worth keeping when `progress` throws.
///
/// Errors below ten times the reference's uncertainty are not claimed. Throws Error(scene) for a
/// scene that cannot be compared, Error(numerical) if the reference fails or does not agree with
/// itself to 1e-13. Failures of candidates are recorded in their runs.
void compare(const Scene& scene, const ComparisonOptions& options, ComparisonResult& result);

/// For each series the fastest run whose error at formation scale is at most `error_m` metres; the
/// fastest series first.
std::vector<const ComparedRun*> cheapest_runs(const ComparisonResult& result, double error_m);

/// What the comparison says in one sentence, with numbers.
std::string verdict(const ComparisonResult& result);

/// The cheapest configuration that reaches the wanted error, as `[[integrator]]` lines ready for a
/// scene; a comment that says so where none does.
std::string advice(const ComparisonResult& result);

}  // namespace hamjet
