#pragma once

#include <vector>

#include "hamjet/detail/algebra/matrix.hpp"

namespace hamjet {

/// Nodes and weights of a quadrature for independent standard normal variables; the nodes are the
/// columns of `points`.
struct NormalQuadrature {
  Matrix<double> points;
  Vector<double> weights;
};

/// The product of Gauss-Hermite rules with this number of nodes n for each variable, exact for
/// degrees up to 2n - 1 in each. The rules follow from the eigenvalues of the recurrence's matrix.
/// Source: G. H. Golub and J. H. Welsch, Mathematics of Computation 23 (1969) 221.
NormalQuadrature product_quadrature(const std::vector<int>& nodes);

}  // namespace hamjet
