#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/flow_problem.hpp"

// Tools for methods that do not work on series: the flow's jet as one flat vector of real numbers,
// its time derivative, and a check of the nominal's energy.

namespace hamjet {

/// The coefficient equations z' = f(z), z = (q, p) a vector of series, for methods that advance one
/// flat vector of real numbers.
///
/// The state holds component after component; each has its coefficients of degree 0 to
/// working_order(problem), in the order of SeriesSpace. A linear system has no coefficients above
/// degree 1, so that none are integrated. Units are the system's own.
template <class Real>
class SeriesVectorField {
 public:
  /// `method` is the beginning of error messages. The problem must be valid and outlive this
  /// object.
  SeriesVectorField(const FlowProblem<Real>& problem, std::string method)
      : problem_(&problem),
        method_(std::move(method)),
        order_(working_order(problem)),
        coefficients_(problem.space->first(order_ + 1)),
        start_time_(problem.start_time.template in<Real>()),
        evaluator_(list(), problem.space, order_) {
    if (!problem.system->second_order) return;
    for (const Extended& entry : problem.system->second_order->inverse_mass) {
      inverse_mass_.push_back(convert<Real>(entry));
    }
  }

  std::size_t dimension() const noexcept { return problem_->system->dimension(); }
  /// Number of coefficients of one component.
  std::size_t coefficients() const noexcept { return coefficients_; }
  std::size_t size() const noexcept { return dimension() * coefficients_; }
  /// Number of evaluations of f so far.
  long evaluations() const noexcept { return evaluations_; }
  /// Products of series formed so far.
  const SeriesWork& work() const noexcept { return evaluator_.work(); }

  /// The state of the starting jet.
  std::vector<Real> initial_state() const {
    std::vector<Real> state(size());
    const FlowJet<Real> jet = starting_jet(*problem_);
    for (std::size_t c = 0; c < jet.size(); ++c) {
      std::copy_n(jet[c].coefficients().data(), coefficients_, state.data() + c * coefficients_);
    }
    return state;
  }

  /// Writes a state into a jet of the problem's space; degrees above the working order are
  /// unchanged.
  void copy_to(FlowJet<Real>& jet, const Real* state) const {
    for (std::size_t c = 0; c < jet.size(); ++c) {
      std::copy_n(state + c * coefficients_, coefficients_, jet[c].coefficients().data());
    }
  }

  /// derivative = f(state) at a time since the start, both of size() numbers. Throws
  /// Error(numerical), naming the time, if a number of the derivative is not finite.
  void evaluate(const Real* state, Real* derivative, const Real& time) {
    ++evaluations_;
    const std::size_t inputs = list().variables();
    if (evaluator_.has_time()) evaluator_.set_time(Real(start_time_ + time));
    for (std::size_t i = 0; i < inputs; ++i) {
      std::copy_n(state + i * coefficients_, coefficients_, evaluator_.input(i));
    }
    evaluator_.evaluate_all();
    Real* outputs = derivative;
    if (problem_->system->second_order) {
      multiply_inverse_mass(state + inputs * coefficients_, derivative);
      outputs += inputs * coefficients_;
    }
    for (std::size_t i = 0; i < list().outputs().size(); ++i) {
      std::copy_n(evaluator_.output(i), coefficients_, outputs + i * coefficients_);
    }
    if (!is_finite(derivative)) {
      throw Error(
          ErrorKind::numerical,
          fmt::format("{}: the vector field is not finite at t = {:.10g}: a collision, or a "
                      "point outside its domain",
                      method_, static_cast<double>(time)));
    }
  }

  /// Whether all numbers of a state (or derivative) are finite.
  bool is_finite(const Real* state) const {
    using std::isfinite;
    bool result = true;
    for (std::size_t k = 0; k < size(); ++k) result &= isfinite(state[k]);
    return result;
  }

 private:
  const OperationList& list() const { return problem_->system->evaluated_list(); }

  /// Forms q' = M^-1 p.
  void multiply_inverse_mass(const Real* p, Real* velocity) const {
    const std::size_t n = list().variables();
    std::fill_n(velocity, n * coefficients_, Real(0));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Real factor = inverse_mass_[i * n + j];
        if (factor == 0) continue;
        const Real* from = p + j * coefficients_;
        Real* to = velocity + i * coefficients_;
        for (std::size_t k = 0; k < coefficients_; ++k) to[k] += factor * from[k];
      }
    }
  }

  const FlowProblem<Real>* problem_;
  std::string method_;
  int order_;
  std::size_t coefficients_;
  Real start_time_;
  SliceEvaluator<Real, Real> evaluator_;
  std::vector<Real> inverse_mass_;
  long evaluations_ = 0;
};

