#pragma once

#include <functional>
#include <memory>
#include <span>

#include "hamjet/integrators/flow_problem.hpp"
#include "hamjet/studies/propagation.hpp"

namespace hamjet {

template <class Real>
class SymmetryReduction;

/// The flow's jet, brought from time to time by integrations that each go on from where the last
/// one came to. A copy goes on by itself. A rotation that the problem allows is left out all along
/// and put back in what is given out.
class JetPropagation {
 public:
  /// At time 0, with the identity. `problem` and `settings` must outlive it.
  JetPropagation(const ComputedProblem& problem, const IntegratorSettings& settings);

  /// The jet at a time, in the system's own unit. Throws as the integrator.
  FlowJet<double> advance_to(double time);

  double time() const { return reached_; }
  /// Summed over the integrations; their seconds are those of the integrations alone.
  const IntegrationStatistics& statistics() const { return total_; }

 private:
  const IntegratorSettings* settings_;
  std::shared_ptr<const SymmetryReduction<double>> reduction_;  ///< none: no symmetry is left out
  FlowProblem<double> flow_;
  double reached_ = 0;
  IntegrationStatistics total_;
};

/// The flow's jets at several times from one propagation. Times move away from 0. `visit` gets each
/// jet with the index of its time.
IntegrationStatistics visit_jets(
    const ComputedProblem& problem, const IntegratorSettings& settings,
    std::span<const double> times,
    const std::function<void(std::size_t index, const FlowJet<double>& jet)>& visit);

}  // namespace hamjet
