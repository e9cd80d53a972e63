#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

#include "../integrators/momentum_unit.hpp"
#include "descriptions/method_description.hpp"
#include "descriptions/system_description.hpp"
#include "flights/manoeuvred_flight.hpp"
#include "hamjet/studies/propagation.hpp"
#include "memory_use/needed_memory.hpp"

namespace hamjet {

DynamicalSystem make_system(const SystemSettings& settings, double canonical_radius) {
  return description_of(settings.model).make(settings, canonical_radius);
}

DynamicalSystem make_system(const Scene& scene) {
  if (scene.own_system) return *scene.own_system;
  return make_system(scene.system, scene.canonical_radius);
}

namespace {

/// A scene from a file was checked when it was read; one made in C++ is checked here.
void require_good_integrators(const Scene& scene) {
  std::set<std::string> labels;
  for (const IntegratorSettings& settings : scene.integrators) {
    const MethodDescription& method = description_of(settings.method);
    const auto refuse = [&](const std::string& problem) {
      throw Error(ErrorKind::usage, fmt::format("integrator {}: {}", settings.label, problem));
    };
    if (!method.is_built()) {
      refuse(fmt::format("this build has no {}; configure with {}", method.library,
                         method.build_option));
    }
    if (!scene.jet_times.empty() && settings.method != IntegrationMethod::gauss) {
      refuse(fmt::format("{} has no jets between its steps, must be gauss where there are times",
                         method.name));
    }
    if (scene.own_system == nullptr) continue;
    if (settings.label.empty() || !labels.insert(settings.label).second) {
      refuse("the label is empty or stands twice, must be there once");
    }
    const bool has_step = method.has_fixed_steps && settings.step_canonical.has_value();
    const bool has_tolerance = method.has_tolerance && settings.tolerance.has_value();
    if (has_step == has_tolerance) {
      refuse(fmt::format("{} needs either a step or a tolerance, of those that it takes",
                         method.name));
    }
  }
}

}  // namespace

ComputedProblem make_problem(const Scene& scene, std::size_t threads) {
  require_good_integrators(scene);
  require_coasting(scene);
  if (!scene.jet_times.empty()) require_unsplit(scene, "a list of times");
  const DynamicalSystem full = make_system(scene);
  const std::size_t n = full.degrees_of_freedom;
  ComputedProblem problem;
  problem.degrees_of_freedom = needed_degrees_of_freedom(full, scene.nominal, scene.variables);
  problem.system = restrict_system(full, problem.degrees_of_freedom);
  problem.components = problem.degrees_of_freedom;
  for (const std::size_t i : problem.degrees_of_freedom) problem.components.push_back(n + i);
  for (std::size_t c = 2 * n; c < full.dimension(); ++c) problem.components.push_back(c);
  for (const std::size_t c : problem.components) problem.nominal.push_back(scene.nominal[c]);
  problem.start_time = scene.start_time;
  for (const std::size_t v : scene.variables) {
    const auto place = std::find(problem.components.begin(), problem.components.end(), v);
    problem.variables.push_back(
        static_cast<std::size_t>(std::distance(problem.components.begin(), place)));
  }
  problem.is_full_jet =
      full.parameters == 0 && problem.variables.size() == problem.components.size();
  problem.symmetry = scene.symmetry;
  if (has_time_shift(scene.symmetry) && !full.is_autonomous()) {
    throw Error(
        ErrorKind::scene,
        "jet.symmetry: got \"rotation-and-time\", but the forces depend on the time, so that "
        "no shift in time is a symmetry; must be \"rotation\" or \"none\"");
  }
  problem.momentum_exponent =
      natural_momentum_exponent(is_orbit(scene.system.model), scene.nominal);
  require_memory(scene, *problem.system, threads);
  problem.space = SeriesSpace::create(scene.variables.size(), scene.order);
  return problem;
}

}  // namespace hamjet
