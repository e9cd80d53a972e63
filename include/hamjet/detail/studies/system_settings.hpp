#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/dynamics/zonal_coefficients.hpp"
#include "hamjet/detail/studies/fields.hpp"

namespace hamjet {

/// The dynamics. What distinguishes the models is in SystemDescription.
enum class SystemModel {
  zonal_gravity,
  kepler,
  harmonic_oscillator,
  double_well,
  oscillator_pair,
  spring_pendulum,
  fermi_pasta_ulam,
  own,  ///< a Hamiltonian of the C++ user, Scene::own_system; no scene of a file can name it
};

/// The models' names in scenes, in the order of the enumeration.
const std::vector<std::string_view>& model_names();

/// The name of a model in scenes and results.
std::string_view model_name(SystemModel model);

/// Whether a model is an orbit in space: three degrees of freedom, kilometres. The others have one
/// or more degrees of freedom and metres.
bool is_orbit(SystemModel model);

/// The numbers of degrees of freedom that a model can have, ascending: a single one, but for the
/// chain fermi-pasta-ulam, whose length the scene chooses.
std::vector<std::size_t> possible_degrees_of_freedom(SystemModel model);

/// Names of the variables (q, p), in the order of the state: x, y, z, px, py, pz for an orbit; q, p
/// for one degree of freedom; else q1, q2, ..., p1, p2, .... `degrees_of_freedom` must be possible.
std::vector<std::string_view> variable_names(SystemModel model, std::size_t degrees_of_freedom);

/// Where the gravity field of a scene comes from, if it is a file.
struct GravityFile {
  std::string file;         ///< as the scene names it
  std::string model_name;   ///< from the file's header; empty where it has none
  std::string tide_system;  ///< from the header; "unknown" where it has none
  /// At which coefficients that vary with time were taken, ISO 8601; empty where none does.
  std::string epoch;
  /// How far the file's origin lies from the centre of mass along the axis, by C(1,0), which is
  /// left out; absent where that varies with time and nothing says when.
  std::optional<double> origin_offset_m = 0;
};

/// Table `[system]`.
struct SystemSettings {
  SystemModel model = SystemModel::zonal_gravity;
  double mu_km3_s2 = 0;  ///< zonal-gravity, kepler: gravitational parameter
  double radius_km = 0;  ///< zonal-gravity: the radius that the J_n refer to; 0 if without them
  ZonalCoefficients J;   ///< zonal-gravity: 0 where the scene has none
  double mass_kg = 1;    ///< harmonic-oscillator, oscillator-pair, spring-pendulum
  double stiffness_N_per_m = 1;         ///< models with a mass; of a pair: first oscillator
  double second_stiffness_N_per_m = 1;  ///< oscillator-pair: of the second oscillator
  double length_m = 1;                  ///< spring-pendulum: of the spring at rest
  double gravity_m_s2 = 0;              ///< spring-pendulum: toward negative q2
  double omega_rad_per_s = 0;           ///< fermi-pasta-ulam: frequency of the stiff springs
  std::size_t pairs = 1;                ///< fermi-pasta-ulam: number of stiff springs
  /// zonal-gravity: what mu, radius and J were read from.
  std::optional<GravityFile> gravity_file;
  std::size_t own_degrees_of_freedom = 1;  ///< own: 1 to 8
};

HAMJET_FIELDS(GravityFile, file, model_name, tide_system, epoch, origin_offset_m)
HAMJET_FIELDS(SystemSettings, model, mu_km3_s2, radius_km, J, mass_kg, stiffness_N_per_m,
              second_stiffness_N_per_m, length_m, gravity_m_s2, omega_rad_per_s, pairs,
              gravity_file, own_degrees_of_freedom)

/// The number of degrees of freedom of a system.
std::size_t degrees_of_freedom_of(const SystemSettings& settings);

/// Names of a system's variables (q, p), in the order of the state.
std::vector<std::string_view> variable_names(const SystemSettings& settings);

}  // namespace hamjet
