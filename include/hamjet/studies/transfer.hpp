#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/studies/energy_optimal.hpp"
#include "hamjet/detail/studies/finite_burns.hpp"
#include "hamjet/detail/studies/fuel_optimal.hpp"
#include "hamjet/detail/studies/impulse_plan.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet {

/// The answer of one polynomial order, or of the refinement: velocity changes at the start and at
/// the end, in m/s along the axes of the scene's frame, and the miss of a deputy that flies them.
struct TransferAnswer {
  int order = 0;  ///< order of the polynomials; 1 is the linear answer
  Eigen::Vector3d start_change_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_change_m_s = Eigen::Vector3d::Zero();
  /// Sum of the two magnitudes.
  double total_change_m_s() const;
  double largest_impulse_m_s() const {
    return std::max(start_change_m_s.norm(), end_change_m_s.norm());
  }
  /// Distance, in metres, from the wanted end position of the deputy that flies this answer with
  /// the full equations of motion.
  double miss_m = 0;
  std::string
      failure;  ///< if not empty, the reason why this order has no answer; the numbers are then 0
};

/// The answer for one transfer time.
struct TransferPoint {
  double time = 0;  ///< in canonical units
  /// Kind of generating function that was used; no value if polynomials in coordinates other than
  /// Cartesian answer.
  std::optional<GeneratingFunctionKind> kind;
  double condition = 0;  ///< condition of its linear part
  /// Condition of the linear part of F1, dq/dp0; infinite where positions cannot be commanded.
  double position_condition = 0;
  /// Distance in canonical time to the nearest singularity of F1; absent if there is none.
  std::optional<double> singular_distance;
  bool is_near_singular = false;        ///< whether that distance is less than the scene's margin
  std::vector<TransferAnswer> answers;  ///< answers of the orders 1..N
  std::optional<TransferAnswer> refined;
  int refinement_flights = 0;
  bool is_beyond_tolerance = false;  ///< the miss of order N exceeds the scene's tolerance
  /// Scaled residual of the Hamilton-Jacobi equation of that kind, at the transfer's own boundary
  /// values, see HamiltonJacobiTerms::scaled.
  std::optional<double> hamilton_jacobi_residual;
  bool exceeds_impulse = false;  ///< one of the two changes is larger than the scene allows
  /// If the scene has an ellipsoid to keep out of, the least of |(R/a, T/b, N/c)| along the way of
  /// the best answer; it is 1 on the ellipsoid, and 0 of a way that cannot be followed.
  std::optional<double> keep_out_ratio;
  /// The least distance from the centre along that way, in canonical units; absent if the scene's
  /// check `surface` is off or the model has no radius.
  std::optional<double> lowest;
  bool is_below_surface = false;  ///< whether that distance is less than the check allows
  RelativeState arrived;          ///< state after the second velocity change, in the scene's frame
  /// The drift of the deputy after its arrival if nothing is done; absent if it was not found.
  std::optional<RelativeDrift> drift;
  std::string failure;  ///< if not empty, the reason why no kind exists; `answers` is then empty

  bool has_answer() const { return !answers.empty() && answers.back().failure.empty(); }
  bool is_refined() const { return refined && refined->failure.empty(); }
  /// Whether the answer is proved to come within the tolerance, and is away from singularities.
  bool is_proved() const {
    return has_answer() && !is_near_singular && (!is_beyond_tolerance || is_refined());
  }
  bool enters_keep_out() const { return keep_out_ratio && *keep_out_ratio < 1; }
  bool is_allowed() const { return !exceeds_impulse && !enters_keep_out() && !is_below_surface; }
  /// Whether the answer may be the least: it is proved, and the scene allows it.
  bool is_candidate() const { return is_proved() && is_allowed(); }
  /// The refined answer if the refinement succeeded, otherwise that of the highest order.
  const TransferAnswer& best() const { return is_refined() ? *refined : answers.back(); }
  double change_m_s() const { return best().total_change_m_s(); }
};

/// A span of transfer times whose transfers cost no more than the scene's budget.
struct BudgetWindow {
  double first = 0;  ///< in canonical units
  double last = 0;
  bool begins_before =
      false;  ///< `first` is the first time that was searched, so that the span may begin earlier
  bool ends_after = false;  ///< `last` is the last time that was searched
};

/// Condition numbers of the linear parts of all 64 kinds along time.
struct KindConditions {
  std::vector<GeneratingFunctionKind> kinds;
  std::vector<double> times;                ///< in canonical units
  std::vector<std::vector<double>> values;  ///< [time][kind]; infinite where singular
};

/// Seconds spent in the parts of a transfer study.
struct TransferSeconds {
  double propagation = 0;    ///< jets at all times, by one integration
  double singularities = 0;  ///< linear flow, conditions and singular times of all kinds
  double inversion = 0;      ///< partial inversions, one per time
  double solution = 0;       ///< boundary values by the polynomials, for all orders
  double proof = 0;          ///< flights of deputies, and the refinement
  double residual = 0;       ///< Hamilton-Jacobi residuals
  double impulses = 0;       ///< the primer vector and optimal impulses
  double thrust = 0;         ///< energy-optimal thrust
  double fuel = 0;           ///< fuel-optimal thrust
  double burns = 0;          ///< burns in place of impulses

