#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// Coefficients of the s-stage Gauss collocation method of order 2s on [0, 1]: nodes c (zeros of
/// the shifted Legendre polynomial), weights b and the matrix A. Source: Hairer, Lubich and Wanner,
/// Geometric Numerical Integration, section II.1.3. The coefficients are computed in extended
/// precision, not tabulated.
struct GaussTableau {
  std::size_t stages = 0;
  std::vector<Extended> nodes;
  std::vector<Extended> weights;
  std::vector<Extended> matrix;   ///< s x s by rows, a_ij = integral of l_j from 0 to c_i
  std::vector<Extended> squared;  ///< A^2, by rows; it couples the stages of a second-order system
  /// The s x s matrix whose row k gives, from values at the nodes, their Legendre mode of degree k
  /// on [0, 1].
  std::vector<Extended> modes;
  /// Factors of Lagrange's polynomials at the nodes: l_j(x) is lagrange_j times the product over k
  /// != j of x - c_k.
  std::vector<Extended> lagrange;
  std::vector<Extended> start;  ///< values at 0 of Lagrange's polynomials at the nodes

  const Extended& a(std::size_t i, std::size_t j) const { return matrix[i * stages + j]; }
  const Extended& mode(std::size_t degree, std::size_t i) const {
    return modes[degree * stages + i];
  }
};

/// The tableau, computed once for each number of stages. Throws Error(usage) unless
/// 1 <= stages <= 16.
const GaussTableau& gauss_tableau(std::size_t stages);

}  // namespace hamjet
