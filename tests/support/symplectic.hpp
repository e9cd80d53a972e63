#pragma once

#include <Eigen/LU>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "maps/affine_symplectic_map.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

// Random symplectic matrices and Hamiltonians, the same in every run.

namespace hamjet::test {

template <class Real>
Matrix<Real> random_matrix(Eigen::Index rows, Eigen::Index columns, RandomNumbers& random,
                           double size = 1) {
  Matrix<Real> matrix(rows, columns);
  for (Real& x : matrix.reshaped()) x = Real(random.uniform(-size, size));
  return matrix;
}

template <class Real>
Vector<Real> random_vector(Eigen::Index size, RandomNumbers& random, double largest = 1) {
  return random_matrix<Real>(size, 1, random, largest);
}

template <class Real>
Matrix<Real> random_symmetric(Eigen::Index size, RandomNumbers& random, double largest = 1) {
  const Matrix<Real> matrix = random_matrix<Real>(size, size, random, largest);
  return (matrix + matrix.transpose()) / Real(2);
}

/// J = [[0, I], [-I, 0]].
template <class Real>
Matrix<Real> symplectic_unit(Eigen::Index degrees_of_freedom) {
  const Eigen::Index n = degrees_of_freedom;
  Matrix<Real> unit = Matrix<Real>::Zero(2 * n, 2 * n);
  unit.topRightCorner(n, n).setIdentity();
  unit.bottomLeftCorner(n, n) = -Matrix<Real>::Identity(n, n);
  return unit;
}

/// exp(J S) with S symmetric, by its Taylor series: symplectic by Liouville's theorem.
template <class Real>
Matrix<Real> hamiltonian_exponential(const Matrix<Real>& symmetric) {
  const Matrix<Real> generator = symplectic_unit<Real>(symmetric.rows() / 2) * symmetric;
  Matrix<Real> term = Matrix<Real>::Identity(symmetric.rows(), symmetric.rows());
  Matrix<Real> sum = term;
  for (int k = 1; k <= 60; ++k) {
    term = term * generator / Real(k);
    sum += term;
  }
  return sum;
}

/// A product of two shears, a change of the positions with that of the momenta that belongs to it,
/// and the exponential of a Hamiltonian matrix: each is symplectic by construction.
template <class Real>
Matrix<Real> random_symplectic_matrix(Eigen::Index degrees_of_freedom, RandomNumbers& random) {
  const Eigen::Index n = degrees_of_freedom;
  Matrix<Real> upper = Matrix<Real>::Identity(2 * n, 2 * n);
  upper.topRightCorner(n, n) = random_symmetric<Real>(n, random);
  Matrix<Real> lower = Matrix<Real>::Identity(2 * n, 2 * n);
  lower.bottomLeftCorner(n, n) = random_symmetric<Real>(n, random);
  const Matrix<Real> positions =
      Matrix<Real>::Identity(n, n) * Real(1.5) + random_matrix<Real>(n, n, random, 0.3);
  Matrix<Real> point = Matrix<Real>::Zero(2 * n, 2 * n);
  point.topLeftCorner(n, n) = positions;
  point.bottomRightCorner(n, n) = positions.inverse().transpose();
  return upper * lower * point *
         hamiltonian_exponential<Real>(random_symmetric<Real>(2 * n, random, 0.7));
}

template <class Real>
AffineSymplecticMap<Real> random_affine_map(Eigen::Index degrees_of_freedom,
                                            RandomNumbers& random) {
  return {random_symplectic_matrix<Real>(degrees_of_freedom, random),
          random_vector<Real>(2 * degrees_of_freedom, random)};
}

/// A Hamiltonian that is neither separable nor polynomial, with random coefficients.
inline DynamicalSystem random_system(std::size_t degrees_of_freedom, RandomNumbers& random) {
  const auto size = static_cast<Eigen::Index>(2 * degrees_of_freedom);
  const Matrix<double> quadratic = random_symmetric<double>(size, random);
  const double cubic = random.uniform(0.2, 0.5);
  return make_system("random", degrees_of_freedom,
                     [&](std::span<const Expression> q, std::span<const Expression> p) {
                       std::vector<Expression> z(q.begin(), q.end());
                       z.insert(z.end(), p.begin(), p.end());
                       Expression h = sin(q[0] + 0.3 * p.back()) + cubic * q[0] * q[0] * p.back();
                       Expression norm = 0;
                       for (std::size_t i = 0; i < z.size(); ++i) {
                         norm += z[i] * z[i];
                         for (std::size_t j = 0; j < z.size(); ++j) {
                           h += quadratic(static_cast<Eigen::Index>(i),
                                          static_cast<Eigen::Index>(j)) *
                                z[i] * z[j] / 2;
                         }
                       }
                       return h + norm * norm / 4;
                     });
}

/// z^T S z / 2.
inline DynamicalSystem quadratic_system(const Matrix<double>& symmetric) {
  return make_system("quadratic", static_cast<std::size_t>(symmetric.rows() / 2),
                     [&](std::span<const Expression> q, std::span<const Expression> p) {
                       std::vector<Expression> z(q.begin(), q.end());
                       z.insert(z.end(), p.begin(), p.end());
                       Expression h = 0;
                       for (std::size_t i = 0; i < z.size(); ++i) {
                         for (std::size_t j = 0; j < z.size(); ++j) {
                           h += symmetric(static_cast<Eigen::Index>(i),
                                          static_cast<Eigen::Index>(j)) *
                                z[i] * z[j] / 2;
                         }
                       }
                       return h;
                     });
}

/// The largest magnitude; a NaN is larger than any.
template <class Derived>
double largest_entry(const Eigen::MatrixBase<Derived>& values) {
  double largest = 0;
  // The value is named, because a view in the loop's head would outlive the value.
  const typename Derived::PlainObject entries = values;
  for (const auto& x : entries.reshaped()) {
    largest = larger(largest, std::abs(static_cast<double>(x)));
  }
  return largest;
}

}  // namespace hamjet::test
