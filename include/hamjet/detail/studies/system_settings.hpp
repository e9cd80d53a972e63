#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/dynamics/zonal_coefficients.hpp"
#include "hamjet/detail/studies/earth_settings.hpp"
#include "hamjet/detail/studies/fields.hpp"
#include "hamjet/dynamics/system_text.hpp"

namespace hamjet {

/// The models of the dynamics. SystemDescription describes their differences.
enum class SystemModel {
  earth,
  zonal_gravity,
  kepler,
  harmonic_oscillator,
  double_well,
  oscillator_pair,
  spring_pendulum,
  fermi_pasta_ulam,
  own,  ///< the user's own, Scene::own_system: made in C++, or written in the scene
};

/// The models' names in scenes, in the order of the enumeration.
const std::vector<std::string_view>& model_names();

/// The name of a model in scenes and results.
std::string_view model_name(SystemModel model);

/// Whether a model is an orbit in space, with three degrees of freedom and lengths in kilometres.
/// The other models have one or more degrees of freedom and lengths in metres.
bool is_orbit(SystemModel model);

/// The possible numbers of degrees of freedom of a model, ascending. There is a single one, except
/// for the chain fermi-pasta-ulam, whose length the scene chooses.
std::vector<std::size_t> possible_degrees_of_freedom(SystemModel model);

/// Whether the states of a model may end with parameters, in which jets are expanded, and so have
/// names of their own.
bool has_state_parameters(SystemModel model);

/// The most parameters that a state can end with: inputs of operation lists are bits of 64.
inline constexpr std::size_t most_state_parameters = 40;

/// The possible lengths of a model's states that end with so many parameters, ascending.
std::vector<std::size_t> possible_dimensions(SystemModel model, std::size_t parameters);

/// Names of the variables (q, p) of a model whose scene does not name them, in the order of the
/// state: x, y, z, px, py, pz for an orbit; q, p for one degree of freedom; else q1, q2, ..., p1,
/// p2, .... `degrees_of_freedom` must be possible.
std::vector<std::string_view> variable_names(SystemModel model, std::size_t degrees_of_freedom);

/// The origin of a scene's gravity field, if it comes from a file.
struct GravityFile {
  std::string file;         ///< file name as in the scene
  std::string model_name;   ///< from the file's header; empty if the header has none
  std::string tide_system;  ///< from the header; "unknown" if the header has none
  /// Epoch at which coefficients that vary with time were taken, in ISO 8601; empty if none varies.
  std::string epoch;
  /// Distance along the axis of the file's origin from the centre of mass, by C(1,0), which is left
  /// out; absent if C(1,0) varies with time and there is no epoch.
  std::optional<double> origin_offset_m = 0;
};

/// Table `[system]`.
struct SystemSettings {
  SystemModel model = SystemModel::zonal_gravity;
  double mu_km3_s2 = 0;  ///< earth, zonal-gravity, kepler: gravitational parameter
  /// earth, zonal-gravity: the reference radius of the coefficients; 0 if there are none
  double radius_km = 0;
  /// zonal-gravity: 0 for a coefficient that the scene does not have. earth: those of its field,
  /// for what is told of mean motions.
  ZonalCoefficients J;
  double mass_kg = 1;                   ///< harmonic-oscillator, oscillator-pair, spring-pendulum
  double stiffness_N_per_m = 1;         ///< models with a mass; for a pair, of the first oscillator
  double second_stiffness_N_per_m = 1;  ///< oscillator-pair: stiffness of the second oscillator
  double length_m = 1;                  ///< spring-pendulum: length of the spring at rest
  double gravity_m_s2 = 0;              ///< spring-pendulum: acceleration toward negative q2
  double omega_rad_per_s = 0;           ///< fermi-pasta-ulam: frequency of the stiff springs
  std::size_t pairs = 1;                ///< fermi-pasta-ulam: number of stiff springs
  /// earth, zonal-gravity: the file from which mu, radius and coefficients were read.
  std::optional<GravityFile> gravity_file;
  std::size_t own_degrees_of_freedom = 1;  ///< own: 1 to 8
  std::optional<EarthSettings> earth;      ///< earth
  /// own: of (q, p, c) with the parameters c; earth: likewise if it has some; else empty
  std::vector<std::string> own_names;
  std::optional<SystemText> own_text;  ///< own: as the scene writes it
};

HAMJET_FIELDS(NamedText, name, text)
HAMJET_FIELDS(SystemText, coordinates, momenta, states, parameters, state_parameters, definitions,
              hamiltonian, vector_field)
HAMJET_FIELDS(GravityFile, file, model_name, tide_system, epoch, origin_offset_m)
HAMJET_FIELDS(SystemSettings, model, mu_km3_s2, radius_km, J, mass_kg, stiffness_N_per_m,
              second_stiffness_N_per_m, length_m, gravity_m_s2, omega_rad_per_s, pairs,
              gravity_file, own_degrees_of_freedom, earth, own_names, own_text)

/// The number of degrees of freedom of a system.
std::size_t degrees_of_freedom_of(const SystemSettings& settings);

/// Names of a system's variables (q, p, c), in the order of the state.
std::vector<std::string_view> variable_names(const SystemSettings& settings);

/// Names of the parameters c with which a system's states end.
const std::vector<std::string>& state_parameters(const SystemSettings& settings);

}  // namespace hamjet
