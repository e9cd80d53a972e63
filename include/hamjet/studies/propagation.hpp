#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/run_along_time.hpp"
#include "hamjet/detail/studies/self_checks.hpp"
#include "hamjet/integrators/arc_splitting.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/maps/exactness.hpp"
#include "hamjet/maps/symplecticity.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// One point of the nominal trajectory, canonical.
struct NominalPoint {
  double time = 0;
  std::vector<double> state;  ///< all 2n components of the model
  double energy_error = 0;    ///< (H - H(0)) / |H(0)|; H - H(0) where H(0) = 0
};

/// One degree of the exactness residual, and the rounding floor below which it says nothing: the
/// residual of the reference rounded to the run's precision. No floor without a reference.
struct ExactnessEntry {
  ExactnessResidual residual;
  std::optional<ExactnessResidual> floor;
};

/// A generating function of one kind, and how exact it is.
struct KindResult {
  std::string requested;  ///< as in the scene: F1..F4, auto, or explicit
  GeneratingFunctionKind kind;
  double condition = 0;
  std::vector<ExactnessEntry> by_degree;
  std::optional<Series<Extended>> generating_function;
  std::string failure;  ///< not empty: the kind does not exist at the final time, and why
};

/// What was done with a run's jet, counted where it is done.
struct AnalysisCounts {
  long inversions = 0;           ///< partial inversions of the map
  long compositions = 0;         ///< of an inverted map with the map, along a line
  long exactness_residuals = 0;  ///< of a one-form
  long poisson_brackets = 0;     ///< of two components of the map
};

/// A run's jet at a time before the duration.
struct JetAtTime {
  double time = 0;                     ///< canonical
  FlowJet<Extended> jet;               ///< of the computed components
  std::vector<double> nominal;         ///< all components of the model then
  std::vector<double> error_estimate;  ///< by degree; empty where there is none
};

/// A run's polynomials in the scene's own coordinates, beside its jet in positions and momenta.
struct ChartedJet {
  CoordinatesAtEnds coordinates;
  /// Of flow boxes the chart of their sections, and its values are FlowBoxMap's, `time` before
  /// `coordinates`; else absent, and it is in_charts of the run's jet.
  std::optional<ChartName> section;
  FlowJet<Extended> jet;
  std::vector<double> nominal_final;  ///< in positions and momenta
  std::vector<SymplecticityDefect> symplecticity;
  /// Of flow boxes, by further integrations (see charted_jet), where the scene estimates errors.
  JetErrorEstimate error_estimate;
  double seconds = 0;   ///< of making it, without the estimate
  std::string failure;  ///< not empty: there is none, and why
};

/// What one integrator gave.
struct RunResult {
  IntegratorSettings settings;
  IntegrationStatistics statistics;
  std::vector<std::string> failed_checks;  ///< those of the scene and self-checks, one line each
  std::vector<SelfCheck> checks;           ///< all self-checks; empty if the run failed
  std::string failure;                     ///< not empty: no result, and why
  /// The components of the flow's jet that were computed, exact copies in extended precision.
  FlowJet<Extended> jet;
  std::vector<double> nominal_final;
  std::vector<JetAtTime> jets;  ///< at the scene's `jet_times`
  std::optional<ChartedJet>
      charted;              ///< if the scene's coordinates can be written, see charted_jet
  double energy_error = 0;  ///< the largest magnitude along the nominal
  EnergyAlongNominal energy;
  AnalysisCounts counts;
  std::optional<ArcStatistics> arcs;          ///< unless the scene has one arc, as by default
  std::optional<LowestPoint> lowest_point;    ///< if it was watched
  std::optional<InversionQuality> inversion;  ///< if a map was inverted and composed
  std::vector<NominalPoint> nominal;
  std::vector<KindResult> kinds;
  std::vector<SymplecticityDefect> symplecticity;  ///< empty if not all variables are expanded in
  std::optional<std::vector<double>> error_by_degree;  ///< see relative_error_by_degree
  JetErrorEstimate error_estimate;
  /// By degree, what it costs that a shift in time was left out (FlowSymmetry): the relative
  /// difference, along two lines of deviations, from the jet that the same steps make in all
  /// variables. Empty where none was left out, and where it was not measured.
  std::vector<double> time_shift_difference;
  /// Distance of the nominal's final position from the reference's.
  std::optional<double> position_error_m;
  std::optional<RunAlongTime> along_time;  ///< if the scene asks for a figure
};

