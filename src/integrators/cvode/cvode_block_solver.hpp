#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "hamjet/detail/algebra/slice_product.hpp"
#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// Solves (I - gamma J) x = b exactly, where J is the Jacobian of the coefficient equations z' =
/// f(z) at a state in the layout of SeriesVectorField.
///
/// J acts on a vector of series as the truncated product with the matrix of series A = Df(z). It is
/// therefore block lower triangular in the degree, and
///
///   (I - gamma A_0) x_d = b_d + gamma sum over k = 1..d of A_k x_(d-k) ,
///
/// with the same 2n x 2n matrix I - gamma A_0 for every monomial. A solve thus takes one small
/// factorisation and the truncated product of A and x. Constant entries of A do not contribute to
/// the sum.
class CoefficientBlockSolver {
 public:
  /// The problem must be valid and outlive this object.
  explicit CoefficientBlockSolver(const FlowProblem<double>& problem)
      : space_(problem.space),
        order_(working_order(problem)),
        dimension_(problem.system->dimension()),
        coefficients_(space_->first(order_ + 1)),
        jacobian_(jacobian(problem.system->vector_field)),
        start_time_(problem.start_time.in<double>()),
        evaluator_(jacobian_, space_, order_),
        factors_(dimension_ * dimension_),
        rows_(dimension_),
        scratch_(coefficients_) {
    for (std::size_t i = 0; i < dimension_; ++i) {
      for (std::size_t j = 0; j < dimension_; ++j) {
        const std::size_t entry = i * dimension_ + j;
        if (jacobian_.dependencies(jacobian_.outputs()[entry]) != 0) varying_.push_back({i, j});
      }
    }
  }

  /// Evaluates A at a state and a time since the start. Returns false if a number is not finite.
  bool evaluate(const double* state, double time) {
    evaluator_.set_time(start_time_ + time);
    for (std::size_t i = 0; i < dimension_; ++i) {
      std::copy_n(state + i * coefficients_, coefficients_, evaluator_.input(i));
    }
    evaluator_.evaluate_all();
    for (const Entry& entry : varying_) {
      const double* a = series(entry);
      for (std::size_t k = 0; k < coefficients_; ++k) {
        if (!std::isfinite(a[k])) return false;
      }
    }
    return true;
  }

  /// Factorises I - gamma A_0 with partial pivoting. Returns false if the matrix is singular.
  bool factorise(double gamma) {
    const std::size_t n = dimension_;
    gamma_ = gamma;
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        factor(i, j) = (i == j ? 1 : 0) - gamma * *evaluator_.output(i * n + j);
      }
    }
    for (std::size_t j = 0; j < n; ++j) {
      std::size_t pivot = j;
      for (std::size_t i = j + 1; i < n; ++i) {
        if (std::abs(factor(i, j)) > std::abs(factor(pivot, j))) pivot = i;
      }
      if (factor(pivot, j) == 0 || !std::isfinite(factor(pivot, j))) return false;
      std::swap(rows_[j], rows_[pivot]);
      for (std::size_t i = j + 1; i < n; ++i) {
        factor(i, j) /= factor(j, j);
        for (std::size_t k = j + 1; k < n; ++k) factor(i, k) -= factor(i, j) * factor(j, k);
      }
    }
    return true;
  }

  /// Replaces b by x.
  void solve(double* b) {
    for (int d = 0; d <= order_; ++d) {
      if (d > 0) {
        for (const Entry& entry : varying_) add_coupling(entry, d, b);
      }
      solve_slice(d, b);
    }
  }

 private:
  struct Entry {
    std::size_t row;
    std::size_t column;
  };

  /// An entry of row i after pivoting; below the diagonal stand the multipliers of the elimination.
  double& factor(std::size_t i, std::size_t j) { return factors_[rows_[i] * dimension_ + j]; }

  const double* series(const Entry& entry) const {
    return evaluator_.output(entry.row * dimension_ + entry.column);
  }

  /// b_d += gamma sum over k = 1..d of a_k x_(d-k), for one entry a of A.
  void add_coupling(const Entry& entry, int d, double* b) {
    const double* a = series(entry);
    const double* x = b + entry.column * coefficients_;
    double* sum = b + entry.row * coefficients_;
    const bool is_coupled = d >= 2;
    if (is_coupled) interior_product(*space_, d, a, x, scratch_.data());
    for (std::size_t k = space_->first(d); k < space_->first(d + 1); ++k) {
      sum[k] += gamma_ * ((is_coupled ? scratch_[k] : 0) + a[k] * x[0]);
    }
  }

  /// One forward and one backward substitution, for all monomials of a degree at once.
  void solve_slice(int d, double* b) {
    const std::size_t n = dimension_;
    const std::size_t count = space_->count(d);
    slice_.resize(n * count);
    for (std::size_t i = 0; i < n; ++i) {
      std::copy_n(b + rows_[i] * coefficients_ + space_->first(d), count,
                  slice_.data() + i * count);
    }
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) subtract_row(i, j, count);
    }
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t j = i + 1; j < n; ++j) subtract_row(i, j, count);
      double* row = slice_.data() + i * count;
      for (std::size_t k = 0; k < count; ++k) row[k] /= factor(i, i);
      std::copy_n(row, count, b + i * coefficients_ + space_->first(d));
    }
  }

  void subtract_row(std::size_t i, std::size_t j, std::size_t count) {
    const double multiplier = factor(i, j);
    if (multiplier == 0) return;
    double* to = slice_.data() + i * count;
    const double* from = slice_.data() + j * count;
    for (std::size_t k = 0; k < count; ++k) to[k] -= multiplier * from[k];
  }

  SpacePointer space_;
  int order_;
  std::size_t dimension_;
  std::size_t coefficients_;
  OperationList jacobian_;
  double start_time_;
  SliceEvaluator<double, double> evaluator_;
  std::vector<Entry> varying_;
  std::vector<double> factors_;    ///< 2n x 2n
  std::vector<std::size_t> rows_;  ///< the order of the rows after pivoting
  double gamma_ = 0;
  std::vector<double> scratch_;  ///< one series
  std::vector<double> slice_;    ///< the rows of one degree
};

}  // namespace hamjet
