#pragma once

#include <cstddef>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/double_double.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"

namespace hamjet {

/// The potential U = mu / |r| of a point mass at the origin, such as the Sun with r counted from
/// it.
class PointMassField final : public LocalField {
 public:
  /// Throws Error(usage) unless mu is positive and finite.
  explicit PointMassField(double mu);

  double mu() const { return mu_; }

  void expand(std::size_t count, const double* x, const double* y, const double* z, int degree,
              double* out) const override;
  void expand(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
              int degree, Extended* out) const override;
  void expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
              const DoubleDouble* z, int degree, DoubleDouble* out) const override;
  /// A sphere's own field has no waves.
  int waves_on_a_circle() const override { return 0; }
  double multiply_adds(int degree) const override;

  /// As expand, but of the potential that moves a satellite at r relative to the centre of the axes
  /// when the mass at s attracts both,
  ///
  ///   U = mu (1 / |r - s| - 1 / |s| - r.s / |s|^3) .
  ///
  /// The position is (x, y, z), that of the mass (sx, sy, sz). Coefficients of degree 0 and 1 are
  /// formed without the cancellation of direct and indirect part, those of higher degree are
  /// expand's at r - s.
  void expand_tide(std::size_t count, const double* x, const double* y, const double* z,
                   const double* sx, const double* sy, const double* sz, int degree,
                   double* out) const;
  void expand_tide(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
                   const Extended* sx, const Extended* sy, const Extended* sz, int degree,
                   Extended* out) const;
  void expand_tide(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                   const DoubleDouble* z, const DoubleDouble* sx, const DoubleDouble* sy,
                   const DoubleDouble* sz, int degree, DoubleDouble* out) const;

 private:
  double mu_;
};

}  // namespace hamjet
