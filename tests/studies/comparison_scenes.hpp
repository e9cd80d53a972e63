#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/studies/comparison.hpp"

// Small scenes for comparisons of integrators.

namespace hamjet {

inline Scene oscillator_scene() {
  Scene scene;
  scene.system.model = SystemModel::harmonic_oscillator;
  scene.units = {1e-3, 1};
  scene.nominal = {1, 0};
  scene.duration = 5;
  scene.order = 2;
  scene.variables = {0, 1};
  scene.separation = 0.1;
  scene.comparison.repeats = 1;
  return scene;
}

/// Kepler's problem, e = 0.3, from perigee at distance 1, a third of a revolution.
inline Scene kepler_scene() {
  Scene scene;
  scene.system.model = SystemModel::kepler;
  scene.units = {7000, 1000};
  scene.nominal = {1, 0, 0, 0, std::sqrt(1.3) * 0.6, std::sqrt(1.3) * 0.8};
  scene.duration = 3.5;
  scene.order = 2;
  scene.variables = {0, 1, 2, 3, 4, 5};
  scene.separation = 10.0 / 7000;
  scene.comparison.repeats = 1;
  return scene;
}

inline IntegratorSettings gauss(const std::string& label, int stages, double step) {
  IntegratorSettings settings;
  settings.label = label;
  settings.stages = stages;
  settings.step_canonical = step;
  return settings;
}

inline CandidateSeries series_of(const std::string& name, std::vector<Candidate> candidates) {
  return {name, 0, false, std::move(candidates)};
}

inline ComparisonResult compared(const Scene& scene, std::vector<CandidateSeries> series) {
  ComparisonOptions options;
  options.series = std::move(series);
  ComparisonResult result;
  compare(scene, options, result);
  return result;
}

inline const ComparedRun& run_of(const ComparisonResult& result, const std::string& label) {
  for (const ComparedRun& run : result.runs) {
    if (run.settings.label == label) return run;
  }
  throw std::runtime_error("no run " + label);
}

}  // namespace hamjet
