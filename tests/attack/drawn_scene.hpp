#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "force_models.hpp"

// Random scenes. A scene is drawn from a seed and its own number alone, so that each scene can be
// drawn again by itself.

namespace hamjet::attack {

class RandomNumbers {
 public:
  RandomNumbers(std::uint64_t seed, std::uint64_t scene);
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// The logarithm is uniform.
  double log_uniform(double low, double high);
  int integer(int low, int high);  ///< with both ends included
  bool chance(double probability) { return uniform(0, 1) < probability; }

 private:
  std::mt19937_64 generator_;
};

/// The contents of a scene in its own units (km and s for orbits, otherwise m, kg, s).
struct DrawnScene {
  std::uint64_t seed = 0, number = 0;
  std::string precision = "double";
  Model model;  ///< for an orbit the radius is in km
  double mu_km3_s2 = 398600.4415;
  bool is_orbit = true;
  /// The elements a, e, i, raan, argp, ta in km and degrees; without them the state is given.
  std::optional<std::array<double, 6>> elements;
  std::vector<double> position, velocity;  ///< for the other models momenta instead of velocities
  std::optional<double> length_km;
  int order = 1;
  std::vector<std::size_t> variables;  ///< if empty, all variables
  double duration_s = 0;
  int arcs = 1;  ///< if 0, the number is chosen automatically
  bool checks_surface = false;
  bool keeps_rotation = false;  ///< the rotation is integrated instead of left out and put back
  bool has_zeros = false;       ///< zonal coefficients that are absent are written as 0
  std::string method = "gauss";
  int stages = 8;
  int verlet_order = 2;
  double beta = 0.25;
  bool compensated_summation = true;
  std::optional<double> tolerance;
  double step_s = 0;
  double revolutions = 0;  ///< or number of periods of the fastest oscillation
  double eccentricity = 0;

  std::size_t dimension() const { return 2 * model.degrees_of_freedom; }
  bool is_adaptive_gauss() const { return method == "gauss" && tolerance.has_value(); }
};

DrawnScene draw_scene(std::uint64_t seed, std::uint64_t number);

/// The scene as a user writes it.
std::string toml(const DrawnScene& scene);

/// A summary of one line.
std::string summary(const DrawnScene& scene);

/// J_n of the gravity field that the program ships, from its normalised coefficients:
/// J_n = -sqrt(2n + 1) C_n0.
const std::array<double, 21>& shipped_zonals();

}  // namespace hamjet::attack
