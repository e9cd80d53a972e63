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

/// How a stiff or extreme case came out.
enum class CaseOutcome {
  right,    ///< within the stated tolerance of an independent reference
  refused,  ///< a clear error, where that is what is right
  marked,   ///< a result that carries its own warning, a failed self-check
  wrong     ///< anything else: the only outcome that must never be
};

/// The outcomes' names, in the order of the enumeration.
const char* outcome_name(CaseOutcome outcome);

/// How a quantity is expected to grow along a case's duration: exponents of time that a fit through
/// its values at some times must not exceed, or must meet.
struct GrowthExpectation {
  /// Number of values, at 1, 1/2, 1/4, ... of the duration; used where no times are given.
  int checkpoints = 8;
  std::vector<double> times;     ///< canonical, away from 0; each must be the end of a step
  std::vector<Extended> states;  ///< true nominal at these times, 2n numbers each; empty: computed
  /// Number of starts, each an ulp further from the scene's in every component. Errors are the root
  /// mean square over them: a fit to one sample would be as random as its round-off.
  int samples = 1;
  std::optional<double> error_exponent;       ///< upper bound for the nominal's error
  std::optional<double> energy_exponent;      ///< upper bound for the energy error
  std::vector<double> coefficient_exponents;  ///< of the largest coefficient of degree 1, 2, ...
  double exponent_tolerance = 0.1;            ///< of the coefficients' exponents
};

/// A condition number of a kind's inverted block that is known independently.
struct ConditionExpectation {
  std::string kind;  ///< as in a scene
  double value = 0;
};

/// What is right for a case: the table `[case]` of its file.
struct StabilityExpectation {
  CaseOutcome outcome = CaseOutcome::right;
  std::string source;  ///< where the reference comes from
  /// Final nominal, canonical, 2n numbers; empty: not compared.
  std::vector<Extended> state;
  /// First derivatives of the final by the initial state, by rows, 2n x 2n; empty: not compared.
  std::vector<Extended> matrix;
  /// What the method may miss besides rounding: a result passes within tolerance + rounding_factor
  /// * MeasuredError::floor.
  double tolerance = 0;
  /// A scene that gives the same jet in another way: compared coefficient by coefficient up to the
  /// lower order, relative to the largest of the degree.
  std::optional<Scene> twin;
  bool round_trip = false;  ///< out and back: the start is compared
  std::optional<ConditionExpectation> condition;
  std::optional<GrowthExpectation> growth;
  int exit_code = 0;    ///< refused: the one expected
  std::string message;  ///< refused: a part of the error
  std::string mark;     ///< marked: the self-check that must fail
};

/// A chief of a flow box, whose deputies are predicted and flown: see flow_box_error.
struct FlowBoxCase {
  ZonalGravity field;
  SixNumbers<double> start;
  double time = 0;
};

/// A scene, or a flow box's chief, with what is right for it.
struct StabilityCase {
  std::string name;   ///< stem of its file
  std::string title;  ///< of the scene
  std::string group;
  std::string why;  ///< what is hard about it
  StabilityExpectation expected;
  std::variant<Scene, Error, FlowBoxCase> scene;  ///< or the error that refused it on reading
};

/// How far a result may be from the largest of a sample of 32 in which everything is rounded once.
/// A step rounds a number not once but, say, 16 times, one after another (powers of the distance,
/// sums of the stages): that is 4 times as much where each rounding is independent of the others. A
/// single draw of a normal distribution exceeds the largest of 32 others 2.5-fold once in 100 000
/// times.
inline constexpr double rounding_factor = 4 * 2.5;

/// An error, and how large it may be.
struct MeasuredError {
  std::string quantity;
  double error = 0;
  /// The rounding floor, what rounding alone does: the largest in a sample of random roundings at
  /// the start, in every step and at the end, carried along the flow; 0 where the error is not that
  /// of a state or a matrix.
  double floor = 0;
  double tolerance = 0;

  double allowed() const { return tolerance + rounding_factor * floor; }
  /// The error over the allowed one: at most 1 if it passes; infinite if no error is allowed and
  /// there is one, or if it is not a number.
  double ratio() const;
};

/// A quantity along a case's duration, with the exponent of time fitted to it.
struct GrowthCurve {
  std::string quantity;
  std::vector<std::pair<double, double>> points;  ///< canonical time, value
  std::optional<double> exponent;                 ///< none where too few values are above round-off
  double expected = 0;
  bool is_upper_bound = true;
  bool is_as_expected = false;
};

/// What a case gave.
struct StabilityResult {
  const StabilityCase* subject = nullptr;
  CaseOutcome outcome = CaseOutcome::wrong;
  std::string text;                     ///< one line: the error, the mark, or why it is wrong
  std::optional<MeasuredError> error;   ///< the worst of those measured
  std::vector<MeasuredError> measured;  ///< all, one a quantity
  double seconds = 0;                   ///< of the whole case
  std::optional<long> steps;            ///< absent where nothing was integrated
  std::optional<double> energy_error;   ///< relative, the largest along the nominal
  std::optional<double> symplecticity;  ///< largest scaled defect over all degrees
  std::optional<double> exactness;      ///< largest scaled residual over kinds and degrees
  std::optional<double> condition;      ///< of the first kind's inverted block
  std::vector<GrowthCurve> growth;
};

/// Runs a case and says how it came out. Errors that the case does not expect make it wrong; only
/// what `progress` throws is passed on.
StabilityResult run_stability_case(const StabilityCase& subject,
                                   const ProgressCallback& progress = {});

}  // namespace hamjet
