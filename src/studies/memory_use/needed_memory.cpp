#include "needed_memory.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../../integrators/arc_plan.hpp"
#include "../arcs.hpp"
#include "../descriptions/method_description.hpp"
#include "../integration.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/propagation.hpp"

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

void require_memory(const Scene& scene, const DynamicalSystem& system, std::size_t threads) {
  const double needed = estimate_memory(scene, system, scene.variables.size(), threads);
  const double memory_limit = needed > always_there ? available_memory() : needed;
  if (needed > memory_limit) {
    throw Error(
        ErrorKind::too_large,
        fmt::format("order {} in {} variables: {:.0f} coefficients a component, about {:.0f} "
                    "MB in all, but {:.0f} MB are free; a lower order, fewer variables or no "
                    "reference would fit",
                    scene.order, scene.variables.size(),
                    SeriesSpace::monomial_count(scene.variables.size(), scene.order),
                    needed / megabyte, memory_limit / megabyte));
  }
}

}  // namespace hamjet
