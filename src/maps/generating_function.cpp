#include "hamjet/maps/generating_function.hpp"

#include <cstddef>

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
  Series<T> result(space.next_order());
  for (std::size_t i = 0; i < one_form.size(); ++i) {
    const auto raised = result.space().raised(i);
    for (std::size_t k = 1; k < space.size(); ++k) result[raised[k]] += one_form[i][k];
  }
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (result.space().degree(k) > 1) result[k] /= T(static_cast<double>(result.space().degree(k)));
  }
  return result;
}

template std::vector<Series<InstantiatedReal>> one_form(const PartialInversion<InstantiatedReal>&);
template Series<InstantiatedReal> generating_function(const std::vector<Series<InstantiatedReal>>&);

}  // namespace hamjet
