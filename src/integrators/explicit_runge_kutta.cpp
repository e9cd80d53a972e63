#include "hamjet/integrators/explicit_runge_kutta.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "integration_clock.hpp"
#include "series_vector_field.hpp"
#include "step_ends.hpp"
#include "step_sequence.hpp"

namespace hamjet {
namespace {

namespace odeint = boost::numeric::odeint;

constexpr const char* fehlberg_name = "Fehlberg 7(8)";

/// odeint's algebra on ranges, with a norm for every number type. odeint's own norm would look for
/// the type of the real numbers inside Extended.
struct CoefficientAlgebra : odeint::range_algebra {
  template <class State>
  static typename State::value_type norm_inf(const State& state) {
    using std::abs;
    typename State::value_type norm(0);
    for (const auto& x : state) norm = std::max(norm, typename State::value_type(abs(x)));
    return norm;
  }
};

/// odeint's error test, which keeps its last result: the largest error of a coefficient c relative
/// to tolerance (1 + |c| + h |dc/dt|).
template <class Stepper>
struct RecordingErrorChecker
    : odeint::default_error_checker<typename Stepper::value_type, CoefficientAlgebra,
                                    typename Stepper::operations_type> {
  using Value = typename Stepper::value_type;
  using Base =
      odeint::default_error_checker<Value, CoefficientAlgebra, typename Stepper::operations_type>;

  RecordingErrorChecker(const Value& tolerance, Value& result)
      : Base(tolerance, tolerance), last(&result) {}

  template <class State, class Derivative, class Estimates, class Time>
  Value error(CoefficientAlgebra& algebra, const State& state, const Derivative& derivative,
              Estimates& estimates, Time step) const {
    return *last = Base::error(algebra, state, derivative, estimates, step);
  }

  Value* last;
};

/// One integration with Fehlberg 7(8). The loop over the steps is written here, because odeint's
/// integrate functions return without moving if the step has the wrong sign, and accept steps to
/// NaN.
template <class Real>
class FehlbergIntegration {
 public:
  using State = std::vector<Real>;
  using Stepper = odeint::runge_kutta_fehlberg78<State, Real, State, Real, CoefficientAlgebra>;
  using ErrorChecker = RecordingErrorChecker<Stepper>;
  using ControlledStepper = odeint::controlled_runge_kutta<Stepper, ErrorChecker>;

  FehlbergIntegration(const FlowProblem<Real>& problem, const ExplicitRungeKuttaSettings& settings,
                      IntegrationStatistics& statistics, const StepObserver<Real>& observer)
      : problem_(problem),
        settings_(settings),
        statistics_(statistics),
        observer_(observer),
        field_(problem, fehlberg_name),
        guard_(problem, settings.tolerance.value_or(0), fehlberg_name),
        jet_(starting_jet(problem)),
        state_(field_.initial_state()),
        derivative_(state_.size()),
        trial_(state_.size()) {}

  FlowJet<Real> run() {
    field_.evaluate(state_.data(), derivative_.data(), time_);
    if (settings_.step) {
      run_fixed_steps();
    } else {
      run_controlled_steps();
    }
    field_.copy_to(jet_, state_.data());
    statistics_.vector_field_evaluations += field_.evaluations();
    statistics_.series_work = field_.work();
    statistics_.wall_seconds = clock_.seconds();
    return std::move(jet_);
  }

 private:
  auto system() {
    return [this](const State& state, State& derivative, const Real& time) {
      field_.evaluate(state.data(), derivative.data(), time);
    };
  }

  double span() const { return std::abs(static_cast<double>(problem_.duration)); }

  void run_fixed_steps() {
    const long steps = equal_step_count(problem_.duration, *settings_.step, fehlberg_name);
    const Real h = problem_.duration / Real(steps);
    Stepper stepper;
    for (long left = steps - 1; left >= 0; --left) {
      if (time_ + h == time_) fail_step_size(h);
      stepper.do_step(system(), state_, derivative_, time_, trial_, h);
      time_ = left == 0 ? problem_.duration : Real(problem_.duration - h * Real(left));
      if (!field_.is_finite(trial_.data())) fail_not_finite();
      accept();
    }
  }

  void run_controlled_steps() {
    const Real tolerance(*settings_.tolerance);
    Real error = 0;
    ControlledStepper stepper(ErrorChecker(tolerance, error));
    const StepEnds<Real> ends(problem_);
    Real proposed = first_step();
    while (time_ != problem_.duration) {
      const Real& end = ends.after(time_);
      const Real remaining = end - time_;
      const Real wanted = proposed;
      Real h = fit_to_span(wanted, remaining);
      bool is_cut = end != problem_.duration && h != wanted;
      while (true) {
        if (is_lost_in_rounding(h, remaining)) fail_step_size(h);
        if (attempt(stepper, h, proposed)) break;
        ++statistics_.rejected_steps;
        h = proposed;
        is_cut = false;
      }
      if (is_cut) proposed = proposal_after_cut(proposed, wanted);
      statistics_.record_step_error(static_cast<double>(Real(error * tolerance)));
      time_ = h == remaining ? end : Real(time_ + h);
      accept();
      limit_step_count(fehlberg_name, statistics_.steps, static_cast<double>(time_), span());
    }
  }

