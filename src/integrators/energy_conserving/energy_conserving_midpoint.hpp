#pragma once

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "energy_conserving_attempt.hpp"
#include "energy_scale.hpp"

namespace hamjet {

/// The step equations of the energy-conserving midpoint form, for the half step u = z_m - z_k and
/// the step size h, with f = J grad H:
///
///   u - (h/2) f(z_k + u) = 0,   H(z_k + u) - E = 0 .
///
/// The first alone defines the curve u(h), along which with A = I - (h/2) Df(z_m)
///
///   u' = A^-1 f/2,   dH/dh = grad H . u' = -h G/4 + O(h^2) ,
///
/// so that Newton's method in (u, h) needs one factorisation of A an iteration.
template <class Real>
class EnergyConservingMidpoint {
 public:
  explicit EnergyConservingMidpoint(const DynamicalSystem& system)
      : size_(static_cast<Eigen::Index>(system.dimension())),
        hamiltonian_(system.hamiltonian),
        field_(system.vector_field),
        matrix_(size_, size_),
        factors_(size_),
        residual_(size_),
        half_field_(size_),
        mean_(system.dimension()) {}

  const Real& energy() const { return energy_; }

  /// The first step, of given size; its discrete energy is conserved from then on.
  StepAttempt<Real> start(const std::vector<Real>& z, const Real& h) {
    Trial trial = explicit_trial(z, h);
    if (!is_finite(trial.half.sum())) {
      return refused<Real>(EnergyConservingStopCause::not_finite, not_finite_reason);
    }
    const Vector explicit_half = trial.half;
    // A solution far from the explicit step does not belong to the curve that starts at h = 0.
    if (!solve(z, trial, false) ||
        !((trial.half - explicit_half).norm() <= explicit_half.norm() / 2)) {
      return refused<Real>(
          EnergyConservingStopCause::no_midpoint,
          fmt::format("the midpoint equation has no solution near the start for the first step of "
                      "{:.6g}; a smaller one may have",
                      static_cast<double>(h)));
    }
    energy_ = hamiltonian_.value(0);
    slope_sign_ = trial.slope < 0 ? -1 : 1;
    return taken(z, trial);
  }

  /// The step that follows a step of size `last`.
  StepAttempt<Real> advance(const std::vector<Real>& z, const Real& last) {
    Trial trial = explicit_trial(z, last);
    if (!is_finite(trial.half.sum())) {
      return refused<Real>(EnergyConservingStopCause::not_finite, not_finite_reason);
    }
    if (trial.half.norm() == 0) return undetermined(trial);  // the state is an equilibrium
    const bool is_solved = solve(z, trial, true);
    if (is_solved && !is_determined(trial)) return undetermined(trial);
    if (!is_solved || !continues(trial, last)) {
      const std::optional<Trial> found = search(z, last);
      if (!found) return refused<Real>(EnergyConservingStopCause::no_root, absence(last));
      trial = *found;
    }
    return taken(z, trial);
  }

 private:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  static constexpr int largest_iteration_count = 30;
  static constexpr int search_intervals = 64;  ///< number on either side of the last step size
  static constexpr int bisections = 60;

  /// A half step and its size.
  struct Trial {
    Vector half;
    Real size = 0;
    Real slope = 0;   ///< dH/dh along the curve
    Real excess = 0;  ///< H(z_m) - E
    int iterations = 0;
  };

  Trial explicit_trial(const std::vector<Real>& z, const Real& h) {
    Trial trial;
    field_.evaluate(z);
    trial.half.resize(size_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      trial.half(i) = h / 2 * field_.value(static_cast<std::size_t>(i));
    }
    trial.size = h;
    return trial;
  }

  StepAttempt<Real> taken(const std::vector<Real>& z, const Trial& trial) const {
    StepAttempt<Real> attempt;
    attempt.is_taken = true;
    attempt.size = trial.size;
    attempt.end = z;
    for (std::size_t i = 0; i < z.size(); ++i) {
      attempt.end[i] += 2 * trial.half(static_cast<Eigen::Index>(i));
    }
    attempt.iterations = trial.iterations;
    return attempt;
  }

  /// Whether h is known: round-off in H changes h by itself divided by dH/dh.
  bool is_determined(const Trial& trial) const {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    const Real change = magnitude(Real(trial.slope * trial.size));
    return epsilon * scale_ < Real(largest_step_uncertainty) * change;
  }

  StepAttempt<Real> undetermined(const Trial& trial) const {
    return refused<Real>(
        EnergyConservingStopCause::undetermined_step,
        fmt::format("round-off leaves the step size undetermined: H changes by {:.3g} over a step "
                    "of {:.6g}; a larger first step would do",
                    static_cast<double>(Real(trial.slope * trial.size)),
                    static_cast<double>(trial.size)));
  }

  /// Whether a root continues the last step size.
  bool continues(const Trial& trial, const Real& last) const {
    const Real ratio = trial.size / last;
    return ratio > 0 && ratio <= Real(largest_step_change) &&
           Real(1) / ratio <= Real(largest_step_change) && trial.slope * slope_sign_ > 0;
  }

