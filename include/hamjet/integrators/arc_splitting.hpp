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

/// The methods whose steps follow from the nominal alone, so that a flow can be split into arcs.
/// The other methods choose or correct their steps by the whole series (CVODE, adaptive
/// Runge-Kutta).
using SplittableMethod = std::variant<GaussSettings, StormerSettings, VelocityVerletSettings,
                                      SymmetricCompositionSettings>;

/// How a flow is split into arcs.
struct ArcSettings {
  std::optional<std::size_t> arcs =
      1;  ///< number of arcs; without a value, it is chosen from operation counts, see ArcPlan
  std::size_t threads = 1;  ///< at least 1; the result does not depend on it
};

/// The number of arcs into which a flow is split, and the expected gain. A plan is made from counts
/// of operations alone, so that it is the same on every machine and for every number of threads.
struct ArcPlan {
  static constexpr std::array<std::size_t, 3> thread_counts = {1, 2, 4};

  std::size_t arcs = 1;
  long steps = 0;
  double nominal_multiply_adds =
      0;  ///< cost of one step of the nominal, as multiply-adds that take the same time
  double step_multiply_adds = 0;  ///< for one step of the jet
  double arc_step_multiply_adds =
      0;  ///< for one step of a later arc, which is expanded in all variables
  double composition_multiply_adds = 0;  ///< for one composition
  /// Estimated ratio of the time of the unsplit integration to that of the split one, on
  /// thread_counts threads.
  std::array<double, 3> speed_ups = {1, 1, 1};
  std::string reason;  ///< the reason for this number of arcs, in one line
};

/// The work of a split integration. Seconds are wall time.
struct ArcStatistics {
  ArcPlan plan;
  std::size_t threads = 1;  ///< number of threads that worked
  long compositions = 0;
  double composition_multiply_adds = 0;  ///< multiply-adds of all compositions
  double nominal_seconds = 0;
  double arcs_seconds = 0;
  double composition_seconds = 0;
};

/// Called from the calling thread with the fraction of the work that is done, 0..1; at least ten
/// times a second if steps are shorter than that. It may throw to stop.
using ArcProgress = std::function<void(double fraction)>;

/// Integrates the flow's jet in arcs. First the nominal is integrated alone. Then each arc's jet is
/// integrated from its own start with the steps that the nominal took; the arcs are independent of
/// each other and run on threads. Last, these maps are composed in a fixed tree. The result has the
/// same bits for every number of threads. The nominal has the bits of the unsplit integration and,
/// with a single arc, so has the whole jet. The maps are symplectic if those of the method are, and
/// so is their composition, to the order.
///
/// An arc does not start from the identity but from coordinates that suit the flow, because
/// otherwise the composition would lose most digits at high order; see CutCoordinates. The composed
/// jet is compared with the unsplit flow along two lines of deviations. If its error at some degree
/// is more than ten times that of the unsplit flow, a requested number of arcs is refused with
/// Error(numerical), and a number that was left to the plan becomes 1, with the reason in ArcPlan.
///
/// `observer` is called after every step of the nominal, with jets of order 0. There are at most as
/// many arcs as steps. `statistics` counts the steps of the nominal and the evaluations of all
/// arcs. Throws what the method throws, from the calling thread; Error(usage) for no arcs or no
/// threads.
template <class Real>
FlowJet<Real> integrate_in_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                                const ArcSettings& settings, IntegrationStatistics& statistics,
                                ArcStatistics& arc_statistics,
                                const StepObserver<Real>& observer = {},
                                const ArcProgress& progress = {});

/// The plan that integrate_in_arcs would follow, for which the nominal alone is integrated. Throws
/// what integrate_in_arcs throws.
template <class Real>
ArcPlan plan_arcs(const FlowProblem<Real>& problem, const SplittableMethod& method,
                  const std::optional<std::size_t>& arcs, const ArcProgress& progress = {});

}  // namespace hamjet