/// Refuses a nominal whose energy shows that the nominal has left the solution. A method that
/// controls local errors alone can step over a collision and report success; the energy then jumps
/// by about its own size.
///
/// The change of H since the start may not exceed
///
///   min(1e-2 + 1e3 tolerance, 0.1) max(|H|, S/100, max(tolerance, 1e-10) S_now) ,
///
/// where S = sum |z_i dH/dz_i| at the start is the size of the terms of H, which serves as the
/// scale if these terms cancel, as on a parabola. S_now is the same sum for the present state,
/// which serves if all terms vanish at the start, as at an equilibrium. The test does not depend on
/// the units. A nominal that fails it is too wrong to be of use (1 % in energy is 1.5 % in the
/// period of an orbit), whether the cause is a collision, a tolerance too coarse for a close
/// passage, or a drift over very many periods. The converse does not hold: a conserved energy
/// proves nothing.
///
/// Of a system with time, the change that H makes by itself is taken off first: in a step from
/// (z_0, t_0) to (z_1, t_1) the mean of H(z, t_1) - H(z, t_0) at its two ends, by the trapezoidal
/// rule. The difference between the ends, which is the rule's own uncertainty, is allowed in
/// addition.
template <class Real>
class EnergyGuard {
 public:
  EnergyGuard(const FlowProblem<Real>& problem, double tolerance, std::string method)
      : method_(std::move(method)),
        evaluator_(problem.system->hamiltonian, problem.space, 0),
        dimension_(problem.system->dimension()),
        start_time_(problem.start_time.template in<Real>()),
        last_state_(problem.initial_state) {
    evaluator_.set_time(start_time_);
    start_ = energy(problem.initial_state.data(), 1);
    start_scale_ = std::max(std::abs(static_cast<double>(start_)), size_of_terms() / 100);
    least_share_ = std::max(tolerance, 1e-10);
    allowed_ = std::min(1e-2 + 1e3 * tolerance, 0.1);
  }

  /// Throws Error(numerical) if the energy of the constant terms, which are `stride` apart, is not
  /// finite or too far from the energy at the start.
  void check(const Real* state, std::size_t stride, const Real& time) {
    if (evaluator_.has_time()) take_change_by_time(state, stride, time);
    const double change =
        std::abs(static_cast<double>(Real(energy(state, stride) - start_ - by_time_)));
    const double scale = std::max(start_scale_, least_share_ * size_of_terms());
    if (change <= allowed_ * scale + uncertainty_) return;
    throw Error(
        ErrorKind::numerical,
        fmt::format("{}: the integration left the solution before t = {:.10g}: the energy "
                    "changed by {:.3g} from {:.6g}; a collision, or too coarse a tolerance "
                    "or step",
                    method_, static_cast<double>(time), change, static_cast<double>(start_)));
  }

 private:
  Real energy(const Real* state, std::size_t stride) {
    for (std::size_t i = 0; i < dimension_; ++i) *evaluator_.input(i) = state[i * stride];
    evaluator_.evaluate_constant_terms();
    return *evaluator_.output(0);
  }

  /// Adds the change that H has made by itself since the last check; the evaluator then has the
  /// present time.
  void take_change_by_time(const Real* state, std::size_t stride, const Real& time) {
    evaluator_.set_time(Real(start_time_ + last_time_));
    const Real old_before = energy(last_state_.data(), 1);
    const Real new_before = energy(state, stride);
    evaluator_.set_time(Real(start_time_ + time));
    const Real old_change = energy(last_state_.data(), 1) - old_before;
    const Real new_change = energy(state, stride) - new_before;
    by_time_ += (old_change + new_change) / 2;
    uncertainty_ += std::abs(static_cast<double>(Real(new_change - old_change)));
    for (std::size_t i = 0; i < dimension_; ++i) last_state_[i] = state[i * stride];
    last_time_ = time;
  }

  /// S for the state whose energy was last evaluated.
  double size_of_terms() {
    double size = 0;
    for (std::size_t i = 0; i < dimension_; ++i) {
      const double slope = static_cast<double>(evaluator_.output_gradient(0, i));
      size += std::abs(slope * static_cast<double>(*evaluator_.input(i)));
    }
    return size;
  }

  std::string method_;
  SliceEvaluator<Real, Real> evaluator_;
  std::size_t dimension_;
  Real start_time_;
  std::vector<Real> last_state_;
  Real last_time_ = 0;
  Real by_time_ = 0;        ///< change that H has made by itself since the start
  double uncertainty_ = 0;  ///< the uncertainty of that change
  Real start_ = 0;
  double start_scale_ = 0;
  double least_share_ = 0;  ///< least fraction of the terms of the present state
  double allowed_ = 0;      ///< allowed change, as a fraction of the scale
};

}  // namespace hamjet
