#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hamjet/algebra/composition.hpp"
#include "instantiated_real.hpp"

namespace hamjet {
namespace {

/// The rows of a map that are not linear, without their linear parts, and the indices of these
/// rows.
template <class T>
struct NonlinearRows {
  std::vector<Series<T>> parts;
  std::vector<std::size_t> places;

  explicit NonlinearRows(const std::vector<Series<T>>& map) {
    const std::size_t first = map[0].space().first(2);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const auto coefficients = map[i].coefficients().subspan(first);
      if (std::all_of(coefficients.begin(), coefficients.end(),
                      [](const T& x) { return x == T(0); })) {
        continue;
      }
      parts.push_back(map[i]);
      places.push_back(i);
      for (std::size_t k = 0; k < first; ++k) parts.back()[k] = T(0);
    }
  }
};

}  // namespace

template <class T>
std::vector<Series<T>> inverse(const std::vector<Series<T>>& map) {
  detail::require_composable(map, map);
  if (map.size() != map[0].space().variables()) {
    throw Error(ErrorKind::usage, "inverse: the map must have as many components as variables");
  }
  const SpacePointer& space = map[0].space_pointer();
  const std::size_t n = map.size();
  const Matrix<T> inverse_linear = linear_part(map).partialPivLu().inverse();
  for (Eigen::Index i = 0; i < inverse_linear.size(); ++i) {
    using std::isfinite;
    if (!isfinite(inverse_linear(i))) {
      throw Error(ErrorKind::numerical, "inverse: the linear part of the map is singular");
    }
  }
  std::vector<Series<T>> result(n, Series<T>(space));
  const auto apply_inverse = [&](std::size_t monomial, const std::vector<T>& right) {
    for (std::size_t i = 0; i < n; ++i) {
      T sum(0);
      for (std::size_t j = 0; j < n; ++j) {
        sum +=
            inverse_linear(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * right[j];
      }
      result[i][monomial] = sum;
    }
  };
  std::vector<T> right(n, T(0));
  for (std::size_t v = 0; v < n; ++v) {
    std::fill(right.begin(), right.end(), T(0));
    right[v] = T(1);
    apply_inverse(space->linear_index(v), right);
  }
  const NonlinearRows<T> rows(map);
  for (int d = 2; d <= space->order() && !rows.parts.empty(); ++d) {
    const auto nonlinear = detail::compose_up_to(rows.parts, result, d);
    for (std::size_t k = space->first(d); k < space->first(d + 1); ++k) {
      std::fill(right.begin(), right.end(), T(0));
      for (std::size_t j = 0; j < rows.places.size(); ++j) right[rows.places[j]] = -nonlinear[j][k];
      apply_inverse(k, right);
    }
  }
  return result;
}

template std::vector<Series<InstantiatedReal>> inverse(
    const std::vector<Series<InstantiatedReal>>&);

}  // namespace hamjet
