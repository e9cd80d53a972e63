#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// The outcome of a stiff or extreme case.
enum class CaseOutcome {
  right,    ///< within the stated tolerance of an independent reference
  refused,  ///< a clear error, if an error is the right outcome
  marked,   ///< a result with its own warning: a failed self-check
  wrong     ///< anything else: the only outcome that must never occur
};

/// The outcomes' names, in the order of the enumeration.
const char* outcome_name(CaseOutcome outcome);

/// The expected growth of a quantity along a case's duration: exponents of time that a fit through
/// its values at some times must not exceed, or must meet.
struct GrowthExpectation {
  /// Number of values, at 1, 1/2, 1/4, ... of the duration; used if no times are given.
  int checkpoints = 8;
  std::vector<double> times;  ///< in canonical units, away from 0; each must be the end of a step
  /// True nominal at these times, 2n numbers each; if empty, it is computed.
  std::vector<Extended> states;
  /// Number of starts, each moved by one more ulp from the scene's start in every component. Errors
  /// are the root mean square over them, because a fit to a single sample would be as random as its
  /// round-off.
  int samples = 1;
  std::optional<double> error_exponent;       ///< upper bound for the nominal's error
  std::optional<double> energy_exponent;      ///< upper bound for the energy error
  std::vector<double> coefficient_exponents;  ///< for the largest coefficient of degree 1, 2, ...
  double exponent_tolerance = 0.1;            ///< tolerance of the coefficients' exponents
};

/// A condition number of a kind's inverted block that is known independently.
struct ConditionExpectation {
  std::string kind;  ///< name as in a scene
  double value = 0;
};

/// The right outcome of a case: the table `[case]` of its file.
struct StabilityExpectation {
  CaseOutcome outcome = CaseOutcome::right;
  std::string source;  ///< origin of the reference
  /// Final nominal, in canonical units, 2n numbers; not compared if empty.
  std::vector<Extended> state;
  /// First derivatives of the final by the initial state, by rows, 2n x 2n; not compared if empty.
  std::vector<Extended> matrix;
  /// What the method may miss besides rounding: a result passes within tolerance + rounding_factor
  /// * MeasuredError::floor.
  double tolerance = 0;
  /// A scene that gives the same jet in another way. The jets are compared coefficient by
  /// coefficient up to the lower order, relative to the largest coefficient of the degree.
  std::optional<Scene> twin;
  bool round_trip = false;  ///< the run goes out and back, and its end is compared with the start
  std::optional<ConditionExpectation> condition;
  std::optional<GrowthExpectation> growth;
  int exit_code = 0;    ///< for the outcome refused: the expected exit code
  std::string message;  ///< for the outcome refused: a part of the error message
  std::string mark;     ///< for the outcome marked: the self-check that must fail
};

/// A chief of a flow box, whose deputies are predicted and flown: see flow_box_error.
struct FlowBoxCase {
  ZonalGravity field;
  SixNumbers<double> start;
  double time = 0;
};

/// A scene, or the chief of a flow box, with its right outcome.
struct StabilityCase {
  std::string name;   ///< stem of its file
  std::string title;  ///< title of the scene
  std::string group;
  std::string why;  ///< the difficulty of the case
  StabilityExpectation expected;
  std::variant<Scene, Error, FlowBoxCase> scene;  ///< or the error with which reading refused it
};

/// The factor by which a result may exceed the largest of a sample of 32 in which everything is
/// rounded once. A step rounds a number not once but, say, 16 times in a row (powers of the
/// distance, sums of the stages), which amounts to 4 times as much if the roundings are
/// independent. A single draw of a normal distribution exceeds the largest of 32 others 2.5-fold
/// once in 100 000 times.
inline constexpr double rounding_factor = 4 * 2.5;

/// An error, and its allowed size.
struct MeasuredError {
  std::string quantity;
  double error = 0;
  /// The rounding floor: the largest effect in a sample of random roundings at the start, in every
  /// step and at the end, carried along the flow; 0 if the error is not that of a state or a
  /// matrix.
  double floor = 0;
  double tolerance = 0;

  double allowed() const { return tolerance + rounding_factor * floor; }
  /// The ratio of the error to the allowed one: at most 1 if it passes; infinite if no error is
  /// allowed and there is one, or if it is NaN.
  double ratio() const;
};

/// A quantity along a case's duration, with the exponent of time fitted to it.
struct GrowthCurve {
  std::string quantity;
  std::vector<std::pair<double, double>> points;  ///< canonical time, value
  std::optional<double> exponent;  ///< no value if too few values are above round-off
  double expected = 0;
  bool is_upper_bound = true;
  bool is_as_expected = false;
};

/// The result of a case.
struct StabilityResult {
  const StabilityCase* subject = nullptr;
  CaseOutcome outcome = CaseOutcome::wrong;
  std::string text;  ///< one line: the error, the mark, or the reason why the outcome is wrong
  std::optional<MeasuredError> error;   ///< the worst of the measured errors
  std::vector<MeasuredError> measured;  ///< all measured errors, one for each quantity
  double seconds = 0;                   ///< time of the whole case
  std::optional<long> steps;            ///< absent if nothing was integrated
  std::optional<double> energy_error;   ///< relative, the largest along the nominal
  std::optional<double> symplecticity;  ///< largest scaled defect over all degrees
  std::optional<double> exactness;      ///< largest scaled residual over kinds and degrees
  std::optional<double> condition;      ///< condition of the first kind's inverted block
  std::vector<GrowthCurve> growth;
};

/// Runs a case and judges its outcome. Errors that the case does not expect make it wrong; only
/// exceptions of `progress` are passed on.
StabilityResult run_stability_case(const StabilityCase& subject,
                                   const ProgressCallback& progress = {});

}  // namespace hamjet
