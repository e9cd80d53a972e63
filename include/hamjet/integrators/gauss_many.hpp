#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The outcome of one orbit of integrate_gauss_many.
struct ManyFlowsOutcome {
  FlowJet<double> jet;  ///< empty if the orbit failed
  IntegrationStatistics statistics;
  std::optional<Error> failure;  ///< the error that integrate_gauss throws for this orbit alone
  bool was_alone = false;        ///< the orbit was integrated by itself, not in a lane
};

/// Settings of integrate_gauss_many.
struct ManyFlowsSettings {
  std::size_t threads = 1;
  /// Called from the calling thread with the number of orbits that are done. It may throw to stop.
  std::function<void(std::size_t)> progress = {};
};

/// The highest order at which orbits are integrated side by side; at higher orders a single orbit
/// fills the vectors.
inline constexpr int highest_order_in_lanes = 2;

/// integrate_gauss for many orbits of one problem, each from an initial state of its own in the
/// place of the problem's: a constellation, an axis of a sweep, a Monte-Carlo sample.
///
/// At orders 0 to 2, where the jet of one orbit is too short to fill the machine's vectors, orbits
/// are integrated side by side, each in a lane, with steps of its own, which are chosen as
/// integrate_gauss chooses them, up to rounding. A circle and an eccentric orbit side by side do
/// not slow each other down. The jet of each orbit is that of the method's numerical map,
/// symplectic to rounding; no symmetry is left out. Every degree is checked along two finer lines
/// as by integrate_gauss. Orbits that need shorter steps after this check, or Newton's method, are
/// integrated one at a time. So are all orbits for other orders, of a system of second order whose
/// inverse mass is not the identity, with `controls_all_degrees`, or with a profile.
///
/// To the last bit, the result of an orbit does not depend on the other orbits, their order or the
/// number of threads. An orbit that fails has a `failure` and does not affect the others.
/// Statistics are those of each orbit; its seconds are an equal share of the time that was spent
/// together.
///
/// Throws Error(usage) for settings or a problem out of range and for states of another size;
/// states that are not finite are failures of their orbits.
std::vector<ManyFlowsOutcome> integrate_gauss_many(
    const FlowProblem<double>& problem, const std::vector<std::vector<double>>& initial_states,
    const GaussSettings& settings, const ManyFlowsSettings& many = {});

}  // namespace hamjet
