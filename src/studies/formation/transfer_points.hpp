#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../../maps/hamilton_jacobi.hpp"
#include "../kind_choice.hpp"
#include "charts/deputy_flows.hpp"
#include "companion_flow.hpp"
#include "hamjet/studies/transfer.hpp"
#include "single_transfer.hpp"

namespace hamjet {

/// The kind by which the transfers of one time are answered, and the jet solved for it. Polynomials
/// in other coordinates need no generating function.
struct ChosenKind {
  double time = 0;
  std::vector<double> conditions;  ///< condition numbers of all kinds, F1's first
  std::optional<PartialInversion<double>> inversion;  ///< no value in other coordinates
  std::string failure;  ///< if not empty, the reason why there is no inversion
};

/// The two relative states between which a transfer leads.
struct RelativeTransfer {
  RelativeState start;
  ArrivalState end;
};

/// Answers transfers about one chief, time after time. All arguments of the constructor must
/// outlive it.
class TransferPoints {
 public:
  /// Finds the singular times of all kinds up to the scene's last transfer time. Adds the time
  /// spent to `seconds`.
  TransferPoints(const Scene& scene, const ProgressCallback& progress, TransferSeconds& seconds);

  const ComputedProblem& problem() const noexcept { return problem_; }
  /// The problem of the Cartesian jets. It has the scene's order; but if polynomials in other
  /// coordinates answer, it is linear and serves for conditions and floors alone.
  const ComputedProblem& jet_problem() const noexcept {
    return linear_problem_ ? *linear_problem_ : problem_;
  }
  const std::vector<GeneratingFunctionKind>& kinds() const noexcept { return kinds_; }
  const std::vector<SingularTime>& singular_times() const noexcept { return singular_times_; }
  /// The coordinates of the polynomials that answer; not automatic.
  const ChosenCoordinates& coordinates() const noexcept { return coordinates_; }

  /// The flow about the orbit of the polynomials, to beyond the scene's last transfer time.
  const CompanionFlow& linear_flow() const noexcept { return *flow_; }
  /// The chief's state at a time at which the orbit of the polynomials is here.
  std::vector<double> chief_beside(const std::vector<double>& orbit, double time) const;

  bool is_near_singular(double time) const;

  /// The scene's kind, or the best one for these transfers, with hysteresis from call to call.
  ChosenKind choose_kind(double time, const FlowJet<double>& jet,
                         const std::vector<RelativeTransfer>& transfers);
  /// The answers of all orders for one transfer, proved by flying, with the refinement if it is
  /// needed.
  TransferPoint answer(const ChosenKind& chosen, const FlowJet<double>& jet,
                       const RelativeTransfer& ends);
  /// Adds the drift of the deputy after its arrival, see relative_drift.
  void add_drift(const RelativeTransfer& ends, TransferPoint& point, bool finds_holding);
  /// The flow in the scene's coordinates, or null if these are Cartesian. Successive times that
  /// increase cost least.
  const DeputyFlow* charted_flow(double time);
  /// Makes the next choice of a kind independent of earlier ones.
  void forget_last_kind() { choice_ = {}; }
  /// See TransferResult::flight_floor_m.
  double flight_floor_m(const FlowJet<double>& jet) const;
  double chief_error_m(double time, const FlowJet<double>& jet);
  std::optional<double> hamilton_jacobi_floor() const;

 private:
  /// The answer with the largest Hamilton-Jacobi residual so far.
  struct LargestResidual {
    double scaled = 0;
    SharedSystem system;  ///< the system at the time of the jet
    FlowJet<double> jet;
    GeneratingFunctionKind kind;
    std::vector<double> w;  ///< variables of the kind
    HamiltonJacobiTerms terms;
  };

  /// How fast each kind's polynomials decay. With B the block that the kind inverts and d the
  /// linear answer, it is |B(0)^-1 (B(d) - B(0))|, the relative change of the block over the
  /// transfer; the largest value over the transfers. (The condition of B alone is no guide: on the
  /// paper's orbit kinds with a condition of 3 miss by metres where F1, with 60, misses by
  /// micrometres.)
  std::vector<double> expansion_parameters(const FlowJet<double>& jet,
                                           const std::vector<RelativeTransfer>& transfers,
                                           double time) const;
  void find_singular_times(const ProgressCallback& progress);
  std::optional<double> singular_distance(double time) const;
  /// The chief, and the orbit of the polynomials, flown to a time; the last states are kept,
  /// because several deputies and the error of the orbit need them.
  struct FlownOrbits {
    double time = 0;
    std::vector<double> orbit;  ///< empty before the first flight
    std::vector<double> chief;
  };
  const FlownOrbits& flown_orbits(double time);
  /// Judges whether the scene allows the best answer.
  void judge_limits(const RelativeTransfer& ends, TransferPoint& point);
  void measure_residual(const ChosenKind& chosen, const FlowJet<double>& jet,
                        const std::vector<double>& w, TransferPoint& point);

  const Scene& scene_;
  const TransferSettings& settings_;
  bool has_orbit_;
  TransferSeconds& seconds_;
  FlownTogether both_;
  ComputedProblem problem_;                        ///< the problem of spacecraft like the deputy
  std::optional<ComputedProblem> linear_problem_;  ///< see jet_problem
  std::optional<CompanionFlow> flow_;
  std::vector<GeneratingFunctionKind> kinds_;
  KindChoice choice_;
  FlownOrbits flown_;
  ChosenCoordinates coordinates_;
  /// Propagation of the flows in other coordinates.
  std::optional<DeputyFlowPropagation> propagation_;
  double propagated_ = 0;                     ///< the time that the flow has reached
  std::unique_ptr<DeputyFlow> charted_flow_;  ///< flow at that time
  std::vector<SingularTime> singular_times_;
  std::optional<LargestResidual> largest_residual_;
};

}  // namespace hamjet
