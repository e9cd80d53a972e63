#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/detail/integrators/flow_symmetry.hpp"
#include "hamjet/detail/studies/domain_settings.hpp"
#include "hamjet/detail/studies/integration_method.hpp"
#include "hamjet/detail/studies/self_check_settings.hpp"
#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/detail/studies/transfer_settings.hpp"
#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Arithmetic of all computations: binary64, or 113 significant bits (Boost.Multiprecision).
enum class Precision { double_precision, extended };

/// The machine epsilon of an arithmetic.
double rounding_of(Precision precision);

/// Canonical units: the SI value is the canonical value times these. For an orbit the unit of
/// length is the nominal's initial radius, or one that the scene chooses, and mu = 1; the other
/// models have metre and second.
struct CanonicalUnits {
  double length_km = 1;
  double time_s = 1;
};

/// What a momentum of 1, along a coordinate that is a length, is where a mass of 1 is `mass_kg`.
inline double momentum_kg_m_s(const CanonicalUnits& units, double mass_kg) {
  return mass_kg * units.length_km * 1000 / units.time_s;
}
/// What an energy of 1 is there.
inline double energy_J(const CanonicalUnits& units, double mass_kg) {
  const double speed_m_s = units.length_km * 1000 / units.time_s;
  return mass_kg * speed_m_s * speed_m_s;
}

/// Factors that convert canonical numbers to other canonical units.
struct CanonicalFactors {
  double length = 1;
  double time = 1;
  double momentum = 1;  ///< for momenta of a mass of 1, that is velocities

  /// Converts an action, for example an angular momentum.
  double told_action(double canonical) const { return canonical * length * momentum; }
};

/// Table `[reference]`.
struct ReferenceSettings {
  double tolerance = 1e-24;  ///< local tolerance of the finer of the two extended-precision runs
};

/// Table `[compare]`: the runs of `hamjet compare`.
struct ComparisonSettings {
  std::vector<IntegrationMethod> methods;  ///< if empty, all methods in this build
  std::vector<int> stages = {1, 2, 4, 8};  ///< numbers of stages of Gauss
  std::vector<double> steps_canonical;     ///< if empty, halved from far too coarse to round-off
  std::vector<double> tolerances;          ///< if empty, powers of ten from 1e-2 to round-off
  std::vector<int> orders;  ///< orders for the cost against order; if empty, 1 to jet.order
  int repeats = 5;          ///< number of timings of each run
  double time_budget_s =
      150;  ///< budget of all integrations; runs that would exceed it are left out
  double wanted_error_m = 1;  ///< error at formation scale, for verdict and advice
};

/// The quantity that `hamjet run` draws along time.
enum class FigureQuantity { exactness, energy_error };

/// Table `[figure]`.
struct FigureSettings {
  FigureQuantity quantity = FigureQuantity::exactness;
  std::string
      kind;  ///< kind whose exactness is drawn: F1..F4 or letters; empty for the energy error
};

/// Table `[output]`: the output of `hamjet run` beside CSV and JSON.
struct OutputSettings {
  std::vector<std::string> formats;  ///< names of formats, such as "hdf5"

  bool has(std::string_view format) const {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  }
};

/// Table `[ephemeris]`: what a CCSDS message states about an orbit beyond its numbers.
struct EphemerisSettings {
  std::string epoch;        ///< epoch of the nominal's start, in ISO 8601, in the time system
  std::string time_system;  ///< for example UTC, TDB
  std::string
      reference_frame;      ///< inertial frame; its z axis is taken as the axis of the zonal field
  std::string center_name;  ///< for example EARTH
  std::string reference_frame_epoch =
      {};  ///< epoch of a frame "of epoch", in ISO 8601; otherwise empty
  std::string object_name = "UNKNOWN";
  std::string object_id = "UNKNOWN";  ///< international designator
  std::string deputy_name =
      "DEPUTY";  ///< name of the spacecraft that flies relative to the nominal
  std::string deputy_id = "UNKNOWN";
  std::string originator = "HAMJET";  ///< originator of the message
  std::string oem_version = "2.0";    ///< version that is written: "2.0" or "3.0"
};

/// The message from which the nominal's start was read.
struct NominalFile {
  std::string path;                 ///< path as in the scene
  std::string format;               ///< for example "OEM 2.0"
  EphemerisSettings ephemeris;      ///< metadata of the state that was taken
  std::vector<std::string> unused;  ///< other contents of the message, for example "covariance"
};

