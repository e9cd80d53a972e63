#pragma once

#include <optional>
#include <span>
#include <vector>

#include "charts/charted_boundary_values.hpp"
#include "hamjet/maps/position_boundary_values.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {

/// SI values of a scene's units, and what the velocities of its deviations are.
MetricUnits metric_units(const Scene& scene);

/// Rounding of the positions of two flights, in canonical units: that of the end, and that of the
/// chief's start, grown with the jet's linear part.
double rounding_of_flights(const ComputedProblem& problem, const FlowJet<double>& jet);
/// The same rounding from the linear part of the jet alone, between two states of the chief.
double rounding_of_flights(const Matrix<double>& linear, std::span<const double> start,
                           std::span<const double> end, int momentum_exponent);
/// The same rounding after a time; the linear flow up to it is integrated here.
double rounding_of_flights(const ComputedProblem& problem, double time);

/// The two-point problems of one transfer time, solved by a generating function of the jet or, if
/// there is a flow in other coordinates, by its polynomials.
class TransferBoundary {
 public:
  /// Both must outlive this object. `flow` may be null; then `inversion` must be present.
  TransferBoundary(const std::optional<PartialInversion<double>>& inversion,
                   const DeputyFlow* flow) {
    if (flow == nullptr) {
      cartesian_.emplace(*inversion);
    } else {
      charted_.emplace(*flow);
    }
  }
  BoundaryMomenta solve(std::span<const double> first, std::span<const double> last, int order,
                        std::span<const double> guess) {
    return charted_ ? charted_->solve(first, last, order, guess)
                    : cartesian_->solve(first, last, order);
  }

 private:
  std::optional<PositionBoundaryValues> cartesian_;
  std::optional<ChartedBoundaryValues> charted_;
};

/// One transfer of a deputy, from one relative state to another in one time. All arguments of the
/// constructor must outlive it.
class SingleTransfer {
 public:
  /// The orbit of the problem starts with the chief (CompanionFlow); `orbit_end` and `chief_end`
  /// are the states of both at the end. `time` is canonical.
  SingleTransfer(const Scene& scene, const ComputedProblem& problem, double time,
                 const std::vector<double>& orbit_end, const std::vector<double>& chief_end,
                 const RelativeState& start, const ArrivalState& end);

  /// The deviation at the start, after the first impulse, by the linear flow alone.
  std::vector<double> linear_deviation(const Eigen::Matrix<double, 6, 6>& flow) const;
  /// The deviation of the momentum before the first impulse. If the deputy's orbit is similar to
  /// the chief's, the wanted momentum is similar too, however far apart both are.
  std::vector<double> momentum_before() const { return {start_.begin() + 3, start_.end()}; }
  /// The momenta by the polynomials of one order. In coordinates other than Cartesian, Newton's
  /// method starts from a guess of the first momentum. Throws as PositionBoundaryValues::solve and
  /// ChartedBoundaryValues::solve.
  BoundaryMomenta solve(TransferBoundary& boundary, int order, std::span<const double> guess) const;
  /// The variables of a kind's generating function with these momenta.
  std::vector<double> variables(const GeneratingFunctionKind& kind,
                                const BoundaryMomenta& momenta) const;
  /// The velocity changes that lead to these momenta.
  TransferAnswer answer(const BoundaryMomenta& momenta, int order) const;
  /// Flies the deputy from the start with this initial momentum (a deviation); returns (dq, dp)
  /// from the orbit at the end. Throws Error(numerical) as exact_flow.
  std::vector<double> fly(const std::vector<double>& initial_momentum) const;
  /// Distance in metres of a flown deviation from the wanted end.
  double miss_m(const std::vector<double>& flown) const;
  /// Newton's method on the flown miss, starting from the momenta of the highest order, until the
  /// scene's `refined_miss_m` is reached. The derivatives are those of the jet at this time or, if
  /// it is not null, of `flow`. If the method fails, the reason is recorded in the answer. Adds the
  /// number of flights to `flights`.
  TransferAnswer refine(const FlowJet<double>& jet, const DeputyFlow* flow, BoundaryMomenta momenta,
                        int& flights) const;

  /// The state of the deputy at the start, after the first impulse.
  std::vector<double> deputy(const std::vector<double>& initial_momentum) const;

 private:
  const Scene& scene_;
  const ComputedProblem& problem_;
  double time_;
  MetricUnits units_;
  const std::vector<double>& orbit_end_;
  ChiefFrame start_frame_;
  ChiefFrame end_frame_;
  std::vector<double> start_;  ///< canonical (dq, dp) before the first impulse
  std::vector<double> end_;    ///< canonical (dq, dp) from the orbit, after the second impulse
};

}  // namespace hamjet
