#include "hamjet/integrators/stormer_verlet.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "../dynamics/operation_count.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "splitting_integration.hpp"
#include "symmetry/symmetry_reduction.hpp"

namespace hamjet {
namespace {

/// The force at the positions themselves, which are the inputs of its evaluator.
template <class Real>
class ExplicitForce {
 public:
  explicit ExplicitForce(const FlowProblem<Real>& problem)
      : list_(problem.system->second_order->force),
        count_(problem.space->first(working_order(problem) + 1)),
        evaluator_(list_, problem.space, working_order(problem)) {}

  Real* x(std::size_t i) { return evaluator_.input(i); }
  const Real* q(std::size_t i) { return evaluator_.input(i); }
  const Real* f(std::size_t i) const { return evaluator_.output(i); }

  void set_time(const Real& time) { evaluator_.set_time(time); }

  bool start(const FlowJet<Real>& jet) {
    for (std::size_t i = 0; i < list_.variables(); ++i) {
      std::copy_n(jet[i].coefficients().data(), count_, evaluator_.input(i));
    }
    return evaluate();
  }

  bool evaluate() {
    evaluator_.evaluate_all();
    bool result = true;
    for (std::size_t i = 0; i < list_.variables(); ++i) result &= is_finite(f(i)[0]);
    return result;
  }

  const SeriesWork& work() const { return evaluator_.work(); }

  const char* failure() const {
    return "the force is not finite (a collision, or a point outside its domain)";
  }

 private:
  const OperationList& list_;
  std::size_t count_;
  SliceEvaluator<Real, Real> evaluator_;
};

/// The arc integrator of an explicit splitting.
template <class Real>
class SplittingArcs : public ArcIntegrator<Real> {
 public:
  SplittingArcs(const FlowProblem<Real>& problem, Splitting<Real> splitting)
      : problem_(problem),
        splitting_(std::move(splitting)),
        steps_(equal_step_count(problem.duration, splitting_.step, splitting_.method)) {}

  FlowJet<Real> run_nominal(IntegrationStatistics& statistics,
                            const StepObserver<Real>& observer) override {
    const FlowProblem<Real> nominal = nominal_problem(problem_);
    ExplicitForce<Real> force(nominal);
    return integration(nominal, force, statistics, observer)
        .run_nominal([&](long taken) { return checkpoints_.is_kept(taken); },
                     [&](auto checkpoint) { checkpoints_.add(std::move(checkpoint)); });
  }

  std::size_t checkpoints() const override { return checkpoints_.size(); }
  long step(std::size_t checkpoint) const override { return checkpoints_[checkpoint].taken; }
  const std::vector<Real>& state(std::size_t checkpoint) const override {
    return checkpoints_[checkpoint].state;
  }
  Real time(std::size_t checkpoint) const override { return checkpoints_[checkpoint].time; }

  FlowJet<Real> run_arc(std::size_t checkpoint, long last, const SpacePointer& space,
                        const std::vector<std::size_t>& variables, const FlowJet<Real>& start,
                        IntegrationStatistics& statistics,
                        const std::function<void()>& after_step) const override {
    const auto& from = checkpoints_[checkpoint];
    const FlowProblem<Real> arc = arc_problem(problem_, from.state, space, variables, start);
    ExplicitForce<Real> force(arc);
    const StepObserver<Real> none;
    return integration(arc, force, statistics, none).run_from(from, last, after_step);
  }

  StepCost cost(const SeriesSpace& space) const override {
    const OperationList& list = problem_.system->evaluated_list();
    const int order = working_order(*problem_.system, space.order());
    const double components = static_cast<double>(list.variables());
    const double stages = static_cast<double>(splitting_.drifts.size());
    const double values = static_cast<double>(list.operations().size());
    const double coefficients = static_cast<double>(space.first(order + 1));
    // Linear parts of all values; kicks and drifts, which are summed with compensation, count as
    // four each.
    const double linear = components * values + 8 * components;
    const double nominal = nominal_weight * stages * (values * (1 + components) + 8 * components);
    const double series =
        stages * (series_multiply_adds(list, space, order) + linear * coefficients);
    return {nominal, series, series + nominal};
  }

