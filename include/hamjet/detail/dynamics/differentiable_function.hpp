#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "hamjet/detail/algebra/matrix.hpp"
#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// A recorded function R^inputs -> R^outputs with its exact Jacobian: the terms of degree 0 and 1
/// of the series algebra, on plain numbers. An evaluation reuses the object's storage, so that each
/// thread needs an object of its own.
template <class Real>
class DifferentiableFunction {
 public:
  /// Throws Error(usage) for a list of no inputs or more than 64.
  explicit DifferentiableFunction(OperationList list)
      : list_(std::make_unique<OperationList>(std::move(list))),
        evaluator_(*list_, SeriesSpace::create(list_->variables(), 0), 0) {}

  /// The number of inputs without the time.
  std::size_t inputs() const noexcept { return list_->variables(); }
  bool has_time() const noexcept { return list_->has_time(); }
  std::size_t outputs() const noexcept { return list_->outputs().size(); }

  /// Evaluates value and Jacobian, by the inputs without the time; throws Error(usage) for another
  /// number of inputs, and without a time for a function that depends on it.
  void evaluate(std::span<const Real> point) {
    if (has_time())
      throw Error(ErrorKind::usage,
                  "recorded function: it depends on the time, which is not given");
    evaluate_at_inputs(point);
  }
  void evaluate(std::span<const Real> point, const Real& time) {
    evaluator_.set_time(time);
    evaluate_at_inputs(point);
  }

  /// The value of an output at the point last evaluated.
  const Real& value(std::size_t output) const { return *evaluator_.output(output); }
  /// The derivative d output / d input at the point last evaluated.
  const Real& derivative(std::size_t output, std::size_t input) const {
    return evaluator_.output_gradient(output, input);
  }
  /// Whether all values are finite.
  bool is_finite() const {
    using std::isfinite;
    bool result = true;
    for (std::size_t i = 0; i < outputs(); ++i) result &= isfinite(value(i));
    return result;
  }

  Vector<Real> values() const {
    Vector<Real> result(static_cast<Eigen::Index>(outputs()));
    for (std::size_t i = 0; i < outputs(); ++i) result(static_cast<Eigen::Index>(i)) = value(i);
    return result;
  }
  /// The Jacobian at the point last evaluated, outputs x inputs.
  Matrix<Real> jacobian() const {
    Matrix<Real> result(static_cast<Eigen::Index>(outputs()), static_cast<Eigen::Index>(inputs()));
    for (std::size_t i = 0; i < outputs(); ++i) {
      for (std::size_t j = 0; j < inputs(); ++j) {
        result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = derivative(i, j);
      }
    }
    return result;
  }

 private:
  void evaluate_at_inputs(std::span<const Real> point) {
    if (point.size() != inputs()) {
      throw Error(ErrorKind::usage, "recorded function: wrong number of inputs");
    }
    for (std::size_t i = 0; i < inputs(); ++i) *evaluator_.input(i) = point[i];
    evaluator_.evaluate_constant_terms();
  }

  std::unique_ptr<OperationList> list_;  ///< the evaluator points to it
  SliceEvaluator<Real, Real> evaluator_;
};

}  // namespace hamjet
