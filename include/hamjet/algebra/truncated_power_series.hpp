#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hamjet/algebra/series_space.hpp"
#include "hamjet/detail/algebra/slice_product.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

/// An element of a truncated polynomial ring (see SeriesSpace) with coefficients in T: double, a
/// Pack, or an extended-precision number. The ring is commutative with
///
///   (a b)_k = sum over i j = k of a_i b_j ,
///
/// products of degree above the order being dropped; every operation is exact up to the rounding of
/// T. Combining series of two different spaces throws Error(usage). Coefficients are Taylor
/// coefficients: factorials are included in them.
template <class T>
class TruncatedPowerSeries {
 public:
  /// The constant series.
  explicit TruncatedPowerSeries(SpacePointer space, const T& constant = T(0))
      : space_(std::move(space)), coefficients_(space_->size(), T(0)) {
    coefficients_[0] = constant;
  }
  /// One coefficient per monomial of the space, in its order; throws Error(usage) for another
  /// count.
  TruncatedPowerSeries(SpacePointer space, std::vector<T> coefficients)
      : space_(std::move(space)), coefficients_(std::move(coefficients)) {
    if (coefficients_.size() != space_->size()) {
      throw Error(ErrorKind::usage, "series: the number of coefficients is not that of the space");
    }
  }

  /// The series constant + x_i. Throws Error(usage) unless i < variables.
  static TruncatedPowerSeries variable(SpacePointer space, std::size_t i,
                                       const T& constant = T(0)) {
    if (i >= space->variables()) throw Error(ErrorKind::usage, "series: no such variable");
    TruncatedPowerSeries result(std::move(space), constant);
    if (result.order() >= 1) result[result.space().linear_index(i)] = T(1);
    return result;
  }

  const SeriesSpace& space() const noexcept { return *space_; }
  const SpacePointer& space_pointer() const noexcept { return space_; }
  int order() const noexcept { return space_->order(); }
  std::size_t size() const noexcept { return coefficients_.size(); }

  T& operator[](std::size_t monomial) { return coefficients_[monomial]; }
  const T& operator[](std::size_t monomial) const { return coefficients_[monomial]; }
  const T& constant() const { return coefficients_[0]; }
  std::span<T> coefficients() noexcept { return coefficients_; }
  std::span<const T> coefficients() const noexcept { return coefficients_; }
  /// The homogeneous part of one degree.
  std::span<T> slice(int degree) {
    return std::span<T>(coefficients_).subspan(space_->first(degree), space_->count(degree));
  }
  std::span<const T> slice(int degree) const {
    return std::span<const T>(coefficients_).subspan(space_->first(degree), space_->count(degree));
  }

  TruncatedPowerSeries& operator+=(const TruncatedPowerSeries& o) {
    require_same_space(*space_, *o.space_);
    for (std::size_t i = 0; i < size(); ++i) coefficients_[i] += o[i];
    return *this;
  }
  TruncatedPowerSeries& operator-=(const TruncatedPowerSeries& o) {
    require_same_space(*space_, *o.space_);
    for (std::size_t i = 0; i < size(); ++i) coefficients_[i] -= o[i];
    return *this;
  }
  TruncatedPowerSeries& operator+=(const T& o) {
    coefficients_[0] += o;
    return *this;
  }
  TruncatedPowerSeries& operator-=(const T& o) {
    coefficients_[0] -= o;
    return *this;
  }
  TruncatedPowerSeries& operator*=(const T& o) {
    for (auto& c : coefficients_) c *= o;
    return *this;
  }
  TruncatedPowerSeries& operator/=(const T& o) {
    for (auto& c : coefficients_) c /= o;
    return *this;
  }
  TruncatedPowerSeries& operator*=(const TruncatedPowerSeries& o) { return *this = *this * o; }
  TruncatedPowerSeries& operator/=(const TruncatedPowerSeries& o) { return *this = *this / o; }

 private:
  SpacePointer space_;
  std::vector<T> coefficients_;
};

template <class T>
using Series = TruncatedPowerSeries<T>;

template <class T>
Series<T> operator+(Series<T> a, const Series<T>& b) {
  return a += b;
}
template <class T>
Series<T> operator-(Series<T> a, const Series<T>& b) {
  return a -= b;
}
template <class T>
Series<T> operator+(Series<T> a, const std::type_identity_t<T>& b) {
  return a += b;
}
template <class T>
Series<T> operator+(const std::type_identity_t<T>& a, Series<T> b) {
  return b += a;
}
template <class T>
Series<T> operator-(Series<T> a, const std::type_identity_t<T>& b) {
  return a -= b;
}
template <class T>
Series<T> operator*(Series<T> a, const std::type_identity_t<T>& b) {
  return a *= b;
}
template <class T>
Series<T> operator*(const std::type_identity_t<T>& a, Series<T> b) {
  return b *= a;
}
template <class T>
Series<T> operator/(Series<T> a, const std::type_identity_t<T>& b) {
  return a /= b;
}
template <class T>
Series<T> operator-(Series<T> a) {
  return a *= T(-1);
}
template <class T>
Series<T> operator-(const std::type_identity_t<T>& a, Series<T> b) {
  return -std::move(b) + a;
}

template <class T>
Series<T> operator*(const Series<T>& a, const Series<T>& b) {
  require_same_space(a.space(), b.space());
  const SeriesSpace& space = a.space();
  Series<T> c(a.space_pointer(), T(a[0] * b[0]));
  for (int d = 1; d <= space.order(); ++d) {
    interior_product(space, d, a.coefficients().data(), b.coefficients().data(),
                     c.coefficients().data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
      c[k] += a[0] * b[k] + a[k] * b[0];
    }
  }
  return c;
}

/// a^2, at about half the cost of a product.
template <class T>
Series<T> square(const Series<T>& a) {
  const SeriesSpace& space = a.space();
  Series<T> c(a.space_pointer(), T(a[0] * a[0]));
  const T twice = a[0] + a[0];
  for (int d = 1; d <= space.order(); ++d) {
    interior_square(space, d, a.coefficients().data(), c.coefficients().data());
    for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) c[k] += twice * a[k];
  }
  return c;
}

}  // namespace hamjet
