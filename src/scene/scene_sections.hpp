#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/detail/integrators/flow_symmetry.hpp"
#include "hamjet/formats/gravity_field_file.hpp"
#include "starts/scene_nominal_file.hpp"
#include "study_reader.hpp"
#include "tables/scene_table.hpp"

// One function for each table of a scene, in the order in which the tables are read: a later table
// may need the results of an earlier one. Each function reads, checks and converts all keys of its
// table, in a file of its own, scene_<table>.cpp (for tables of one key in scene_reader.cpp). All
// throw Error(scene), and Error(too_large) where their comment says so.

namespace hamjet::io {

inline constexpr std::int64_t largest_order = 20;

/// The largest number of integrators of a scene; all their jets are held until the end.
inline constexpr std::size_t most_integrators = 1000;

/// check_keys for a table with keys that belong to orbits only, or to the other models only.
inline void check_keys_of_model(const TableReader& table, SystemModel model) {
  table.check_keys(is_orbit(model) ? orbits : other_models,
                   "the model " + std::string(model_name(model)));
}

/// All tables of the study "flow-jet".
Scene read_flow_jet(const TableReader& root, SceneUnits units);

/// All tables of the study "canonical-transformation". Throws Error(too_large) for too many steps.
CanonicalTransformationStudy read_canonical_transformation(const TableReader& root);
/// The study "optimal-control": table `[optimal_control]`.
Study read_optimal_control(const TableReader& root);

/// The keys that a table `[[integrator]]` may have for a method.
std::vector<std::string_view> integrator_keys(IntegrationMethod method);

/// Table `[system]`. `root` is the whole scene: a gravity field that varies with time needs its
/// epoch.
SystemSettings read_system(const TableReader& root);

/// Refuses a file whose origin lies too far from the centre of mass.
void require_centre_of_mass(const TableReader& system, const std::optional<double>& offset_km,
                            double radius_km);
/// What a scene remembers of the file of its field.
GravityFile gravity_file_of(const TableReader& system, const GravityModel& field,
                            const std::optional<double>& origin_offset_km);

/// The moment at which the nominal of a scene starts, from the table `[ephemeris]` or from the
/// orbit message that the nominal is read from; no value if there is neither.
std::optional<Epoch> epoch_of_start(const TableReader& root);

/// Canonical units before they are rounded: the SI value is the canonical value times these.
struct CanonicalScale {
  Extended length_km;
  Extended time_s;

  /// A length in km, or a time in seconds, in canonical units, rounded once.
  double length_of_km(double km) const;
  double time_of_s(double seconds) const;
};

/// The content of the table `[nominal]`.
struct Nominal {
  CanonicalScale scale;       ///< units of all canonical numbers of the scene
  CanonicalScale told;        ///< units of the canonical numbers that the user gives and reads
  std::vector<double> state;  ///< (q, p), canonical, 2n numbers
  /// Period of the osculating Kepler ellipse, if the orbit is one.
  std::optional<Extended> period_s;
  std::optional<NominalFile> file;  ///< file from which it was read
  /// For an orbit, the data with which deputies' own orbits are compared: the state before it is
  /// rounded, its centre, and its date.
  std::optional<CartesianState> orbit;
  SceneCentre centre;
  std::optional<EphemerisSettings> ephemeris;

