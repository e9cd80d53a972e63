#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

#include "../integrators/arc_plan.hpp"
#include "../integrators/momentum_unit.hpp"
#include "arcs.hpp"
#include "descriptions/method_description.hpp"
#include "descriptions/system_description.hpp"
#include "hamjet/studies/propagation.hpp"
#include "integration.hpp"

namespace hamjet {
namespace {

constexpr double megabyte = 1e6;

/// Asking for the free memory takes as long as the integration of a small scene. Therefore no
/// question is asked if hardly more memory than that of the program itself is needed.
constexpr double always_there = 32 * megabyte;

/// Bytes of the product schedules: pairs of blocks, see ProductSchedule.
double schedule_bytes(std::size_t variables, int order) {
  const std::size_t outer = variables >= 3 ? variables - 3 : variables;
  double pairs = 0;
  for (int d = 0; d <= order; ++d) {
    for (int s = 0; s <= d; ++s) {
      if (variables < 3 && s != d) continue;
      const double splits =
          outer == 0 ? (s == 0 ? 1 : 0) : SeriesSpace::monomial_count(2 * outer - 1, s);
      pairs += splits * (variables >= 3 ? d - s + 1 : 1);
    }
  }
  return 1.5 * 8 * pairs;
}

}  // namespace

DynamicalSystem make_system(const SystemSettings& settings, double canonical_radius) {
  return description_of(settings.model).make(settings, canonical_radius);
}

DynamicalSystem make_system(const Scene& scene) {
  if (scene.own_system) return *scene.own_system;
  return make_system(scene.system, scene.canonical_radius);
}

namespace {

/// Bytes of one integration; for arcs, the bytes of every thread, and the maps and starts of all
/// arcs.
double run_memory(const Scene& scene, const IntegratorSettings& settings,
                  const DynamicalSystem& system, std::size_t variables, std::size_t threads) {
  const double real = scene.precision == Precision::extended ? sizeof(Extended) : sizeof(double);
  const int order = working_order(system, scene.order);
  const double whole =
      integration_memory(settings, system, SeriesSpace::monomial_count(variables, order), real);
  if (scene.arcs == std::optional<std::size_t>(1) || reason_not_to_split(scene, settings)) {
    return whole;
  }
  const std::size_t dimension = system.dimension();
  const double arcs = static_cast<double>(scene.arcs.value_or(most_chosen_arcs));
  const double each =
      integration_memory(settings, system, SeriesSpace::monomial_count(dimension, order), real);
  const double maps = 2 * static_cast<double>(dimension) * real *
                      SeriesSpace::monomial_count(dimension, scene.order);
  const double schedule = variables == dimension ? 0 : schedule_bytes(dimension, scene.order);
  return std::min(arcs, static_cast<double>(threads)) * each + arcs * maps + schedule;
}

}  // namespace

double estimate_memory(const Scene& scene, const DynamicalSystem& system, std::size_t variables,
                       std::size_t threads) {
  const OperationList& list = system.evaluated_list();
  const double values = static_cast<double>(list.operations().size()) + 2;
  const double components = static_cast<double>(system.dimension());
  const int order = working_order(system, scene.order);
  const double working = SeriesSpace::monomial_count(variables, order);
  const double coefficients = SeriesSpace::monomial_count(variables, scene.order);
  double largest_run = 0;
  for (const IntegratorSettings& settings : scene.integrators) {
    largest_run = std::max(largest_run, run_memory(scene, settings, system, variables, threads));
  }
  double total = largest_run + schedule_bytes(variables, scene.order);
  const double jets_each = static_cast<double>(scene.jet_times.size()) + 1;
  const double stored_jets = static_cast<double>(scene.integrators.size()) * jets_each + 4;
  total += stored_jets * components * coefficients * sizeof(Extended);
  if (!scene.jet_times.empty()) total += most_trajectory_bytes;
  if (scene.reference) total += 2 * values * 16 * sizeof(Extended) * working;
  if (variables == system.dimension()) {
    // Poisson brackets need the derivatives of all components by all variables.
    total += (components * components + 4) * coefficients * (sizeof(Extended) + sizeof(double));
  }
  if (scene.kinds) {
    // Inversions need their series, and a generating function of order N + 1 for every kind and
    // run.
    total += (10 * components + scene.order) * coefficients * sizeof(Extended);
    total += static_cast<double>(scene.kinds->size() * scene.integrators.size() + 1) *
             SeriesSpace::monomial_count(variables, scene.order + 1) *
             (sizeof(Extended) + static_cast<double>(variables));
  }
  return total + 20 * megabyte;
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
  const double needed = estimate_memory(scene, *problem.system, scene.variables.size(), threads);
  const double memory_limit = needed > always_there ? available_memory() : needed;
  if (needed > memory_limit) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("order {} in {} variables: {:.4g} coefficients a component, about {:.0f} "
                    "MB in all, but {:.0f} MB are free; a lower order, fewer variables or no "
                    "reference would fit",
                    scene.order, scene.variables.size(),
                    SeriesSpace::monomial_count(scene.variables.size(), scene.order),
                    needed / megabyte, memory_limit / megabyte));
  }
  problem.space = SeriesSpace::create(scene.variables.size(), scene.order);
  return problem;
}

}  // namespace hamjet
