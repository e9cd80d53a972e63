#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hamjet::io {

/// Arithmetic of the whole chain: binary64, or 113 significant bits (Boost.Multiprecision).
enum class Precision { double_precision, extended };

/// The dynamics. Which of the numbers below count depends on the model.
enum class SystemModel { zonal_gravity, kepler, harmonic_oscillator };

/// Table `[system]`.
struct SystemSettings {
  SystemModel model = SystemModel::zonal_gravity;
  double mu_km3_s2 = 0;                ///< zonal-gravity, kepler: gravitational parameter
  double radius_km = 0;                ///< zonal-gravity: the radius that J2 and J3 refer to
  double J2 = 0;                       ///< zonal-gravity: 0 where the scene has no J2
  double J3 = 0;                       ///< zonal-gravity: 0 where the scene has no J3
  double mass_kg = 1;                  ///< harmonic-oscillator
  double stiffness_N_per_m = 1;        ///< harmonic-oscillator
};

/// Canonical units: SI value = canonical value times these. For an orbit the length is the
/// nominal's initial radius and mu = 1; for the harmonic oscillator metre and second.
struct CanonicalUnits {
  double length_km = 1;
  double time_s = 1;
};

enum class IntegrationMethod { gauss, fehlberg78, cvode_adams, cvode_bdf };

/// One table `[[integrator]]`.
struct IntegratorSettings {
  std::string label;
  IntegrationMethod method = IntegrationMethod::gauss;
  int stages = 8;                            ///< Gauss only
  std::optional<double> step_canonical;      ///< fixed steps (positive; the sign follows the duration)
  std::optional<double> tolerance;           ///< adaptive steps; exactly one of the two is set
  std::optional<double> require_relative_error;  ///< check: largest relative error over all degrees
  std::optional<double> require_symplecticity;   ///< check: largest scaled symplecticity defect
};

/// Table `[reference]`.
struct ReferenceSettings {
  double tolerance = 1e-24;  ///< local tolerance of the finer of the two extended-precision runs
};

/// A scene, read, checked and converted to canonical units. Lengths of arrays: 2n, with n = 3 for
/// an orbit and n = 1 for the harmonic oscillator.
struct Scene {
  std::string name;   ///< stem of the file name
  std::string title;
  Precision precision = Precision::double_precision;
  SystemSettings system;
  CanonicalUnits units;
  double canonical_radius = 0;              ///< radius_km in canonical units
  std::vector<double> nominal;              ///< initial state (q, p), canonical
  double duration = 0;                      ///< canonical; negative is backwards
  int order = 1;
  std::vector<std::size_t> variables;       ///< indices into (q, p) to expand in, ascending
  std::vector<IntegratorSettings> integrators;
  std::optional<double> separation;         ///< `[formation]`, canonical length
  std::optional<std::vector<std::string>> kinds;  ///< `[generating_function]`; absent: no inversion
  std::optional<ReferenceSettings> reference;     ///< absent: no reference is run
};

/// One `--set key=value`: dotted key, TOML value.
struct Override {
  std::string key;
  std::string value;
};

/// Reads a scene file. Throws Error(input_output) if it cannot be read, Error(scene) with
/// `file:line:column: key: what is wrong, what would be right`, Error(too_large) for an order
/// beyond what any machine holds.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// The same from text; `file_name` is used in messages and for Scene::name.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides = {});

}  // namespace hamjet::io
