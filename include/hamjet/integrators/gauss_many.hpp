#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// What became of one orbit of integrate_gauss_many.
struct ManyFlowsOutcome {
  FlowJet<double> jet;  ///< empty where it failed
  IntegrationStatistics statistics;
  std::optional<Error> failure;  ///< what integrate_gauss throws for this orbit alone
  bool was_alone = false;        ///< integrated one at a time, not in a lane
};

/// How integrate_gauss_many works.
struct ManyFlowsSettings {
  std::size_t threads = 1;
  /// Called from the calling thread with the number of orbits that are done. May throw to stop.
  std::function<void(std::size_t)> progress = {};
};

/// The highest order at which orbits are integrated side by side: above it one fills the vectors.
inline constexpr int highest_order_in_lanes = 2;

/// integrate_gauss for many orbits of one problem, each from an initial state of its own in the
/// place of the problem's: a constellation, an axis of a sweep, a Monte-Carlo sample.
///
/// At orders 0 to 2, where the jet of one orbit is too short to fill the machine's vectors, orbits
/// are integrated side by side, each in a lane, with steps of its own that are chosen as
/// integrate_gauss chooses them, up to rounding: a circle beside an eccentric orbit costs neither
/// anything. The jet of each is that of the method's numerical map, symplectic to rounding, and of
/// the whole of it: no symmetry is left out. Every degree is checked along two finer lines as by
/// integrate_gauss. Orbits that need more, shorter steps after that check or Newton's method, are
/// integrated one at a time, and so are those of other orders, of a system of second order whose
/// inverse mass is not the identity, and with `controls_all_degrees` or a profile.
///
/// What an orbit's result is does not depend, to the last bit, on the other orbits, their order or
/// the number of threads. An orbit that fails has a failure; the others are as they are without it.
/// Statistics are of each orbit, but seconds, which are an equal share of what was spent together.
///
/// Throws Error(usage) for settings or a problem out of range and for states of another size;
/// states that are not finite are failures of their orbits.
std::vector<ManyFlowsOutcome> integrate_gauss_many(
    const FlowProblem<double>& problem, const std::vector<std::vector<double>>& initial_states,
    const GaussSettings& settings, const ManyFlowsSettings& many = {});

}  // namespace hamjet
