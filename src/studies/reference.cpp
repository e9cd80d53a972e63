#include "reference.hpp"

#include <fmt/format.h>

#include <atomic>
#include <future>

#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/studies/comparison.hpp"

namespace hamjet {
namespace {

constexpr int reference_stages = 16;
/// The run that is compared has another order and a looser tolerance, so that the two share neither
/// steps nor stages even where one step spans the whole duration.
constexpr int compared_stages = 12;
constexpr double looser = 1e4;

}  // namespace

std::string reference_key(const Scene& scene, int order) {
  std::string key = fmt::format(
      "reference 1; {}; {} and {} stages, factor {}; tolerance {}; J2 {} J3 {} radius {}; mass {} "
      "stiffness {}",
      model_names()[static_cast<std::size_t>(scene.system.model)], reference_stages,
      compared_stages, looser, scene.reference.value_or(ReferenceSettings{}).tolerance,
      scene.system.J[2], scene.system.J[3], scene.canonical_radius, scene.system.mass_kg,
      scene.system.stiffness_N_per_m);
  const SystemSettings& system = scene.system;
  for (int n = 4; n <= ZonalCoefficients::highest; ++n) {
    if (system.J[n] != 0) key += fmt::format(" J{} {}", n, system.J[n]);
  }
  switch (system.model) {  // what the other models have not
    case SystemModel::oscillator_pair:
      key += fmt::format(" {}", system.second_stiffness_N_per_m);
      break;
    case SystemModel::spring_pendulum:
      key += fmt::format(" length {} gravity {}", system.length_m, system.gravity_m_s2);
      break;
    case SystemModel::fermi_pasta_ulam:
      key += fmt::format(" omega {} pairs {}", system.omega_rad_per_s, system.pairs);
      break;
    default:
      break;
  }
  key += "; nominal";
  for (const double x : scene.nominal) key += fmt::format(" {}", x);
  key += fmt::format("; duration {}; order {}; variables", scene.duration, order);
  for (const std::size_t v : scene.variables) key += fmt::format(" {}", v);
  return key;
}

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

ReferenceResult compute_reference(const ComputedProblem& problem, double duration,
                                  const ReferenceSettings& settings,
                                  const std::function<void(double)>& keep_going) {
  FlowProblem<Extended> flow{&problem.system, problem.space, problem.variables, {}, duration};
  for (const double x : problem.nominal) flow.initial_state.emplace_back(x);
  std::atomic<bool> stop = false;
  const auto run = [&](int stages, double tolerance, IntegrationStatistics& statistics,
                       bool reports) {
    GaussSettings gauss;
    gauss.stages = stages;
    gauss.tolerance = tolerance;
    return integrate_gauss<Extended>(
        flow, gauss, statistics, [&](const Extended& time, const FlowJet<Extended>&) {
          if (stop) throw Error(ErrorKind::numerical, "reference: stopped with its other run");
          if (reports) keep_going(static_cast<double>(time) / duration);
        });
  };
  ReferenceResult result;
  result.stages = reference_stages;
  result.tolerance = settings.tolerance;
  IntegrationStatistics coarse_statistics;
  auto coarse = std::async(std::launch::async, [&] {
    return run(compared_stages, looser * settings.tolerance, coarse_statistics, false);
  });
  try {
    result.jet = run(reference_stages, settings.tolerance, result.statistics, true);
  } catch (...) {
    stop = true;
    coarse.wait();
    throw;
  }
  result.uncertainty_by_degree = relative_error_by_degree(coarse.get(), result.jet);
  result.runs = 2;
  return result;
}

}  // namespace hamjet
