#pragma once

#include <functional>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// A function of the state that vanishes at an event: a height over a plane, a distance less a
/// radius, the product of position and velocity (an apsis). The function is only evaluated on
/// series.
template <class Real>
using EventCondition = std::function<Series<Real>(const SixNumbers<Series<Real>>&)>;

/// The time at which a condition holds, and the state then, as polynomials of the deviation of the
/// initial state, (dq, dp).
template <class Real>
struct EventMap {
  Series<Real> time;  ///< since the start; its constant term is the chief's
  SixNumbers<Series<Real>> state;
};

/// The event of a chief that is nearest to a time after its start, and those of its neighbours, to
/// an order. The flow's jet is integrated to the chief's event, which Newton's method finds; then
/// the times of the neighbours are found as series, t -> t - g / g'(0), each iteration with one
/// step of a Gauss method whose error vanishes to the order.
///
/// `system` has three positions and three momenta. Throws Error(usage) for one that depends on the
/// time, for which the neighbours' times of flight would have to be its argument; Error(numerical)
/// if the chief's event is not found, or if the flow touches the condition's surface there, so that
/// the time is no series; and as integrate_gauss.
template <class Real>
EventMap<Real> event_map(const DynamicalSystem& system, const SixNumbers<Real>& chief,
                         const ClockTime& start_time, const Real& near, int order,
                         const GaussSettings& gauss, const EventCondition<Real>& condition);

}  // namespace hamjet
