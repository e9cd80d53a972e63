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

/// What a jet between flow boxes needs beside the nominal's states: where its sections are.
struct StoredFlowBox {
  ChartName section = ChartName::nodal;  ///< chart of both sections, which go through the nominal
  ZonalGravity field;                    ///< canonical

  /// Whether the radius is one that a field has: that of a centre without harmonics is 0.
  bool has_radius_of_field() const {
    return std::isfinite(field.radius) &&
           (field.radius > 0 || (field.radius == 0 && !field.J.any()));
  }
};

/// What is said of another radius.
inline constexpr std::string_view radius_of_field_rule =
    "must be positive, or 0 of a field without harmonics";

/// The jet of one run as `hamjet run` has stored it. Indices are those of the model's state (q, p);
/// numbers are canonical.
struct StoredJet {
  std::string scene;  ///< its name
  std::string label;  ///< of the run
  SystemModel model = SystemModel::zonal_gravity;
  Precision precision = Precision::double_precision;  ///< of the coefficients as printed
  CanonicalUnits units;
  double duration = 0;
  std::vector<double> nominal_initial;  ///< all 2n components of the model
  std::vector<double> nominal_final;
  /// Components that were computed, ascending; the others are zero throughout, whatever the
  /// deviation in the variables.
  std::vector<std::size_t> components;
  std::vector<std::size_t> variables;  ///< expanded in, ascending
  /// Date and frame of the nominal, where the scene names them: epoch, time system, reference frame
  /// with its epoch, and centre; the rest is not stored.
  std::optional<EphemerisSettings> ephemeris = {};
  /// Errors of the coefficients by degree, relative to the largest of the degree, where the run has
  /// measured or estimated them (see relative_error_by_degree) and the format keeps them; else
  /// empty. Of other coordinates than Cartesian, flow boxes apart, they are those of the run's jet in
  /// positions and momenta.
  std::vector<double> error_by_degree = {};
  /// In which the deviations are, at the start, and the final ones. In other coordinates than
  /// Cartesian the constant terms are the chief's, in the chart of the end; nominal states are
  /// positions and momenta all the same.
  CoordinatesAtEnds coordinates = {};
  /// Of flow boxes, and of these alone. Then the series are FlowBoxMap's, `time` before
  /// `coordinates`, in the variables of the sections, which are fewer than the state's.
  std::optional<StoredFlowBox> flow_box = {};
  /// What its reader has to tell of the file, a line each.
  std::vector<std::string> notes = {};
  /// One series a component. The printed digits bring back the numbers of the run bit by bit; in
  /// double precision they are doubles.
  FlowJet<Extended> jet;

  int order() const { return jet.at(0).order(); }
  /// See ComputedProblem::momentum_exponent.
  int momentum_exponent() const;
  /// Names of the model's state (q, p), to which `components` and `variables` are indices.
  std::vector<std::string_view> variable_names() const {
    return hamjet::variable_names(model, nominal_initial.size() / 2);
  }
};

/// Reads `summary.json` and `<label>/jet.csv` of a results directory: the run with this label, or
/// else the first that has a result. Throws Error(input_output), one line with the file and the
/// line or key, if anything is missing, changed since, of another version or of a failed run;
/// Error(usage) if no run has this label.
StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label = {});

/// The times of a run's jets that are wanted, in seconds.
struct WantedTimes {
  std::vector<double> seconds = {};
  bool all = false;  ///< all times that the run has, the duration last
};

/// The jets of a results directory's run at the wanted times, in their order: those that the
/// scene's `jet.times_...` asked for, and that of the duration. A time is a stored one's to 1e-9 of
/// it. Throws as read_stored_jet, and Error(usage) for a time that the run has no jet at.
std::vector<StoredJet> read_stored_jets(const std::filesystem::path& directory,
                                        const std::optional<std::string>& label,
                                        const WantedTimes& wanted);

/// The polynomials that a run wrote in its scene's coordinates, other than Cartesian ones, beside
/// its jet; nothing if it has none, and of a path that is no directory. Throws as read_stored_jet.
std::optional<StoredJet> read_stored_polynomials(const std::filesystem::path& directory,
                                                 const std::optional<std::string>& label = {});

/// Its series as a map between flow boxes, in double precision. Throws Error(numerical) where its
/// orbit has not such sections. Precondition: it has `flow_box`.
FlowBoxMap<double> flow_box_map(const StoredJet& stored);

/// Throws Error(usage) unless a stored jet is in positions and momenta, for those who can do
/// nothing with another; `name` is the file's.
void require_positions_and_momenta(const StoredJet& stored, const std::string& name);

/// Whether a stored jet is of this time, to 1e-9 of it.
bool is_at(const StoredJet& stored, double time_s);

/// All that is stored of a run's jet but the coefficients.
StoredJet describe_jet(const PropagationResult& result, const RunResult& run);

/// What evaluating a stored jet in double precision loses up to a degree, see
/// hamjet::evaluation_error; its largest coefficients are those that are the largest whatever the
/// unit of length. `map` is the jet in double precision without its constant terms.
std::vector<Series<double>> evaluation_error(const StoredJet& stored,
                                             const std::vector<Series<double>>& map, int degree);

/// The bytes of a file; throws Error(input_output) if it cannot be read.
using FileReader = std::function<std::string(const std::filesystem::path& file)>;

/// read_stored_jet with files that `read` brings, for example from memory.
StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label, const FileReader& read);

}  // namespace hamjet::io
