#include "hamjet/maps/generating_function.hpp"

#include <cstdint>

#include "../algebra/instantiated_real.hpp"

namespace hamjet {

template <class T>
std::vector<Series<T>> one_form(const PartialInversion<T>& inversion) {
  std::vector<Series<T>> sigma;
  const std::size_t n = inversion.kind.degrees_of_freedom();
  for (std::size_t i = 0; i < n; ++i) {
    const Series<T>& rest = inversion.remaining_final[i];
    sigma.push_back(inversion.kind.final_is_momentum[i] ? -rest : rest);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Series<T>& rest = inversion.remaining_initial[i];
    sigma.push_back(inversion.kind.initial_is_momentum[i] ? rest : -rest);
  }
  return sigma;
}

template <class T>
Series<T> generating_function(const std::vector<Series<T>>& one_form) {
  const SeriesSpace& space = one_form[0].space();
  const SpacePointer target = SeriesSpace::create(space.variables(), space.order() + 1);
  Series<T> result(target);
  std::vector<std::uint8_t> exponents;
  for (std::size_t i = 0; i < one_form.size(); ++i) {
    for (std::size_t k = 1; k < space.size(); ++k) {
      const auto from = space.exponents(k);
      exponents.assign(from.begin(), from.end());
      ++exponents[i];
      result[target->index(exponents)] +=
          one_form[i][k] / T(static_cast<double>(space.degree(k) + 1));
    }
  }
  return result;
}

template std::vector<Series<InstantiatedReal>> one_form(const PartialInversion<InstantiatedReal>&);
template Series<InstantiatedReal> generating_function(const std::vector<Series<InstantiatedReal>>&);

}  // namespace hamjet
