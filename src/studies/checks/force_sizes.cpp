#include "force_sizes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <functional>

#include "../../algebra/state_sums.hpp"
#include "../exact_flow.hpp"
#include "../flights/paced_times.hpp"
#include "../formation/formation_problem.hpp"
#include "../formation/single_transfer.hpp"
#include "../sunlight.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {
namespace {

using Eigen::Vector3d;

Vector3d place_of(const std::vector<double>& z) { return {z[0], z[1], z[2]}; }

/// States along time, from the start on.
using Orbit = std::vector<std::vector<double>>;

Orbit fly(const SharedSystem& system, std::vector<double> state, const ClockTime& start,
          const std::vector<double>& times) {
  Orbit orbit = {state};
  for (std::size_t k = 1; k < times.size(); ++k) {
    state = exact_flow(system, state, start + times[k - 1], times[k] - times[k - 1]);
    orbit.push_back(state);
  }
  return orbit;
}

/// Equal times over the scene's duration.
std::vector<double> looks(const Scene& scene) {
  const int count =
      interval_count(scene, scene.duration, {.each_revolution = 8, .fewest = 48, .most = 2000});
  std::vector<double> times;
  for (int k = 0; k <= count; ++k) times.push_back(scene.duration * k / count);
  return times;
}

/// Accelerations of a system along an orbit.
std::vector<Vector3d> accelerations(const DynamicalSystem& system, const Orbit& orbit,
                                    const ClockTime& start, const std::vector<double>& times) {
  DifferentiableFunction<double> field(system.vector_field);
  std::vector<Vector3d> result;
  for (std::size_t k = 0; k < orbit.size(); ++k) {
    if (field.has_time()) {
      field.evaluate(orbit[k], (start + times[k]).in<double>());
    } else {
      field.evaluate(orbit[k]);
    }
    result.emplace_back(field.value(3), field.value(4), field.value(5));
  }
  return result;
}

/// A scene with one force left out.
struct Without {
  std::string name;
  std::string key;
  std::function<void(EarthSettings&)> leave_out;
};

std::vector<Without> forces_of(const EarthSettings& earth) {
  std::vector<Without> forces;
  const auto truncated = [](int degree) {
    return [degree](EarthSettings& settings) {
      settings.degree = std::min(settings.degree, degree);
      settings.order = std::min(settings.order, degree);
    };
  };
  if (earth.order > 0) {
    forces.push_back({"tesseral harmonics", "gravity_order = 0",
                      [](EarthSettings& settings) { settings.order = 0; }});
  }
  for (const int degree : {2, 8, 20, 36, 70}) {
    if (earth.degree <= degree) continue;
    forces.push_back({"harmonics above " + std::to_string(degree),
                      "gravity_degree = " + std::to_string(degree), truncated(degree)});
  }
  if (earth.has_sun) {
    forces.push_back({"Sun", "sun = false", [](EarthSettings& s) { s.has_sun = false; }});
  }
  if (earth.has_moon) {
    forces.push_back({"Moon", "moon = false", [](EarthSettings& s) { s.has_moon = false; }});
  }
  if (earth.atmosphere) {
    forces.push_back({"drag", "without atmosphere and [spacecraft]",
                      [](EarthSettings& s) { s.atmosphere.reset(); }});
  }
  if (earth.radiation) {
    forces.push_back(
        {"radiation", "radiation = false", [](EarthSettings& s) { s.radiation.reset(); }});
  }
  if (earth.sunlight && !earth.sunlight->edges().empty()) {
    forces.push_back({"shadow", "shadow = \"none\"", [](EarthSettings& s) { s.sunlight.reset(); }});
  }
  return forces;
}

}  // namespace

std::vector<ForceSize> force_sizes(const Scene& asked) {
  std::vector<ForceSize> sizes;
  if (!asked.system.earth) return sizes;
  const Scene scene = with_deputy_parameters(asked);
  const MetricUnits units = metric_units(scene);
  const std::vector<double> times = looks(scene);
  std::optional<std::vector<double>> deputy;
  if (scene.deputy) deputy = state_sum(scene.nominal, deputy_deviation(scene));
  const auto fly_from = [&](const SharedSystem& system, const std::vector<double>& state) {
    return fly(system, state, scene.start_time, times);
  };
  const SharedSystem all = make_system(scene);
  const Orbit chief = fly_from(all, scene.nominal);
  const Orbit beside = deputy ? fly_from(all, *deputy) : Orbit();
  const std::vector<Vector3d> full = accelerations(*all, chief, scene.start_time, times);
  for (const Without& force : forces_of(*scene.system.earth)) {
    SystemSettings settings = scene.system;
    force.leave_out(*settings.earth);
    const SharedSystem system = make_system(settings, scene.canonical_radius);
    const Orbit other_chief = fly_from(system, scene.nominal);
    const Orbit other_beside = deputy ? fly_from(system, *deputy) : Orbit();
    const std::vector<Vector3d> less = accelerations(*system, chief, scene.start_time, times);
    ForceSize size = {.name = force.name, .key = force.key};
    if (deputy) size.relative_m = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Vector3d moved = place_of(other_chief[k]) - place_of(chief[k]);
      const double acceleration =
          (full[k] - less[k]).norm() * units.length_m / (units.time_s * units.time_s);
      size.largest_m_s2 = std::max(size.largest_m_s2, acceleration);
      size.chief_m = std::max(size.chief_m, moved.norm() * units.length_m);
      if (!deputy) continue;
      const Vector3d other = place_of(other_beside[k]) - place_of(beside[k]);
      size.relative_m = std::max(*size.relative_m, (other - moved).norm() * units.length_m);
    }
    sizes.push_back(std::move(size));
  }
  const auto& sunlight = scene.system.earth->sunlight;
  if (deputy && sunlight && !sunlight->edges().empty()) {
    // All flights of a scene have the light that its chief sees; this is what that leaves out.
    SystemSettings settings = scene.system;
    settings.earth->sunlight = sunlight_along(settings, scene.canonical_radius, *deputy);
    const SharedSystem system = make_system(settings, scene.canonical_radius);
    const Orbit own = fly_from(system, *deputy);
    const auto with_chief = accelerations(*all, beside, scene.start_time, times);
    const auto with_own = accelerations(*system, beside, scene.start_time, times);
    ForceSize size = {.name = "deputy's own edges", .key = "no key does", .relative_m = 0};
    for (std::size_t k = 0; k < times.size(); ++k) {
      const double acceleration =
          (with_own[k] - with_chief[k]).norm() * units.length_m / (units.time_s * units.time_s);
      size.largest_m_s2 = std::max(size.largest_m_s2, acceleration);
      const Vector3d moved = place_of(own[k]) - place_of(beside[k]);
      size.relative_m = std::max(*size.relative_m, moved.norm() * units.length_m);
    }
    sizes.push_back(std::move(size));
  }
  return sizes;
}

double drag_m_s2(const Scene& scene) {
  if (!scene.system.earth || !scene.system.earth->atmosphere) return 0;
  SystemSettings settings = scene.system;
  settings.earth->atmosphere.reset();
  const auto acceleration = [&](const SystemSettings& forces) {
    const SharedSystem system = make_system(forces, scene.canonical_radius);
    return accelerations(*system, {scene.nominal}, scene.start_time, {0}).front();
  };
  const MetricUnits units = metric_units(scene);
  return (acceleration(scene.system) - acceleration(settings)).norm() * units.length_m /
         (units.time_s * units.time_s);
}

}  // namespace hamjet
