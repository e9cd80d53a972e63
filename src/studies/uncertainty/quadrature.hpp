#pragma once

#include <limits>
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

/// Values of a standard normal variable.
struct NormalInterval {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  double probability() const;
};

/// The same for variables of which it is known that each lies in its interval: the weights are
/// those of the conditional distribution, and sum up to 1. The recurrences of the orthogonal
/// polynomials are Stieltjes's, on a finer rule (W. Gautschi, Orthogonal Polynomials, Oxford 2004,
/// section 2.2.3).
NormalQuadrature product_quadrature(const std::vector<int>& nodes,
                                    const std::vector<NormalInterval>& intervals);

}  // namespace hamjet
