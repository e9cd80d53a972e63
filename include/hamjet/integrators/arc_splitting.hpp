#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"

namespace hamjet {

/// The methods whose steps are known from the nominal alone, so that a flow can be split into arcs.
/// The others choose or correct their steps on the whole series (CVODE, adaptive Runge-Kutta).
using SplittableMethod = std::variant<GaussSettings, StormerSettings, VelocityVerletSettings,
                                      SymmetricCompositionSettings>;

/// How a flow is split into arcs.
struct ArcSettings {
  std::optional<std::size_t> arcs = 1;  ///< none: chosen from operation counts, see ArcPlan
  std::size_t threads = 1;              ///< at least 1; the result does not depend on it
};

/// Into how many arcs a flow is split, and what that is expected to bring. It is made from counts
/// of operations alone, so that it is the same on every machine and for every number of threads.
struct ArcPlan {
  static constexpr std::array<std::size_t, 3> thread_counts = {1, 2, 4};

  std::size_t arcs = 1;
  long steps = 0;
  double nominal_multiply_adds = 0;      ///< of one step of the nominal, weighed by their time
  double step_multiply_adds = 0;         ///< of one step of the jet
  double arc_step_multiply_adds = 0;     ///< of one step of a later arc, expanded in all variables
  double composition_multiply_adds = 0;  ///< of one composition
  /// Estimated time of the unsplit integration over that of the split one on thread_counts threads.
  std::array<double, 3> speed_ups = {1, 1, 1};
  std::string reason;  ///< why this number of arcs, in one line
};

/// What a split integration took. Seconds are wall time.
struct ArcStatistics {
  ArcPlan plan;
  std::size_t threads = 1;  ///< threads that worked
  long compositions = 0;
  double composition_multiply_adds = 0;  ///< of all compositions
  double nominal_seconds = 0;
  double arcs_seconds = 0;
  double composition_seconds = 0;
};

/// Called from the calling thread with the fraction of the work that is done, 0..1, at least ten
/// times a second where a step is shorter than that. May throw to stop.
using ArcProgress = std::function<void(double fraction)>;

/// Integrates the flow's jet in arcs: the nominal first, alone; then each arc's jet from its own
/// start on the steps that the nominal took, the arcs independent of each other and on threads;
/// then these maps are composed in a fixed tree. The result has the same bits for every number of
/// threads, the nominal those of the unsplit integration, and one arc those of the unsplit one
/// throughout. The maps are symplectic where those of the method are, and so is their composition
/// to the order.
///
/// An arc does not start from the identity but from coordinates that suit the flow, without which
/// composing would lose most digits at high order; see CutCoordinates. The composed jet is compared
/// with the unsplit flow along two lines of deviations: where its error is more than ten times the
/// unsplit one's at some degree, the number of arcs that was asked for is refused with
/// Error(numerical), and one that was left to the plan becomes 1, with the reason in ArcPlan.
///
/// `observer` is called after every step of the nominal, with jets of order 0. Arcs are at most as
/// many as steps. In `statistics` steps are those of the nominal, evaluations all that were made.
/// Throws what the method throws, from the calling thread; Error(usage) for no arcs or no threads.
template <class Real>
FlowJet<Real> integrate_in_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                                const ArcSettings& settings, IntegrationStatistics& statistics,
                                ArcStatistics& arc_statistics,
                                const StepObserver<Real>& observer = {},
                                const ArcProgress& progress = {});

/// The plan that integrate_in_arcs would follow; integrates the nominal alone. Throws what
/// integrate_in_arcs throws.
template <class Real>
ArcPlan plan_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                  const std::optional<std::size_t>& arcs, const ArcProgress& progress = {});

}  // namespace hamjet
