#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "hamjet/dynamics/expression.hpp"
#include "hamjet/dynamics/slice_evaluator.hpp"

namespace hamjet {

/// The outputs of a list on these expressions, recorded anew: a recorded function called inside the
/// recording of another one.
std::vector<Expression> recorded_outputs(const OperationList& list,
                                         std::span<const Expression> inputs);

/// A recorded function R^inputs -> R^outputs with its exact Jacobian: the terms of degree 0 and 1
/// of the series algebra, on plain numbers.
class DifferentiableFunction {
 public:
  /// Throws Error(usage) for no inputs or more than 64.
  explicit DifferentiableFunction(OperationList list);

  std::size_t inputs() const noexcept { return list_->inputs(); }
  std::size_t outputs() const noexcept { return list_->outputs().size(); }

  /// Evaluates value and Jacobian; throws Error(usage) for another number of inputs.
  void evaluate(std::span<const double> inputs);
  double value(std::size_t output) const { return *evaluator_.output(output); }
  /// d output / d input.
  double derivative(std::size_t output, std::size_t input) const {
    return evaluator_.output_gradient(output, input);
  }
  Eigen::VectorXd values() const;
  Eigen::MatrixXd jacobian() const;  ///< outputs x inputs

 private:
  std::unique_ptr<OperationList> list_;  ///< the evaluator points to it
  SliceEvaluator<double, double> evaluator_;
};

}  // namespace hamjet
