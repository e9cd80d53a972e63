#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "arc_integrator.hpp"
#include "compensated_addition.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "integration_clock.hpp"
#include "real_number.hpp"
#include "step_sequence.hpp"

// The steps that all methods for the second-order form q' = M^-1 p, p' = F(q) share: alternating
// kicks of the momenta and drifts of the positions.

namespace hamjet {

/// A method as a sequence of shears, in fractions of the step h:
///
///   kick(kicks_0), drift(drifts_1), kick(kicks_1), ..., drift(drifts_s), kick(kicks_s);
///   kick(b): p += b h F(q, t),   drift(c): x += c h M^-1 p,  t += c h .
///
/// x is q itself, or the variable that determines it (see NewmarkForce).
template <class Real>
struct Splitting {
  const char* method = "";  ///< the beginning of error messages
  double step = 0;
  std::vector<Real> drifts;
  std::vector<Real> kicks;  ///< there is one more kick than drifts
};

/// Throws Error(usage) for a step that is not positive or a system without second-order form.
inline void validate_splitting(const DynamicalSystem& system, double step, const char* method) {
  if (!(step > 0) || !std::isfinite(step)) {
    throw Error(ErrorKind::usage, fmt::format("{}: the step must be positive", method));
  }
  if (!system.second_order) {
    throw Error(ErrorKind::usage,
                fmt::format("{}: the system {} has no second-order form, which is needed: "
                            "q' = M^-1 p with a constant mass matrix M and p' = F(q); the Gauss "
                            "methods take any system",
                            method, system.name));
  }
}

/// The nominal of an explicit splitting between two steps, without the kicks that join the steps.
template <class Real>
struct SplittingCheckpoint {
  std::vector<Real> state;           ///< state with the kick that ends the step
  std::vector<Real> summed_momenta;  ///< momenta without the kick that ends the step
  std::vector<Real> lost;            ///< rounding lost; positions, then momenta
  long taken = 0;                    ///< number of steps taken
  Real time = 0;
};

/// The splitting that a method's settings describe.
template <class Real>
Splitting<Real> splitting_of(const StormerSettings& settings);
template <class Real>
Splitting<Real> splitting_of(const VelocityVerletSettings& settings);
template <class Real>
Splitting<Real> splitting_of(const SymmetricCompositionSettings& settings);

/// The arc integrator of any explicit splitting. Throws what integrate_splitting throws for its
/// arguments.
template <class Real>
std::unique_ptr<ArcIntegrator<Real>> make_splitting_arcs(const FlowProblem<Real>& problem,
                                                         Splitting<Real> splitting);

/// Integrates the flow's jet with any explicit splitting.
template <class Real>
FlowJet<Real> integrate_splitting(const FlowProblem<Real>& problem, Splitting<Real> splitting,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer);

/// One integration. Force holds the positions and evaluates the force on series:
///
///   x(i), q(i), f(i)  the coefficients of the i-th summed position, position and force;
///   set_time(t)       sets the time of the system's clock for the evaluations that follow;
///   start(jet)        takes the initial positions and evaluates there, false if not finite;
///   evaluate()        evaluates at the drifted x; false if there is no finite result;
///   work()            the products of series formed so far.
///
/// The kick at the end of a step and that at the start of the next step use the same force and are
/// done as one addition. Between steps the momenta are therefore those after the first kick of the
/// next step.
template <class Real, class Force>
class SplittingIntegration {
 public:
  SplittingIntegration(const FlowProblem<Real>& problem, Splitting<Real> splitting, Force& force,
                       long steps, IntegrationStatistics& statistics,
                       const StepObserver<Real>& observer)
      : problem_(problem),
        splitting_(std::move(splitting)),
        force_(force),
        steps_(steps),
        statistics_(statistics),
        observer_(observer),
        n_(problem.system->degrees_of_freedom),
        start_time_(problem.start_time.template in<Real>()),
        count_(problem.space->first(working_order(problem) + 1)),
        jet_(starting_jet(problem)),
        momenta_(n_ * count_),
        lost_(2 * n_ * count_, Real(0)),
        products_(count_) {
    for (const Extended& entry : problem.system->second_order->inverse_mass) {
      inverse_mass_.push_back(convert<Real>(entry));
    }
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(jet_[n_ + i].coefficients().data(), count_, &momenta_[i * count_]);
    }
  }

