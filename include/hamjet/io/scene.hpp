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
  double mu_km3_s2 = 0;  ///< zonal-gravity, kepler: gravitational parameter
  double radius_km = 0;  ///< zonal-gravity: the radius that J2 and J3 refer to; 0 if without them
  double J2 = 0;         ///< zonal-gravity: 0 where the scene has no J2
  double J3 = 0;         ///< zonal-gravity: 0 where the scene has no J3
  double mass_kg = 1;    ///< harmonic-oscillator
  double stiffness_N_per_m = 1;  ///< harmonic-oscillator
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
  int stages = 8;                        ///< Gauss only
  std::optional<double> step_canonical;  ///< fixed steps (positive; the sign follows the duration)
  std::optional<double> tolerance;       ///< adaptive steps; exactly one of the two is set
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
  std::string name;  ///< stem of the file name, other characters than A-Z a-z 0-9 . _ - as _
  std::string title;
  Precision precision = Precision::double_precision;
  SystemSettings system;
  CanonicalUnits units;
  double canonical_radius = 0;  ///< radius_km in canonical units
  std::vector<double> nominal;  ///< initial state (q, p), canonical
  double duration = 0;          ///< canonical; negative is backwards
  int order = 1;
  std::vector<std::size_t> variables;  ///< indices into (q, p) to expand in, ascending
  std::vector<IntegratorSettings> integrators;
  /// `[formation]`, canonical length (metres for the oscillator).
  std::optional<double> separation;
  /// `[generating_function]`, as written: F1..F4, auto, or letters such as qpq-qqp (final
  /// variables, then initial ones); absent: no inversion.
  std::optional<std::vector<std::string>> kinds;
  std::optional<ReferenceSettings> reference;  ///< absent: no reference is run
};

/// One `--set key=value`. The key is a dotted path; an element of an array is named by its index
/// from 0 or, if it is a table with a label, by that: `jet.order`, `integrator.0.tolerance`,
/// `integrator.gauss8.tolerance`. Missing tables on the way are added. The value is TOML (`3`,
/// `[1, 2]`, `{}`); what is not valid TOML is taken as a string. A key of which a table has one of
/// several forms is changed by giving the whole table: `nominal={a_km=7000, ...}`.
struct Override {
  std::string key;
  std::string value;
};

/// Reads a scene file and applies the overrides in their order, after which the same rules hold as
/// if the file had been written so. Throws
///  - Error(input_output) with the path and the reason if the file cannot be read, or is a
///    directory, a pipe or a device;
///  - Error(scene) with `file:line:column: key: what is wrong, got what, what would be right`, on
///    one line; for a value that an override gave the location is `--set key`. A text that is too
///    large or not UTF-8 is named by its size or the byte's offset;
///  - Error(too_large) for an order above 20, or more than 1e9 fixed steps;
///  - Error(usage) for an override whose key leads nowhere.
///
/// A fixed step that is longer than the duration means a single step.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// The same from text; `file_name` is used in messages and for Scene::name. Every number becomes
/// the nearest binary64; the conversion to canonical units is done in extended precision and
/// rounded once.
Scene parse_scene(std::string_view text, const std::string& file_name,
                  const std::vector<Override>& overrides = {});

}  // namespace hamjet::io
