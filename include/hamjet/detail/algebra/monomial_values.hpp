#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// The values of a space's monomials at one point, each formed from its parent by one product.
/// Several series and their derivatives can then be evaluated there, truncated at any degree. For
/// many points see MapEvaluator.
class MonomialValues {
 public:
  explicit MonomialValues(SpacePointer space);

  /// Sets the point, one number per variable; throws Error(usage) for another count.
  void set_point(std::span<const double> point);

  /// The terms of degree 0..degree of a series at the point, summed from the highest degree down.
  double value(const Series<double>& series, int degree) const;
  /// A bound of the rounding error of that value. A term of degree d, of n terms, contributes to
  /// first order at most (n + d) unit round-offs of its magnitude (Higham, Accuracy and Stability
  /// of Numerical Algorithms, 2nd ed., section 5.1).
  double rounding(const Series<double>& series, int degree) const;
  /// The homogeneous part of one degree of a series at the point.
  double slice(const Series<double>& series, int degree) const;
  /// The partial derivative by a variable, at the point, of the terms of degree 0..degree of a
  /// series.
  double derivative(const Series<double>& series, std::size_t variable, int degree) const;

 private:
  SpacePointer space_;
  std::vector<std::size_t> parent_;    ///< by monomial: the monomial with one factor less
  std::vector<std::size_t> variable_;  ///< by monomial: the variable of that factor
  /// [monomial][variable]: the monomial with that exponent less one, if not 0.
  std::vector<std::size_t> lowered_;
  std::vector<double> values_;
};

}  // namespace hamjet
