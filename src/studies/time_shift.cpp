#include <type_traits>
#include <variant>

#include "../integrators/directional_flow.hpp"
#include "../integrators/gauss/gauss_tolerance.hpp"
#include "arcs.hpp"
#include "integration.hpp"

namespace hamjet {

template <class Real>
std::vector<double> time_shift_difference(const FlowProblem<Real>& flow, const FlowJet<Real>& jet,
                                          const RunResult& run) {
  const DirectionalFlow<Real> lines(flow, 2);
  const auto along_line = [&](const FlowProblem<Real>& line) {
    IntegrationStatistics statistics;
    if (run.statistics.step_tolerance) {
      return integrate_with_step_tolerance<Real>(
          line, std::get<GaussSettings>(splittable_method(run.settings)),
          *run.statistics.step_tolerance, statistics);
    }
    return integrate<Real>(line, run.settings, statistics, {});
  };
  try {
    return lines.relative_difference(lines.restrict(jet), lines.integrate(along_line));
  } catch (const Error& error) {
    // The jet itself is complete.
    if (error.kind() != ErrorKind::numerical) throw;
    return {};
  }
}

template std::vector<double> time_shift_difference(const FlowProblem<double>&,
                                                   const FlowJet<double>&, const RunResult&);
template std::vector<double> time_shift_difference(const FlowProblem<Extended>&,
                                                   const FlowJet<Extended>&, const RunResult&);

}  // namespace hamjet
