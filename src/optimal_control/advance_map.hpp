#pragma once

#include <cstddef>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// One step of discrete necessary conditions.
struct AdvancedPoint {
  Eigen::VectorXd point;     ///< (x_(k+1), p_(k+1)), 2n
  Eigen::VectorXd control;   ///< u^d of the step, m
  Eigen::MatrixXd jacobian;  ///< d (x_(k+1), p_(k+1)) / d (x_k, p_k), exact, 2n x 2n
};

/// The advance map (x_k, p_k) -> (x_(k+1), p_(k+1)) of the necessary conditions of an
/// optimal-control problem, with a fixed step tau. It is symplectic.
class AdvanceMap {
 public:
  AdvanceMap(std::size_t states, std::size_t controls) : states_(states), controls_(controls) {}
  virtual ~AdvanceMap() = default;
  AdvanceMap(const AdvanceMap&) = delete;
  AdvanceMap& operator=(const AdvanceMap&) = delete;

  std::size_t states() const noexcept { return states_; }
  std::size_t controls() const noexcept { return controls_; }

  /// Advances `point`, 2n numbers (x, p). The iteration for the controls starts at `control_guess`,
  /// m numbers. Throws Error(numerical) if the equations cannot be solved there.
  virtual AdvancedPoint advance(const Eigen::VectorXd& point,
                                const Eigen::VectorXd& control_guess) = 0;

 private:
  std::size_t states_;
  std::size_t controls_;
};

}  // namespace hamjet
