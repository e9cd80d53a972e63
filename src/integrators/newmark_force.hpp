#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <cstddef>
#include <limits>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/integrators/flow_problem.hpp"
#include "real_number.hpp"

namespace hamjet {

/// The force of Newmark's method at the positions q that solve x = q - c M^-1 F(q), with c = beta
/// h^2 > 0. With G the wanted force,
///
///   q = x + c M^-1 G,   G = F(q) .
///
/// Degree 0 is solved by Newton's method on G. At degree d, with R_d the remainder of F
/// (SliceEvaluator) and DF the gradient at the converged q,
///
///   (I - c DF M^-1) G_d = R_d + DF x_d ,
///
/// whose matrix is the transpose of I - c M^-1 DF. Solving for G instead of q keeps G accurate to
/// round-off where c DF M^-1 is large, and does not need M.
template <class Real>
class NewmarkForce {
 public:
  NewmarkForce(const FlowProblem<Real>& problem, const Real& c, IntegrationStatistics& statistics)
      : list_(problem.system->second_order->force),
        space_(problem.space),
        statistics_(statistics),
        order_(working_order(problem)),
        is_linear_(problem.system->vector_field.is_linear_system()),
        n_(problem.system->degrees_of_freedom),
        count_(problem.space->first(order_ + 1)),
        evaluator_(list_, problem.space, order_),
        positions_(n_ * count_),
        force_(n_ * count_),
        response_(size(), size()),
        position_response_(size(), size()),
        compliance_(size(), size()),
        gradient_(size(), size()),
        factors_(size()) {
    const auto& inverse_mass = problem.system->second_order->inverse_mass;
    for (Eigen::Index i = 0; i < size(); ++i) {
      for (Eigen::Index j = 0; j < size(); ++j) {
        compliance_(i, j) =
            c * convert<Real>(inverse_mass[static_cast<std::size_t>(i * size() + j)]);
      }
    }
    start_.resize(n_);
    target_.resize(n_);
    trial_.resize(n_);
    residual_.resize(n_);
    change_.resize(n_);
  }

  Real* x(std::size_t i) { return &positions_[i * count_]; }
  const Real* q(std::size_t i) { return evaluator_.input(i); }
  const Real* f(std::size_t i) const { return &force_[i * count_]; }

  void set_time(const Real& time) { evaluator_.set_time(time); }

  /// Evaluates F(q) and x = q - c M^-1 F(q); returns false if F(q) is not finite.
  bool start(const FlowJet<Real>& jet) {
    failure_ = "the force is not finite (a collision, or a point outside its domain)";
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(jet[i].coefficients().data(), count_, evaluator_.input(i));
    }
    evaluator_.evaluate_all();
    for (std::size_t i = 0; i < n_; ++i) {
      if (!is_finite(evaluator_.output(i)[0])) return false;
      std::copy_n(evaluator_.output(i), count_, &force_[i * count_]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      std::copy_n(evaluator_.input(i), count_, x(i));
      for (std::size_t j = 0; j < n_; ++j) add(x(i), -entry(compliance_, i, j), f(j), 0, count_);
    }
    failure_ = "the implicit equation has no solution connected to the start of the step";
    return true;
  }

  bool evaluate() {
    if (!solve_nominal() || !factorise(1)) return false;
    form_responses();
    for (std::size_t i = 0; i < n_; ++i) force_[i * count_] = trial_[i];
    for (int d = 1; d <= order_; ++d) {
      evaluator_.evaluate_remainder(d);
      solve_degree(d);
      // At the highest degree `complete` would form only the outputs, which are the force.
      if (d < order_) evaluator_.complete(d);
    }
    return true;
  }

  const char* failure() const { return failure_; }
  const SeriesWork& work() const { return evaluator_.work(); }

 private:
  using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  Eigen::Index size() const { return static_cast<Eigen::Index>(n_); }
  static const Real& entry(const RealMatrix& m, std::size_t i, std::size_t j) {
    return m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }

  /// target += factor series, for the monomials from `first` to `last`.
  static void add(Real* target, const Real& factor, const Real* series, std::size_t first,
                  std::size_t last) {
    if (factor == 0) return;
    for (std::size_t k = first; k < last; ++k) target[k] += factor * series[k];
  }

  void solve_degree(int d) {
    const std::size_t first = space_->first(d);
    const std::size_t last = space_->first(d + 1);
    for (std::size_t i = 0; i < n_; ++i) {
      Real* force = &force_[i * count_];
      std::fill(force + first, force + last, Real(0));
      for (std::size_t j = 0; j < n_; ++j) {
        add(force, entry(position_response_, i, j), x(j), first, last);
        if (!evaluator_.has_remainder(j, d)) continue;
        add(force, entry(response_, i, j), evaluator_.remainder(j), first, last);
      }
    }
    for (std::size_t i = 0; i < n_; ++i) {
      Real* q = evaluator_.input(i);
      std::copy(x(i) + first, x(i) + last, q + first);
      for (std::size_t j = 0; j < n_; ++j) add(q, entry(compliance_, i, j), f(j), first, last);
    }
  }

  /// Sets the positions q = (1 - s) q_start + s x + s c M^-1 G, where G is the trial force: s = 1
  /// gives the equation itself, s = 0 the start of the step.
  void place(double s) {
    for (std::size_t i = 0; i < n_; ++i) {
      Real sum = s == 1 ? target_[i] : Real(start_[i] + Real(s) * (target_[i] - start_[i]));
      for (std::size_t j = 0; j < n_; ++j) sum += Real(s) * entry(compliance_, i, j) * trial_[j];
      *evaluator_.input(i) = sum;
    }
    evaluator_.evaluate_constant_terms();
    ++statistics_.nominal_evaluations;
  }

