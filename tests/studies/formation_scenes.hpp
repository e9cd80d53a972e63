#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "hamjet/studies/scene.hpp"

// Chiefs and transfers for tests of formation studies.

namespace hamjet {

inline IntegratorSettings precise_gauss() {
  IntegratorSettings settings;
  settings.label = "gauss8";
  settings.stages = 8;
  settings.tolerance = 1e-14;
  return settings;
}

/// Equal parts of a span, with its end.
inline std::vector<double> equal_times(double span, int count) {
  std::vector<double> times;
  for (int k = 1; k <= count; ++k) times.push_back(span * k / count);
  return times;
}

/// Equal parts of a span after 0.
inline std::vector<double> equal_times_from_0(double span, int count) {
  std::vector<double> times = equal_times(span, count);
  times.insert(times.begin(), 0);
  return times;
}

/// Kepler's problem from perigee at distance 1 in the orbit's plane z = 0; eccentricity 0 is the
/// circular orbit.
inline Scene kepler_chief(double eccentricity, double length_km, double time_s, int order) {
  Scene scene;
  scene.system.model = SystemModel::kepler;
  scene.units = {length_km, time_s};
  scene.nominal = {1, 0, 0, 0, std::sqrt(1 + eccentricity), 0};
  scene.duration = 1;
  scene.order = order;
  scene.variables = {0, 1, 2, 3, 4, 5};
  scene.integrators = {precise_gauss()};
  return scene;
}

/// Nearly half a revolution of a circle, from 1 km behind its chief to 1 km before it: half an
/// ellipse of 2 by 1, which at the middle is a quarter of the distance of its ends above or below
/// the chief (Fehse, Automated Rendezvous and Docking of Spacecraft, 2003, section 3.3).
inline Scene half_revolution_along_the_track() {
  Scene scene = kepler_chief(0, 7000, 1000, 2);
  TransferSettings settings;
  settings.start.position_m = {0, -1000, 0};
  settings.end.position_m = {0, 1000, 0};
  settings.times = {std::numbers::pi - 0.02};
  settings.singular_margin = 1e-3;
  scene.transfer = settings;
  return scene;
}

/// A revolution of the orbit with e = 0.3, the paper's without its zonal harmonics.
inline const double paper_period = 2 * std::numbers::pi * std::pow(0.7, -1.5);

/// The paper's orbit with J2 and J3 (case SEED-* of reference_cases.json).
inline Scene paper_chief(int order) {
  Scene scene = kepler_chief(0.3, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), order);
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = 1.082626675e-3;
  scene.system.J[3] = 2.532436e-6;
  scene.canonical_radius = 0x1.d283e1c01dcf3p-1;
  scene.nominal = {1, 0, 0, 0, 0x1.23e2896280f23p-1, 0x1.f98f3adef13f2p-1};
  return scene;
}

}  // namespace hamjet
