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
#include "hamjet/detail/studies/integration_method.hpp"
#include "hamjet/detail/studies/self_check_settings.hpp"
#include "hamjet/detail/studies/system_settings.hpp"
#include "hamjet/detail/studies/transfer_settings.hpp"
#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Arithmetic of the whole chain: binary64, or 113 significant bits (Boost.Multiprecision).
enum class Precision { double_precision, extended };

/// The machine epsilon of an arithmetic, to which its numbers are rounded.
double rounding_of(Precision precision);

/// Canonical units: SI value = canonical value times these. For an orbit the length is the
/// nominal's initial radius, or what the scene chooses, and mu = 1; for the other models metre and
/// second.
struct CanonicalUnits {
  double length_km = 1;
  double time_s = 1;
};

/// By what canonical numbers are multiplied to be told in other canonical units.
struct CanonicalFactors {
  double length = 1;
  double time = 1;
  double momentum = 1;  ///< of a mass of 1: a velocity

  /// An action, as an angular momentum is one, in these numbers.
  double told_action(double canonical) const { return canonical * length * momentum; }
};

/// Table `[reference]`.
struct ReferenceSettings {
  double tolerance = 1e-24;  ///< local tolerance of the finer of the two extended-precision runs
};

/// Table `[compare]`: what `hamjet compare` sweeps over.
struct ComparisonSettings {
  std::vector<IntegrationMethod> methods;  ///< empty: all that are in this build
  std::vector<int> stages = {1, 2, 4, 8};  ///< of Gauss
  std::vector<double> steps_canonical;     ///< empty: halved from far too coarse to round-off
  std::vector<double> tolerances;          ///< empty: by powers of ten from 1e-2 to round-off
  std::vector<int> orders;                 ///< of the cost against order; empty: 1 to jet.order
  int repeats = 5;                         ///< timings of each run
  double time_budget_s = 150;  ///< of all integrations; what would exceed it is left out
  double wanted_error_m = 1;   ///< at formation scale; for verdict and advice
};

/// What `hamjet run` draws along time.
enum class FigureQuantity { exactness, energy_error };

/// Table `[figure]`.
struct FigureSettings {
  FigureQuantity quantity = FigureQuantity::exactness;
  std::string kind;  ///< whose exactness is drawn: F1..F4 or letters; empty for the energy error
};

/// Table `[output]`: what `hamjet run` writes beside CSV and JSON.
struct OutputSettings {
  std::vector<std::string> formats;  ///< their names, such as "hdf5"

  bool has(std::string_view format) const {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  }
};

/// Table `[ephemeris]`: what a CCSDS message says of an orbit beyond its numbers.
struct EphemerisSettings {
  std::string epoch;            ///< of the nominal's start, ISO 8601, in the time system
  std::string time_system;      ///< for example UTC, TDB
  std::string reference_frame;  ///< inertial; its z axis is taken as the axis of the zonal field
  std::string center_name;      ///< for example EARTH
  std::string reference_frame_epoch = {};  ///< of a frame "of epoch", ISO 8601; else empty
  std::string object_name = "UNKNOWN";
  std::string object_id = "UNKNOWN";   ///< international designator
  std::string deputy_name = "DEPUTY";  ///< of the spacecraft that flies relative to the nominal
  std::string deputy_id = "UNKNOWN";
  std::string originator = "HAMJET";  ///< who made the message
  std::string oem_version = "2.0";    ///< version that is written; or "3.0"
};

/// The message that the nominal's start was read from.
struct NominalFile {
  std::string path;                 ///< as the scene has it
  std::string format;               ///< for example "OEM 2.0"
  EphemerisSettings ephemeris;      ///< of the state that was taken
  std::vector<std::string> unused;  ///< what else the message holds, for example "covariance"
};