  FlowJet<Real> run() {
    set_kicks();
    start();
    take_steps(steps_, [] {});
    return finish();
  }

  /// Runs like `run`. At the start and after every step but the last for which `is_kept(taken)`
  /// holds, it calls `keep` with the checkpoint of the nominal.
  template <class IsKept, class Keep>
  FlowJet<Real> run_nominal(const IsKept& is_kept, const Keep& keep) {
    set_kicks();
    if (is_kept(0)) keep(checkpoint());
    start();
    take_steps(steps_, [&] {
      if (taken_ < steps_ && is_kept(taken_)) keep(checkpoint());
    });
    return finish();
  }

  /// Repeats the steps of an earlier run of the same nominal, from a checkpoint to step number
  /// `last`. The problem's starting jet must be about the checkpoint's state.
  template <class AfterStep>
  FlowJet<Real> run_from(const SplittingCheckpoint<Real>& checkpoint, long last,
                         const AfterStep& after_step) {
    set_kicks();
    taken_ = checkpoint.taken;
    time_ = checkpoint.time;
    start();
    if (taken_ > 0) {
      // The last kick of a step and the first of the next are joined. The nominal takes this kick
      // as it did in the earlier run.
      for (std::size_t i = 0; i < n_; ++i) {
        *lost(i) = checkpoint.lost[i];
        *lost(n_ + i) = checkpoint.lost[n_ + i];
        momenta_[i * count_] = checkpoint.summed_momenta[i];
        add(&momenta_[i * count_], lost(n_ + i), joined_kick_, force_.f(i), 1);
      }
    }
    take_steps(last, after_step);
    return finish();
  }

 private:
  void set_kicks() {
    const std::size_t stages = splitting_.drifts.size();
    step_ = problem_.duration / Real(steps_);
    end_kick_ = step_ * splitting_.kicks[stages];
    joined_kick_ = step_ * (splitting_.kicks[stages] + splitting_.kicks[0]);
  }

  /// Evaluates the force at the start and takes the first kick.
  void start() {
    force_.set_time(Real(start_time_ + time_));
    require(force_.start(jet_));
    ++statistics_.vector_field_evaluations;
    kick(step_ * splitting_.kicks[0]);
  }

  /// Takes steps until `last` are done.
  template <class AfterStep>
  void take_steps(long last, const AfterStep& after_step) {
    const std::size_t stages = splitting_.drifts.size();
    while (taken_ < last) {
      const Real end = time_after(taken_ + 1);
      Real drifted = 0;
      for (std::size_t s = 0; s < stages; ++s) {
        if (s > 0) {
          evaluate(Real(time_ + step_ * drifted));
          kick(step_ * splitting_.kicks[s]);
        }
        drift(step_ * splitting_.drifts[s]);
        drifted += splitting_.drifts[s];
      }
      // Störmer's rule ends with a drift, so that the force at the end is not needed.
      if (taken_ + 1 < last || end_kick_ != 0) evaluate(end);
      ++statistics_.steps;
      ++taken_;
      time_ = end;
      if (observer_) observe();
      after_step();
      if (taken_ < last) kick(joined_kick_);
    }
  }

  FlowJet<Real> finish() {
    write_jet(end_kick_);
    statistics_.series_work = force_.work();
    require_finite(jet_, time_, splitting_.method);
    statistics_.wall_seconds = clock_.seconds();
    return std::move(jet_);
  }

