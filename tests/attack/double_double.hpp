#pragma once

#include <cmath>

// Numbers of 106 significant bits (31 digits) as unevaluated sums of two doubles, for the attack's
// own integrator, which shares no arithmetic with what it attacks.

namespace hamjet::attack {

/// high + low, with |low| at most half a unit in the last place of high. Sources: T. J. Dekker, A
/// floating-point technique for extending the available precision (1971); M. Joldes, J.-M. Muller
/// and V. Popescu, Tight and rigorous error bounds for basic building blocks of double-word
/// arithmetic (2017), whose algorithms 6, 12 and 17 these are: relative errors of at most 3, 5 and
/// 10 times 2^-106.
struct DoubleDouble {
  double high = 0;
  double low = 0;

  DoubleDouble() = default;
  DoubleDouble(double x) : high(x) {}  // NOLINT: numbers mix with doubles
  DoubleDouble(double h, double l) : high(h), low(l) {}

  explicit operator double() const { return high + low; }
};

/// a + b exactly, for |a| >= |b|.
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b exactly.
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double shadow = sum - a;
  return {sum, (a - (sum - shadow)) + (b - shadow)};
}

/// a b exactly, unless it underflows.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
#ifdef __FMA__
  return {product, __builtin_fma(a, b, -product)};
#else
  // Dekker's splitting: without the instruction, a fused multiply-add is a slow call.
  const double splitter = 0x1p27 + 1;
  const double scaled_a = splitter * a, scaled_b = splitter * b;
  const double a_high = scaled_a - (scaled_a - a), b_high = scaled_b - (scaled_b - b);
  const double a_low = a - a_high, b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
#endif
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = two_sum(a.high, b.high);
  const DoubleDouble low = two_sum(a.low, b.low);
  const DoubleDouble sum = fast_two_sum(high.high, high.low + low.high);
  return fast_two_sum(sum.high, low.low + sum.low);
}
inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.high, b.high);
  return fast_two_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double quotient = a.high / b.high;
  const DoubleDouble rest = a - b * DoubleDouble(quotient);
  const double correction = rest.high / b.high;
  const DoubleDouble sum = fast_two_sum(quotient, correction);
  const DoubleDouble last = a - b * sum;
  return fast_two_sum(sum.high, sum.low + last.high / b.high);
}
inline DoubleDouble& operator+=(DoubleDouble& a, const DoubleDouble& b) { return a = a + b; }
inline DoubleDouble& operator-=(DoubleDouble& a, const DoubleDouble& b) { return a = a - b; }
inline DoubleDouble& operator*=(DoubleDouble& a, const DoubleDouble& b) { return a = a * b; }

/// One step of Newton's method on the square root in double precision.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  const double root = std::sqrt(a.high);
  if (root == 0 || !std::isfinite(root)) return root;
  const DoubleDouble rest = a - two_product(root, root);
  return fast_two_sum(root, rest.high / (2 * root));
}

inline double magnitude(const DoubleDouble& a) { return std::abs(a.high); }
inline double magnitude(double a) { return std::abs(a); }
inline double to_double(const DoubleDouble& a) { return a.high + a.low; }
inline double to_double(double a) { return a; }

}  // namespace hamjet::attack
