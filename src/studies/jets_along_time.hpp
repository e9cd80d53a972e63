#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

template <class Real>
class SymmetryReduction;

/// The flow's jet, propagated from time to time by integrations that each continue from the last
/// one. A copy continues independently. A rotation that the problem allows is left out throughout,
/// and put back in the jets that are returned.
class JetPropagation {
 public:
  /// Starts with the identity at the problem's start, from which times are counted. `problem` and
  /// `settings` must outlive this object.
  JetPropagation(const ComputedProblem& problem, const IntegratorSettings& settings);

  /// The jet a time, in the system's own unit, after the start. Throws as the integrator.
  FlowJet<double> advance_to(double time);

  double time() const { return reached_; }
  /// Statistics summed over the integrations; seconds are those of the integrations alone.
  const IntegrationStatistics& statistics() const { return total_; }

 private:
  const IntegratorSettings* settings_;
  std::shared_ptr<const SymmetryReduction<double>> reduction_;  ///< null if no symmetry is left out
  ClockTime start_time_;
  FlowProblem<double> flow_;  ///< from the time that was reached
  double reached_ = 0;        ///< since the start
  IntegrationStatistics total_;
};

/// Computes the flow's jets at several times, moving away from 0, from one propagation. `visit`
/// receives each jet with the index of its time.
IntegrationStatistics visit_jets(
    const ComputedProblem& problem, const IntegratorSettings& settings,
    std::span<const double> times,
    const std::function<void(std::size_t index, const FlowJet<double>& jet)>& visit);

}  // namespace hamjet
