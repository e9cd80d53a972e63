#pragma once

#include <optional>

#include "../integration_clock.hpp"
#include "rotation_reduction.hpp"
#include "time_reduction.hpp"

namespace hamjet {

/// Takes symmetries out of a problem and puts them back: those that FlowProblem::symmetry asks for,
/// as far as the problem has them. The rotation is taken out first, then the shift in time of what
/// is left.
template <class Real>
class SymmetryReduction {
 public:
  /// The reduction; no value if nothing is left out.
  static std::optional<SymmetryReduction> of(const FlowProblem<Real>& problem);

  FlowSymmetry left_out() const;
  const FlowProblem<Real>& problem() const {
    return time_ ? time_->problem() : rotation_->problem();
  }
  FlowJet<Real> expand(const FlowJet<Real>& reduced) const;

 private:
  SymmetryReduction() = default;

  std::optional<RotationReduction<Real>> rotation_;
  std::optional<TimeReduction<Real>> time_;
};

/// Integrates a problem; its symmetries are left out where there are any. `run` integrates a
/// problem with an observer and must commute with the rotation. The time for leaving out and
/// putting back is added to the statistics' seconds.
template <class Real, class Run>
FlowJet<Real> integrate_without_symmetry(const FlowProblem<Real>& problem,
                                         IntegrationStatistics& statistics,
                                         const StepObserver<Real>& observer, const Run& run) {
  IntegrationClock clock;
  const auto reduction = SymmetryReduction<Real>::of(problem);
  if (!reduction) return run(problem, observer);
  StepObserver<Real> of_reduced = observer;
  if (observer && !problem.observes_constant_terms) {
    of_reduced = [&](const Real& time, const FlowJet<Real>& jet) {
      observer(time, reduction->expand(jet));
    };
  }
  FlowJet<Real> jet;
  clock.exclude([&] { jet = run(reduction->problem(), of_reduced); });
  jet = reduction->expand(jet);
  statistics.left_out = reduction->left_out();
  statistics.wall_seconds += clock.seconds();
  return jet;
}

}  // namespace hamjet
