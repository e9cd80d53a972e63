#include "formation_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamjet/error.hpp"

namespace hamjet {
namespace {

bool is_symplectic(const IntegratorSettings& settings) {
  switch (settings.method) {
    case IntegrationMethod::gauss:
    case IntegrationMethod::stormer:
    case IntegrationMethod::velocity_verlet:
      return true;
    case IntegrationMethod::newmark:  // for beta > 0 in other variables than (q, p)
      return settings.beta == 0;
    case IntegrationMethod::fehlberg78:
    case IntegrationMethod::cvode_adams:
    case IntegrationMethod::cvode_bdf:
      return false;
  }
  return false;
}

}  // namespace

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
  const auto place =
      std::find_if(scene.integrators.begin(), scene.integrators.end(), is_symplectic);
  if (place == scene.integrators.end()) {
    throw Error(
        ErrorKind::scene,
        "integrator: only a symplectic map has generating functions, got none that is "
        "symplectic in (q, p), must be one of gauss, stormer, velocity-verlet, newmark with "
        "beta = 0");
  }
  return *place;
}

}  // namespace hamjet
