#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// Where an evaluation writes its results. Each span has as many numbers as components times
/// points, laid out as MapEvaluator says, or is empty where the result is not wanted.
struct MapValues {
  std::span<double> values;             ///< sum over all degrees 0..N
  std::span<double> last;               ///< the share of degree N, part of `values`
  std::span<double> last_but_one;       ///< the share of degree N-1 (0 for N = 0), part of `values`
  std::span<double> last_but_two = {};  ///< the share of degree N-2 (0 for N < 2), part of `values`
};

/// A polynomial map in double precision, prepared for the evaluation at many points.
///
/// Points and values are structures of arrays: of M points, variable i of point j is at i M + j,
/// and component c of its value at c M + j.
///
/// With m_k the monomials of degree d, graded as in SeriesSpace, each is a variable times a
/// monomial of degree d-1, its parent:
///
///   m_k = x_i m_parent(k) ,   u_c,d = sum over k of degree d of a_c,k m_k ,   u_c = sum_d u_c,d ,
///
/// This takes one multiplication per monomial, and one multiply-add per monomial and component.
/// Monomials of degree N are used at once and not stored. Each degree is summed by itself and the
/// highest is added first, so that small terms are not lost and the shares of the last three
/// degrees come at no extra cost. Points are taken a block at a time, one to a lane of a Pack.
/// Lanes do not mix, so that a NaN stays with its point.
///
/// An evaluator is immutable: threads may share one. A call allocates one scratch of a few dozen
/// kilobytes, whatever the number of points.
class MapEvaluator {
 public:
  /// The components must share one space. Terms above `degree`, if given, are left out. Throws
  /// Error(usage) for no components, and for a degree outside 0 to the order.
  explicit MapEvaluator(const std::vector<Series<double>>& map, std::optional<int> degree = {});

  std::size_t variables() const noexcept { return variables_; }
  std::size_t components() const noexcept { return components_; }
  /// The degree N at which the map is truncated.
  int degree() const noexcept { return degree_; }

  /// Evaluates the map at the points. Throws Error(usage) if the sizes of points and results do not
  /// fit.
  void evaluate(std::span<const double> points, const MapValues& results) const;

  /// Multiply-adds by coefficients for one point: components times monomials of degree 1 to N,
  /// without the products that form the monomials.
  std::size_t multiply_adds_per_point() const noexcept;
  /// Products that form the monomials of degree 2 to N for one point.
  std::size_t products_per_point() const noexcept;

 private:
  std::size_t variables_;
  std::size_t components_;
  int degree_;
  std::size_t monomials_;  ///< number of monomials of degree 0..N
  /// Coefficients by group of components that are evaluated together, then by monomial; the
  /// coefficients of one group stand next to each other.
  std::vector<double> coefficients_;
};

}  // namespace hamjet