 private:
  /// Time of an operation on single numbers that depend on each other, relative to the time of one
  /// in a sequence of independent multiply-adds.
  static constexpr double nominal_weight = 4;

  SplittingIntegration<Real, ExplicitForce<Real>> integration(
      const FlowProblem<Real>& problem, ExplicitForce<Real>& force,
      IntegrationStatistics& statistics, const StepObserver<Real>& observer) const {
    return {problem, splitting_, force, steps_, statistics, observer};
  }

  FlowProblem<Real> problem_;
  Splitting<Real> splitting_;
  long steps_;
  CheckpointList<SplittingCheckpoint<Real>> checkpoints_;
};

}  // namespace

template <class Real>
Splitting<Real> splitting_of(const StormerSettings& settings) {
  return {"Störmer's rule", settings.step, {Real(1)}, {Real(1), Real(0)}};
}

template <class Real>
Splitting<Real> splitting_of(const VelocityVerletSettings& settings) {
  const Real half = Real(1) / 2;
  return {"velocity Verlet", settings.step, {Real(1)}, {half, half}};
}

template <class Real>
std::unique_ptr<ArcIntegrator<Real>> make_splitting_arcs(const FlowProblem<Real>& problem,
                                                         Splitting<Real> splitting) {
  validate_splitting(*problem.system, splitting.step, splitting.method);
  return std::make_unique<SplittingArcs<Real>>(problem, std::move(splitting));
}

template <class Real>
FlowJet<Real> integrate_splitting(const FlowProblem<Real>& problem, Splitting<Real> splitting,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
  validate_splitting(*problem.system, splitting.step, splitting.method);
  if (problem.duration == 0) return starting_jet(problem);
  const long steps = equal_step_count(problem.duration, splitting.step, splitting.method);
  const auto run = [&](const FlowProblem<Real>& integrated, const StepObserver<Real>& watch) {
    ExplicitForce<Real> force(integrated);
    return SplittingIntegration<Real, ExplicitForce<Real>>(integrated, std::move(splitting), force,
                                                           steps, statistics, watch)
        .run();
  };
  return integrate_without_symmetry<Real>(problem, statistics, observer, run);
}

template <class Real>
FlowJet<Real> integrate_stormer(const FlowProblem<Real>& problem, const StormerSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<Real>& observer) {
  return integrate_splitting(problem, splitting_of<Real>(settings), statistics, observer);
}

template <class Real>
FlowJet<Real> integrate_velocity_verlet(const FlowProblem<Real>& problem,
                                        const VelocityVerletSettings& settings,
                                        IntegrationStatistics& statistics,
                                        const StepObserver<Real>& observer) {
  return integrate_splitting(problem, splitting_of<Real>(settings), statistics, observer);
}

template Splitting<InstantiatedReal> splitting_of(const StormerSettings&);
template Splitting<InstantiatedReal> splitting_of(const VelocityVerletSettings&);
template std::unique_ptr<ArcIntegrator<InstantiatedReal>> make_splitting_arcs(
    const FlowProblem<InstantiatedReal>&, Splitting<InstantiatedReal>);
template FlowJet<InstantiatedReal> integrate_splitting(const FlowProblem<InstantiatedReal>&,
                                                       Splitting<InstantiatedReal>,
                                                       IntegrationStatistics&,
                                                       const StepObserver<InstantiatedReal>&);
template FlowJet<InstantiatedReal> integrate_stormer(const FlowProblem<InstantiatedReal>&,
                                                     const StormerSettings&, IntegrationStatistics&,
                                                     const StepObserver<InstantiatedReal>&);
template FlowJet<InstantiatedReal> integrate_velocity_verlet(const FlowProblem<InstantiatedReal>&,
                                                             const VelocityVerletSettings&,
                                                             IntegrationStatistics&,
                                                             const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