  /// Seconds for the answers, without their proof and residuals.
  double study() const { return propagation + singularities + inversion + solution; }
};

/// All results of the study of table `[transfer]`.
struct TransferResult {
  Scene scene;  ///< with `transfer`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< coordinates of the polynomials; not automatic
  IntegrationStatistics statistics;
  std::vector<TransferPoint> points;  ///< one for each transfer time
  /// Singular times of all 64 kinds, in order of kind and time.
  std::vector<SingularTime> singular_times;
  KindConditions conditions;
  /// Rounding floor of the flown positions in metres: rounding grown with the linear flow, the
  /// largest of the transfer times. Misses below this mean nothing.
  double flight_floor_m = 0;
  /// Distance in metres, at the last time, of the jet's nominal from the flown chief. Ends are
  /// relative to the flown chief, so that an inaccurate integrator shows in the misses.
  double chief_error_m = 0;
  /// Rounding floor of the largest Hamilton-Jacobi residual: its largest change when the jet's
  /// coefficients change by an ulp, in a sample of sixteen.
  std::optional<double> hamilton_jacobi_floor;
  /// The cheapest answer between the listed times, minimised about the lowest of them, if it is
  /// cheaper than at every listed time.
  std::optional<TransferPoint> least_between;
  std::size_t times_between = 0;  ///< number of further times answered between the listed ones
  /// If the scene has a budget: its windows, to a 4000th of the distance of the listed times. A
  /// window between two listed times that are both outside it is found only if `least_between` is
  /// in it.
  std::vector<BudgetWindow> budget_windows;
  /// Primer vector of the cheapest answer at the listed times; absent if there is none.
  std::optional<PrimerHistory> primer;
  std::optional<OptimalImpulses> optimal;      ///< if the scene asks for optimal impulses
  std::optional<WaypointTransfers> waypoints;  ///< if the scene has waypoints
  std::optional<CoastingTransfer> coasting;    ///< if the scene asks for a coasting start
  /// If the scene asks for other numbers of revolutions.
  std::optional<OtherRevolutions> revolutions;
  std::optional<EnergyOptimalTransfers> thrust;  ///< if the scene asks for a thrust that lasts
  std::optional<FuelOptimalTransfers> fuel;      ///< if the scene asks for fuel-optimal thrust
  std::optional<FiniteBurns> burns;  ///< if the scene has a thruster for other than such thrust
  std::optional<ValidityResult> validity;  ///< if the scene has `[validity]`
  TransferSeconds seconds;
  /// Checks of the chief's flight; transfers have marks of their own.
  std::vector<SelfCheck> checks;

  /// Index of the point with the least total velocity change among answers that are within the
  /// tolerance, originally or refined, and not near a singularity; absent if there is none.
  std::optional<std::size_t> best_point() const;
  /// The singular times of F1, from position to position.
  std::vector<SingularTime> position_singularities() const;
};

/// A jet that was computed earlier, by the run `label`.
struct EarlierJet {
  std::string label;
  double time = 0;  ///< in canonical units
  FlowJet<double> jet;
};

/// The study of table `[transfer]`, and of `[validity]` if the scene has it. Jets at all times come
/// from one propagation, and kinds, singular times and answers come from these jets. Each answer is
/// proved by flying. The integrator is the scene's first symplectic one. Throws Error(scene) if the
/// scene has no `[transfer]`, is no orbit, or has no symplectic integrator; Error(too_large),
/// Error(numerical) as make_problem and the integrator do.
///
/// With an earlier jet there is a single transfer time, that of the jet, and its order replaces the
/// scene's; no jet is propagated. Throws Error(scene) if the flown chief of the scene does not
/// arrive where the jet's nominal does.
TransferResult study_transfer(const Scene& scene, const ProgressCallback& progress = {},
                              const EarlierJet* earlier = nullptr);

/// Exit code: 0; 1 if a self-check failed, if the scene's limits allow none of the answers, if
/// optimal impulses, a way through waypoints, a coasting start, other revolutions a thrust that
/// lasts or burns of a thruster were asked for and not found, if the solver of optimal impulses
/// failed for a time, so that the least may be missing, or if the scene is strict and an answer
/// away from singularities is missing, beyond its tolerance or could not be refined; 4 if no
/// transfer time has an answer.
int exit_code(const TransferResult& result);

/// A flown deputy relative to its chief, along R, T, N in any frame of the scene (along the
/// inertial axes if the chief has no orbital plane).
struct RelativeTrajectory {
  std::vector<double> times;  ///< in canonical units
  std::vector<RelativeState> states;
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< frame of the states
  /// The deputy without velocity changes, over the scene's whole duration; empty if it is not
  /// requested.
  std::vector<RelativeState> unchanged;
  /// States (q, p) about the centre of attraction, in canonical units: of the chief, and of the
  /// deputy from after the first velocity change to before the second.
  std::vector<std::vector<double>> chief;
  std::vector<std::vector<double>> deputy;
};

/// The flown relative trajectory of one point's best answer: at canonical times, the first of which
/// is 0, or, for drawing, in equal steps of the chief's eccentric anomaly.
RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point,
                                const std::vector<double>& times);
RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point);

}  // namespace hamjet
