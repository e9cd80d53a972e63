#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "hamjet/uncertainty/polynomial_moments.hpp"

// Polynomials of Gaussian variables, rewritten in standard normal variables.

namespace hamjet {

std::vector<Series<double>> polynomials_of_rows(std::span<const double> coefficients,
                                                std::span<const std::uint8_t> exponents,
                                                std::size_t variables) {
  const std::size_t rows = variables == 0 ? 0 : exponents.size() / variables;
  if (rows == 0 || rows * variables != exponents.size() || coefficients.empty() ||
      coefficients.size() % rows != 0) {
    throw Error(ErrorKind::usage,
                "moments: the coefficients must have a column for each row of exponents");
  }
  int order = 0;
  for (std::size_t k = 0; k < rows; ++k) {
    const auto row = exponents.subspan(k * variables, variables);
    order = std::max(order, std::accumulate(row.begin(), row.end(), 0));
  }
  const SpacePointer space = SeriesSpace::create(variables, order);
  std::vector<Series<double>> map(coefficients.size() / rows, Series<double>(space));
  std::vector<bool> is_there(space->size(), false);
  for (std::size_t k = 0; k < rows; ++k) {
    const std::size_t place = space->index(exponents.subspan(k * variables, variables));
    if (is_there[place]) {
      throw Error(ErrorKind::usage, fmt::format("moments: the exponents of row {} stand twice", k));
    }
    is_there[place] = true;
    for (std::size_t c = 0; c < map.size(); ++c) map[c][place] = coefficients[c * rows + k];
  }
  return map;
}

std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance) {
  return in_standard_normals(map, covariance, Vector<double>::Zero(covariance.size()));
}

std::vector<Series<double>> in_standard_normals(const std::vector<Series<double>>& map,
                                                const Covariance& covariance,
                                                const Vector<double>& mean) {
  if (map.empty()) throw Error(ErrorKind::usage, "moments: no polynomials");
  const SeriesSpace& outer = map.front().space();
  if (covariance.size() != static_cast<Eigen::Index>(outer.variables()) ||
      mean.size() != covariance.size()) {
    throw Error(ErrorKind::usage,
                "moments: the covariance must have a row for each variable of the polynomials");
  }
  Matrix<double> factor = covariance.factor();
  if (factor.cols() == 0) factor = Matrix<double>::Zero(covariance.size(), 1);
  // The mean is treated as the factor of one more variable, whose value is 1. A polynomial of
  // degree N in linear forms is a polynomial of degree N, so that nothing is cut off.
  const bool is_moved = (mean.array() != 0).any();
  const auto rank = static_cast<std::size_t>(factor.cols());
  if (is_moved) {
    factor.conservativeResize(Eigen::NoChange, factor.cols() + 1);
    factor.rightCols(1) = mean;
  }
  const SpacePointer space =
      SeriesSpace::create(static_cast<std::size_t>(factor.cols()), outer.order());
  std::vector<Series<double>> inner;
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    inner.emplace_back(space);
    if (outer.order() == 0) continue;
    for (Eigen::Index k = 0; k < factor.cols(); ++k) {
      inner.back()[space->linear_index(static_cast<std::size_t>(k))] = factor(i, k);
    }
  }
  std::vector<Series<double>> composed = compose(map, inner);
  if (!is_moved) return composed;
  const SpacePointer kept = SeriesSpace::create(rank, outer.order());
  std::vector<Series<double>> result(map.size(), Series<double>(kept));
  // The sum runs from the highest degree down, so that small terms are not lost.
  for (std::size_t k = space->size(); k-- > 0;) {
    const std::size_t place = kept->index(space->exponents(k).first(rank));
    for (std::size_t c = 0; c < map.size(); ++c) result[c][place] += composed[c][k];
  }
  return result;
}

}  // namespace hamjet
