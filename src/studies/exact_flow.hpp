#pragma once

#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The nominal's final state: the constant terms of a jet.
std::vector<double> nominal_of(const FlowJet<double>& jet);

/// A flow problem for the trajectory alone, with series of order 0.
FlowProblem<double> trajectory_problem(const SharedSystem& system, const std::vector<double>& start,
                                       double duration);

/// The settings with which exact_flow integrates.
GaussSettings exact_gauss();

/// The final state of the flow with the full equations of motion, to the precision of double.
/// Throws as integrate_gauss.
std::vector<double> exact_flow(const SharedSystem& system, const std::vector<double>& start,
                               double duration);

}  // namespace hamjet
