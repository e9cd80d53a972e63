#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet::test {

/// Composes outer(inner(x)) monomial by monomial with products of whole series, truncated at the
/// order of the inner map: independent of the algorithm of `compose`, and slow.
template <class T>
std::vector<Series<T>> compose_directly(const std::vector<Series<T>>& outer,
                                        const std::vector<Series<T>>& inner) {
  const SpacePointer space = inner[0].space_pointer();
  std::vector<Series<T>> result(outer.size(), Series<T>(space));
  for (std::size_t k = 0; k < outer[0].space().size(); ++k) {
    Series<T> monomial(space, T(1));
    const auto exponents = outer[0].space().exponents(k);
    for (std::size_t v = 0; v < exponents.size(); ++v) {
      for (int e = 0; e < exponents[v]; ++e) monomial = monomial * inner[v];
    }
    for (std::size_t i = 0; i < outer.size(); ++i) result[i] = result[i] + monomial * outer[i][k];
  }
  return result;
}

}  // namespace hamjet::test
