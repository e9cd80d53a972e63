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

/// One point of the nominal trajectory, in canonical units.
struct NominalPoint {
  double time = 0;
  std::vector<double> state;  ///< all 2n components of the model
  double energy_error = 0;    ///< (H - H(0)) / |H(0)|; H - H(0) where H(0) = 0
};

/// One degree of the exactness residual, and its rounding floor, below which the residual means
/// nothing: the residual of the reference rounded to the run's precision. There is no floor without
/// a reference.
/// Where the forces are none of a Hamiltonian, their own residual stands in place of a floor: that
/// of the reference or of a finer jet, and beside it the residual of the difference of both
/// one-forms, which the integration causes.
struct ExactnessEntry {
  ExactnessResidual residual;
  std::optional<ExactnessResidual> floor;
  std::optional<ExactnessResidual> forces;
  std::optional<double> integration;  ///< absolute
};

/// A generating function of one kind, and its exactness.
struct KindResult {
  std::string requested;  ///< name in the scene: F1..F4, auto, or explicit
  GeneratingFunctionKind kind;
  double condition = 0;
  std::vector<ExactnessEntry> by_degree;
  std::optional<Series<Extended>> generating_function;
  std::string failure;  ///< if not empty, the reason why the kind does not exist at the final time
};

/// The operations on a run's jet, counted where they are done.
struct AnalysisCounts {
  long inversions = 0;           ///< partial inversions of the map
  long compositions = 0;         ///< compositions of an inverted map with the map, along a line
  long exactness_residuals = 0;  ///< exactness residuals of a one-form
  long poisson_brackets = 0;     ///< Poisson brackets of two components of the map
};

/// A run's jet at a time before the duration.
struct JetAtTime {
  double time = 0;                     ///< in canonical units
  FlowJet<Extended> jet;               ///< the computed components
  std::vector<double> nominal;         ///< all components of the model at that time
  std::vector<double> error_estimate;  ///< by degree; empty if there is no estimate
};

/// A run's polynomials in the scene's own coordinates, beside its jet in positions and momenta.
struct ChartedJet {
  CoordinatesAtEnds coordinates;
  /// For flow boxes, the chart of their sections; the values are then those of FlowBoxMap, `time`
  /// before `coordinates`. Otherwise absent; the polynomials are then in_charts of the run's jet.
  std::optional<ChartName> section;
  FlowJet<Extended> jet;
  std::vector<double> nominal_final;  ///< in positions and momenta
  std::vector<SymplecticityDefect> symplecticity;
  /// For flow boxes, an estimate by further integrations (see charted_jet), if the scene estimates
  /// errors.
  JetErrorEstimate error_estimate;
  double seconds = 0;   ///< time of making it, without the estimate
  std::string failure;  ///< if not empty, the reason why there is none
};

/// The results of one integrator.
struct RunResult {
  IntegratorSettings settings;
  IntegrationStatistics statistics;
  /// Checks of the scene and self-checks that failed, one line each.
  std::vector<std::string> failed_checks;
  std::vector<SelfCheck> checks;  ///< all self-checks; empty if the run failed
  std::string failure;            ///< if not empty, the reason why there is no result
  /// The computed components of the flow's jet, as exact copies in extended precision.
  FlowJet<Extended> jet;
  std::vector<double> nominal_final;
  std::vector<JetAtTime> jets;  ///< jets at the scene's `jet_times`
  /// If polynomials in the scene's coordinates can be written, see charted_jet.
  std::optional<ChartedJet> charted;
  double energy_error = 0;  ///< the largest magnitude along the nominal
  EnergyAlongNominal energy;
  AnalysisCounts counts;
  std::optional<ArcStatistics> arcs;        ///< unless the scene has one arc, which is the default
  std::optional<LowestPoint> lowest_point;  ///< if it was observed
  std::optional<InversionQuality> inversion;  ///< if a map was inverted and composed
  std::vector<NominalPoint> nominal;
  std::vector<KindResult> kinds;
  /// Empty if the jet is not expanded in all variables.
  std::vector<SymplecticityDefect> symplecticity;
  /// Where the forces are none of a Hamiltonian, for each entry of `symplecticity` about how much
  /// of its scaled defect the error of the jet may be; the rest is of the forces. Empty otherwise,
  /// and where that error is not known.
  std::vector<double> integration_defects;
  std::optional<std::vector<double>> error_by_degree;  ///< see relative_error_by_degree
  JetErrorEstimate error_estimate;
  /// By degree, the effect of leaving out a shift in time (FlowSymmetry): the relative difference,
  /// along two lines of deviations, from the jet that the same steps give in all variables. Empty
  /// if no shift was left out, or if this was not measured.
  std::vector<double> time_shift_difference;
  /// Distance of the nominal's final position from that of the reference.
  std::optional<double> position_error_m;
  std::optional<RunAlongTime> along_time;  ///< if the scene asks for a figure
};

