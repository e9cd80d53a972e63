#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/studies/impulse_plan.hpp"
#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/detail/studies/relative_drift.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "hamjet/detail/studies/waypoint_plan.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/validity.hpp"

namespace hamjet {

/// What one polynomial order answers, or the refinement: velocity changes along the axes of the
/// scene's frame at the start and at the end, m/s, and where a deputy that flies it comes to.
struct TransferAnswer {
  int order = 0;  ///< of the polynomials used; 1 is the linear answer
  Eigen::Vector3d start_change_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_change_m_s = Eigen::Vector3d::Zero();
  /// Sum of the two magnitudes.
  double total_change_m_s() const;
  double largest_impulse_m_s() const {
    return std::max(start_change_m_s.norm(), end_change_m_s.norm());
  }
  /// Distance, in metres, of the deputy, flown with the full equations of motion, from the wanted
  /// end position.
  double miss_m = 0;
  std::string failure;  ///< not empty: no answer of this order, and why; the numbers are 0
};

/// The answer for one transfer time.
struct TransferPoint {
  double time = 0;  ///< canonical
  /// That was used; none where polynomials in other coordinates than Cartesian answer.
  std::optional<GeneratingFunctionKind> kind;
  double condition = 0;  ///< of its linear part
  /// Condition of the linear part of F1, dq/dp0: infinite where positions cannot be commanded.
  double position_condition = 0;
  /// Distance in time to the nearest singularity of F1, canonical; absent: there is none.
  std::optional<double> singular_distance;
  bool is_near_singular = false;        ///< nearer than the scene's margin
  std::vector<TransferAnswer> answers;  ///< orders 1..N
  std::optional<TransferAnswer> refined;
  int refinement_flights = 0;
  bool is_beyond_tolerance = false;  ///< the miss of order N exceeds the scene's tolerance
  /// Scaled residual of the Hamilton-Jacobi equation of the kind used, at the transfer's own
  /// boundary values, see HamiltonJacobiTerms::scaled.
  std::optional<double> hamilton_jacobi_residual;
  bool exceeds_impulse = false;  ///< one of the two changes is larger than the scene allows
  /// Where the scene has an ellipsoid to keep out of: the least of |(R/a, T/b, N/c)| along the way
  /// of the best answer, 1 on the ellipsoid.
  std::optional<double> keep_out_ratio;
  /// The least distance from the centre along that way, canonical; absent where the scene's check
  /// `surface` is off or the model has no radius.
  std::optional<double> lowest;
  bool is_below_surface = false;  ///< that is less than the check allows
  RelativeState arrived;          ///< after the second velocity change, in the scene's frame
  /// How the deputy goes on from there if nothing is done; absent where it was not found.
  std::optional<RelativeDrift> drift;
  std::string failure;  ///< not empty: no kind exists, and why; `answers` is empty

  bool has_answer() const { return !answers.empty() && answers.back().failure.empty(); }
  bool is_refined() const { return refined && refined->failure.empty(); }
  /// Whether it is proved to come within the tolerance, and is away from singularities.
  bool is_proved() const {
    return has_answer() && !is_near_singular && (!is_beyond_tolerance || is_refined());
  }
  bool enters_keep_out() const { return keep_out_ratio && *keep_out_ratio < 1; }
  bool is_allowed() const { return !exceeds_impulse && !enters_keep_out() && !is_below_surface; }
  /// Whether it may be the least: proved, and as the scene allows.
  bool is_candidate() const { return is_proved() && is_allowed(); }
  /// The refined answer, where the refinement succeeded, else that of the highest order.
  const TransferAnswer& best() const { return is_refined() ? *refined : answers.back(); }
  double change_m_s() const { return best().total_change_m_s(); }
};

/// A span of transfer times that take no more than the scene's budget.
struct BudgetWindow {
  double first = 0;  ///< canonical
  double last = 0;
  bool begins_before = false;  ///< `first` is the first of the times searched
  bool ends_after = false;     ///< `last` is the last of them
};

/// Condition numbers of the linear parts of all 64 kinds along time.
struct KindConditions {
  std::vector<GeneratingFunctionKind> kinds;
  std::vector<double> times;                ///< canonical
  std::vector<std::vector<double>> values;  ///< [time][kind]; infinite where singular
};

/// Seconds spent in the parts of a transfer study.
struct TransferSeconds {
  double propagation = 0;    ///< jets at all times, one integration
  double singularities = 0;  ///< linear flow, conditions and singular times of all kinds
  double inversion = 0;      ///< partial inversions, one a time
  double solution = 0;       ///< boundary values by the polynomials, all orders
  double proof = 0;          ///< deputies flown, and the refinement
  double residual = 0;       ///< Hamilton-Jacobi residuals
  double impulses = 0;       ///< the primer vector and optimal impulses

