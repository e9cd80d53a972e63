#pragma once

#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"

namespace hamjet {

/// The plane of the neighbours of an extremal that start from the same state with other costates,
/// in the phase space of n states and n costates. At the start it is the plane of the costates.
class LagrangianPlane {
 public:
  explicit LagrangianPlane(Eigen::Index n);

  /// Moves the plane by the 2n x 2n Jacobian of a symplectic map.
  void advance(const Eigen::MatrixXd& jacobian);

  /// The phases, ascending, of the n eigenvalues of U = W W^T. W = D + i B is unitary if the
  /// columns (B, D) of the plane are orthonormal; U does not depend on the choice of these columns.
  std::vector<double> phases() const;

 private:
  Eigen::MatrixXd frame_;
};

}  // namespace hamjet
