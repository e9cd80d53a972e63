#include <algorithm>

#include "hamjet/algebra/composition.hpp"

namespace hamjet {

double composition_multiply_adds(std::size_t variables, int degree, const SeriesSpace& inner) {
  double total = 0;
  const int deepest = std::min(degree, inner.order());
  for (int k = 1; k <= deepest; ++k) {
    // The cost of one product of a node by the series of one variable.
    const int highest = inner.order() - k + 1;
    double product = static_cast<double>(inner.first(highest + 1)) - 1;
    for (int d = 2; d <= highest && k < deepest; ++d) {
      product += static_cast<double>(inner.products(d).multiply_adds);
    }
    const double nodes =
        SeriesSpace::monomial_count(variables, k) - SeriesSpace::monomial_count(variables, k - 1);
    total += nodes * product;
  }
  return total;
}

}  // namespace hamjet
