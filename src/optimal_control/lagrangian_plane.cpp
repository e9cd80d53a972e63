#include "lagrangian_plane.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <complex>

#include "hamjet/error.hpp"

// This stands in a file of its own because the decompositions take long to compile.

namespace hamjet {

LagrangianPlane::LagrangianPlane(Eigen::Index n) : frame_(Eigen::MatrixXd::Zero(2 * n, n)) {
  frame_.bottomRows(n).setIdentity();
}

void LagrangianPlane::advance(const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd moved = jacobian * frame_;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(moved);
  frame_ = decomposition.householderQ() * Eigen::MatrixXd::Identity(moved.rows(), moved.cols());
}

std::vector<double> LagrangianPlane::phases() const {
  using Complex = std::complex<double>;
  const Eigen::Index n = frame_.cols();
  const Eigen::MatrixXcd w =
      frame_.bottomRows(n).cast<Complex>() + Complex(0, 1) * frame_.topRows(n).cast<Complex>();
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(w * w.transpose(), false);
  // For a 1 x 1 matrix the solver always reports success.
  if (solver.info() != Eigen::Success || !frame_.allFinite()) {
    throw Error(ErrorKind::numerical,
                "second variation: the eigenvalues of the Lagrangian plane are not found");
  }
  std::vector<double> result;
  for (const Complex& value : solver.eigenvalues()) result.push_back(std::arg(value));
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace hamjet
