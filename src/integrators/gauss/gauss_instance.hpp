#pragma once

#include <memory>

#include "gauss_arcs.hpp"
#include "gauss_integrator.hpp"
#include "gauss_lanes.hpp"

// The functions that gauss_lanes.cpp.in instantiates.

namespace hamjet {

template <int Lanes, class Real>
FlowJet<Real> run_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer) {
  return GaussIntegrator<Real, Lanes>(problem, settings, statistics).run(observer);
}

template <int Lanes, class Real>
std::unique_ptr<ArcIntegrator<Real>> make_gauss_arcs(const FlowProblem<Real>& problem,
                                                     const GaussSettings& settings) {
  return std::make_unique<GaussArcs<Real, Lanes>>(problem, settings);
}

}  // namespace hamjet
