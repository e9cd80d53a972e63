#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/charts/jet_coordinates.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {
struct PropagationResult;
struct RunResult;
}  // namespace hamjet

namespace hamjet::io {

/// The sections of a jet between flow boxes, which are needed beside the nominal's states.
struct StoredFlowBox {
  ChartName section = ChartName::nodal;  ///< chart of both sections, which go through the nominal
  ZonalGravity field;                    ///< in canonical units

  /// Whether the radius fits the field: without harmonics it is 0, otherwise it is positive.
  bool has_radius_of_field() const {
    return std::isfinite(field.radius) &&
           (field.radius > 0 || (field.radius == 0 && !field.J.any()));
  }
};

/// The end of a message about a radius that does not fit the field.
inline constexpr std::string_view radius_of_field_rule =
    "must be positive, or 0 of a field without harmonics";

/// The jet of one run as `hamjet run` has stored it. Indices refer to the model's state (q, p);
/// numbers are canonical.
struct StoredJet {
  std::string scene;  ///< name of the scene
  std::string label;  ///< label of the run
  SystemModel model = SystemModel::zonal_gravity;
  Precision precision = Precision::double_precision;  ///< precision of the printed coefficients
  CanonicalUnits units;
  double duration = 0;
  /// The system's clock at the start: the epoch for the jet of a run, another time for one that was
  /// made of several or turned round.
  ClockTime start_time = ClockTime::epoch();
  bool is_autonomous = true;            ///< whether the system's forces are the same at all times
  std::vector<double> nominal_initial;  ///< all 2n components of the model, and its parameters
  std::vector<double> nominal_final;
  /// Components that were computed, ascending; all others vanish, whatever the deviations of the
  /// variables are.
  std::vector<std::size_t> components;
  std::vector<std::size_t> variables;  ///< variables in which the jet is expanded, ascending
  /// Epoch, time system, reference frame with its epoch, and centre of the nominal, where the scene
  /// names them; other settings of the table are not stored.
  std::optional<EphemerisSettings> ephemeris = {};
  /// Errors of the coefficients by degree, relative to the largest coefficient of the degree, where
  /// the run has measured or estimated them (see relative_error_by_degree) and the format keeps
  /// them; otherwise empty. For coordinates other than Cartesian and flow boxes, they are the
  /// errors of the run's jet in positions and momenta.
  std::vector<double> error_by_degree = {};
  /// The coordinates of the deviations at the start and of the final ones. If they are not
  /// Cartesian, the constant terms are the chief's coordinates in the chart of the end; the nominal
  /// states are positions and momenta in any case.
  CoordinatesAtEnds coordinates = {};
  /// Present for flow boxes only. The series are then those of FlowBoxMap, `time` before
  /// `coordinates`, in the variables of the sections, which are fewer than those of the state.
  std::optional<StoredFlowBox> flow_box = {};
  /// The tolerance of the table [eval] of its scene: deputies beyond it would have polynomials of
  /// their own, which results have not.
  std::optional<double> eval_tolerance_m = {};
  /// Notes of the reader about the file, one line each.
  std::vector<std::string> notes = {};
  std::vector<std::string> own_names =
      {};  ///< where others than the usual ones, see SystemSettings
  /// The number of parameters with which states end; they are components of every jet.
  std::size_t parameters = 0;
  /// One series for each component. In extended precision the printed digits bring back the numbers
  /// of the run bit by bit; in double precision the numbers are doubles.
  FlowJet<Extended> jet;

  int order() const { return jet.at(0).order(); }
  /// The degrees of freedom of the model.
  std::size_t degrees_of_freedom() const { return (nominal_initial.size() - parameters) / 2; }
  /// See ComputedProblem::momentum_exponent.
  int momentum_exponent() const;
  /// Names of the model's state (q, p), to which `components` and `variables` are indices.
  std::vector<std::string_view> variable_names() const {
    if (!own_names.empty()) return {own_names.begin(), own_names.end()};
    return hamjet::variable_names(model, degrees_of_freedom());
  }
};

/// Reads `summary.json` and `<label>/jet.csv` of a results directory: the run with this label or,
/// without a label, the first run that has a result. Throws Error(input_output), with one line that
/// names the file and the line or key, if a file is missing, was changed since, or has another
/// version, or if the run failed. Throws Error(usage) if no run has this label.
StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label = {});

/// The wanted times of a run's jets, in seconds.
struct WantedTimes {
  std::vector<double> seconds = {};
  bool all = false;  ///< all times of the run, the duration last
};

/// The jets of a run at the wanted times, in their order, from a results directory. A run has jets
/// at the times that the scene's `jet.times_...` asked for, and at the duration. A wanted time
/// matches a stored one if both agree to 1e-9. Throws as read_stored_jet, and Error(usage) for a
/// time at which the run has no jet.
std::vector<StoredJet> read_stored_jets(const std::filesystem::path& directory,
                                        const std::optional<std::string>& label,
                                        const WantedTimes& wanted);

/// The polynomials that a run wrote, beside its jet, in the coordinates of its scene, if these are
/// not Cartesian. No value if there are none, or if the path is not a directory. Throws as
/// read_stored_jet.
std::optional<StoredJet> read_stored_polynomials(const std::filesystem::path& directory,
                                                 const std::optional<std::string>& label = {});

/// The series of a stored jet as a map between flow boxes, in double precision. Throws
/// Error(numerical) where the orbit does not have such sections. Precondition: the jet has
/// `flow_box`.
FlowBoxMap<double> flow_box_map(const StoredJet& stored);

/// Throws Error(usage) unless a stored jet is in positions and momenta; for callers that cannot use
/// other coordinates. `name` is the file's name.
void require_positions_and_momenta(const StoredJet& stored, const std::string& name);

/// Whether a stored jet is at this time, to a relative difference of 1e-9.
bool is_at(const StoredJet& stored, double time_s);

/// Names the parameters with which the states of a jet from elsewhere end. Returns what is wrong
/// with the names, if anything is; then the jet stays as it was. Precondition: `nominal_initial`
/// has numbers for them.
std::optional<std::string> set_state_parameters(StoredJet& stored,
                                                const std::vector<std::string>& names);

/// All that is stored of a run's jet except the coefficients.
StoredJet describe_jet(const PropagationResult& result, const RunResult& run);

/// The error of evaluating a stored jet in double precision up to a degree, see
/// hamjet::evaluation_error. The largest coefficients are chosen independently of the unit of
/// length. `map` is the jet in double precision without its constant terms.
std::vector<Series<double>> evaluation_error(const StoredJet& stored,
                                             const std::vector<Series<double>>& map, int degree);

/// The bytes of a file; throws Error(input_output) if it cannot be read.
using FileReader = std::function<std::string(const std::filesystem::path& file)>;

/// read_stored_jet with files that `read` supplies, for example from memory.
StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label, const FileReader& read);

}  // namespace hamjet::io
