#include "arcs.hpp"

#include <fmt/format.h>

#include "descriptions/method_description.hpp"
#include "integration.hpp"

namespace hamjet {

std::optional<std::string> reason_not_to_split(const Scene& scene,
                                               const IntegratorSettings& settings) {
  const MethodDescription& method = description_of(settings.method);
  if (!state_parameters(scene.system).empty()) {
    return "states with a parameter are not split";
  }
  if (!method.splittable(settings)) return fmt::format("{} is not available in arcs", method.name);
  if (scene.figure && scene.figure->quantity == FigureQuantity::exactness) {
    return "the figure takes the jet after every step";
  }
  return std::nullopt;
}

SplittableMethod splittable_method(const IntegratorSettings& settings) {
  if (const auto method = description_of(settings.method).splittable(settings)) return *method;
  throw Error(ErrorKind::usage,
              fmt::format("integrator {}: this method cannot be split into arcs", settings.label));
}

ArcPlan plan_arcs(const Scene& scene, const ComputedProblem& problem,
                  const IntegratorSettings& settings, const ProgressCallback& progress) {
  if (const auto reason = reason_not_to_split(scene, settings)) {
    ArcPlan plan;
    plan.reason = *reason;
    return plan;
  }
  const ArcProgress report = [&](double fraction) {
    if (progress) progress(settings.label + ": arcs", fraction);
  };
  const SplittableMethod method = splittable_method(settings);
  if (scene.precision == Precision::extended) {
    return plan_arcs(flow_problem<Extended>(problem, scene.duration), method, scene.arcs, report);
  }
  return plan_arcs(flow_problem<double>(problem, scene.duration), method, scene.arcs, report);
}

void require_unsplit(const Scene& scene, const std::string& who) {
  if (scene.arcs == std::optional<std::size_t>(1)) return;
  throw Error(ErrorKind::scene,
              fmt::format("jet.arcs: {} takes jets along one propagation, which is not split; "
                          "must be 1 or left out, as by --set jet.arcs=1",
                          who));
}

}  // namespace hamjet
