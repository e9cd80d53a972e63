#include "reference.hpp"

#include <atomic>
#include <future>
#include <system_error>

#include "../integrators/momentum_unit.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

ReferenceResult truncated_reference(const ReferenceResult& reference, const SpacePointer& space) {
  ReferenceResult result = reference;
  result.jet.clear();
  for (const auto& component : reference.jet) {
    const auto first = component.coefficients().first(space->size());
    result.jet.emplace_back(space, std::vector<Extended>(first.begin(), first.end()));
  }
  result.uncertainty_by_degree.resize(static_cast<std::size_t>(space->order()) + 1);
  return result;
}

namespace {

/// The flow by Gauss's method in the numbers of Real; `observe` is called after every step with the
/// time.
template <class Real>
FlowJet<Extended> integrate_in(const ComputedProblem& problem, double duration,
                               const GaussSettings& settings, IntegrationStatistics& statistics,
                               const std::function<void(double)>& observe) {
  FlowProblem<Real> flow{problem.system,     problem.space, problem.variables, {},
                         problem.start_time, Real(duration)};
  // The reference must share nothing with the runs that it judges, because an error in a shared
  // part would not show.
  flow.symmetry = FlowSymmetry::none;
  for (const double x : problem.nominal) flow.initial_state.emplace_back(x);
  return convert_map<Extended>(integrate_gauss<Real>(
      flow, settings, statistics,
      [&](const Real& time, const FlowJet<Real>&) { observe(static_cast<double>(time)); }));
}

}  // namespace

ReferenceResult compute_reference(const ComputedProblem& problem, double duration,
                                  const ReferenceSettings& settings, Precision judged,
                                  const std::function<void(double)>& keep_going) {
  const bool is_extended = reference_arithmetic(judged, settings.tolerance).bits == 113;
  const auto integrate = is_extended ? integrate_in<Extended> : integrate_in<DoubleDouble>;
  std::atomic<bool> stop = false;
  const auto run = [&](int stages, double tolerance, IntegrationStatistics& statistics,
                       bool reports) {
    GaussSettings gauss;
    gauss.stages = stages;
    gauss.tolerance = tolerance;
    return integrate(problem, duration, gauss, statistics, [&](double time) {
      if (stop) throw Error(ErrorKind::numerical, "reference: stopped with its other run");
      if (reports) keep_going(time / duration);
    });
  };
  ReferenceResult result;
  result.stages = reference_stages;
  result.tolerance = settings.tolerance;
  IntegrationStatistics coarse_statistics;
  const auto run_coarse = [&] {
    return run(compared_stages, looser_tolerance * settings.tolerance, coarse_statistics, false);
  };
  std::future<FlowJet<Extended>> coarse;
  try {
    coarse = std::async(std::launch::async, run_coarse);
  } catch (const std::system_error&) {
    // No thread is available, so that the coarse run follows the fine one.
    coarse = std::async(std::launch::deferred, run_coarse);
  }
  try {
    result.jet = run(reference_stages, settings.tolerance, result.statistics, true);
  } catch (...) {
    stop = true;
    coarse.wait();
    throw;
  }
  const auto comparable = [&](const FlowJet<Extended>& jet) {
    return compared_components(jet, problem.variables, problem.system->degrees_of_freedom,
                               problem.momentum_exponent);
  };
  result.uncertainty_by_degree =
      relative_error_by_degree(comparable(coarse.get()), comparable(result.jet));
  result.runs = 2;
  return result;
}

}  // namespace hamjet
