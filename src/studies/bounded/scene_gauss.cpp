#include "scene_gauss.hpp"

#include <algorithm>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

const IntegratorSettings& gauss_of(const Scene& scene) {
  const auto found = std::find_if(
      scene.integrators.begin(), scene.integrators.end(), [](const IntegratorSettings& integrator) {
        return integrator.method == IntegrationMethod::gauss && integrator.tolerance.has_value();
      });
  if (found == scene.integrators.end()) {
    throw Error(ErrorKind::scene,
                "integrator: returns and events are searched for by a Gauss method with adaptive "
                "steps, got none, must be one with method = \"gauss\" and tolerance, or left out");
  }
  return *found;
}

}  // namespace

GaussSettings scene_gauss(const Scene& scene, double most_tolerance) {
  const IntegratorSettings& integrator = gauss_of(scene);
  GaussSettings gauss;
  gauss.stages = integrator.stages;
  gauss.tolerance = std::min(*integrator.tolerance, most_tolerance);
  gauss.compensated_summation = integrator.compensated_summation;
  return gauss;
}

const std::string& scene_gauss_label(const Scene& scene) { return gauss_of(scene).label; }

}  // namespace hamjet