  /// Newton's method, for the half step alone if the size is given. It ends when the residuals of
  /// both equations are round-off and no longer shrink.
  bool solve(const std::vector<Real>& z, Trial& trial, bool is_size_free) {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    const Real given = trial.size;
    std::optional<Trial> best;
    Real least = 0;
    for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
      if (!linearise(z, trial)) return false;
      Real defect = magnitude(trial.excess) / scale_;
      if (!is_size_free) defect = 0;
      Real largest = 0;
      for (const Real& x : mean_) largest = std::max(largest, magnitude(x));
      for (const Real& r : residual_) defect = std::max(defect, Real(magnitude(r) / largest));
      const bool is_at_floor = best && least <= 64 * epsilon && !(defect < least / 2);
      if (!best || defect < least) {
        least = defect;
        best = trial;
      }
      if (least <= epsilon / 4 || is_at_floor) {
        best->iterations = iteration;
        trial = *best;
        return true;
      }
      const Vector correction = factors_.solve(residual_);
      if (is_size_free) {
        const Real change = (gradient_product(correction) - trial.excess) / trial.slope;
        trial.size += change;
        trial.half += tangent_ * change;
        // Far from the last size Newton's method converges to another root.
        if (!(trial.size / given > 0) || trial.size / given > 4) return false;
      }
      trial.half -= correction;
    }
    return false;
  }

  /// The residuals, A and the tangent u' at a trial. Returns false if they are not finite or A is
  /// singular.
  bool linearise(const std::vector<Real>& z, Trial& trial) {
    for (std::size_t i = 0; i < z.size(); ++i) {
      mean_[i] = z[i] + trial.half(static_cast<Eigen::Index>(i));
    }
    hamiltonian_.evaluate(mean_);
    field_.evaluate(mean_);
    if (!hamiltonian_.is_finite() || !field_.is_finite()) return false;
    const Real half_step = trial.size / 2;
    for (Eigen::Index i = 0; i < size_; ++i) {
      const auto row = static_cast<std::size_t>(i);
      half_field_(i) = field_.value(row) / 2;
      residual_(i) = trial.half(i) - half_step * field_.value(row);
      for (Eigen::Index j = 0; j < size_; ++j) {
        matrix_(i, j) =
            Real(i == j ? 1 : 0) - half_step * field_.derivative(row, static_cast<std::size_t>(j));
      }
    }
    factors_.compute(matrix_);
    // The curve u(h) starts with A = I and turns back where A is singular.
    if (!(factors_.determinant() > 0)) return false;
    tangent_ = factors_.solve(half_field_);
    trial.slope = gradient_product(tangent_);
    trial.excess = hamiltonian_.value(0) - energy_;
    scale_ = energy_scale(hamiltonian_, mean_);
    return is_finite(trial.slope);
  }

  /// The product grad H . x at the trial.
  Real gradient_product(const Vector& x) const {
    Real sum = 0;
    for (Eigen::Index i = 0; i < size_; ++i) {
      sum += hamiltonian_.derivative(0, static_cast<std::size_t>(i)) * x(i);
    }
    return sum;
  }

  /// Searches all step sizes within a factor of largest_step_change, in both directions at once,
  /// for the wanted root nearest to the last step size.
  std::optional<Trial> search(const std::vector<Real>& z, const Real& last) {
    using std::pow;
    Trial middle = explicit_trial(z, last);
    closest_.reset();
    if (!solve(z, middle, false)) return std::nullopt;
    closest_ = middle.excess;
    std::optional<Trial> larger = middle;
    std::optional<Trial> smaller = middle;
    for (int k = 1; k <= search_intervals; ++k) {
      const Real factor = pow(Real(largest_step_change), Real(Real(k) / Real(search_intervals)));
      for (const bool is_larger : {true, false}) {
        std::optional<Trial>& before = is_larger ? larger : smaller;
        if (!before) continue;
        std::optional<Trial> next = before;
        next->size = is_larger ? Real(last * factor) : Real(last / factor);
        if (!solve(z, *next, false)) {
          before.reset();
          continue;
        }
        if (magnitude(next->excess) < magnitude(*closest_)) closest_ = next->excess;
        if (before->excess * next->excess <= 0) {
          std::optional<Trial> root = bisect(z, *before, *next);
          if (root && continues(*root, last)) return root;
        }
        before = next;
      }
    }
    return std::nullopt;
  }

  std::optional<Trial> bisect(const std::vector<Real>& z, Trial from, const Trial& to) {
    Real other = to.size;
    for (int k = 0; k < bisections; ++k) {
      Trial middle = from;
      middle.size = (from.size + other) / 2;
      if (!solve(z, middle, false)) return std::nullopt;
      if (middle.excess * from.excess > 0) {
        from = middle;
      } else {
        other = middle.size;
      }
    }
    if (!solve(z, from, true)) return std::nullopt;
    return from;
  }

  std::string absence(const Real& last) const {
    const double size = static_cast<double>(last);
    std::string reason = fmt::format(
        "no step size from {:.6g} to {:.6g}, within a factor of {} of the last, has the conserved "
        "energy at its midpoint",
        size / largest_step_change, size * largest_step_change, largest_step_change);
    if (closest_) {
      reason += fmt::format(": H(z_m) - E comes no nearer to 0 than {:.3g}",
                            static_cast<double>(*closest_));
    }
    return reason;
  }

  Eigen::Index size_;
  DifferentiableFunction<Real> hamiltonian_;
  DifferentiableFunction<Real> field_;
  Matrix matrix_;
  Eigen::PartialPivLU<Matrix> factors_;
  Vector residual_;
  Vector half_field_;
  Vector tangent_;
  std::vector<Real> mean_;
  Real scale_ = 0;
  Real energy_ = 0;
  int slope_sign_ = -1;
  std::optional<Real> closest_;  ///< the value of H(z_m) - E nearest to 0 in the last search
};

}  // namespace hamjet
