#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/algebra/eigen.hpp"
#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/matrix.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// The linear part of a map, components x variables: row i holds the coefficients of degree 1 of
/// component i.
template <class T>
Matrix<T> linear_part(std::span<const Series<T>> map) {
  const std::size_t variables = map.front().space().variables();
  Matrix<T> result(map.size(), variables);
  for (std::size_t i = 0; i < map.size(); ++i) {
    for (std::size_t j = 0; j < variables; ++j) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          map[i][map[i].space().linear_index(j)];
    }
  }
  return result;
}

namespace detail {

template <class T>
void require_composable(std::span<const Series<T>> outer, std::span<const Series<T>> inner) {
  if (outer.empty() || inner.empty() || inner.size() != outer[0].space().variables()) {
    throw Error(ErrorKind::usage,
                "composition: the inner map must have as many components as the "
                "outer one has variables");
  }
  for (const auto& series : outer) require_same_space(series.space(), outer[0].space());
  for (const auto& series : inner) {
    require_same_space(series.space(), inner[0].space());
    if (series[0] != T(0)) {
      throw Error(ErrorKind::usage,
                  "composition: the inner map has a constant term; subtract it "
                  "first, for a truncated series knows its function near 0 only");
    }
  }
}

}  // namespace detail

/// Composes outer(inner(x)), truncated at the order of the inner map's space. The inner map must
/// have no constant terms; throws Error(usage) otherwise or if the sizes do not fit.
template <class T>
std::vector<Series<T>> compose(std::span<const Series<T>> outer, std::span<const Series<T>> inner);

/// The inverse of a map of v components in v variables without constant terms:
/// map(inverse(w)) = w up to the order. With A the linear part and N the rest, the fixed point of
///
///   x = A^-1 (w - N(x))
///
/// gains one degree an iteration, since N begins at degree 2. Throws Error(numerical) if A is
/// singular. Rows of `map` that are single variables (as in a partial inversion) cost nothing.
template <class T>
std::vector<Series<T>> inverse(std::span<const Series<T>> map);

/// A series with its coefficients rounded to another precision.
template <class To, class From>
Series<To> convert_series(const Series<From>& series) {
  std::vector<To> coefficients;
  coefficients.reserve(series.size());
  for (const From& c : series.coefficients()) coefficients.push_back(convert<To>(c));
  return {series.space_pointer(), std::move(coefficients)};
}

/// A map with the coefficients of all components rounded to another precision.
template <class To, class From>
std::vector<Series<To>> convert_map(const std::vector<Series<From>>& map) {
  std::vector<Series<To>> result;
  result.reserve(map.size());
  for (const auto& component : map) result.push_back(convert_series<To>(component));
  return result;
}

/// A map without its constant terms: the map of deviations.
template <class T>
std::vector<Series<T>> without_constants(std::vector<Series<T>> map) {
  for (auto& component : map) component[0] = T(0);
  return map;
}

}  // namespace hamjet
