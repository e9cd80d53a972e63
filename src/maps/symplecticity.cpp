#include "hamjet/maps/symplecticity.hpp"

#include <algorithm>
#include <cmath>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/algebra/composition.hpp"

namespace hamjet {
namespace {

/// Adds factor times the product a b to the target, up to a degree.
template <class T>
void add_product(Series<T>& target, const T& factor, const Series<T>& a, const Series<T>& b,
                 int highest, std::vector<T>& scratch) {
  const SeriesSpace& space = target.space();
  target[0] += factor * a[0] * b[0];
  for (int d = 1; d <= highest; ++d) {
    interior_product(space, d, a.coefficients().data(), b.coefficients().data(), scratch.data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      target[k] += factor * (scratch[k] + a[0] * b[k] + a[k] * b[0]);
    }
  }
}

Series<double> absolute_values(const Series<Extended>& series) {
  Series<double> result(series.space_pointer());
  for (std::size_t k = 0; k < series.size(); ++k) {
    result[k] = std::abs(static_cast<double>(series[k]));
  }
  return result;
}

}  // namespace

template <class T>
std::vector<SymplecticityDefect> symplecticity_by_degree(const std::vector<Series<T>>& jet) {
  const std::size_t size = jet.size();
  if (size == 0 || size % 2 != 0 || jet[0].space().variables() != size) {
    throw Error(ErrorKind::usage,
                "symplecticity: a jet of 2n components in all 2n variables is needed");
  }
  const std::size_t n = size / 2;
  const SeriesSpace& space = jet[0].space();
  const int highest = space.order() - 1;
  std::vector<std::vector<Series<Extended>>> derivatives(size);
  std::vector<std::vector<Series<double>>> magnitudes(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Series<Extended> component = convert_series<Extended>(jet[i]);
    for (std::size_t v = 0; v < size; ++v) {
      derivatives[i].push_back(derivative(component, v));
      magnitudes[i].push_back(absolute_values(derivatives[i].back()));
    }
  }
  std::vector<SymplecticityDefect> result(static_cast<std::size_t>(highest + 1));
  std::vector<double> largest(result.size(), 0);
  std::vector<Extended> scratch(space.size());
  std::vector<double> double_scratch(space.size());
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j) {
      Series<Extended> bracket(jet[0].space_pointer());
      Series<double> terms(jet[0].space_pointer());
      const bool is_conjugate = j == i + n;
      if (is_conjugate) {
        bracket[0] = -1;
        terms[0] = 1;
      }
      for (std::size_t v = 0; v < n; ++v) {
        add_product(bracket, Extended(1), derivatives[i][v], derivatives[j][n + v], highest,
                    scratch);
        add_product(bracket, Extended(-1), derivatives[i][n + v], derivatives[j][v], highest,
                    scratch);
        add_product(terms, 1.0, magnitudes[i][v], magnitudes[j][n + v], highest, double_scratch);
        add_product(terms, 1.0, magnitudes[i][n + v], magnitudes[j][v], highest, double_scratch);
      }
      for (std::size_t k = 0; k < space.first(space.order()); ++k) {
        SymplecticityDefect& entry = result[static_cast<std::size_t>(space.degree(k))];
        const double value = std::abs(static_cast<double>(bracket[k]));
        entry.absolute = std::max(entry.absolute, value);
        double& scale = largest[static_cast<std::size_t>(space.degree(k))];
        scale = std::max(scale, terms[k]);
      }
    }
  }
  for (std::size_t d = 0; d < result.size(); ++d) {
    result[d].degree = static_cast<int>(d);
    result[d].scaled = largest[d] > 0 ? result[d].absolute / largest[d] : result[d].absolute;
  }
  return result;
}

template std::vector<SymplecticityDefect> symplecticity_by_degree(
    const std::vector<Series<double>>&);
template std::vector<SymplecticityDefect> symplecticity_by_degree(
    const std::vector<Series<Extended>>&);

}  // namespace hamjet
