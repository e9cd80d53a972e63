#pragma once

#include <vector>

#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// The jet of a flow at times s about a time of the clock, as a polynomial in s: element k of the
/// result is the coefficient of s^k, for k up to the jet's order N. `jet` is the jet at that time
/// itself, in all variables of the system.
///
/// The polynomial is the Taylor polynomial of degree N in s and the jet's variables together, so
/// that the coefficient of s^k has the degrees up to N - k alone.
std::vector<FlowJet<double>> jets_about_time(const DynamicalSystem& system, const ClockTime& time,
                                             const FlowJet<double>& jet);

}  // namespace hamjet
