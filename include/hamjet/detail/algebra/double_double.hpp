#pragma once

#include <cmath>
#include <compare>
#include <cstddef>
#include <experimental/simd>
#include <limits>
#include <type_traits>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/instruction_set.hpp"

namespace hamjet {

/// Numbers as unevaluated sums high + low of two doubles, |low| at most half a unit in the last
/// place of high: about 31 digits, with the range of double. V is double, or a vector of doubles,
/// whose lanes are independent numbers.
///
/// With u = 2^-53, sums are good to 3 u^2, products to 5 u^2 and quotients to some 10 u^2, each
/// relative to the result. Source: M. Joldes, J.-M. Muller and V. Popescu, Tight and rigorous error
/// bounds for basic building blocks of double-word arithmetic, ACM TOMS 44 (2017) 15, algorithms 6
/// and 11. An overflow gives NaN rather than infinity.
template <class V>
class Doubled {
 public:
  V high{};
  V low{};

  Doubled() = default;
  Doubled(const V& value) : high(value), low(0.0) {}  // NOLINT(google-explicit-constructor)
  Doubled(const V& h, const V& l) : high(h), low(l) {}
  template <class Number>
  requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, V>)
      Doubled(Number value)  // NOLINT(google-explicit-constructor): as double(value) would
      : high(static_cast<double>(value)), low(0.0) {}
  /// A number with all lanes alike.
  template <class W>
  requires(std::is_same_v<W, double> &&
           !std::is_same_v<V, W>) explicit Doubled(const Doubled<W>& value)
      : high(value.high), low(value.low) {}
  explicit Doubled(const Extended& value) requires(std::is_same_v<V, double>)
      : high(static_cast<double>(value)),
        low(static_cast<double>(Extended(value - Extended(high)))) {}

  explicit operator Extended() const requires(std::is_same_v<V, double>) {
    return Extended(high) + Extended(low);
  }
  template <class Number>
  requires(std::is_same_v<V, double>&& std::is_arithmetic_v<Number>) explicit operator Number()
      const {
    return static_cast<Number>(high);
  }

  friend Doubled operator+(const Doubled& a, const Doubled& b) {
    const Doubled s = exact_sum(a.high, b.high);
    const Doubled t = exact_sum(a.low, b.low);
    const Doubled v = normalised(s.high, s.low + t.high);
    return normalised(v.high, t.low + v.low);
  }
  friend Doubled operator-(const Doubled& a) { return {-a.high, -a.low}; }
  friend Doubled operator-(const Doubled& a, const Doubled& b) { return a + -b; }
  friend Doubled operator*(const Doubled& a, const Doubled& b) {
    const Doubled p = exact_product(a.high, b.high);
    return normalised(p.high, p.low + add_product(V(a.low * b.high), a.high, b.low));
  }
  /// The sum of three quotients of doubles, each computed from the remainder that the ones before
  /// it left.
  friend Doubled operator/(const Doubled& a, const Doubled& b) {
    const V first = a.high / b.high;
    Doubled left = a - b * Doubled(first);
    const V second = left.high / b.high;
    left = left - b * Doubled(second);
    const V third = left.high / b.high;
    return normalised(first, second) + Doubled(third);
  }
  /// A step of Newton's method from the root of the high part; 0 for 0.
  friend Doubled sqrt(const Doubled& a) {
    using std::sqrt;
    const V root = sqrt(a.high);
    const Doubled left = a - exact_product(root, root);
    if constexpr (std::is_same_v<V, double>) {
      if (root == 0) return Doubled(root);
      return normalised(root, left.high / (2 * root));
    } else {
      V change = left.high / (2 * root);
      where(root == V(0.0), change) = V(0.0);
      return normalised(root, change);
    }
  }

  Doubled& operator+=(const Doubled& o) { return *this = *this + o; }
  Doubled& operator-=(const Doubled& o) { return *this = *this - o; }
  Doubled& operator*=(const Doubled& o) { return *this = *this * o; }
  Doubled& operator/=(const Doubled& o) { return *this = *this / o; }