  /// Converts a time of a key `_canonical` to the scene's own canonical units, rounded once; it
  /// stays as it is if the units are the same.
  double time_of_canonical(double given) const;
  /// Converts a time to the units in which the user reads it.
  double told_time(double time) const;
};

/// Table `[units]` of an orbit: the canonical unit of length, `length_km`. Throws Error(scene) for
/// a model whose units are fixed.
double read_unit_of_length(const TableReader& units, SystemModel model);
/// Table `[units]` of a system that the scene writes: what its numbers mean.
CanonicalScale read_units_of_own(const TableReader& units);
/// The key `mass_kg` of such a table, of a scene whose system and other units have been read.
void read_unit_of_mass(const TableReader& units, Scene& scene);

/// Table `[nominal]`. For an orbit the unit of length is `length_km` or, without this key or with
/// SceneUnits::chiefs, the distance from the centre. The unit of time is sqrt(length^3 / mu), so
/// that mu = 1 and a momentum (per unit of mass) is a velocity divided by sqrt(mu / length). For
/// the other models the units remain metre, second and kilogram. `center_name` is the centre that
/// the table `[ephemeris]` names, see read_nominal_file.
Nominal read_nominal(const TableReader& nominal, const SystemSettings& system,
                     const std::optional<double>& length_km, SceneUnits units,
                     const std::optional<std::string>& center_name);

/// The units as the nearest binary64 numbers.
CanonicalUnits canonical_units(const CanonicalScale& scale);

/// The key `radius_km` of the table `[system]` in canonical units.
double read_canonical_radius(const TableReader& system, const SystemSettings& settings,
                             const CanonicalScale& scale);

/// Reads the tables `[system]`, `[units]` and `[nominal]` into the members that every scene of a
/// model has.
template <class ModelScene>
Nominal read_start(const TableReader& root, ModelScene& scene,
                   SceneUnits units = SceneUnits::told) {
  const TableReader system = root.table("system");
  scene.system = read_system(root);
  std::optional<double> length_km;
  const bool is_own = scene.system.model == SystemModel::own;
  if (root.has("units") && !is_own) {
    length_km = read_unit_of_length(root.table("units"), scene.system.model);
  }
  std::optional<std::string> center_name;
  if (root.has("ephemeris") && root.table("ephemeris").has("center_name")) {
    center_name = root.table("ephemeris").text("center_name");
  }
  Nominal nominal =
      read_nominal(root.table("nominal"), scene.system, length_km, units, center_name);
  if (root.has("units") && is_own) {
    nominal.scale = nominal.told = read_units_of_own(root.table("units"));
  }
  scene.nominal = nominal.state;
  scene.units = canonical_units(nominal.scale);
  scene.canonical_radius = read_canonical_radius(system, scene.system, nominal.scale);
  return nominal;
}

/// A duration, given by exactly one of `duration_s`, `duration_canonical` and, for orbits,
/// `duration_orbits`; in canonical units.
double read_duration(const TableReader& table, bool has_orbits, const Nominal& nominal);

/// The content of the table `[jet]`.
struct JetSettings {
  int order = 4;
  std::vector<std::size_t> variables;   ///< indices into (q, p), ascending
  double duration = 0;                  ///< in canonical units
  std::optional<std::size_t> arcs = 1;  ///< no value for "auto"
  FlowSymmetry symmetry = FlowSymmetry::rotation;
  CoordinatesAtEnds coordinates;
};

/// Table `[jet]`. Throws Error(too_large) for an order above the largest.
JetSettings read_jet(const TableReader& jet, const SystemSettings& system, Precision precision,
                     const Nominal& nominal);

/// The tables `[[integrator]]`; a table without a label is named as comparisons name its series.
/// Throws Error(too_large) for too many steps.
std::vector<IntegratorSettings> read_integrators(const std::vector<TableReader>& integrators,
                                                 Precision precision, double duration,
                                                 const Nominal& nominal);

/// Table `[formation]`: the separation, in canonical units.
double read_formation(const TableReader& formation, SystemModel model, const CanonicalScale& scale);

/// Table `[generating_function]`: the kinds as the scene names them, checked against the parts of
/// `scene` that have been read.
std::vector<std::string> read_generating_function(const TableReader& generating_function,
                                                  const Scene& scene);

/// The degrees of freedom of the kinds of generating functions for a scene's jet; `table` and `key`
/// ask for such a kind. Throws Error(scene) if the jet is not expanded in all variables of phase
/// space.
std::size_t degrees_of_freedom_of_kinds(const TableReader& table, std::string_view key,
                                        const Scene& scene);

/// The explicit name of a kind, with final and initial choice in letters: "qqq-ppp" for "F2" and so
/// on. "auto" stays; a text that is not a kind gives an empty text.
std::string explicit_kind(const std::string& kind, std::size_t degrees_of_freedom);

/// Table `[reference]`.
ReferenceSettings read_reference(const TableReader& reference);

/// Table `[compare]`, checked against the parts of `scene` that have been read.
ComparisonSettings read_compare(const TableReader& table, const Scene& scene,
                                const Nominal& nominal);

/// Table `[checks]`, checked against the parts of `scene` that have been read.
SelfCheckSettings read_checks(const TableReader& checks, const Scene& scene);

/// Table `[output]`: the formats besides CSV and JSON.
OutputSettings read_output(const TableReader& output, SystemModel model);

/// Reads a required key of any table whose value is a moment of the calendar; and the declared form
/// of such a key.
Epoch read_epoch(const TableReader& table, std::string_view key);

/// Refuses a date within a leap second in another time system than UTC, which alone has them.
void require_leap_second(const TableReader& table, std::string_view key, const Epoch& epoch,
                         TimeSystem system);
ValueForm form_of_epoch();

/// Table `[ephemeris]`. What is known of time, frame and centre, from the nominal's file or from
/// the epoch of the model earth, may be repeated here, but not changed. A body that the scene names
/// must be the centre of its system.
EphemerisSettings read_ephemeris(const TableReader& ephemeris,
                                 const std::optional<EphemerisSettings>& known,
                                 const SystemSettings& system);

/// Throws an error about the key that gives the nominal's start if the moments of the scene cannot
/// be dated by adding seconds: before or across leap seconds of UTC, or outside the years 1 to
/// 9999.
void require_calendar(const TableReader& table, std::string_view key, const Scene& scene);

/// Table `[figure]`, checked against the parts of `scene` that have been read.
FigureSettings read_figure(const TableReader& figure, const Scene& scene);

/// Table `[deputy]`, checked against the parts of `scene` that have been read.
DeputySettings read_deputy(const TableReader& deputy, const Scene& scene, const Nominal& nominal,
                           bool is_anywhere);

/// Table `[transfer]`, checked against the parts of `scene` that have been read. If `needs_ends` is
/// false, the tables `[transfer.start]` and `[transfer.end]` may both be left out. If the scene has
/// a deputy, the start may be left out.
TransferSettings read_transfer(const TableReader& transfer, const Scene& scene,
                               const Nominal& nominal, bool needs_ends);

/// Table `[thruster]` of a scene whose table `[transfer]` has been read, if it has one; `has_box`
/// says whether it has a table `[bounded.box]`.
ThrusterSettings read_thruster(const TableReader& thruster, const Scene& scene, bool has_box);

/// Table `[validity]`, checked against the parts of `scene` that have been read.
ValiditySettings read_validity(const TableReader& validity, const Scene& scene,
                               const Nominal& nominal);

/// Table `[assignment]` of a scene whose table `[transfer]` has been read, if it has one.
AssignmentSettings read_assignment(const TableReader& assignment, const Scene& scene,
                                   const Nominal& nominal);

/// Table `[uncertainty.collision]` of a scene whose table `[deputy]` has been read.
CollisionWatch read_collision(const TableReader& collision, const Scene& scene, bool has_burn);

/// Table `[uncertainty.safety]`, for a scene with or without a burn.
SafetyWatch read_safety(const TableReader& safety, const Scene& scene, const Nominal& nominal,
                        bool has_burn);

/// Table `[uncertainty]` of a scene whose table `[deputy]` has been read, if it has one. `root` is
/// the whole scene: a covariance from a message needs the content of the deputy's message.
UncertaintySettings read_uncertainty(const TableReader& root, const Scene& scene,
                                     const Nominal& nominal);

/// The reason why the energy-conserving methods integrate no flow jet, for messages.
inline constexpr std::string_view no_energy_conserving_jet =
    "the map of an energy-conserving method at a fixed physical time is not symplectic, because "
    "each neighbour takes its own steps; it integrates trajectories only";

/// All tables of the study "energy-conservation". Throws Error(too_large) for too many steps.
EnergyConservationStudy read_energy_conservation(const TableReader& root);

/// Warnings of what is almost surely a mistake in a scene about an orbit, though it can be
/// computed: a mu in m^3/s^2, a radius in metres, mu and radius of two different bodies, a J2 that
/// no planet has, a start in metres, a height in place of a semi-major axis, a velocity in m/s.
/// Each is one line for the user, with place, key and what would be right.
std::vector<std::string> likely_slips(const TableReader& root, const Scene& scene);

/// Warnings about spacecraft that the air brings down within the scene, about a low perigee, and
/// about a thruster that the air exceeds.
std::vector<std::string> warnings_of_decay(const TableReader& root, const Scene& scene);

/// Table `[relative_hamiltonian]`: canonical times from the start to the duration.
std::vector<double> read_relative_hamiltonian(const TableReader& table, double span,
                                              const Nominal& nominal);

}  // namespace hamjet::io
