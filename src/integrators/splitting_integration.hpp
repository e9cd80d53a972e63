#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "compensated_addition.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "integration_clock.hpp"
#include "real_number.hpp"
#include "step_sequence.hpp"

// The steps that all methods on the second-order form q' = M^-1 p, p' = F(q) share: kicks of the
// momenta and drifts of the positions in turn.

namespace hamjet {

/// A method as a sequence of shears, in fractions of the step h:
///
///   kick(kicks_0), drift(drifts_1), kick(kicks_1), ..., drift(drifts_s), kick(kicks_s);
///   kick(b): p += b h F(q),   drift(c): x += c h M^-1 p .
///
/// x is q itself, or the variable that determines it (see NewmarkForce).
template <class Real>
struct Splitting {
  const char* method = "";  ///< opens the messages of errors
  double step = 0;
  std::vector<Real> drifts;
  std::vector<Real> kicks;  ///< one more than drifts
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

/// Integrates with any explicit splitting.
template <class Real>
FlowJet<Real> integrate_splitting(const FlowProblem<Real>& problem, Splitting<Real> splitting,
                                  IntegrationStatistics& statistics,
                                  const StepObserver<Real>& observer);

/// One integration. Force holds the positions and evaluates the force on series:
///
///   x(i), q(i), f(i)  the coefficients of the i-th summed position, position and force;
///   start(jet)        takes the initial positions and evaluates there, false if not finite;
///   evaluate()        evaluates at the drifted x; false if there is no finite result;
///   work()            the products of series formed so far.
///
/// A kick at the end of a step and the one at the start of the next share their force and are one
/// addition: between steps the momenta are those after the first kick of the next step.
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
        count_(problem.space->first(working_order(problem) + 1)),
        jet_(starting_jet(problem)),
        momenta_(n_ * count_),
        lost_(2 * n_ * count_, Real(0)) {
    for (const Extended& entry : problem.system->second_order->inverse_mass) {
      inverse_mass_.push_back(convert<Real>(entry));
    }
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(jet_[n_ + i].coefficients().data(), count_, &momenta_[i * count_]);
    }
  }

  FlowJet<Real> run() {
    const Real h = problem_.duration / Real(steps_);
    const std::size_t stages = splitting_.drifts.size();
    const Real end_kick = h * splitting_.kicks[stages];
    const Real joined_kick = h * (splitting_.kicks[stages] + splitting_.kicks[0]);
    require(force_.start(jet_), h);
    ++statistics_.vector_field_evaluations;
    kick(h * splitting_.kicks[0]);
    for (long left = steps_ - 1; left >= 0; --left) {
      for (std::size_t s = 0; s < stages; ++s) {
        if (s > 0) {
          evaluate(h);
          kick(h * splitting_.kicks[s]);
        }
        drift(h * splitting_.drifts[s]);
      }
      // Störmer's rule ends with a drift: the force there is not needed.
      if (left > 0 || end_kick != 0) evaluate(h);
      ++statistics_.steps;
      ++taken_;
      time_ = left == 0 ? problem_.duration : Real(problem_.duration - h * Real(left));
      if (observer_) observe(end_kick);
      if (left > 0) kick(joined_kick);
    }
    write_jet(end_kick);
    statistics_.series_work = force_.work();
    require_finite(jet_, time_, splitting_.method);
    statistics_.wall_seconds = clock_.seconds();
    return std::move(jet_);
  }

 private:
  void evaluate(const Real& h) {
    ++statistics_.vector_field_evaluations;
    require(force_.evaluate(), h);
  }

  void require(bool is_good, const Real& h) const {
    if (is_good) return;
    throw Error(ErrorKind::numerical,
                fmt::format("{}: {} in step {} of {}, of size {:.6g} from t = {:.10g}",
                            splitting_.method, force_.failure(), taken_ + 1, steps_,
                            static_cast<double>(h), static_cast<double>(time_)));
  }

  /// value += factor series.
  void add(Real* value, Real* lost, const Real& factor, const Real* series) const {
    for (std::size_t k = 0; k < count_; ++k) {
      add_compensated(value[k], lost[k], Real(factor * series[k]));
    }
  }

  /// p += factor F(q).
  void kick(const Real& factor) {
    for (std::size_t i = 0; i < n_; ++i) {
      add(&momenta_[i * count_], lost(n_ + i), factor, force_.f(i));
    }
  }

  /// x += factor M^-1 p.
  void drift(const Real& factor) {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) {
        const Real& entry = inverse_mass_[i * n_ + j];
        if (entry != 0) add(force_.x(i), lost(i), Real(factor * entry), &momenta_[j * count_]);
      }
    }
  }

  Real* lost(std::size_t component) { return &lost_[component * count_]; }

  /// The state with the kick that is still due. Degrees above the working order stay zero.
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
      for (std::size_t k = 0; k < count_; ++k) target[k] = p[k] + (factor * f[k] - lost_part[k]);
    }
  }

  void observe(const Real& end_kick) {
    clock_.exclude([&] {
      write_jet(end_kick);
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
  std::size_t count_;  ///< coefficients of one component
  FlowJet<Real> jet_;
  std::vector<Real> momenta_;
  std::vector<Real> lost_;  ///< to rounding, so far; positions, then momenta
  std::vector<Real> inverse_mass_;
  Real time_ = 0;
  long taken_ = 0;
};

}  // namespace hamjet