  SplittingCheckpoint<Real> checkpoint() {
    SplittingCheckpoint<Real> result;
    result.taken = taken_;
    result.time = time_;
    if (taken_ > 0) write_jet(end_kick_);
    for (const Series<Real>& component : jet_) result.state.push_back(component[0]);
    for (std::size_t i = 0; i < n_; ++i) result.summed_momenta.push_back(momenta_[i * count_]);
    for (std::size_t c = 0; c < 2 * n_; ++c) result.lost.push_back(*lost(c));
    return result;
  }

  /// The time since the start after a number of steps.
  Real time_after(long taken) const {
    return taken == steps_ ? problem_.duration
                           : Real(problem_.duration - step_ * Real(steps_ - taken));
  }

  /// Evaluates the force at a time since the start.
  void evaluate(const Real& time) {
    ++statistics_.vector_field_evaluations;
    force_.set_time(Real(start_time_ + time));
    require(force_.evaluate());
  }

  void require(bool is_good) const {
    if (is_good) return;
    throw Error(ErrorKind::numerical,
                fmt::format("{}: {} in step {} of {}, of size {:.6g} from t = {:.10g}",
                            splitting_.method, force_.failure(), taken_ + 1, steps_,
                            static_cast<double>(step_), static_cast<double>(time_)));
  }

  /// value += factor series, for `count` numbers. The products are rounded before they are added. A
  /// compiler that fuses both operations would do so in vectors but not in the remaining numbers,
  /// so that a nominal alone would have other last bits than with its jet.
  void add(Real* value, Real* lost, const Real& factor, const Real* series, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) products_[k] = factor * series[k];
    for (std::size_t k = 0; k < count; ++k) add_compensated(value[k], lost[k], products_[k]);
  }

  /// Kicks the momenta: p += factor F(q).
  void kick(const Real& factor) {
    for (std::size_t i = 0; i < n_; ++i) {
      add(&momenta_[i * count_], lost(n_ + i), factor, force_.f(i), count_);
    }
  }

  /// Lets the positions drift: x += factor M^-1 p.
  void drift(const Real& factor) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        const Real& entry = inverse_mass_[i * n_ + j];
        if (entry != 0)
          add(force_.x(i), lost(i), Real(factor * entry), &momenta_[j * count_], count_);
      }
    }
  }

  Real* lost(std::size_t component) { return &lost_[component * count_]; }

  /// Writes the state, including the kick that is still due. Degrees above the working order stay
  /// zero.
  void write_jet(const Real& factor) {
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(force_.q(i), count_, jet_[i].coefficients().data());
      const Real* p = &momenta_[i * count_];
      Real* target = jet_[n_ + i].coefficients().data();
      if (factor == 0) {
        std::copy_n(p, count_, target);
        continue;
      }
      const Real* f = force_.f(i);
      const Real* lost_part = lost(n_ + i);
      for (std::size_t k = 0; k < count_; ++k) products_[k] = factor * f[k];
      for (std::size_t k = 0; k < count_; ++k) target[k] = p[k] + (products_[k] - lost_part[k]);
    }
  }

  void observe() {
    clock_.exclude([&] {
      write_jet(end_kick_);
      observer_(time_, jet_);
    });
  }

  IntegrationClock clock_;
  const FlowProblem<Real>& problem_;
  Splitting<Real> splitting_;
  Force& force_;
  long steps_;
  IntegrationStatistics& statistics_;
  const StepObserver<Real>& observer_;
  std::size_t n_;
  Real start_time_;
  std::size_t count_;  ///< number of coefficients of one component
  FlowJet<Real> jet_;
  std::vector<Real> momenta_;
  std::vector<Real> lost_;      ///< rounding lost so far; positions, then momenta
  std::vector<Real> products_;  ///< work space for one component
  std::vector<Real> inverse_mass_;
  Real step_ = 0;
  Real end_kick_ = 0;
  Real joined_kick_ = 0;  ///< sum of the kicks at the end of a step and at the start of the next
  Real time_ = 0;
  long taken_ = 0;
};

}  // namespace hamjet
