#include <algorithm>
#include <cmath>
#include <complex>

#include "../../algebra/matrix_eigenvalues.hpp"
#include "../../algebra/singular_values.hpp"
#include "periodic_orbit.hpp"

// The multipliers of a periodic orbit. Two of them are 1, one of the flow's direction and one of
// the energy. They belong to a Jordan block, whose eigenvalues lose half of the digits. This pair
// is therefore divided out first, which leaves a matrix P: that of the section across the flow on
// the energy's surface. P is symplectic with the form that the surface inherits, so that its
// inverse is known without inversion, and (P + P^-1)/2 has the stability indices, each twice and
// without Jordan blocks even where two multipliers meet.

namespace hamjet {
namespace {

using Complex = std::complex<double>;

/// The symplectic unit matrix J.
Matrix<double> symplectic_unit(Eigen::Index dimension) {
  return symplectic_unit_times(Matrix<double>(Matrix<double>::Identity(dimension, dimension)));
}

/// Each of these numbers stands twice, but for rounding: the mean of each pair.
std::vector<Complex> means_of_pairs(const Eigen::VectorXcd& twice) {
  std::vector<Complex> left(twice.begin(), twice.end());
  std::vector<Complex> means;
  while (left.size() > 1) {
    const Complex first = left.back();
    left.pop_back();
    const auto other = std::ranges::min_element(
        left, {}, [&](const Complex& one) { return std::abs(one - first); });
    means.push_back(0.5 * (first + *other));
    left.erase(other);
  }
  std::ranges::stable_sort(means, std::ranges::greater{},
                           [](const Complex& one) { return std::abs(one); });
  return means;
}

/// The multiplier of an index that lies on or outside the unit circle.
Complex multiplier_of(const Complex& index) {
  const Complex root = std::sqrt(index * index - 1.0);
  const Complex sum = index + root;
  const Complex difference = index - root;
  const bool is_outside = std::abs(sum) >= std::abs(difference);
  const Complex larger = is_outside ? sum : difference;
  const bool is_on_circle = index.imag() == 0 && std::abs(index.real()) <= 1;
  return is_on_circle && larger.imag() < 0 ? std::conj(larger) : larger;
}

}  // namespace

bool Monodromy::is_stable() const {
  const double doubt = std::max(1e-9, trivial_defect);
  return std::ranges::all_of(indices, [&](const Complex& index) {
    return std::abs(index.imag()) <= doubt && std::abs(index.real()) <= 1 + doubt;
  });
}

Monodromy monodromy_of(const DynamicalSystem& system, const Vector<double>& start,
                       Matrix<double> matrix, const Vector<double>& sizes) {
  Monodromy result;
  const Eigen::Index dimension = start.size();
  const Eigen::Index n = dimension / 2;
  const EnergyGradient at = energy_gradient(system, start);
  // One unit for positions and one for momenta leave the matrix symplectic.
  Matrix<double> turn = matrix;
  for (Eigen::Index i = 0; i < dimension; ++i) {
    turn.row(i) /= sizes[i];
    turn.col(i) *= sizes[i];
  }
  const Vector<double> field = (at.field().array() / sizes.array()).matrix().normalized();
  const Vector<double> gradient = (at.gradient.array() * sizes.array()).matrix().normalized();
  const Matrix<double> unit = symplectic_unit(dimension);
  result.matrix = std::move(matrix);
  result.determinant_defect = std::abs(turn.partialPivLu().determinant() - 1);
  result.symplectic_defect = (turn.transpose() * unit * turn - unit).cwiseAbs().maxCoeff();
  result.trivial_defect =
      std::max((turn * field - field).norm(), (turn.transpose() * gradient - gradient).norm());
  if (n < 2) return result;
  Matrix<double> taken(dimension, 2);
  taken << field, gradient;
  const Matrix<double> basis = decompose_by_singular_values(taken).left.rightCols(dimension - 2);
  const Matrix<double> map = basis.transpose() * turn * basis;
  const Matrix<double> form = basis.transpose() * unit * basis;
  const Matrix<double> back = form.partialPivLu().solve(map.transpose() * form);
  result.indices =
      means_of_pairs(matrix_eigenvalues("periodic", Matrix<double>(0.5 * (map + back))));
  for (const Complex& index : result.indices) result.multipliers.push_back(multiplier_of(index));
  return result;
}

}  // namespace hamjet