  /// Factorises I - s c DF M^-1 at the present positions. Returns false if the matrix is singular
  /// or, unless the force is linear, if its determinant is negative. The determinant is 1 at s = 0
  /// and changes sign only where the solution connected to the start ends, so that a solution
  /// beyond is a detached one.
  bool factorise(double s) {
    for (Eigen::Index i = 0; i < size(); ++i) {
      for (Eigen::Index j = 0; j < size(); ++j) {
        gradient_(i, j) =
            evaluator_.output_gradient(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      }
    }
    matrix_.noalias() = gradient_ * compliance_;
    matrix_ *= Real(-s);
    matrix_.diagonal().array() += Real(1);
    factors_.compute(matrix_);
    const Real determinant = factors_.determinant();
    return is_finite(determinant) && (is_linear_ ? determinant != 0 : determinant > 0);
  }

  /// Newton's method from the trial force, to round-off. Every correction must be at most a quarter
  /// of the one before: a start of this quality belongs to the solution that is found. Because
  /// convergence is quadratic, the next correction would be this one times the square of their
  /// ratio.
  bool newton(double s) {
    const Real epsilon = std::numeric_limits<Real>::epsilon();
    Real previous = 0;
    place(s);
    for (int iteration = 0; iteration < largest_iteration_count; ++iteration) {
      if (!factorise(s)) return false;
      for (std::size_t i = 0; i < n_; ++i) {
        residual_(static_cast<Eigen::Index>(i)) = *evaluator_.output(i) - trial_[i];
      }
      change_ = factors_.solve(residual_);
      for (std::size_t i = 0; i < n_; ++i) trial_[i] += change_(static_cast<Eigen::Index>(i));
      const Real moved = displacement(s);
      if (!is_finite(moved)) return false;
      place(s);
      statistics_.most_newton_iterations =
          std::max(statistics_.most_newton_iterations, iteration + 1);
      if (moved <= 4 * epsilon) return true;
      const Real ratio = iteration == 0 ? Real(0.25) : Real(moved / previous);
      if (iteration > 0 && moved * ratio * ratio <= epsilon / 4) return true;
      if (ratio > Real(0.25)) return moved <= 100 * epsilon * cancellation(s);
      previous = moved;
    }
    return false;
  }

  /// The largest change of a position, relative to the largest position.
  Real displacement(double s) const {
    Real moved = 0;
    Real scale = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      Real sum = 0;
      for (std::size_t j = 0; j < n_; ++j) {
        sum += Real(s) * entry(compliance_, i, j) * change_(static_cast<Eigen::Index>(j));
      }
      if (!is_finite(sum)) return sum;
      moved = std::max(moved, magnitude(sum));
      scale = std::max({scale, magnitude(target_[i]), magnitude(start_[i])});
    }
    return moved > 0 ? Real(moved / std::max(scale, moved)) : Real(0);
  }

  /// The factor by which the terms of q are larger than the positions to which `displacement` is
  /// relative.
  Real cancellation(double s) const {
    Real terms = 0;
    Real scale = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      Real sum = magnitude(target_[i]) + magnitude(start_[i]);
      scale = std::max(scale, sum);
      for (std::size_t j = 0; j < n_; ++j) {
        sum += magnitude(Real(Real(s) * entry(compliance_, i, j) * trial_[j]));
      }
      terms = std::max(terms, sum);
    }
    return scale > 0 ? Real(terms / scale) : Real(1);
  }

  /// Solves degree 0 from the last force or, if that is not a good start, along s from 0 to 1.
  bool solve_nominal() {
    for (std::size_t i = 0; i < n_; ++i) {
      start_[i] = *evaluator_.input(i);
      target_[i] = *x(i);
      trial_[i] = *f(i);
    }
    if (newton(1)) return true;
    return !is_linear_ && continue_from_start();
  }

  /// Follows the solution from the start of the step. A path that ends (in a fold) has no
  /// continuation, however far it is refined.
  bool continue_from_start() {
    constexpr double first = 0x1p-8;
    constexpr double smallest = 0x1p-16;
    for (std::size_t i = 0; i < n_; ++i) trial_[i] = *f(i);
    double reached = 0;
    double part = first;
    std::vector<Real> good = trial_;
    while (reached < 1) {
      const double next = std::min(1.0, reached + part);
      if (newton(next)) {
        reached = next;
        good = trial_;
        part *= 2;
        continue;
      }
      trial_ = good;
      part /= 2;
      if (part < smallest) return false;
    }
    return true;
  }

  /// Forms K = (I - c DF M^-1)^-1 and K DF.
  void form_responses() {
    matrix_.setIdentity(size(), size());
    response_ = factors_.solve(matrix_);
    position_response_ = factors_.solve(gradient_);
  }

  static constexpr int largest_iteration_count = 40;

  const OperationList& list_;
  SpacePointer space_;
  IntegrationStatistics& statistics_;
  int order_;
  bool is_linear_;
  std::size_t n_;
  std::size_t count_;
  SliceEvaluator<Real, Real> evaluator_;
  std::vector<Real> positions_;
  std::vector<Real> force_;
  RealMatrix response_;           ///< K
  RealMatrix position_response_;  ///< K DF
  RealMatrix compliance_;         ///< c M^-1
  RealMatrix gradient_;           ///< DF
  RealMatrix matrix_;
  Eigen::PartialPivLU<RealMatrix> factors_;
  std::vector<Real> start_;   ///< q at the start of the step
  std::vector<Real> target_;  ///< x at its end
  std::vector<Real> trial_;   ///< G
  Eigen::Matrix<Real, Eigen::Dynamic, 1> residual_;
  Eigen::Matrix<Real, Eigen::Dynamic, 1> change_;
  const char* failure_ = "";
};

}  // namespace hamjet
