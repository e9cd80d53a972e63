#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The verdict of a comparison on a run: whether its map is exact (symplectic), and whether its
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
/// method that is not symplectic also counts as exact if its error is at round-off: no measurement
/// can then distinguish the two.
inline constexpr double largest_exact_defect = 1e-13;

/// One integrator with one step or tolerance at one order, and all measurements of it.
struct ComparedRun {
  IntegratorSettings settings;  ///< the label is unique among the runs of one order
  std::string series;   ///< name of the series; runs that differ only in step or tolerance share it
  int order = 0;        ///< order of the jet
  std::string failure;  ///< if not empty, the numerical failure
  std::string left_out;  ///< if not empty, the reason why it was not run
  IntegrationStatistics statistics;
  double multiply_adds = 0;     ///< multiply-adds of the products of series, in all evaluations
  double memory_bytes = 0;      ///< estimated memory of the integrator's series
  std::vector<double> seconds;  ///< time of the integration alone, one entry for each repetition
  std::vector<double> error_by_degree;  ///< see relative_error_by_degree
  /// Errors estimated without the reference, see estimate_error; empty if the independent run
  /// failed.
  std::vector<double> error_estimate_by_degree;
  double error_at_formation_m = 0;  ///< see ComparisonResult::separation_points
  /// Exactness of ComparisonResult::kind; empty if there is no kind.
  std::vector<ExactnessEntry> exactness;
  std::string exactness_failure;  ///< if not empty, the reason why the kind does not exist for this
                                  ///< run's map
  std::vector<SymplecticityDefect> symplecticity;  ///< by degree; degree 0 is the linear part
  double energy_error = 0;                         ///< largest magnitude along the nominal
  std::optional<Corner> corner;  ///< no value if the jet is not a full map of phase space

  bool is_finished() const { return failure.empty() && left_out.empty(); }
  double median_seconds() const;          ///< 0 before the first timing
  double largest_error() const;           ///< over all degrees
  double largest_error_estimate() const;  ///< over all degrees; infinite without an estimate
  double largest_symplecticity() const;   ///< scaled, over all degrees
};

/// A fitted order of convergence: the slope of log error against log step.
struct ConvergenceFit {
  std::string series;
  int degree = 0;
  double slope = 0;
  double expected = 0;  ///< order predicted by theory
  /// Labels of the runs in the fit, which lie above the rounding floor.
  std::vector<std::string> labels;
  /// Step (canonical) and relative error of the runs in the fit, the finest first.
  std::vector<std::pair<double, double>> points = {};
  /// Whether the runs were made for the fit, in extended precision, with smaller steps than double
  /// precision resolves. The next term of the error's expansion is then fitted too.
  bool is_extended = false;
  /// The fraction of the duration, from its start, that the fitted runs cover.
  double arc = 1;

  /// Whether the slope is within 0.3 of theory. If not, the leading term does not yet dominate at
  /// the steps that could be run.
  bool agrees() const { return std::abs(slope - expected) <= 0.3; }
};

/// Result of a comparison. Every number of the report comes from here.
struct ComparisonResult {
  Scene scene;
  bool is_complete = false;
  ReferenceResult reference;  ///< reference at the largest order that is compared
  bool is_reference_cached = false;
  std::optional<GeneratingFunctionKind>
      kind;  ///< kind whose exactness is reported: the scene's first, or the best conditioned one;
             ///< no value without a full jet
  double kind_condition = 0;
  std::size_t separation_points =
      0;  ///< separation: error_at_formation_m is the greatest error over deviations of this size
  std::vector<ComparedRun> runs;         ///< runs at the scene's order
  std::vector<ComparedRun> cost_runs;    ///< one configuration of each method, over the orders
  std::vector<RunAlongTime> along_time;  ///< the scene's own integrators
  std::vector<ConvergenceFit> fits;

  /// Relative errors below this number, ten times the reference's uncertainty, may be errors of the
  /// reference. It is 0 for a degree that the reference does not have.
  double smallest_claimed_error(int degree) const;
  /// Values of error_at_formation_m below this, in metres, are not claimed: it is the largest error
  /// at that separation that coefficients with errors of smallest_claimed_error can cause. It is 0
  /// before there is a reference.
  double smallest_claimed_error_m() const;
};

/// An integrator to compare. Without `integrate`, the settings name the method.
struct Candidate {
  IntegratorSettings settings;
  std::function<FlowJet<double>(const FlowProblem<double>&, IntegrationStatistics&,
                                const StepObserver<double>&)>
      integrate = {};
};

/// Candidates that differ only in step or tolerance, the coarsest first.
struct CandidateSeries {
  std::string name;
  double order = 0;  ///< order of convergence, for fixed steps; 0 if it is not to be fitted
  bool stops_at_round_off =
      false;  ///< whether finer candidates are skipped once the error no longer falls
  std::vector<Candidate> candidates;
};

/// The series that the scene's table `[compare]` asks for, with defaults filled in. Labels are
/// unique.
std::vector<CandidateSeries> candidate_series(const Scene& scene);

/// Keeps references from one comparison to the next. The key of a reference is a text that contains
/// everything that determines it.
class ReferenceStore {
 public:
  virtual ~ReferenceStore() = default;
  /// The reference stored under a key, in the series of `space`; no value if there is none that can
  /// be read.
  virtual std::optional<ReferenceResult> load(const std::string& key,
                                              const SpacePointer& space) = 0;
  /// Stores a reference. A failure to store it is ignored.
  virtual void save(const std::string& key, const ReferenceResult& reference) = 0;
};

/// Everything that determines a scene's reference of one order, as text.
std::string reference_key(const Scene& scene, int order);

/// Everything that determines the results of a comparison, apart from times, as text. Two
/// comparisons may be merged only if these texts are equal.
std::string comparison_key(const Scene& scene);

/// Input of a comparison beside its scene.
struct ComparisonOptions {
  ProgressCallback progress = {};
  ReferenceStore* references = nullptr;
  /// Called between integrations, when all entries of `result` are complete, so that it can be
  /// saved.
  std::function<void()> checkpoint = {};
  std::vector<CandidateSeries> series = {};  ///< if empty, candidate_series(scene)
};

/// Compares integrators on a scene. Every candidate is integrated and judged against the reference
/// once. Then all are timed in turns, so that other load on the machine affects all alike. `result`
/// may hold finished parts of an interrupted comparison of the same scene, which are not repeated.
/// It is filled as the work proceeds, and may be kept when `progress` throws.
///
/// Errors below ten times the reference's uncertainty are not claimed. Throws Error(scene) for a
/// scene that cannot be compared, Error(numerical) if the reference fails or does not agree with
/// itself to 1e-13. Failures of candidates are recorded in their runs.
void compare(const Scene& scene, const ComparisonOptions& options, ComparisonResult& result);

/// For each series the fastest run whose error at formation scale is at most `error_m` metres; the
/// fastest series first.
std::vector<const ComparedRun*> cheapest_runs(const ComparisonResult& result, double error_m);

/// The conclusion of the comparison in one sentence, with numbers.
std::string verdict(const ComparisonResult& result);

/// The cheapest configuration that reaches the wanted error, as `[[integrator]]` lines for a scene;
/// if none does, a comment that says so.
std::string advice(const ComparisonResult& result);

}  // namespace hamjet
