#include "formation_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../descriptions/method_description.hpp"
#include "hamjet/error.hpp"

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
