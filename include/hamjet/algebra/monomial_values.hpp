#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hamjet/algebra/truncated_power_series.hpp"

namespace hamjet {

/// The monomials of a space at one point, each from its parent by one product: evaluates several
/// series there, truncated at any degree, with their derivatives. For many points see MapEvaluator.
class MonomialValues {
 public:
  explicit MonomialValues(SpacePointer space);

  /// One number per variable; throws Error(usage) for another count.
  void set_point(std::span<const double> point);

  /// The degrees 0..degree of a series at the point, summed from the highest degree down.
  double value(const Series<double>& series, int degree) const;
  /// The homogeneous part of one degree.
  double slice(const Series<double>& series, int degree) const;
  /// The partial derivative by a variable of the degrees 0..degree.
  double derivative(const Series<double>& series, std::size_t variable, int degree) const;

 private:
  SpacePointer space_;
  std::vector<std::size_t> parent_;    ///< of each monomial: without one factor of ...
  std::vector<std::size_t> variable_;  ///< ... this variable
  std::vector<std::size_t> lowered_;   ///< [monomial][variable]: exponent less one, where there is
  std::vector<double> values_;
};

}  // namespace hamjet
