#pragma once

#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The nominal's final state: the constant terms of a jet.
std::vector<double> nominal_of(const FlowJet<double>& jet);

/// A flow problem for the trajectory alone, with series of order 0. The start stands at
/// `start_time` of the system's clock.
FlowProblem<double> trajectory_problem(const SharedSystem& system, const std::vector<double>& start,
                                       const ClockTime& start_time, double duration);

/// A flow problem to first order in all numbers of the state, for which `space` has a variable
/// each. No symmetry is left out: a few steps of order 1 are cheaper than putting it back.
FlowProblem<double> linear_problem(const SharedSystem& system, const SpacePointer& space,
                                   const std::vector<double>& start, const ClockTime& start_time,
                                   double duration);

/// The jet of linear_problem, by steps of this tolerance, which is not tried on lines.
/// Throws as integrate_gauss.
FlowJet<double> linear_jet(const SharedSystem& system, const std::vector<double>& start,
                           const ClockTime& start_time, double duration, double tolerance);

/// The final state of the flow with the full equations of motion, to rounding, of the state
/// that stands at `start_time` of the system's clock.
/// Throws as integrate_gauss.
std::vector<double> exact_flow(const SharedSystem& system, const std::vector<double>& start,
                               const ClockTime& start_time, double duration);

}  // namespace hamjet
