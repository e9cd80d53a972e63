#pragma once

#include <cstddef>
#include <span>

#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/detail/dynamics/expression.hpp"

namespace hamjet {

/// End conditions phi(x) = 0, r of them on n states, and the quantities that the transversality
/// conditions need: D phi(x)^T lambda for r multipliers lambda, and the exact derivatives of phi
/// and of this product.
///
/// The augmented cost contains + <lambda_0, phi_0> + <lambda_n, phi_n>, so that, in both discrete
/// geometries as in continuous time,
///
///   p_0 = -D phi_0(x_0)^T lambda_0 ,   p_n = +D phi_n(x_n)^T lambda_n
///
/// (Guibout and Bloch, eqs. trans and dstranscond; dtranscond_mp is printed with the opposite
/// signs). With phi = x - c the multiplier is minus the derivative of the least cost by c.
class EndConditions {
 public:
  explicit EndConditions(const OperationList& conditions);

  std::size_t count() const noexcept { return count_; }

  /// Evaluates conditions and derivatives at n states and r multipliers.
  void evaluate(std::span<const double> x, std::span<const double> multipliers);
  Eigen::VectorXd conditions() const;      ///< phi(x), r
  Eigen::MatrixXd jacobian() const;        ///< D phi(x), r x n
  Eigen::VectorXd covector() const;        ///< D phi(x)^T lambda, n
  Eigen::MatrixXd covector_slope() const;  ///< derivative of the covector by x, n x n

  /// The multipliers for which D phi(x)^T lambda is nearest to a given covector of n numbers.
  Eigen::VectorXd nearest_multipliers(std::span<const double> x, const Eigen::VectorXd& covector);

 private:
  std::size_t states_;
  std::size_t count_;
  DifferentiableFunction<double> function_;  ///< (x, lambda) -> (phi, D phi^T lambda)
};

}  // namespace hamjet
