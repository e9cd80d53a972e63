#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "hamjet/integrators/cvode.hpp"
#include "hamjet/studies/propagation.hpp"

// Random scenes of all models and methods, coarse and fine, to compare their estimated errors with
// the true ones.

namespace hamjet::test {

/// Random numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  /// A number that is equally likely in every decade.
  double decades(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  int whole(int low, int high) {
    return low + static_cast<int>(generator_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int count) { return whole(1, count) == 1; }
  template <class List>
  auto of(const List& list) {
    return list[static_cast<std::size_t>(whole(0, static_cast<int>(std::size(list)) - 1))];
  }

 private:
  std::mt19937_64 generator_;
};

/// Position and momentum of a Kepler orbit with mu = 1, in a random orientation.
inline std::vector<double> random_orbit(Draw& draw, double axis, double eccentricity) {
  const double anomaly = draw.one_in(3) ? 0 : draw.between(0, 2 * std::numbers::pi);  // eccentric
  const double root = std::sqrt(1 - eccentricity * eccentricity);
  const double radius = axis * (1 - eccentricity * std::cos(anomaly));
  const double rate = std::sqrt(axis) / radius;
  const double plane[4] = {axis * (std::cos(anomaly) - eccentricity),
                           axis * root * std::sin(anomaly), -rate * std::sin(anomaly),
                           rate * root * std::cos(anomaly)};
  const double w = draw.between(0, 6), i = draw.between(0, 3), node = draw.between(0, 6);
  const double p[3] = {std::cos(node) * std::cos(w) - std::sin(node) * std::sin(w) * std::cos(i),
                       std::sin(node) * std::cos(w) + std::cos(node) * std::sin(w) * std::cos(i),
                       std::sin(w) * std::sin(i)};
  const double q[3] = {-std::cos(node) * std::sin(w) - std::sin(node) * std::cos(w) * std::cos(i),
                       -std::sin(node) * std::sin(w) + std::cos(node) * std::cos(w) * std::cos(i),
                       std::cos(w) * std::sin(i)};
  std::vector<double> state(6);
  for (std::size_t k = 0; k < 3; ++k) {
    state[k] = plane[0] * p[k] + plane[1] * q[k];
    state[3 + k] = plane[2] * p[k] + plane[3] * q[k];
  }
  return state;
}

/// Sets the model and the nominal; returns about a period.
inline double draw_model(Draw& draw, Scene& scene) {
  SystemSettings& system = scene.system;
  const int model = draw.whole(0, 9);
  if (model <= 5) {
    const double axis = draw.one_in(4) ? draw.decades(1e-3, 1e4) : draw.between(1, 2);
    const double eccentricity = draw.one_in(3) ? draw.between(0.8, 0.99) : draw.between(0, 0.8);
    scene.nominal = random_orbit(draw, axis, eccentricity);
    system.model = model == 0 ? SystemModel::kepler : SystemModel::zonal_gravity;
    if (model > 0) {
      scene.canonical_radius = axis * (1 - eccentricity) * draw.between(0.3, 0.98);
      system.J[2] = 1.082626675e-3;
      if (model > 1) system.J[3] = -2.532436e-6;
      const int highest = model == 5 ? draw.whole(4, ZonalCoefficients::highest) : 0;
      for (int n = 4; n <= highest; ++n) system.J[n] = draw.between(-1e-6, 1e-6);
    }
    return 2 * std::numbers::pi * std::pow(axis, 1.5);
  }
  scene.units = {1e-3, 1};
  const auto state = [&](std::size_t size, double largest) {
    scene.nominal.clear();
    for (std::size_t k = 0; k < size; ++k) scene.nominal.push_back(draw.between(-largest, largest));
  };
  switch (model) {
    case 6:
      system.model =
          draw.one_in(2) ? SystemModel::harmonic_oscillator : SystemModel::oscillator_pair;
      system.mass_kg = draw.between(0.5, 3);
      state(2 * degrees_of_freedom_of(system), 1);
      return 6;
    case 7:
      system.model = SystemModel::double_well;
      state(2, draw.decades(1e-3, 2));
      return 6;
    case 8:
      system.model = SystemModel::spring_pendulum;
      system.stiffness_N_per_m = draw.between(5, 50);
      system.gravity_m_s2 = 1;
      scene.nominal = {draw.between(-0.5, 0.5), -1.1, draw.between(-0.3, 0.3),
                       draw.between(-0.3, 0.3)};
      return 2;
    default:
      system.model = SystemModel::fermi_pasta_ulam;
      system.omega_rad_per_s = draw.decades(2, 50);
      system.pairs = 1;
      state(4, 0.7);
      return 2 * std::numbers::pi / system.omega_rad_per_s;
  }
}

inline void draw_integrator(Draw& draw, Scene& scene, double period) {
  IntegratorSettings settings;
  settings.label = "run";
  const int highest = cvode_available() ? 11 : 9;
  const int method = draw.whole(0, highest);
  // Above 1 a coarse run resolves nothing.
  const double step = period / draw.decades(20, 2000);
  if (method <= 4) {
    constexpr int stages[] = {2, 3, 4, 6, 8, 8, 12, 16};
    settings.stages = draw.of(stages);
    if (draw.one_in(4)) {
      settings.step_canonical = period / draw.decades(5, 300);
    } else {
      settings.tolerance = draw.decades(settings.stages < 4 ? 1e-9 : 1e-15, 1e-4);
    }
  } else if (method == 5) {
    settings.method = IntegrationMethod::stormer;
    settings.step_canonical = step;
  } else if (method <= 7) {
    settings.method = IntegrationMethod::velocity_verlet;
    settings.order = 2 * draw.whole(1, 4);
    settings.step_canonical = step;
  } else if (method == 8) {
    settings.method = IntegrationMethod::newmark;
    settings.beta = draw.one_in(2) ? 0.25 : draw.between(0.05, 0.4);
    settings.step_canonical = step;
  } else if (method == 9) {
    settings.method = IntegrationMethod::fehlberg78;
    if (draw.one_in(3)) {
      settings.step_canonical = step;
    } else {
      settings.tolerance = draw.decades(1e-14, 1e-5);
    }
  } else {
    settings.method = method == 10 ? IntegrationMethod::cvode_adams : IntegrationMethod::cvode_bdf;
    settings.tolerance = draw.decades(method == 10 ? 1e-12 : 1e-8, 1e-4);
  }
  const bool is_splittable = method <= 7;
  if (is_splittable && draw.one_in(4)) scene.arcs = static_cast<std::size_t>(draw.whole(2, 4));
  scene.integrators = {settings};
}

/// The scene of a seed.
inline Scene estimated_scene(std::uint64_t seed) {
  Draw draw(seed);
  Scene scene;
  scene.name = "seed-" + std::to_string(seed);
  const double period = draw_model(draw, scene);
  const std::size_t size = scene.nominal.size();
  scene.duration = period * (draw.one_in(4) ? draw.between(0.02, 0.5) : draw.between(0.5, 2));
  if (draw.one_in(8)) scene.duration = -scene.duration;
  // The time for the reference grows fast with the order.
  scene.order = size == 2 ? draw.whole(1, 6) : (draw.one_in(6) ? 3 : draw.whole(1, 2));
  for (std::size_t v = 0; v < size; ++v) scene.variables.push_back(v);
  if (draw.one_in(6)) {  // a subset
    scene.variables.resize(static_cast<std::size_t>(draw.whole(1, static_cast<int>(size) - 1)));
  }
  draw_integrator(draw, scene, period);
  scene.reference = ReferenceSettings{1e-21};
  return scene;
}

/// Error and estimate of one degree.
struct JudgedDegree {
  int degree = 0;
  double error = 0;
  double estimate = 0;

  double ratio() const { return error / estimate; }
};

/// The degrees of the scene's run. Empty if the run failed, has no estimate, or has a reference
/// that is not accurate enough to judge it.
inline std::vector<JudgedDegree> judged_degrees(const PropagationResult& result) {
  std::vector<JudgedDegree> degrees;
  const RunResult& run = result.runs.front();
  if (!run.failure.empty() || !run.error_by_degree || !run.error_estimate.by_degree) return {};
  for (std::size_t d = 0; d < run.error_by_degree->size(); ++d) {
    const double error = (*run.error_by_degree)[d];
    if (error <= 10 * result.reference->uncertainty_by_degree[d]) continue;
    degrees.push_back({static_cast<int>(d), error, (*run.error_estimate.by_degree)[d]});
  }
  return degrees;
}

/// A line that identifies the scene.
inline std::string description(const Scene& scene) {
  const IntegratorSettings& settings = scene.integrators.front();
  std::string text =
      scene.name + ": " + std::string(model_names()[static_cast<std::size_t>(scene.system.model)]) +
      ", " + std::string(method_names()[static_cast<std::size_t>(settings.method)]) + " " +
      std::to_string(settings.stages) + ", order " + std::to_string(scene.order) + ", " +
      std::to_string(scene.variables.size()) + " variables";
  if (scene.arcs) text += ", arcs " + std::to_string(*scene.arcs);
  return text;
}

}  // namespace hamjet::test
