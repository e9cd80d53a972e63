#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "energy_conserving_attempt.hpp"
#include "energy_scale.hpp"

namespace hamjet {

/// The step equation of the energy-conserving Störmer form. With g = grad V(q_k), v = M^-1 p_k, b =
/// v . g = dV/dt, a = g^T M^-1 g and c = H(q_k, p_k) - E = V(q_k) - V(q_(k-1)),
///
///   H(q_k, p_k - h g) - E = a h^2 / 2 - b h + c = 0 .
///
/// A consistent step has h near c/b. The wanted root is therefore the smaller one, 2 c / (b +-
/// sqrt(d)) with the sign of b and d = b^2 - 2 a c.
template <class Real>
class EnergyConservingStormer {
 public:
  explicit EnergyConservingStormer(const DynamicalSystem& system)
      : n_(system.degrees_of_freedom), hamiltonian_(system.hamiltonian), inverse_mass_(n_ * n_) {
    for (std::size_t i = 0; i < n_ * n_; ++i) {
      inverse_mass_[i] = convert<Real>(system.second_order->inverse_mass[i]);
    }
    slope_.resize(n_);
  }

  const Real& energy() const { return energy_; }

  /// The first step, of given size; its discrete energy is conserved from then on.
  StepAttempt<Real> start(const std::vector<Real>& z, const Real& h) {
    if (!read(z)) {
      return refused<Real>(EnergyConservingStopCause::not_finite, not_finite_reason);
    }
    StepAttempt<Real> attempt = take(z, h);
    energy_ = hamiltonian_.value(0);
    return attempt;
  }

  /// The step that follows a step of size `last`.
  StepAttempt<Real> advance(const std::vector<Real>& z, const Real& last) {
    using Cause = EnergyConservingStopCause;
    using std::sqrt;
    if (!read(z)) return refused<Real>(Cause::not_finite, not_finite_reason);
    const Real scale = energy_scale(hamiltonian_, z);
    const Real c = hamiltonian_.value(0) - energy_;
    const Real discriminant = b_ * b_ - 2 * a_ * c;
    if (discriminant < 0) {
      return refused<Real>(
          Cause::no_root,
          fmt::format("the step equation has no real root: (p.M^-1 g)^2 = {:.6g} < 2 (g.M^-1 g) "
                      "(V(q_k) - V(q_(k-1))) = {:.6g}, g = grad V",
                      static_cast<double>(Real(b_ * b_)), static_cast<double>(Real(2 * a_ * c))));
    }
    if (a_ == 0) {
      return refused<Real>(
          Cause::undetermined_step,
          "the force vanishes, so that the energy does not depend on the step size");
    }
    const Real root = sqrt(discriminant);
    const Real denominator = b_ < 0 ? Real(b_ - root) : Real(b_ + root);
    const Real h = 2 * c / denominator;
    const std::string numbers = fmt::format(
        "V(q_k) - V(q_(k-1)) = {:.6g}, and the other root of the step equation, {:.6g}, belongs to "
        "no consistent step",
        static_cast<double>(c), static_cast<double>(Real(denominator / a_)));
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    // |dH/dh| = |a h - b| = sqrt(d) at a root.
    const Real floor = Real(largest_step_uncertainty) * root * magnitude(last);
    if (!is_finite(h) || !(epsilon * scale < floor)) {
      return refused<Real>(
          Cause::undetermined_step,
          fmt::format("round-off leaves the step size undetermined: H changes by {:.3g} over a "
                      "step of the last size, {:.6g}; {}",
                      static_cast<double>(Real(root * last)), static_cast<double>(last), numbers));
    }
    if (!(h / last > 0)) {
      return refused<Real>(
          Cause::reversed_root,
          fmt::format("the root that continues the last step size, {:.6g}, has turned to {:.6g}, "
                      "against the direction of time: {}",
                      static_cast<double>(last), static_cast<double>(h), numbers));
    }
    if (!(h / last <= Real(largest_step_change)) || !(last / h <= Real(largest_step_change))) {
      return refused<Real>(
          Cause::step_change,
          fmt::format("the root that continues the last step size, {:.6g}, has moved to {:.6g}, "
                      "more than by a factor of {}: {}",
                      static_cast<double>(last), static_cast<double>(h), largest_step_change,
                      numbers));
    }
    return polish(z, h, scale);
  }

 private:
  static constexpr int largest_iteration_count = 10;

  /// Evaluates g, a and b at z; returns false if one is not finite.
  bool read(const std::vector<Real>& z) {
    hamiltonian_.evaluate(z);
    a_ = b_ = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const Real& g = hamiltonian_.derivative(0, i);
      slope_[i] = g;
      b_ += g * hamiltonian_.derivative(0, n_ + i);
      for (std::size_t j = 0; j < n_; ++j) {
        a_ += g * inverse_mass_[i * n_ + j] * hamiltonian_.derivative(0, j);
      }
    }
    return is_finite(a_) && is_finite(b_) && hamiltonian_.is_finite();
  }

  /// Newton's method on the discrete energy itself, because the root of the quadratic is only as
  /// accurate as c.
  StepAttempt<Real> polish(const std::vector<Real>& z, Real h, const Real& scale) {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    StepAttempt<Real> attempt = take(z, h);
    Real residual = hamiltonian_.value(0) - energy_;
    while (magnitude(residual) > epsilon * scale / 4 &&
           attempt.iterations < largest_iteration_count) {
      const Real corrected = h - residual / energy_slope();
      StepAttempt<Real> next = take(z, corrected);
      next.iterations = attempt.iterations + 1;
      const Real remaining = hamiltonian_.value(0) - energy_;
      if (!(magnitude(remaining) < magnitude(residual))) {  // the residual is at the rounding floor
        attempt.iterations = next.iterations;
        break;
      }
      h = corrected;
      attempt = std::move(next);
      residual = remaining;
    }
    return attempt;
  }

  /// Takes the step of size h from z, for which g has been read; H is evaluated at (q_k, p_(k+1)).
  StepAttempt<Real> take(const std::vector<Real>& z, const Real& h) {
    StepAttempt<Real> attempt;
    attempt.is_taken = true;
    attempt.size = h;
    attempt.end = z;
    for (std::size_t i = 0; i < n_; ++i) attempt.end[n_ + i] -= h * slope_[i];
    hamiltonian_.evaluate(attempt.end);
    // dH/dp = M^-1 p_(k+1).
    for (std::size_t i = 0; i < n_; ++i) {
      attempt.end[i] += h * hamiltonian_.derivative(0, n_ + i);
    }
    return attempt;
  }

  /// The slope dH/dh = -g . dH/dp at (q_k, p_(k+1)), where H was last evaluated.
  Real energy_slope() const {
    Real sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum -= slope_[i] * hamiltonian_.derivative(0, n_ + i);
    return sum;
  }

  std::size_t n_;
  DifferentiableFunction<Real> hamiltonian_;
  std::vector<Real> inverse_mass_;
  std::vector<Real> slope_;  ///< g = grad V(q_k)
  Real a_ = 0;
  Real b_ = 0;
  Real energy_ = 0;
};

}  // namespace hamjet