/// A scene that has been read, checked and converted to canonical units. Arrays of length 2n belong
/// to the n degrees of freedom of its system.
struct Scene {
  std::string name;  ///< stem of the file name, where characters other than A-Z a-z 0-9 . _ - are
                     ///< replaced by _
  std::string title;
  Precision precision = Precision::double_precision;
  SystemSettings system;
  CanonicalUnits units;
  /// The units of the table `[units]`, in which the user reads canonical numbers. `units` are the
  /// same or, see SceneUnits, the chief's own. Absent if there is no such table; the user then
  /// reads numbers in `units`.
  std::optional<CanonicalUnits> told_units = {};
  /// What a mass of 1 means in a system that the scene writes, if the scene says it.
  std::optional<double> mass_kg = {};
  double canonical_radius = 0;  ///< radius_km in canonical units
  std::vector<double> nominal;  ///< initial state (q, p), canonical
  /// The system's clock at the nominal. A scene that is read starts at the epoch; one that flies
  /// on, or back, from a state that another one reached starts at that state's time.
  ClockTime start_time = ClockTime::epoch();
  double duration = 0;                ///< in canonical units; negative is backwards
  std::vector<Manoeuvre> manoeuvres;  ///< of the nominal's orbit message, in order of time
  int order = 1;
  /// `jet.arcs`: the number of arcs into which the flow is split; absent ("auto") if it is chosen
  /// from the operation counts.
  std::optional<std::size_t> arcs = 1;
  /// `jet.symmetry`: symmetry that is left out of the integration of jets and put back.
  FlowSymmetry symmetry = FlowSymmetry::rotation;
  /// `jet.coordinates` and `jet.end_coordinates`: coordinates of the polynomials that predict
  /// deputies.
  CoordinatesAtEnds coordinates;
  /// Indices into (q, p) of the variables of the expansion, ascending.
  std::vector<std::size_t> variables;
  /// `jet.times_...`: canonical times before the duration, moving away from 0, at which runs have
  /// their jets too; all runs must be of Gauss and in one arc. If empty, there are jets at the
  /// duration alone.
  std::vector<double> jet_times;
  std::vector<IntegratorSettings> integrators;
  /// `[formation]`: a canonical length (metres if metre is the unit).
  std::optional<double> separation;
  /// `[generating_function]`, as written: F1..F4, auto, or letters such as qpq-qqp (final
  /// variables, then initial ones). Absent if nothing is to be inverted.
  std::optional<std::vector<std::string>> kinds;
  std::optional<ReferenceSettings> reference;  ///< absent if no reference is to be run
  /// `[relative_hamiltonian]`: canonical times between 0 and the duration; empty if it is not to be
  /// computed.
  std::vector<double> relative_hamiltonian_times;
  SelfCheckSettings checks;
  ComparisonSettings comparison;
  /// Absent if there is no figure and nothing is observed along time.
  std::optional<FigureSettings> figure;
  std::optional<DeputySettings> deputy;
  std::optional<TransferSettings> transfer;
  std::optional<ThrusterSettings> thruster;  ///< absent if velocity changes are impulses alone
  std::optional<ValiditySettings> validity;
  std::optional<DomainSettings> eval;  ///< absent if all deputies have the polynomials of the chief
  std::optional<AssignmentSettings> assignment;
  std::optional<UncertaintySettings> uncertainty;
  std::optional<BoundedSettings> bounded;
  std::optional<EventSettings> event;
  std::optional<PeriodicSettings> periodic;
  OutputSettings output;
  std::optional<EphemerisSettings> ephemeris;
  std::optional<NominalFile> nominal_file;  ///< absent if the scene itself has the numbers
  std::vector<std::string> warnings;        ///< likely mistakes in the scene, one line each
  /// The system of the model "own", in canonical units: the caller's, see make_scene, or that which
  /// the scene writes.
  std::shared_ptr<const DynamicalSystem> own_system = nullptr;
};

/// The units in which the user reads canonical numbers of a scene.
const CanonicalUnits& told_units(const Scene& scene);
/// The factors that convert the scene's canonical numbers to these units; all exactly 1 if the
/// units are the same.
CanonicalFactors told_factors(const Scene& scene);
/// A canonical time of the scene in these units.
double told_time(const Scene& scene, double time);
/// A state (q, p) of the scene in these units.
std::vector<double> told_state(const Scene& scene, std::vector<double> state);

/// A scene for the caller's own Hamiltonian: its jet in all variables about the trajectory of
/// `nominal`, 2n numbers (q, p), n at most 8. The caller fills in the integrators, the reference
/// and other settings. Canonical units are the system's own; they count as metre and second where
/// results have units, unless `units` says otherwise. Throws Error(usage) if the sizes do not fit.
Scene make_scene(DynamicalSystem system, std::vector<double> nominal, double duration, int order,
                 const CanonicalUnits& units = {0.001, 1});

}  // namespace hamjet
