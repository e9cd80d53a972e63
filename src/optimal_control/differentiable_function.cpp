#include <hamjet/optimal_control/differentiable_function.hpp>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet {

std::vector<Expression> recorded_outputs(const OperationList& list,
                                         std::span<const Expression> inputs) {
  const std::vector<Expression> values = replay(list, inputs);
  std::vector<Expression> outputs;
  for (const std::size_t place : list.outputs()) outputs.push_back(values[place]);
  return outputs;
}

DifferentiableFunction::DifferentiableFunction(OperationList list)
    : list_(std::make_unique<OperationList>(std::move(list))),
      evaluator_(*list_, SeriesSpace::create(list_->inputs(), 0), 0) {}

void DifferentiableFunction::evaluate(std::span<const double> inputs) {
  if (inputs.size() != list_->inputs()) {
    throw Error(ErrorKind::usage, "recorded function: wrong number of inputs");
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) *evaluator_.input(i) = inputs[i];
  evaluator_.evaluate_constant_terms();
}

Eigen::VectorXd DifferentiableFunction::values() const {
  Eigen::VectorXd result(outputs());
  for (std::size_t i = 0; i < outputs(); ++i) result(i) = value(i);
  return result;
}

Eigen::MatrixXd DifferentiableFunction::jacobian() const {
  Eigen::MatrixXd result(outputs(), inputs());
  for (std::size_t i = 0; i < outputs(); ++i) {
    for (std::size_t j = 0; j < inputs(); ++j) result(i, j) = derivative(i, j);
  }
  return result;
}

}  // namespace hamjet
