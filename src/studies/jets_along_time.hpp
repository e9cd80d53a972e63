#pragma once

#include <functional>
#include <span>

#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

/// The flow's jets at several times from one propagation, each integration going on from the jet
/// that the last one reached. Times move away from 0. `visit` gets each jet with the index of its
/// time. Statistics are summed; their seconds are those of the integrations alone.
IntegrationStatistics visit_jets(
    const ComputedProblem& problem, const IntegratorSettings& settings,
    std::span<const double> times,
    const std::function<void(std::size_t index, const FlowJet<double>& jet)>& visit);

}  // namespace hamjet
