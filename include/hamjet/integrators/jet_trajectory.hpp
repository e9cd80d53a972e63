#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/integrators/gauss_collocation.hpp"

namespace hamjet {

/// The flow's jet at every time between the start and the duration, from one Gauss integration.
///
/// The integration keeps its jets at the ends of its steps. The jet at a time between two of these
/// ends is made by one more, shorter step of the same method from the last end before. It is the
/// jet of a symplectic map with a local error of order h^(2s+1), so that it is as accurate as the
/// jets at the ends. The usual dense output of collocation, the polynomial through the stages, has
/// only order s + 1 (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section
/// II.6), while the steps are as long as order 2s allows. This was measured at 300 random times
/// over 1.5 revolutions, order 3, in J2 to J6, with e = 0 to 0.7, 4 and 8 stages, and tolerances
/// 1e-9 and 1e-12. The largest relative error of a degree is at most 1.2 times that at the ends of
/// the steps; for the polynomial it is up to a million times (8 stages on the circle at 1e-9:
/// 1.2e-8 and 2.7e-3). Such a step takes 20 to 50 microseconds.
///
/// The tolerance applies to the jet at the duration. At other times the error of each degree is
/// below ten tolerances per period of the linearised motion, relative to the larger of the degree's
/// largest coefficients at that time and at the duration. (Near the start the high degrees vanish,
/// and the choice of steps does not control errors relative to so small numbers.)
template <class Real>
class JetTrajectory {
 public:
  /// Integrates. The kept jets, apart from the first and the last, take at most `most_bytes`. If
  /// all would take more, every second, fourth, ... jet is kept, and steps from a kept jet are
  /// repeated where a time asks for them. Throws as integrate_gauss.
  JetTrajectory(const FlowProblem<Real>& problem, const GaussSettings& settings,
                double most_bytes = 256e6, const StepObserver<Real>& observer = {});

  /// The jet at a time between 0 and the duration, in the system's own unit of time. Throws
  /// Error(usage) for any other time or NaN, and Error(numerical) as integrate_gauss. It may be
  /// called on several threads at once.
  FlowJet<Real> at(const Real& time) const;

  const Real& duration() const { return problem_.duration; }
  /// The jet at the duration; it has the same bits as that of integrate_gauss.
  const FlowJet<Real>& final_jet() const { return final_; }
  const IntegrationStatistics& statistics() const { return statistics_; }
  /// The times at which steps begin and end: 0, ..., the duration.
  const std::vector<Real>& step_times() const { return times_; }
  std::size_t kept_jets() const { return kept_.size(); }

 private:
  void keep(const FlowJet<Real>& jet);
  /// One step of the method, starting from a jet.
  FlowJet<Real> step(FlowJet<Real> jet, const Real& from, const Real& length) const;

  FlowProblem<Real> problem_;
  GaussSettings settings_;
  IntegrationStatistics statistics_;
  std::vector<Real> times_;
  std::vector<FlowJet<Real>> kept_;  ///< jets after 0, stride_, 2 stride_, ... steps
  std::size_t stride_ = 1;
  std::size_t most_kept_;
  FlowJet<Real> final_;
};

}  // namespace hamjet
