#include "end_conditions.hpp"

#include <Eigen/QR>
#include <vector>

namespace hamjet {
namespace {

OperationList with_covector(const OperationList& conditions) {
  const std::size_t n = conditions.inputs();
  const std::size_t r = conditions.outputs().size();
  const OperationList weighted = record(n + r, [&](std::span<const Expression> z) {
    const std::vector<Expression> phi = recorded_outputs(conditions, z.first(n));
    Expression sum(0);
    for (std::size_t i = 0; i < r; ++i) sum += z[n + i] * phi[i];
    return std::vector<Expression>{sum};
  });
  const OperationList slope = gradient(weighted);
  return record(n + r, [&](std::span<const Expression> z) {
    std::vector<Expression> outputs = recorded_outputs(conditions, z.first(n));
    const std::vector<Expression> derivatives = recorded_outputs(slope, z);
    outputs.insert(outputs.end(), derivatives.begin(),
                   derivatives.begin() + static_cast<std::ptrdiff_t>(n));
    return outputs;
  });
}

}  // namespace

EndConditions::EndConditions(const OperationList& conditions)
    : states_(conditions.inputs()),
      count_(conditions.outputs().size()),
      function_(with_covector(conditions)) {}

void EndConditions::evaluate(std::span<const double> x, std::span<const double> multipliers) {
  std::vector<double> inputs(x.begin(), x.end());
  inputs.insert(inputs.end(), multipliers.begin(), multipliers.end());
  function_.evaluate(inputs);
}

Eigen::VectorXd EndConditions::conditions() const { return function_.values().head(count_); }

Eigen::MatrixXd EndConditions::jacobian() const {
  return function_.jacobian().topLeftCorner(count_, states_);
}

Eigen::VectorXd EndConditions::covector() const { return function_.values().tail(states_); }

Eigen::MatrixXd EndConditions::covector_slope() const {
  return function_.jacobian().bottomLeftCorner(states_, states_);
}

Eigen::VectorXd EndConditions::nearest_multipliers(std::span<const double> x,
                                                   const Eigen::VectorXd& covector) {
  if (count_ == 0) return {};
  evaluate(x, std::vector<double>(count_, 0));
  const Eigen::MatrixXd conditions = jacobian().transpose();
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(conditions).solve(covector);
}

}  // namespace hamjet
