#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "hamjet/integrators/arc_splitting.hpp"

namespace hamjet {

/// Multiply-adds of one step.
struct StepCost {
  double nominal = 0;  ///< cost of the nominal alone, weighed by its time relative to products
  double series = 0;   ///< cost of the degrees above 0
  double arc = 0;      ///< cost of a step of an arc, which takes the nominal from a checkpoint
};

/// One method, for integrate_in_arcs. After run_nominal, the other functions may be called from
/// several threads at once.
template <class Real>
class ArcIntegrator {
 public:
  ArcIntegrator() = default;
  ArcIntegrator(const ArcIntegrator&) = delete;
  ArcIntegrator& operator=(const ArcIntegrator&) = delete;
  virtual ~ArcIntegrator() = default;

  /// Integrates the nominal to its end, as jets of order 0, and keeps checkpoints.
  virtual FlowJet<Real> run_nominal(IntegrationStatistics& statistics,
                                    const StepObserver<Real>& observer) = 0;
  virtual std::size_t checkpoints() const = 0;
  /// The number of steps taken before a checkpoint.
  virtual long step(std::size_t checkpoint) const = 0;
  /// The nominal at a checkpoint.
  virtual const std::vector<Real>& state(std::size_t checkpoint) const = 0;
  /// The time of a checkpoint since the start.
  virtual Real time(std::size_t checkpoint) const = 0;
  /// Takes the steps from a checkpoint to step number `last` of the whole integration, with a jet
  /// about the checkpoint's state.
  virtual FlowJet<Real> run_arc(std::size_t checkpoint, long last, const SpacePointer& space,
                                const std::vector<std::size_t>& variables,
                                const FlowJet<Real>& start, IntegrationStatistics& statistics,
                                const std::function<void()>& after_step) const = 0;
  virtual StepCost cost(const SeriesSpace& space) const = 0;
};

/// Checkpoints at equal numbers of steps: at first after every step, later after every second and
/// so on, so that there are never more than a few thousand.
template <class Checkpoint>
class CheckpointList {
 public:
  bool is_kept(long taken) const { return taken % stride_ == 0; }
  void add(Checkpoint checkpoint) {
    list_.push_back(std::move(checkpoint));
    if (list_.size() < largest_count) return;
    for (std::size_t i = 0; 2 * i < list_.size(); ++i) {
      if (i > 0) list_[i] = std::move(list_[2 * i]);
    }
    list_.resize((list_.size() + 1) / 2);
    stride_ *= 2;
  }
  std::size_t size() const { return list_.size(); }
  /// Whether there is a checkpoint after every step.
  bool has_all() const { return stride_ == 1; }
  const Checkpoint& operator[](std::size_t i) const { return list_[i]; }

 private:
  static constexpr std::size_t largest_count = 4096;

  std::vector<Checkpoint> list_;
  long stride_ = 1;
};

/// The problem of the nominal alone, without deviations.
template <class Real>
FlowProblem<Real> nominal_problem(const FlowProblem<Real>& problem) {
  FlowProblem<Real> result = problem;
  result.space = SeriesSpace::create(problem.space->variables(), 0);
  result.initial_jet.reset();
  return result;
}

/// The problem of an arc that starts from a checkpoint's state. Its steps go on counting their time
/// from the start of the whole, so that its start time is that of the whole.
template <class Real>
FlowProblem<Real> arc_problem(const FlowProblem<Real>& whole, const std::vector<Real>& state,
                              const SpacePointer& space, const std::vector<std::size_t>& variables,
                              const FlowJet<Real>& start) {
  return {whole.system, space, variables, state, whole.start_time, whole.duration, start};
}

}  // namespace hamjet
