#pragma once

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// integrate_gauss for one number of lanes; each is compiled in a file of its own.
template <int Lanes, class Real>
FlowJet<Real> run_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer);

}  // namespace hamjet
