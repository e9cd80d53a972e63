#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The flow's jet at every time between the start and the duration, from one Gauss integration.
///
/// The integration keeps its jets at the ends of its steps. The jet at a time between two of them
/// is one more step of the same method, shorter than the one that was taken, from the last end
/// before: the jet of a symplectic map, whose local error is of order h^(2s+1), so that it is as
/// right as the ends are. What collocation has for this, the polynomial through the stages, is of
/// order s + 1 only (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section
/// II.6), at steps that are as long as order 2s allows. Measured at 300 random times of 1.5
/// revolutions of order 3 in J2 to J6, e = 0 to 0.7, 4 and 8 stages, tolerances 1e-9 and 1e-12: the
/// largest relative error of a degree is at most 1.2 times that at the ends of the steps, and
/// that of the polynomial up to a million times (8 stages on the circle at 1e-9: 1.2e-8 and
/// 2.7e-3); such a step takes 20 to 50 microseconds.
///
/// The tolerance is one of the jet at the duration. At other times the error of each degree is
/// below ten tolerances for each period of the linearised motion, relative to the larger of the
/// degree's largest coefficients then and at the duration: near the start the high degrees vanish,
/// and steps say nothing of what is relative to that.
template <class Real>
class JetTrajectory {
 public:
  /// Integrates. At most `most_bytes` are taken by the jets that are kept, but for the first and
  /// the last: where all take more, every second, fourth, ... is kept, and the steps to the others
  /// are taken again where a time asks for them. Throws as integrate_gauss.
  JetTrajectory(const FlowProblem<Real>& problem, const GaussSettings& settings,
                double most_bytes = 256e6, const StepObserver<Real>& observer = {});

  /// The jet at a time between 0 and the duration, in the system's own unit. Throws Error(usage)
  /// for any other time, and if it is not a number; Error(numerical) as integrate_gauss. May be
  /// called on several threads at once.
  FlowJet<Real> at(const Real& time) const;

  const Real& duration() const { return problem_.duration; }
  /// The jet at the duration, bit by bit that of integrate_gauss.
  const FlowJet<Real>& final_jet() const { return final_; }
  const IntegrationStatistics& statistics() const { return statistics_; }
  /// Where the steps begin and end: 0, ..., the duration.
  const std::vector<Real>& step_times() const { return times_; }
  std::size_t kept_jets() const { return kept_.size(); }

 private:
  void keep(const FlowJet<Real>& jet);
  /// One step of the method, from a jet.
  FlowJet<Real> step(FlowJet<Real> jet, const Real& length) const;

  FlowProblem<Real> problem_;
  GaussSettings settings_;
  IntegrationStatistics statistics_;
  std::vector<Real> times_;
  std::vector<FlowJet<Real>> kept_;  ///< after 0, stride_, 2 stride_, ... steps
  std::size_t stride_ = 1;
  std::size_t most_kept_;
  FlowJet<Real> final_;
};

}  // namespace hamjet