  /// Whether the rounding of the time is more than 1e-4 of a step, so that what depends on the time
  /// would not be that of the step. Beyond a collision steps can stay so short for millions.
  bool is_lost_in_rounding(const Real& h, const Real& remaining) const {
    using std::abs;
    if (h == remaining) return time_ + h == time_;
    return !(abs(h) > 1e4 * std::numeric_limits<Real>::epsilon() * abs(time_));
  }

  /// Takes one step of size h into `trial_`. Returns whether the step is accepted, and sets
  /// `proposed` to the next size.
  bool attempt(ControlledStepper& stepper, const Real& h, Real& proposed) {
    Real time = time_;
    proposed = h;
    try {
      const auto result = stepper.try_step(system(), state_, derivative_, time, trial_, proposed);
      if (result == odeint::fail) return false;
      if (field_.is_finite(trial_.data())) return true;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
    }
    // A stage met a singularity, so that odeint's error estimate, if there is one, is meaningless.
    proposed = h / 4;
    return false;
  }

  void accept() {
    std::swap(state_, trial_);
    ++statistics_.steps;
    guard_.check(state_.data(), field_.coefficients(), time_);
    if (time_ != problem_.duration) {
      field_.evaluate(state_.data(), derivative_.data(), time_);
    }
    if (!observer_) return;
    clock_.exclude([&] {
      field_.copy_to(jet_, state_.data());
      observer_(time_, jet_);
    });
  }

  /// The size of the first step: a hundredth of the time in which the nominal moves by its own
  /// size. The step control corrects it.
  Real first_step() const {
    double size = 0;
    double slope = 0;
    for (std::size_t c = 0; c < field_.dimension(); ++c) {
      const std::size_t k = c * field_.coefficients();
      size = std::max(size, std::abs(static_cast<double>(state_[k])));
      slope = std::max(slope, std::abs(static_cast<double>(derivative_[k])));
    }
    double h = span();
    if (slope > 0) h = std::min(h, 0.01 * (size > 0 ? size : 1) / slope);
    return problem_.duration < 0 ? Real(-h) : Real(h);
  }

  [[noreturn]] void fail_step_size(const Real& h) const {
    throw Error(
        ErrorKind::numerical,
        fmt::format("Fehlberg 7(8): the step size fell to {:.3g} at t = {:.15g}: a collision "
                    "or another singularity lies ahead",
                    static_cast<double>(h), static_cast<double>(time_)));
  }

  [[noreturn]] void fail_not_finite() const {
    throw Error(ErrorKind::numerical,
                fmt::format("Fehlberg 7(8): a coefficient is not finite at t = {:.10g}",
                            static_cast<double>(time_)));
  }

  const FlowProblem<Real>& problem_;
  const ExplicitRungeKuttaSettings& settings_;
  IntegrationStatistics& statistics_;
  const StepObserver<Real>& observer_;
  IntegrationClock clock_;
  SeriesVectorField<Real> field_;
  EnergyGuard<Real> guard_;
  FlowJet<Real> jet_;
  State state_;
  State derivative_;  ///< derivative at the start of the step
  State trial_;
  Real time_ = 0;
};

template <class Real>
void validate_settings(const ExplicitRungeKuttaSettings& settings) {
  if (settings.step.has_value() == settings.tolerance.has_value()) {
    throw Error(ErrorKind::usage, "Fehlberg 7(8): exactly one of step and tolerance must be given");
  }
  if (!(settings.step.value_or(1) > 0)) {
    throw Error(ErrorKind::usage, "Fehlberg 7(8): the step must be positive");
  }
  const double smallest = static_cast<double>(std::numeric_limits<Real>::epsilon());
  const double tolerance = settings.tolerance.value_or(0.5);
  if (!(tolerance >= smallest) || !(tolerance < 1)) {
    throw Error(ErrorKind::usage,
                fmt::format("Fehlberg 7(8): the tolerance must be between {:.2g}, the rounding of "
                            "its numbers, and 1",
                            smallest));
  }
}

}  // namespace

template <class Real>
FlowJet<Real> integrate_fehlberg78(const FlowProblem<Real>& problem,
                                   const ExplicitRungeKuttaSettings& settings,
                                   IntegrationStatistics& statistics,
                                   const StepObserver<Real>& observer) {
  validate(problem);
  statistics = {};
  validate_settings<Real>(settings);
  if (problem.duration == 0) return starting_jet(problem);
  return FehlbergIntegration<Real>(problem, settings, statistics, observer).run();
}

template FlowJet<InstantiatedReal> integrate_fehlberg78(const FlowProblem<InstantiatedReal>&,
                                                        const ExplicitRungeKuttaSettings&,
                                                        IntegrationStatistics&,
                                                        const StepObserver<InstantiatedReal>&);

}  // namespace hamjet
