#include "affine_symplectic_map.hpp"

#include <fmt/format.h>

#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The defect A J A^T - J.
template <class Real>
Matrix<Real> defect_matrix(const Matrix<Real>& matrix) {
  const Eigen::Index n = matrix.rows() / 2;
  Matrix<Real> defect = matrix * symplectic_unit_times(matrix.transpose());
  defect.topRightCorner(n, n).diagonal().array() -= Real(1);
  defect.bottomLeftCorner(n, n).diagonal().array() += Real(1);
  return defect;
}

template <class Real>
void require_phase_space(const Matrix<Real>& matrix) {
  if (matrix.rows() == 0 || matrix.rows() % 2 != 0 || matrix.rows() != matrix.cols()) {
    throw Error(ErrorKind::usage, fmt::format("symplectic matrix: must be 2n x 2n, got {} x {}",
                                              matrix.rows(), matrix.cols()));
  }
}

template <class Derived>
bool all_finite(const Eigen::MatrixBase<Derived>& values) {
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      using std::isfinite;
      if (!isfinite(values(i, j))) return false;
    }
  }
  return true;
}

}  // namespace

template <class Real>
MatrixSymplecticityDefect symplecticity_defect(const Matrix<Real>& matrix) {
  require_phase_space(matrix);
  const Eigen::Index n = matrix.rows() / 2;
  const Matrix<Real> magnitudes = matrix.cwiseAbs();
  Matrix<Real> exchanged(2 * n, 2 * n);  // |J| |A|^T
  exchanged.topRows(n) = magnitudes.transpose().bottomRows(n);
  exchanged.bottomRows(n) = magnitudes.transpose().topRows(n);
  const Matrix<Real> terms = magnitudes * exchanged;
  MatrixSymplecticityDefect defect;
  defect.absolute = static_cast<double>(defect_matrix(matrix).cwiseAbs().maxCoeff());
  const double scale = static_cast<double>(terms.maxCoeff());
  // In a matrix of zeros no terms cancel; the size of J, which is 1, then serves as the scale.
  defect.relative = defect.absolute / std::max(scale, 1.0);
  return defect;
}

template <class Real>
AffineSymplecticMap<Real>::AffineSymplecticMap(Matrix<Real> matrix, Vector<Real> shift)
    : matrix_(std::move(matrix)), shift_(std::move(shift)) {
  require_phase_space(matrix_);
  if (shift_.size() != matrix_.rows()) {
    throw Error(ErrorKind::usage,
                fmt::format("affine symplectic map: a matrix of {} rows needs a shift of as many "
                            "entries, got {}",
                            matrix_.rows(), shift_.size()));
  }
  if (!all_finite(matrix_) || !all_finite(shift_)) {
    throw Error(ErrorKind::usage, "affine symplectic map: an entry is not finite");
  }
  const MatrixSymplecticityDefect defect = symplecticity_defect(matrix_);
  if (!(defect.relative <= largest_symplecticity_defect<Real>())) {
    throw Error(
        ErrorKind::usage,
        fmt::format("affine symplectic map: the matrix is not symplectic: the largest "
                    "entry of A J A^T - J is {:.3g}, relative {:.3g}, must be at most "
                    "{:.2g} relative",
                    defect.absolute, defect.relative, largest_symplecticity_defect<Real>()));
  }
}

template <class Real>
AffineSymplecticMap<Real>::AffineSymplecticMap(const Matrix<Real>& matrix)
    : AffineSymplecticMap(matrix, Vector<Real>::Zero(matrix.rows())) {}

template <class Real>
AffineSymplecticMap<Real> AffineSymplecticMap<Real>::identity(Eigen::Index degrees_of_freedom) {
  const Eigen::Index size = 2 * degrees_of_freedom;
  return {Matrix<Real>::Identity(size, size), Vector<Real>::Zero(size)};
}

template <class Real>
Matrix<Real> AffineSymplecticMap<Real>::inverse_matrix() const {
  const Eigen::Index n = dimension() / 2;
  Matrix<Real> inverse(2 * n, 2 * n);
  inverse.topLeftCorner(n, n) = matrix_.bottomRightCorner(n, n).transpose();
  inverse.topRightCorner(n, n) = -matrix_.topRightCorner(n, n).transpose();
  inverse.bottomLeftCorner(n, n) = -matrix_.bottomLeftCorner(n, n).transpose();
  inverse.bottomRightCorner(n, n) = matrix_.topLeftCorner(n, n).transpose();
  return inverse;
}

template <class Real>
AffineSymplecticMap<Real> AffineSymplecticMap<Real>::inverse() const {
  const Matrix<Real> inverse = inverse_matrix();
  return {Unchecked{}, inverse, -(inverse * shift_)};
}

template <class Real>
AffineSymplecticMap<Real> AffineSymplecticMap<Real>::after(const AffineSymplecticMap& first) const {
  if (first.dimension() != dimension()) {
    throw Error(ErrorKind::usage, "affine symplectic map: maps of different dimension");
  }
  return {Unchecked{}, matrix_ * first.matrix_, matrix_ * first.shift_ + shift_};
}

template <class Real>
double AffineSymplecticMap<Real>::condition() const {
  return static_cast<double>(matrix_.squaredNorm());
}

template <class Real>
Matrix<Real> nearest_symplectic(Matrix<Real> matrix) {
  constexpr int largest_iteration_count =
      8;  // convergence is quadratic: two iterations from 1e-13 reach 1e-34
  double previous = symplecticity_defect(matrix).relative;
  for (int i = 0; i < largest_iteration_count; ++i) {
    const Matrix<Real> correction = defect_matrix(matrix) * symplectic_unit_times(matrix) / Real(2);
    const Matrix<Real> improved = matrix + correction;
    const double defect = symplecticity_defect(improved).relative;
    if (!(defect < previous)) break;
    matrix = improved;
    previous = defect;
  }
  return matrix;
}

template <class Real>
AffineSymplecticMap<Real> phase_plane_rotation(const Real& angle) {
  using std::cos;
  using std::sin;
  const Real c = cos(angle);
  const Real s = sin(angle);
  Matrix<Real> matrix(2, 2);
  matrix << c, Real(-s), s, c;
  return AffineSymplecticMap<Real>(matrix);
}

template MatrixSymplecticityDefect symplecticity_defect(const Matrix<InstantiatedReal>&);
template class AffineSymplecticMap<InstantiatedReal>;
template Matrix<InstantiatedReal> nearest_symplectic(Matrix<InstantiatedReal>);
template AffineSymplecticMap<InstantiatedReal> phase_plane_rotation(const InstantiatedReal&);

}  // namespace hamjet