  /// Seconds that the answers took, without their proof and residuals.
  double study() const { return propagation + singularities + inversion + solution; }
};

/// All results of the study of table `[transfer]`.
struct TransferResult {
  Scene scene;  ///< with `transfer`
  std::string integrator;
  ChosenCoordinates coordinates;  ///< of the polynomials; not automatic
  IntegrationStatistics statistics;
  std::vector<TransferPoint> points;         ///< one a transfer time
  std::vector<SingularTime> singular_times;  ///< of all 64 kinds, in order of kind and time
  KindConditions conditions;
  /// Rounding floor of the flown positions, grown with the linear flow to the last time; metres.
  /// Misses below this say nothing.
  double flight_floor_m = 0;
  /// Distance, at the last time, of the jet's nominal from the chief as it was flown, metres. Ends
  /// are relative to the flown chief, so that an inaccurate integrator shows in the misses.
  double chief_error_m = 0;
  /// Rounding floor of the largest Hamilton-Jacobi residual: the most that changes of an ulp in the
  /// jet's coefficients change it, in a sample of sixteen.
  std::optional<double> hamilton_jacobi_floor;
  /// The least answer between the listed times, minimised about the lowest of them, where it is
  /// lower than at any listed time.
  std::optional<TransferPoint> least_between;
  std::size_t times_between = 0;  ///< number of further times answered between the listed ones
  /// Where the scene has a budget: its windows, to a 4000th of the listed spacing. One between two
  /// listed times, neither of which is in it, is found only if `least_between` is.
  std::vector<BudgetWindow> budget_windows;
  /// Of the least answer at the listed times; absent where there is none.
  std::optional<PrimerHistory> primer;
  std::optional<OptimalImpulses> optimal;       ///< if the scene asks for it
  std::optional<WaypointTransfers> waypoints;   ///< if the scene has some
  std::optional<CoastingTransfer> coasting;     ///< if the scene asks for it
  std::optional<OtherRevolutions> revolutions;  ///< likewise
  std::optional<ValidityResult> validity;       ///< likewise
  TransferSeconds seconds;
  std::vector<SelfCheck> checks;  ///< of the chief's flight; transfers have marks of their own

  /// Index of the point with the least total velocity change among answers that are within the
  /// tolerance, by themselves or refined, and not near a singularity; absent if there is none.
  std::optional<std::size_t> best_point() const;
  /// The singular times of F1, from position to position.
  std::vector<SingularTime> position_singularities() const;
};

/// A jet that was computed earlier, by the run `label`.
struct EarlierJet {
  std::string label;
  double time = 0;  ///< canonical
  FlowJet<double> jet;
};

/// The study of table `[transfer]`, and of `[validity]` where the scene has it. Jets at all times
/// come from one propagation; kinds, singular times and answers from them; each answer is proved by
/// flying. The integrator is the scene's first symplectic one. Throws Error(scene) if the scene has
/// no `[transfer]`, is no orbit, or has no symplectic integrator; Error(too_large),
/// Error(numerical) as make_problem and the integrator do.
///
/// With an earlier jet there is one transfer time, the jet's, and its order takes the place of the
/// scene's; no jet is propagated. Throws Error(scene) if the scene's own chief, flown, does not
/// come to where the jet's does.
TransferResult study_transfer(const Scene& scene, const ProgressCallback& progress = {},
                              const EarlierJet* earlier = nullptr);

/// Exit code: 0; 1 if a self-check failed, if the scene's limits allow none of the answers, if
/// optimal impulses, a way through waypoints, a coasting start or other revolutions were asked for
/// and not found, if the solver of optimal impulses failed for a time, so that the least may be
/// missing, or if the scene is strict and an answer away from singularities is missing, beyond its
/// tolerance or could not be refined; 4 if no transfer time has an answer.
int exit_code(const TransferResult& result);

/// A flown deputy relative to its chief, along R, T, N whatever the scene's frame (along the
/// inertial axes where the chief has no orbital plane).
struct RelativeTrajectory {
  std::vector<double> times;  ///< canonical
  std::vector<RelativeState> states;
  RelativeFrame frame = RelativeFrame::rtn_rotating;  ///< of the states
  /// The deputy that makes no velocity changes, over the scene's whole duration; empty where none
  /// are asked for.
  std::vector<RelativeState> unchanged;
  /// (q, p) about the centre of attraction, canonical: of the chief, and of the deputy from after
  /// the first velocity change to before the second.
  std::vector<std::vector<double>> chief;
  std::vector<std::vector<double>> deputy;
};

/// The flown relative trajectory of one point's best answer: at canonical times, the first 0, or as
/// it is drawn, in equal steps of the chief's eccentric anomaly.
RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point,
                                const std::vector<double>& times);
RelativeTrajectory fly_relative(const TransferResult& result, std::size_t point);

}  // namespace hamjet
