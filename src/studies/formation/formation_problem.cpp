#include "formation_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../descriptions/method_description.hpp"
#include "../earth_system.hpp"
#include "hamjet/error.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "single_transfer.hpp"

namespace hamjet {
void require_formation_problem(const Scene& scene, bool has_table, std::string_view table) {
  const auto refuse = [&](const std::string& problem) {
    throw Error(ErrorKind::scene, fmt::format("{}: {}", table, problem));
  };
  if (!has_table) refuse("missing, the scene has no such table");
  if (!is_orbit(scene.system.model))
    refuse(
        "is about a deputy and a chief in orbit, got a model "
        "that is no orbit, must be zonal-gravity or kepler");
  if (scene.variables.size() != scene.nominal.size()) {
    refuse("needs the jet in all six variables, got jet.variables with fewer, must be left out");
  }
  if (scene.precision != Precision::double_precision) {
    refuse("is computed in double precision, got precision = \"extended\", must be \"double\"");
  }
  symplectic_integrator(scene);
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

void require_one_spacecraft(const Scene& scene, std::string_view table) {
  for (const Difference& difference : differences_of(scene)) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: is about spacecraft that are alike, got a deputy with {} = {:.6g} "
                            "beside a chief with {:.6g}, must be the same; motion serves deputies "
                            "that differ",
                            table, difference.parameter, difference.deputy, difference.chief));
  }
  if (scene.system.earth && !scene.system.earth->parameters.empty()) {
    throw Error(ErrorKind::scene,
                fmt::format("{}: expands in positions and momenta alone, got jet.variables with "
                            "{}, must be without it",
                            table, scene.system.earth->parameters[0]));
  }
}

Scene with_deputy_parameters(Scene scene) {
  const std::vector<Difference> differences = differences_of(scene);
  if (differences.empty()) return scene;
  if (differences.size() > 1) {
    throw Error(ErrorKind::scene,
                fmt::format("deputy.spacecraft: differs from the chief's in {} and {}, must differ "
                            "in one of them: jets have one parameter",
                            differences[0].parameter, differences[1].parameter));
  }
  const Difference& difference = differences[0];
  const EarthSettings& earth = *scene.system.earth;
  const auto place =
      std::find(earth.parameters.begin(), earth.parameters.end(), difference.parameter);
  if (place != earth.parameters.end()) return scene;
  if (!earth.parameters.empty()) {
    throw Error(ErrorKind::scene,
                fmt::format("deputy.spacecraft: differs from the chief's in {}, got jet.variables "
                            "with {}, must be without it: jets have one parameter",
                            difference.parameter, earth.parameters[0]));
  }
  add_parameter(scene.system, difference.parameter);
  scene.variables.push_back(scene.nominal.size());
  scene.nominal.push_back(difference.chief);
  scene.coordinates = {};
  return scene;
}

std::vector<double> deputy_parameters(const Scene& scene) {
  std::vector<double> values;
  if (!scene.system.earth) return values;
  const std::vector<Difference> differences = differences_of(scene);
  for (const std::string& name : scene.system.earth->parameters) {
    const auto own = std::find_if(differences.begin(), differences.end(),
                                  [&](const Difference& one) { return one.parameter == name; });
    values.push_back(own == differences.end() ? 0 : own->deputy - own->chief);
  }
  return values;
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
