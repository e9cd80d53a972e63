#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "../../dynamics/operation_count.hpp"
#include "../arc_integrator.hpp"
#include "gauss_integrator.hpp"

namespace hamjet {

/// A Gauss integration in arcs. If checkpoints of all steps are kept, an arc takes the steps and
/// the stages of the nominal from them. Otherwise it repeats Newton's iteration and the choice of
/// steps from its own checkpoint on, with the same result.
template <class Real, int Lanes>
class GaussArcs : public ArcIntegrator<Real> {
 public:
  GaussArcs(const FlowProblem<Real>& problem, const GaussSettings& settings)
      : problem_(problem), settings_(settings), arc_settings_(settings) {
    arc_settings_.estimates_step_error = false;
    arc_settings_.profile = nullptr;
  }

  FlowJet<Real> run_nominal(IntegrationStatistics& statistics,
                            const StepObserver<Real>& observer) override {
    const FlowProblem<Real> nominal = nominal_problem(problem_);
    GaussIntegrator<Real, Lanes> integrator(nominal, settings_, statistics,
                                            working_order(problem_));
    return integrator.run_nominal(
        observer, [&](long taken) { return checkpoints_.is_kept(taken); },
        [&](auto checkpoint) { checkpoints_.add(std::move(checkpoint)); });
  }

  std::size_t checkpoints() const override { return checkpoints_.size(); }
  long step(std::size_t checkpoint) const override { return checkpoints_[checkpoint].at.taken; }
  const std::vector<Real>& state(std::size_t checkpoint) const override {
    return checkpoints_[checkpoint].state;
  }
  Real time(std::size_t checkpoint) const override { return checkpoints_[checkpoint].at.time; }

  FlowJet<Real> run_arc(std::size_t checkpoint, long last, const SpacePointer& space,
                        const std::vector<std::size_t>& variables, const FlowJet<Real>& start,
                        IntegrationStatistics& statistics,
                        const std::function<void()>& after_step) const override {
    const auto& from = checkpoints_[checkpoint];
    const FlowProblem<Real> arc = arc_problem(problem_, from.state, space, variables, start);
    GaussIntegrator<Real, Lanes> integrator(arc, arc_settings_, statistics);
    const bool has_all = checkpoints_.has_all();
    const auto after = [&](long taken) {
      return has_all ? &checkpoints_[static_cast<std::size_t>(taken)] : nullptr;
    };
    return integrator.run_from(from, last, after,
                               [&](const Real&, const FlowJet<Real>&) { after_step(); });
  }

  StepCost cost(const SeriesSpace& space) const override {
    const OperationList& list = problem_.system->evaluated_list();
    const int order = working_order(*problem_.system, space.order());
    const double components = static_cast<double>(list.variables());
    const double stages = settings_.stages;
    const double dimension = static_cast<double>(problem_.system->dimension());
    const double values = static_cast<double>(list.operations().size());
    const double coefficients = static_cast<double>(space.first(order + 1));
    // Linear solves and linear parts of all values, per coefficient and stage.
    const double linear = components * (components * stages + dimension) + components * values;
    // Costs once per step, all on packs: the elimination of a matrix of `unknowns` rows with as
    // many and 2n right-hand sides; evaluations in Newton's iteration; its responses;
    // extrapolation.
    const double unknowns = components * stages;
    const double elimination =
        elimination_weight * unknowns * (1.5 * unknowns + dimension) * components;
    const double evaluation = nominal_weight * values * (1 + components);
    const double iteration = 3 * (evaluation + nominal_weight * components * unknowns) +
                             2 * nominal_weight * stages * stages;
    const double series =
        series_multiply_adds(list, space, order) + linear * coefficients + elimination;
    // A step between checkpoints must solve for its stages again.
    const double of_arc = checkpoints_.has_all() ? evaluation : iteration;
    return {Lanes * (elimination + iteration), Lanes * series, Lanes * (series + of_arc)};
  }

 private:
  /// Measured with 8 stages: the number of multiply-adds of products of series that take as long as
  /// one of the elimination, and as one of the other short dependent operations of the nominal.
  static constexpr double elimination_weight = 2.7;
  static constexpr double nominal_weight = 12;

  FlowProblem<Real> problem_;
  GaussSettings settings_;
  GaussSettings arc_settings_;
  CheckpointList<GaussCheckpoint<Real, Lanes>> checkpoints_;
};

}  // namespace hamjet
