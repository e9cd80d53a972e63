#pragma once

#include <cmath>
#include <cstddef>

#include "../real_number.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The largest entries of the blocks of a gradient Dg, of z' = g(z) with z = (q, p) or of
/// q'' = g(q). T is a number or several side by side, each with an own gradient.
template <class T>
struct GradientBlocks {
  T alike;     ///< d q'/dq, d p'/dp, and d q''/dq
  T velocity;  ///< d q'/dp
  T force;     ///< d p'/dq

  /// The largest entry in the unit of momenta that makes the entries of `velocity` and `force`
  /// alike, so that it does not change with the unit of length.
  T largest() const {
    using std::sqrt;
    return larger_magnitude(alike, T(sqrt(velocity) * sqrt(force)));
  }

  /// 1 / sigma, see ComponentUnits; 1 where it is undefined.
  T inverse_sigma() const {
    using std::sqrt;
    const T result = sqrt(velocity) / sqrt(force);
    return result > 0 && is_finite(result) ? result : T(1);
  }
};

/// The components by which a step is measured, all but the parameters, which are at rest. Momenta
/// are compared with positions in the unit sigma = sqrt(|dp'/dq| / |dq'/dp|): with another unit of
/// length, the steps are the same.
class ComponentUnits {
 public:
  explicit ComponentUnits(const DynamicalSystem& system)
      : positions_(system.degrees_of_freedom),
        count_(system.second_order ? positions_ : 2 * positions_) {}

  std::size_t count() const { return count_; }

  /// `entry(c, k)` is d g_c / d z_k.
  template <class T, class Entry>
  GradientBlocks<T> blocks(const Entry& entry) const {
    GradientBlocks<T> result{T(0), T(0), T(0)};
    for (std::size_t c = 0; c < count_; ++c) {
      for (std::size_t k = 0; k < count_; ++k) {
        T& largest = is_momentum(c) == is_momentum(k) ? result.alike
                     : is_momentum(k)                 ? result.velocity
                                                      : result.force;
        largest = larger_magnitude(largest, entry(c, k));
      }
    }
    return result;
  }

  /// The largest sum of magnitudes of a row of a gradient, in these units.
  template <class T, class Entry>
  T row_norm(const Entry& entry, const T& inverse_sigma) const {
    T norm(0);
    for (std::size_t c = 0; c < count_; ++c) {
      T row(0);
      for (std::size_t k = 0; k < count_; ++k) {
        row += larger_magnitude(T(0), T(entry(c, k) / inverse_unit(k, inverse_sigma)));
      }
      norm = larger_magnitude(norm, T(row * inverse_unit(c, inverse_sigma)));
    }
    return norm;
  }

  /// The inverse of the unit of a component, where 1 / sigma is `inverse_sigma`.
  template <class T>
  T inverse_unit(std::size_t c, const T& inverse_sigma) const {
    return is_momentum(c) ? inverse_sigma : T(1);
  }

 private:
  bool is_momentum(std::size_t c) const { return c >= positions_; }

  std::size_t positions_;
  std::size_t count_;
};

}  // namespace hamjet
