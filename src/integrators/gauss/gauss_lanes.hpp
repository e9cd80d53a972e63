#pragma once

#include <memory>
#include <type_traits>

#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

template <class Real>
class ArcIntegrator;

/// integrate_gauss for one number of lanes; each number is compiled in a file of its own.
template <int Lanes, class Real>
FlowJet<Real> run_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                        IntegrationStatistics& statistics, const StepObserver<Real>& observer);

/// The arc integrator of a Gauss method, for one number of lanes.
template <int Lanes, class Real>
std::unique_ptr<ArcIntegrator<Real>> make_gauss_arcs(const FlowProblem<Real>& problem,
                                                     const GaussSettings& settings);

/// Calls `call` with the number of lanes, an integral constant: the smallest of five widths whose
/// lanes hold all stages. Double-double numbers serve references only, which have many stages, so
/// that one width is enough for these.
template <class Real, class Call>
auto with_lanes(int stages, const Call& call) {
  if constexpr (std::is_same_v<Real, DoubleDouble>) {
    return call(std::integral_constant<int, 16>{});
  }
  if (stages == 1) return call(std::integral_constant<int, 1>{});
  if (stages == 2) return call(std::integral_constant<int, 2>{});
  if (stages <= 4) return call(std::integral_constant<int, 4>{});
  if (stages <= 8) return call(std::integral_constant<int, 8>{});
  return call(std::integral_constant<int, 16>{});
}

/// run_gauss and make_gauss_arcs with the number of lanes that the settings' stages need.
template <class Real>
FlowJet<Real> run_gauss(const FlowProblem<Real>& problem, const GaussSettings& settings,
                        IntegrationStatistics& statistics,
                        const StepObserver<Real>& observer = {}) {
  return with_lanes<Real>(settings.stages, [&]<int Lanes>(std::integral_constant<int, Lanes>) {
    return run_gauss<Lanes>(problem, settings, statistics, observer);
  });
}
template <class Real>
std::unique_ptr<ArcIntegrator<Real>> make_gauss_arcs(const FlowProblem<Real>& problem,
                                                     const GaussSettings& settings) {
  return with_lanes<Real>(settings.stages, [&]<int Lanes>(std::integral_constant<int, Lanes>) {
    return make_gauss_arcs<Lanes>(problem, settings);
  });
}

/// Throws Error(usage) for settings out of range.
void validate_gauss(const GaussSettings& settings);

}  // namespace hamjet