/// A scene, read, checked and converted to canonical units. Lengths of arrays: 2n, with the n
/// degrees of freedom of its system.
struct Scene {
  std::string name;  ///< stem of the file name, other characters than A-Z a-z 0-9 . _ - as _
  std::string title;
  Precision precision = Precision::double_precision;
  SystemSettings system;
  CanonicalUnits units;
  /// Those of the table `[units]`, in which the user is told canonical numbers; `units` are the
  /// same or, see SceneUnits, the chief's own. Absent: there is no such table, and `units` are
  /// told.
  std::optional<CanonicalUnits> told_units = {};
  double canonical_radius = 0;  ///< radius_km in canonical units
  std::vector<double> nominal;  ///< initial state (q, p), canonical
  double duration = 0;          ///< canonical; negative is backwards
  int order = 1;
  /// `jet.arcs`: pieces that the flow is split into; absent ("auto"): from the operation counts.
  std::optional<std::size_t> arcs = 1;
  /// `jet.symmetry`: left out of the integration of jets and put back.
  FlowSymmetry symmetry = FlowSymmetry::rotation;
  /// `jet.coordinates` and `jet.end_coordinates`, of the polynomials by which deputies are
  /// predicted.
  CoordinatesAtEnds coordinates;
  std::vector<std::size_t> variables;  ///< indices into (q, p) to expand in, ascending
  /// `jet.times_...`: canonical times before the duration at which runs, all of Gauss and in one
  /// arc, have their jets too, moving away from 0; empty: at the duration alone.
  std::vector<double> jet_times;
  std::vector<IntegratorSettings> integrators;
  /// `[formation]`, canonical length (metres where that is the unit).
  std::optional<double> separation;
  /// `[generating_function]`, as written: F1..F4, auto, or letters such as qpq-qqp (final
  /// variables, then initial ones); absent: no inversion.
  std::optional<std::vector<std::string>> kinds;
  std::optional<ReferenceSettings> reference;  ///< absent: no reference is run
  /// `[relative_hamiltonian]`, canonical times between 0 and the duration; empty: not computed.
  std::vector<double> relative_hamiltonian_times;
  SelfCheckSettings checks;
  ComparisonSettings comparison;
  std::optional<FigureSettings> figure;  ///< absent: no figure, and nothing is watched along time
  std::optional<DeputySettings> deputy;
  std::optional<TransferSettings> transfer;
  std::optional<ValiditySettings> validity;
  std::optional<AssignmentSettings> assignment;
  std::optional<UncertaintySettings> uncertainty;
  std::optional<BoundedSettings> bounded;
  std::optional<EventSettings> event;
  OutputSettings output;
  std::optional<EphemerisSettings> ephemeris;
  std::optional<NominalFile> nominal_file;  ///< absent: the scene has the numbers itself
  std::vector<std::string> warnings;        ///< what is almost surely a slip, a line each
  /// The system of a scene that no file describes, in canonical units; see make_scene.
  std::shared_ptr<const DynamicalSystem> own_system = nullptr;
};

/// The units in which the user is told canonical numbers of a scene.
const CanonicalUnits& told_units(const Scene& scene);
/// What takes the scene's canonical numbers into these; all exactly 1 where they are the same.
CanonicalFactors told_factors(const Scene& scene);
/// A canonical time of the scene in these.
double told_time(const Scene& scene, double time);
/// A state (q, p) of the scene in these.
std::vector<double> told_state(const Scene& scene, std::vector<double> state);

/// A scene of a Hamiltonian of one's own: its jet in all variables about the trajectory of
/// `nominal`, 2n numbers (q, p), n at most 8. The integrators, the reference and what else is
/// wanted are filled in by the caller. Canonical units are the system's own; they count as metre
/// and second where results have units, unless `units` says otherwise. Throws Error(usage) if the
/// sizes do not fit.
Scene make_scene(DynamicalSystem system, std::vector<double> nominal, double duration, int order,
                 const CanonicalUnits& units = {0.001, 1});

}  // namespace hamjet
