#pragma once

#include <cstddef>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/double_double.hpp"

namespace hamjet {

/// A static potential U of three coordinates, known by its Taylor polynomial about any point. A
/// Hamiltonian takes it by `field_value` (expression.hpp). Objects are immutable and may be used by
/// several threads at once.
class LocalField {
 public:
  LocalField() = default;
  LocalField(const LocalField&) = delete;
  LocalField& operator=(const LocalField&) = delete;
  virtual ~LocalField() = default;

  /// Sets the coefficients of U(r + d) = sum over k of c_k d^alpha_k, all |alpha_k| <= degree, at
  /// `count` points side by side: the point of a lane is (x[lane], y[lane], z[lane]), and its c_k
  /// goes to out[k * count + lane]. The monomials are ordered by degree, and within one by the
  /// power of x and then of y, both descending, as SeriesSpace orders those of three variables. No
  /// lane depends on another one. Where U is singular, coefficients are not finite.
  virtual void expand(std::size_t count, const double* x, const double* y, const double* z,
                      int degree, double* out) const = 0;
  virtual void expand(std::size_t count, const Extended* x, const Extended* y, const Extended* z,
                      int degree, Extended* out) const = 0;
  /// For references in double-double arithmetic. The default takes the extended ones, point by
  /// point.
  virtual void expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                      const DoubleDouble* z, int degree, DoubleDouble* out) const;

  /// The largest number of waves along a circle about the origin, for example the highest degree of
  /// a gravity field; 0 where no such wave is known.
  virtual int waves_on_a_circle() const = 0;
  /// Multiply-adds of one expansion to a degree at one point, for counts of work.
  virtual double multiply_adds(int degree) const = 0;
};

/// The number of coefficients of a LocalField to a degree.
constexpr std::size_t local_field_size(int degree) {
  const auto n = static_cast<std::size_t>(degree);
  return (n + 1) * (n + 2) * (n + 3) / 6;
}

}  // namespace hamjet
