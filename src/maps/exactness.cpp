#include "hamjet/maps/exactness.hpp"

#include <algorithm>
#include <cmath>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/algebra/calculus.hpp"

namespace hamjet {

template <class T>
std::vector<ExactnessResidual> exactness_residual(const std::vector<Series<T>>& one_form,
                                                  std::span<const double> scales) {
  const SeriesSpace& space = one_form[0].space();
  const std::size_t size = one_form.size();
  if (!scales.empty() && scales.size() != size) {
    throw Error(ErrorKind::usage, "exactness residual: one scale per variable is needed");
  }
  std::vector<ExactnessResidual> result(static_cast<std::size_t>(space.order()));
  std::vector<double> largest(result.size(), 0);
  for (std::size_t d = 0; d < result.size(); ++d) {
    result[d].degree = static_cast<int>(d);
    if (!scales.empty()) result[d].at_formation_scale = 0;
  }
  const auto weight = [&](std::size_t monomial) {
    double product = 1;
    for (std::size_t v = 0; v < size; ++v) {
      product *= std::pow(scales[v], space.exponents(monomial)[v]);
    }
    return product;
  };
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      const Series<T> ij = derivative(one_form[i], j);
      for (std::size_t k = 0; k < space.first(space.order()); ++k) {
        double& scale = largest[static_cast<std::size_t>(space.degree(k))];
        scale = std::max(scale, std::abs(static_cast<double>(ij[k])));
      }
      if (j <= i) continue;
      const Series<T> residual = ij - derivative(one_form[j], i);
      for (std::size_t k = 0; k < space.first(space.order()); ++k) {
        ExactnessResidual& entry = result[static_cast<std::size_t>(space.degree(k))];
        const double value = std::abs(static_cast<double>(residual[k]));
        entry.absolute = std::max(entry.absolute, value);
        if (!scales.empty()) {
          entry.at_formation_scale =
              std::max(*entry.at_formation_scale, value * scales[i] * scales[j] * weight(k));
        }
      }
    }
  }
  for (std::size_t d = 0; d < result.size(); ++d) {
    result[d].scaled = largest[d] > 0 ? result[d].absolute / largest[d] : result[d].absolute;
  }
  return result;
}

template std::vector<ExactnessResidual> exactness_residual(
    const std::vector<Series<InstantiatedReal>>&, std::span<const double>);

}  // namespace hamjet