  friend bool operator==(const Doubled& a, const Doubled& b) requires(std::is_same_v<V, double>) {
    return a.high == b.high && a.low == b.low;
  }
  friend std::partial_ordering operator<=>(const Doubled& a,
                                           const Doubled& b) requires(std::is_same_v<V, double>) {
    return a.high == b.high ? a.low <=> b.low : a.high <=> b.high;
  }

  /// The sum of two doubles without error (Knuth).
  static Doubled exact_sum(const V& a, const V& b) {
    const V sum = a + b;
    const V of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
  }

 private:
  /// The sum of two doubles without error where |a| is not below |b| (Dekker).
  static Doubled normalised(const V& a, const V& b) {
    const V sum = a + b;
    return {sum, b - (sum - a)};
  }

  /// sum + a b, fused either in every copy of the code or in none: otherwise copies would differ in
  /// their last digits.
  static V add_product(const V& sum, const V& a, const V& b) {
#ifdef __FP_FAST_FMA
    using std::fma;
    return fma(a, b, sum);
#else
    return sum + a * b;
#endif
  }

  /// The product of two doubles without error.
  static Doubled exact_product(const V& a, const V& b) {
    const V product = a * b;
#ifdef __FP_FAST_FMA
    using std::fma;
    return {product, V(fma(a, b, V(-product)))};
#else
    // Halves of 26 bits, whose products are exact (Veltkamp and Dekker).
    const auto upper = [](const V& x) {
      const V scaled = V(0x1p27 + 1) * x;
      return V(scaled - (scaled - x));
    };
    const V a1 = upper(a);
    const V a2 = a - a1;
    const V b1 = upper(b);
    const V b2 = b - b1;
    return {product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2)};
#endif
  }
};

using DoubleDouble = Doubled<double>;

}  // namespace hamjet

/// Numeric limits; the range is that of double.
template <>
class std::numeric_limits<hamjet::DoubleDouble> : public std::numeric_limits<double> {
 public:
  static constexpr bool is_iec559 = false;
  static constexpr int digits = 104;
  static constexpr int digits10 = 31;
  static constexpr int max_digits10 = 33;
  /// Four times the error bound of one sum, and twice that of one product.
  static hamjet::DoubleDouble epsilon() { return 0x1p-103; }
  static hamjet::DoubleDouble min() { return std::numeric_limits<double>::min(); }
  static hamjet::DoubleDouble max() { return std::numeric_limits<double>::max(); }
  static hamjet::DoubleDouble lowest() { return std::numeric_limits<double>::lowest(); }
  static hamjet::DoubleDouble infinity() { return std::numeric_limits<double>::infinity(); }
  static hamjet::DoubleDouble quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
};

namespace hamjet {

inline bool isfinite(const DoubleDouble& x) { return std::isfinite(x.high + x.low); }
inline bool isnan(const DoubleDouble& x) { return std::isnan(x.high + x.low); }
inline DoubleDouble abs(const DoubleDouble& x) { return x < 0 ? -x : x; }

// These functions are called a few times per step, so that their detour through extended precision
// costs nothing that could be measured.
#define HAMJET_DOUBLE_DOUBLE_FUNCTION(name)                        \
  inline DoubleDouble name(const DoubleDouble& x) {                \
    return DoubleDouble(Extended(name(static_cast<Extended>(x)))); \
  }
HAMJET_DOUBLE_DOUBLE_FUNCTION(exp)
HAMJET_DOUBLE_DOUBLE_FUNCTION(log)
HAMJET_DOUBLE_DOUBLE_FUNCTION(sin)
HAMJET_DOUBLE_DOUBLE_FUNCTION(cos)
HAMJET_DOUBLE_DOUBLE_FUNCTION(sinh)
HAMJET_DOUBLE_DOUBLE_FUNCTION(cosh)
#undef HAMJET_DOUBLE_DOUBLE_FUNCTION
inline DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x) {
  return DoubleDouble(Extended(atan2(static_cast<Extended>(y), static_cast<Extended>(x))));
}
inline DoubleDouble pow(const DoubleDouble& x, const DoubleDouble& exponent) {
  return DoubleDouble(Extended(pow(static_cast<Extended>(x), static_cast<Extended>(exponent))));
}

}  // namespace hamjet
