#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/algebra/truncated_power_series.hpp"
#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/detail/algebra/matrix.hpp"

namespace hamjet {

/// The linear part of a map, components x variables: row i holds the coefficients of degree 1 of
/// component i.
template <class T>
Matrix<T> linear_part(const std::vector<Series<T>>& map) {
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
void require_composable(const std::vector<Series<T>>& outer, const std::vector<Series<T>>& inner) {
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

/// Composes outer(inner(x)), truncated at the order of the inner map's space, by Horner's scheme in
/// several variables:
///
///   node(a) = c_a + sum over v >= last variable of a of y_v node(a + e_v) ,   outer(y) = node(0) ,
///
/// where y are the inner series. A node at depth k needs degrees up to N - k only, and all
/// components of the outer map are computed together as the lanes of a pack. At order 6 in 6
/// variables this takes 3 million multiply-adds of numbers. Degrees above the highest degree of the
/// outer map that is not zero cost nothing.
///
/// The inner map must have no constant terms; throws Error(usage) otherwise or if the sizes do not
/// fit. T is double or Extended.
template <class T>
std::vector<Series<T>> compose(const std::vector<Series<T>>& outer,
                               const std::vector<Series<T>>& inner);

/// Multiply-adds of numbers that one component takes in compose, for an outer map with terms up to
/// `degree` in `variables` variables and inner series in the space `inner`.
double composition_multiply_adds(std::size_t variables, int degree, const SeriesSpace& inner);

namespace detail {

/// The composition up to degree `highest` of the result; terms above this degree are zero. The maps
/// must fit as `compose` demands.
template <class T>
std::vector<Series<T>> compose_up_to(const std::vector<Series<T>>& outer,
                                     const std::vector<Series<T>>& inner, int highest);

}  // namespace detail

/// The inverse of a map of v components in v variables without constant terms: map(inverse(w)) = w
/// up to the order. With A the linear part and N the rest, the fixed point of
///
///   x = A^-1 (w - N(x))
///
/// is found by iteration: each iteration makes one more degree right, since N begins at degree 2.
/// Throws Error(numerical) if A is singular. Linear rows of `map` (as in a partial inversion) cost
/// nothing.
template <class T>
std::vector<Series<T>> inverse(const std::vector<Series<T>>& map);

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
