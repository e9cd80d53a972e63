#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "integrators/momentum_unit.hpp"
#include "studies/estimates/estimated_scenes.hpp"
#include "support/kepler_ellipse.hpp"

// Random jets of orbits, of all orders and lengths and in any units, whose estimated errors are
// compared with true ones: of ellipses from their closed form, else from extended precision.

namespace hamjet::test {

/// The units in which an orbit of the given semi-major axis, in kilometres, has the semi-major axis
/// of a scene.
inline CanonicalUnits units_of_axis(double axis_km, double axis) {
  constexpr double mu_km3_s2 = 398600.4415;
  const double length_km = axis_km / axis;
  return {length_km, std::sqrt(length_km * length_km * length_km / mu_km3_s2)};
}

/// Draws an orbit with its units, of Kepler's problem or about an oblate body. Returns the period.
inline double draw_orbit(Draw& draw, Scene& scene, bool is_kepler) {
  const double axis = draw.one_in(2) ? draw.decades(1e-4, 1e8) : draw.between(1, 2);
  const double eccentricity = draw.one_in(3) ? draw.between(0.8, 0.95) : draw.between(0, 0.8);
  scene.nominal = random_orbit(draw, axis, eccentricity);
  scene.units = units_of_axis(draw.decades(7000, 1e5), axis);
  scene.system.model = is_kepler ? SystemModel::kepler : SystemModel::zonal_gravity;
  scene.system.mu_km3_s2 = 398600.4415;
  if (!is_kepler) {
    scene.canonical_radius = axis * (1 - eccentricity) * draw.between(0.3, 0.98);
    scene.system.radius_km = scene.canonical_radius * scene.units.length_km;
    scene.system.J[2] = 1.082626675e-3;
    if (draw.one_in(2)) scene.system.J[3] = -2.532436e-6;
  }
  for (std::size_t v = 0; v < 6; ++v) scene.variables.push_back(v);
  return 2 * std::numbers::pi * std::pow(axis, 1.5);
}

/// Settings of Gauss as most scenes have them, mostly with the default number of stages.
inline void draw_gauss(Draw& draw, Scene& scene, double period, bool may_be_fixed) {
  IntegratorSettings settings;
  settings.label = "run";
  constexpr int stages[] = {4, 6, 8, 8, 8, 8, 8, 12, 16};
  settings.stages = draw.of(stages);
  if (may_be_fixed && draw.one_in(8)) {
    settings.step_canonical = period / draw.decades(15, 200);
  } else {
    settings.tolerance = draw.decades(settings.stages < 8 ? 1e-12 : 1e-15, 1e-6);
  }
  scene.integrators = {settings};
}

/// The jet of a seed over a few steps, an ellipse of order 5 to 8: its error is that of steps
/// alone, which few directions show.
inline Scene jet_of_few_steps(std::uint64_t seed) {
  Draw draw(seed);
  Scene scene;
  scene.name = "few-" + std::to_string(seed);
  scene.nominal = random_orbit(draw, 1, draw.between(0, 0.9));
  scene.units = units_of_axis(7000, 1);
  scene.system.model = SystemModel::kepler;
  for (std::size_t v = 0; v < 6; ++v) scene.variables.push_back(v);
  scene.order = draw.whole(5, draw.one_in(4) ? 8 : 6);
  scene.duration = 6.283185307 * draw.decades(0.02, 1);
  IntegratorSettings settings;
  settings.label = "run";
  settings.tolerance = draw.decades(1e-14, 1e-8);
  scene.integrators = {settings};
  return scene;
}

/// The jet of a seed: orders 1 to 8 over arcs of a step to 50 revolutions. Those about an oblate
/// body, whose reference takes long, are of few degrees or short; a third are of few steps.
inline Scene estimated_jet(std::uint64_t seed) {
  Draw draw(seed);
  if (draw.one_in(3)) return jet_of_few_steps(seed);
  Scene scene;
  scene.name = "jet-" + std::to_string(seed);
  const bool is_kepler = !draw.one_in(3);
  const double period = draw_orbit(draw, scene, is_kepler);
  scene.order = draw.whole(1, 8);
  const double longest = is_kepler ? 50 : (scene.order <= 2 ? 10 : (scene.order <= 4 ? 1 : 0.05));
  scene.duration = period * draw.decades(0.003, longest);
  if (draw.one_in(8)) scene.duration = -scene.duration;
  draw_gauss(draw, scene, period, true);
  if (!is_kepler) scene.reference = ReferenceSettings{1e-21};
  return scene;
}

/// The jet of an ellipse about the scene's nominal from the closed form.
inline FlowJet<Extended> jet_of_ellipse(const Scene& scene) {
  const SpacePointer space = SeriesSpace::create(6, scene.order);
  std::array<Series<Extended>, 6> z = {Series<Extended>(space), Series<Extended>(space),
                                       Series<Extended>(space), Series<Extended>(space),
                                       Series<Extended>(space), Series<Extended>(space)};
  for (std::size_t i = 0; i < 6; ++i) {
    z[i] = Series<Extended>::variable(space, i, Extended(scene.nominal[i]));
  }
  const auto end = along_ellipse(z, Extended(scene.duration), 5);
  return {end.begin(), end.end()};
}

/// The degrees of a jet with their true errors; empty for a jet that failed or has no estimate.
inline std::vector<JudgedDegree> judged_degrees_of_jet(const Scene& scene) {
  const PropagationResult result = propagate(scene);
  if (scene.system.model != SystemModel::kepler) {
    return result.reference ? judged_degrees(result) : std::vector<JudgedDegree>();
  }
  const RunResult& run = result.runs.front();
  if (!run.failure.empty() || !run.error_estimate.by_degree || run.jet.size() != 6) return {};
  const int exponent = natural_momentum_exponent(true, scene.nominal);
  const auto errors = relative_error_by_degree(
      in_momentum_unit(run.jet, scene.variables, 3, exponent),
      in_momentum_unit(jet_of_ellipse(scene), scene.variables, 3, exponent));
  std::vector<JudgedDegree> degrees;
  for (std::size_t d = 0; d < errors.size(); ++d) {
    degrees.push_back({static_cast<int>(d), errors[d], (*run.error_estimate.by_degree)[d]});
  }
  return degrees;
}

}  // namespace hamjet::test
