#include "hamjet/algebra/composition.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hamjet {
namespace {

/// Walks all monomials of the outer space depth first, each made from its parent by one truncated
/// product, so that no more than one series a degree is alive at a time. A monomial of degree k in
/// inner series without constant terms has no terms below degree k.
template <class T>
class Composition {
 public:
  Composition(std::span<const Series<T>> outer, std::span<const Series<T>> inner, int lowest,
              int highest)
      : outer_(outer), inner_(inner), lowest_(lowest), highest_(highest) {
    for (std::size_t i = 0; i < outer.size(); ++i) result_.emplace_back(inner[0].space_pointer());
    for (int d = 0; d <= highest; ++d) powers_.emplace_back(inner[0].space_pointer());
  }

  std::vector<Series<T>> run() {
    if (lowest_ == 0) {
      for (std::size_t i = 0; i < outer_.size(); ++i) result_[i][0] = outer_[i][0];
    }
    std::vector<std::uint8_t> exponents(inner_.size(), 0);
    descend(exponents, 0, 0);
    return std::move(result_);
  }

 private:
  void descend(std::vector<std::uint8_t>& exponents, std::size_t first_variable, int degree) {
    if (degree == std::min(highest_, outer_[0].order())) return;
    for (std::size_t v = first_variable; v < inner_.size(); ++v) {
      ++exponents[v];
      form_power(v, degree + 1);
      if (degree + 1 >= lowest_) accumulate(outer_[0].space().index(exponents), degree + 1);
      descend(exponents, v, degree + 1);
      --exponents[v];
    }
  }

  /// powers_[degree] = powers_[degree - 1] * inner_[v], slices degree..highest.
  void form_power(std::size_t v, int degree) {
    const SeriesSpace& space = inner_[0].space();
    T* target = powers_[static_cast<std::size_t>(degree)].coefficients().data();
    const T* factor = inner_[v].coefficients().data();
    if (degree == 1) {
      std::copy_n(factor, space.first(highest_ + 1), target);
      return;
    }
    const T* parent = powers_[static_cast<std::size_t>(degree - 1)].coefficients().data();
    for (int d = degree; d <= highest_; ++d) {
      interior_product_from(space, d, degree - 1, parent, factor, target);
    }
  }

  void accumulate(std::size_t monomial, int degree) {
    const SeriesSpace& space = inner_[0].space();
    const Series<T>& power = powers_[static_cast<std::size_t>(degree)];
    for (std::size_t i = 0; i < outer_.size(); ++i) {
      const T& coefficient = outer_[i][monomial];
      if (coefficient == T(0)) continue;
      for (std::size_t k = space.first(degree); k < space.first(highest_ + 1); ++k) {
        result_[i][k] += coefficient * power[k];
      }
    }
  }

  std::span<const Series<T>> outer_;
  std::span<const Series<T>> inner_;
  int lowest_;
  int highest_;
  std::vector<Series<T>> result_;
  std::vector<Series<T>> powers_;
};

}  // namespace

template <class T>
std::vector<Series<T>> compose(std::span<const Series<T>> outer, std::span<const Series<T>> inner) {
  detail::require_composable(outer, inner);
  return Composition<T>(outer, inner, 0, inner[0].order()).run();
}

template <class T>
std::vector<Series<T>> inverse(std::span<const Series<T>> map) {
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
  for (int d = 2; d <= space->order(); ++d) {
    const auto nonlinear = Composition<T>(map, std::span<const Series<T>>(result), 2, d).run();
    for (std::size_t k = space->first(d); k < space->first(d + 1); ++k) {
      for (std::size_t j = 0; j < n; ++j) right[j] = -nonlinear[j][k];
      apply_inverse(k, right);
    }
  }
  return result;
}

template std::vector<Series<double>> compose(std::span<const Series<double>>,
                                             std::span<const Series<double>>);
template std::vector<Series<Extended>> compose(std::span<const Series<Extended>>,
                                               std::span<const Series<Extended>>);
template std::vector<Series<double>> inverse(std::span<const Series<double>>);
template std::vector<Series<Extended>> inverse(std::span<const Series<Extended>>);

}  // namespace hamjet