/// The extended-precision reference: two runs of different step size, the finer one kept.
struct ReferenceResult {
  FlowJet<Extended> jet;
  std::vector<double> uncertainty_by_degree;  ///< relative difference of the two runs
  IntegrationStatistics statistics;           ///< of the finer run
  int runs = 0;                               ///< integrations that were done for it
  int stages = 0;
  double tolerance = 0;

  /// The largest uncertainty over all degrees.
  double largest_uncertainty() const {
    return *std::max_element(uncertainty_by_degree.begin(), uncertainty_by_degree.end());
  }
  /// Relative errors below this, ten times the uncertainty, may be the reference's own.
  double smallest_claimed_error() const { return 10 * largest_uncertainty(); }
};

/// Coefficients of the relative Hamiltonian at one time.
struct RelativeHamiltonianResult {
  double time = 0;
  Series<Extended> hamiltonian;
};

/// The part of a scene's problem that is computed.
struct ComputedProblem {
  std::vector<std::size_t> degrees_of_freedom;  ///< kept; the others vanish identically
  std::vector<std::size_t> components;  ///< index in the model's state of each component computed
  std::vector<std::size_t> variables;   ///< index among the components of each variable
  SpacePointer space;
  SharedSystem system;
  std::vector<double> nominal;  ///< of the components
  bool is_full_jet = false;     ///< all components are expanded in: a map of phase space
  FlowSymmetry symmetry = FlowSymmetry::rotation;  ///< left out by the integrators that can
  /// Binary exponent of the unit in which momenta are compared with positions: for an orbit that of
  /// the chief's own motion, so that no verdict depends on the unit of length.
  int momentum_exponent = 0;
};

/// All results of a scene.
struct PropagationResult {
  Scene scene;
  ComputedProblem problem;
  std::optional<ReferenceResult> reference;
  std::string
      reference_failure;  ///< not empty: the scene asks for a reference that failed, and why
  std::vector<RunResult> runs;
  long floor_inversions = 0;  ///< of the reference's map, for rounding floors of exactness
  std::vector<RelativeHamiltonianResult> relative_hamiltonians;
  std::string relative_hamiltonian_failure;  ///< not empty: times are missing above, and why
};

/// A system in canonical units; `canonical_radius` is its gravity field's radius in them.
DynamicalSystem make_system(const SystemSettings& settings, double canonical_radius);
/// The system of a scene in canonical units.
DynamicalSystem make_system(const Scene& scene);

/// What has to be computed for a scene: degrees of freedom that stay exactly zero and that the
/// scene does not expand in are left out. Throws Error(too_large), naming the estimate, if the
/// series would not fit available_memory() (32 MB or less are not asked for), Error(usage) if an
/// integrator is not in this build.
/// Arcs are integrated on `threads` threads.
ComputedProblem make_problem(const Scene& scene, std::size_t threads = 1);

/// Bytes that the scene's runs need at most, from the counts of series and coefficients.
double estimate_memory(const Scene& scene, const DynamicalSystem& system, std::size_t variables,
                       std::size_t threads = 1);

/// Memory that this machine can give now, in bytes; infinite where that cannot be known.
double available_memory();

/// Runs a scene: the reference if it asks for one, then each integrator, then the inversions that
/// it asks for. A numerical failure of one part (the reference, one integrator, one kind) is
/// recorded in its result and the others go on; other errors are thrown. Arcs (Scene::arcs) are
/// integrated on `threads` threads, on which the result does not depend.
PropagationResult propagate(const Scene& scene, const ProgressCallback& progress = {},
                            std::size_t threads = 1);

/// The kind whose exactness the scene's figure shows; none if it shows none.
std::optional<GeneratingFunctionKind> figure_kind(const Scene& scene,
                                                  const ComputedProblem& problem);

/// For each degree the largest difference of a coefficient from the reference's, relative to the
/// reference's largest coefficient of that degree (over all components); 0 where both vanish.
/// Degrees go up to the lower of the two orders.
std::vector<double> relative_error_by_degree(const FlowJet<Extended>& jet,
                                             const FlowJet<Extended>& reference);

/// The worst outcome of all runs, as an exit code: 0, 1 (a check failed) or 4 (a numerical
/// failure).
int exit_code(const PropagationResult& result);

}  // namespace hamjet
