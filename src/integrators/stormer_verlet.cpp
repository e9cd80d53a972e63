#include "hamjet/integrators/stormer_verlet.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hamjet/dynamics/slice_evaluator.hpp"
#include "splitting_integration.hpp"

namespace hamjet {
namespace {

/// The force at the positions themselves, which live in the inputs of its evaluator.
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

  bool start(const FlowJet<Real>& jet) {
    for (std::size_t i = 0; i < list_.inputs(); ++i) {
      std::copy_n(jet[i].coefficients().data(), count_, evaluator_.input(i));
    }
    return evaluate();
  }

  bool evaluate() {
    evaluator_.evaluate_all();
    bool result = true;
    for (std::size_t i = 0; i < list_.inputs(); ++i) result &= is_finite(f(i)[0]);
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

}  // namespace

template <class Real>
FlowJet<Real> integrate_splitting(const FlowProblem<Real>& problem, Splitting<Real> splitting,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
  validate_splitting(*problem.system, splitting.step, splitting.method);
  if (problem.duration == 0) return starting_jet(problem);
  const long steps = equal_step_count(problem.duration, splitting.step, splitting.method);
  ExplicitForce<Real> force(problem);
  return SplittingIntegration<Real, ExplicitForce<Real>>(problem, std::move(splitting), force,
                                                         steps, statistics, observer)
      .run();
}

template <class Real>
FlowJet<Real> integrate_stormer(const FlowProblem<Real>& problem, const StormerSettings& settings,
                                IntegrationStatistics& statistics,
                                const StepObserver<Real>& observer) {
  return integrate_splitting<Real>(problem,
                                   {"Störmer's rule", settings.step, {Real(1)}, {Real(1), Real(0)}},
                                   statistics, observer);
}

template <class Real>
FlowJet<Real> integrate_velocity_verlet(const FlowProblem<Real>& problem,
                                        const VelocityVerletSettings& settings,
                                        IntegrationStatistics& statistics,
                                        const StepObserver<Real>& observer) {
  const Real half = Real(1) / 2;
  return integrate_splitting<Real>(
      problem, {"velocity Verlet", settings.step, {Real(1)}, {half, half}}, statistics, observer);
}

template FlowJet<double> integrate_splitting(const FlowProblem<double>&, Splitting<double>,
                                             IntegrationStatistics&, const StepObserver<double>&);
template FlowJet<Extended> integrate_splitting(const FlowProblem<Extended>&, Splitting<Extended>,
                                               IntegrationStatistics&,
                                               const StepObserver<Extended>&);
template FlowJet<double> integrate_stormer(const FlowProblem<double>&, const StormerSettings&,
                                           IntegrationStatistics&, const StepObserver<double>&);
template FlowJet<Extended> integrate_stormer(const FlowProblem<Extended>&, const StormerSettings&,
                                             IntegrationStatistics&, const StepObserver<Extended>&);
template FlowJet<double> integrate_velocity_verlet(const FlowProblem<double>&,
                                                   const VelocityVerletSettings&,
                                                   IntegrationStatistics&,
                                                   const StepObserver<double>&);
template FlowJet<Extended> integrate_velocity_verlet(const FlowProblem<Extended>&,
                                                     const VelocityVerletSettings&,
                                                     IntegrationStatistics&,
                                                     const StepObserver<Extended>&);

}  // namespace hamjet
