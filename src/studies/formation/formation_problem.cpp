#include "formation_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../descriptions/method_description.hpp"
#include "../earth_system.hpp"
#include "charts/coordinate_deviations.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "single_transfer.hpp"

namespace hamjet {
namespace {

[[noreturn]] void refuse(std::string_view table, const std::string& problem) {
  throw Error(ErrorKind::scene, fmt::format("{}: {}", table, problem));
}

/// What all studies of deviations need, of orbits and others.
void require_symplectic_jets(const Scene& scene, std::string_view table) {
  if (scene.variables.size() != scene.nominal.size()) {
    refuse(table,
           "needs the jet in all six variables, got jet.variables with fewer, must be left out");
  }
  if (scene.precision != Precision::double_precision) {
    refuse(table,
           "is computed in double precision, got precision = \"extended\", must be \"double\"");
  }
  symplectic_integrator(scene);
}

}  // namespace

void require_formation_problem(const Scene& scene, bool has_table, std::string_view table) {
  if (!has_table) refuse(table, "missing, the scene has no such table");
  if (!is_orbit(scene.system.model))
    refuse(table,
           "is about a deputy and a chief in orbit, got a model "
           "that is no orbit, must be earth, zonal-gravity or kepler");
  require_symplectic_jets(scene, table);
}

void require_deviation_problem(const Scene& scene, bool has_table, std::string_view table) {
  if (!has_table) refuse(table, "missing, the scene has no such table");
  if (is_orbit(scene.system.model)) return require_formation_problem(scene, has_table, table);
  if (const std::string missing = missing_for_deviations(scene); !missing.empty()) {
    refuse(table, missing);
  }
  require_symplectic_jets(scene, table);
}

namespace {

/// A coefficient in which the deputy differs from its chief.
struct Difference {
  std::string_view parameter;
  double deputy = 0;
  double chief = 0;
};

std::vector<Difference> differences_of(const Scene& scene) {
  std::vector<Difference> differences;
  if (!scene.system.earth || !scene.deputy) return differences;
  const auto add = [&](std::string_view name, const std::optional<double>& own, double chief) {
    if (own && *own != chief) differences.push_back({name, *own, chief});
  };
  add(drag_parameter, scene.deputy->drag_m2_kg, scene.system.earth->drag_m2_kg);
  add(radiation_parameter, scene.deputy->radiation_m2_kg, scene.system.earth->radiation_m2_kg);
  return differences;
}

}  // namespace

bool is_like_chief(const Scene& scene) { return differences_of(scene).empty(); }

SharedSystem system_of_chief(const Scene& scene, const ComputedProblem& orbit) {
  return is_like_chief(scene) ? orbit.system : make_system(scene);
}

void require_one_spacecraft(const Scene& scene, std::string_view table) {
  for (const Difference& difference : differences_of(scene)) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: is about spacecraft that are alike, got a deputy with {} = {:.6g} "
                            "beside a chief with {:.6g}, must be the same; motion, transfer, "
                            "assignment and uncertainty serve deputies that differ",
                            table, difference.parameter, difference.deputy, difference.chief));
  }
  require_states_alone(scene, table);
}

void require_states_alone(const Scene& scene, std::string_view table) {
  if (scene.system.earth && !scene.system.earth->parameters.empty()) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: expands in positions and momenta alone, got jet.variables with "
                            "{}, must be without it",
                            table, scene.system.earth->parameters[0]));
  }
}

Scene with_deputy_coefficients(Scene scene) {
  if (is_like_chief(scene)) return scene;
  EarthSettings& earth = *scene.system.earth;
  earth.drag_m2_kg = scene.deputy->drag_m2_kg.value_or(earth.drag_m2_kg);
  earth.radiation_m2_kg = scene.deputy->radiation_m2_kg.value_or(earth.radiation_m2_kg);
  return scene;
}

Scene with_deputy_parameters(Scene scene) {
  if (!scene.system.earth) return scene;
  EarthSettings& earth = *scene.system.earth;
  const std::vector<std::string> wanted = differing_parameters(scene);
  if (earth.parameters == wanted) return scene;
  // Deputies have the chief's values of the other parameters, in which nothing need be expanded.
  constexpr std::size_t n = 6;
  earth.parameters.clear();
  scene.system.own_names.clear();
  std::erase_if(scene.variables, [](std::size_t v) { return v >= n; });
  scene.nominal.resize(n);
  for (const std::string& name : wanted) add_parameter(scene.system, name);
  for (const double value : parameter_values(scene.system)) {
    scene.variables.push_back(scene.nominal.size());
    scene.nominal.push_back(value);
  }
  const bool is_automatic = scene.coordinates == JetCoordinates::automatic;
  if (!is_automatic && !serve_parameters(scene.coordinates)) scene.coordinates = {};
  return scene;
}

std::vector<double> deputy_parameters(const Scene& scene) {
  std::vector<double> values;
  if (!scene.system.earth) return values;
  for (const std::string& name : scene.system.earth->parameters) {
    values.push_back(parameter_difference(scene, name));
  }
  return values;
}

std::vector<std::string> differing_parameters(const Scene& scene) {
  std::vector<std::string> names;
  for (const Difference& one : differences_of(scene)) names.emplace_back(one.parameter);
  return names;
}

double parameter_difference(const Scene& scene, std::string_view name) {
  for (const Difference& one : differences_of(scene)) {
    if (one.parameter == name) return one.deputy - one.chief;
  }
  return 0;
}

std::vector<double> deputy_deviation(const Scene& scene) {
  std::vector<double> deviation =
      ChiefFrame(scene.nominal, metric_units(scene), scene.deputy->frame)
          .deviation(scene.deputy->start);
  for (const double difference : deputy_parameters(scene)) deviation.push_back(difference);
  return deviation;
}

const IntegratorSettings& symplectic_integrator(const Scene& scene) {
  const auto place = std::find_if(scene.integrators.begin(), scene.integrators.end(),
                                  [](const IntegratorSettings& settings) {
                                    return description_of(settings.method).is_symplectic(settings);
                                  });
  if (place == scene.integrators.end()) {
    std::vector<std::string> good;
    for (const MethodDescription& method : all_methods()) {
      const bool is_always = method.not_symplectic.empty();
      if (!is_always && method.symplectic_with.empty()) continue;
      good.push_back(is_always ? std::string(method.name)
                               : fmt::format("{} with {}", method.name, method.symplectic_with));
    }
    throw Error(ErrorKind::scene,
                fmt::format("integrator: only a symplectic map has generating functions, got none "
                            "that is symplectic in (q, p), must be one of {}",
                            fmt::join(good, ", ")));
  }
  return *place;
}

}  // namespace hamjet