/// The extended-precision reference: the finer of two runs with different step sizes.
struct ReferenceResult {
  FlowJet<Extended> jet;
  std::vector<double> uncertainty_by_degree;  ///< relative difference of the two runs
  IntegrationStatistics statistics;           ///< statistics of the finer run
  int runs = 0;                               ///< number of integrations that were done for it
  int stages = 0;
  double tolerance = 0;

  /// The largest uncertainty over all degrees.
  double largest_uncertainty() const {
    return *std::max_element(uncertainty_by_degree.begin(), uncertainty_by_degree.end());
  }
  /// Relative errors below this number, ten times the uncertainty, may be errors of the reference.
  double smallest_claimed_error() const { return 10 * largest_uncertainty(); }
};

/// Coefficients of the relative Hamiltonian at one time.
struct RelativeHamiltonianResult {
  double time = 0;
  Series<Extended> hamiltonian;
};

/// The part of a scene's problem that is computed.
struct ComputedProblem {
  /// Degrees of freedom that are kept; the others vanish identically.
  std::vector<std::size_t> degrees_of_freedom;
  std::vector<std::size_t> components;  ///< index in the model's state of each component computed
  std::vector<std::size_t> variables;   ///< index among the components of each variable
  SpacePointer space;
  SharedSystem system;
  std::vector<double> nominal;                ///< nominal of these components
  ClockTime start_time = ClockTime::epoch();  ///< the system's clock at the nominal
  bool is_full_jet =
      false;  ///< whether the jet is expanded in all components, and thus a map of phase space
  FlowSymmetry symmetry =
      FlowSymmetry::rotation;  ///< symmetry to be left out by the integrators that can do so
  /// Binary exponent of the unit in which momenta are compared with positions. For an orbit it is
  /// that of the chief's own motion, so that no verdict depends on the unit of length.
  int momentum_exponent = 0;
};

/// All results of a scene.
struct PropagationResult {
  Scene scene;
  ComputedProblem problem;
  std::optional<ReferenceResult> reference;
  std::string reference_failure;  ///< if not empty, the reason why the scene's reference failed
  std::vector<RunResult> runs;
  long floor_inversions =
      0;  ///< number of inversions of the reference's map, for rounding floors of exactness
  std::vector<RelativeHamiltonianResult> relative_hamiltonians;
  std::string
      relative_hamiltonian_failure;  ///< if not empty, the reason why times are missing above
};

/// A system in canonical units; `canonical_radius` is its gravity field's radius in them.
DynamicalSystem make_system(const SystemSettings& settings, double canonical_radius);
/// The system of a scene in canonical units.
DynamicalSystem make_system(const Scene& scene);

/// The problem that has to be computed for a scene. Degrees of freedom that stay exactly zero, and
/// in which the scene does not expand, are left out. Throws Error(too_large), naming the estimate,
/// if the series would not fit available_memory() (32 MB or less always fit), and Error(usage) if
/// an integrator is not in this build. Arcs will be integrated on `threads` threads.
ComputedProblem make_problem(const Scene& scene, std::size_t threads = 1);

/// Upper bound, in bytes, of the memory that the scene's runs need, from the counts of series and
/// coefficients.
double estimate_memory(const Scene& scene, const DynamicalSystem& system, std::size_t variables,
                       std::size_t threads = 1);

/// Memory in bytes that this machine can provide now; infinite if this is not known.
double available_memory();

/// Runs a scene: the reference, if the scene asks for one, then each integrator, then the
/// inversions. A numerical failure of one part (the reference, one integrator, one kind) is
/// recorded in the result of this part and does not stop the others; other errors are thrown. Arcs
/// (Scene::arcs) are integrated on `threads` threads, on which the result does not depend.
PropagationResult propagate(const Scene& scene, const ProgressCallback& progress = {},
                            std::size_t threads = 1);

/// The kind whose exactness the scene's figure shows; no value if it shows none.
std::optional<GeneratingFunctionKind> figure_kind(const Scene& scene,
                                                  const ComputedProblem& problem);

/// For each degree, the largest difference of a coefficient from that of the reference, relative to
/// the reference's largest coefficient of that degree (over all components); 0 where both vanish.
/// Degrees go up to the lower of the two orders.
std::vector<double> relative_error_by_degree(const FlowJet<Extended>& jet,
                                             const FlowJet<Extended>& reference);

/// The worst outcome of all runs, as an exit code: 0, 1 (a check failed) or 4 (a numerical
/// failure).
int exit_code(const PropagationResult& result);

}  // namespace hamjet
