#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

// Taylor polynomials of one variable, `count` coefficients each, which lie side by side. Of a slow
// one only the first coefficients matter.

namespace hamjet::univariate {

/// out = a b + sign c d, with a and c of `slow` coefficients, which are at most `count`. `out` must
/// be none of the others.
template <class Real>
void combine(std::size_t count, std::size_t slow, const Real* a, const Real* b, int sign,
             const Real* c, const Real* d, Real* out) {
  for (std::size_t k = 0; k < count; ++k) out[k] = a[0] * b[k] + sign * c[0] * d[k];
  for (std::size_t i = 1; i < slow; ++i) {
    const Real of_first = a[i], of_second = sign * c[i];
    for (std::size_t k = 0; k + i < count; ++k) out[k + i] += of_first * b[k] + of_second * d[k];
  }
}

/// out = a b.
template <class Real>
void multiply(std::size_t count, const Real* a, const Real* b, Real* out) {
  for (std::size_t k = 0; k < count; ++k) out[k] = a[0] * b[k];
  for (std::size_t i = 1; i < count; ++i) {
    for (std::size_t k = 0; k + i < count; ++k) out[k + i] += a[i] * b[k];
  }
}

/// The square root of a.
template <class Real>
void square_root(std::size_t count, const Real* a, Real* out) {
  using std::sqrt;
  out[0] = sqrt(a[0]);
  for (std::size_t k = 1; k < count; ++k) {
    Real rest = a[k];
    for (std::size_t i = 1; i < k; ++i) rest -= out[i] * out[k - i];
    out[k] = rest / (2 * out[0]);
  }
}

/// 1 / a.
template <class Real>
void reciprocal(std::size_t count, const Real* a, Real* out) {
  out[0] = 1 / a[0];
  for (std::size_t k = 1; k < count; ++k) {
    Real sum = 0;
    for (std::size_t i = 1; i <= k; ++i) sum += a[i] * out[k - i];
    out[k] = -sum * out[0];
  }
}

/// Sine and cosine of an angle whose coefficients above `degree` vanish: s' = a' c, c' = -a' s.
template <class Real>
void sine_and_cosine(std::size_t count, const Real* angle, std::size_t degree, Real* sine,
                     Real* cosine) {
  using std::cos, std::sin;
  sine[0] = sin(angle[0]);
  cosine[0] = cos(angle[0]);
  for (std::size_t k = 1; k < count; ++k) {
    Real s = 0, c = 0;
    for (std::size_t i = 1; i <= std::min(k, degree); ++i) {
      const Real slope = static_cast<double>(i) * angle[i];
      s += slope * cosine[k - i];
      c += slope * sine[k - i];
    }
    sine[k] = s / static_cast<double>(k);
    cosine[k] = -c / static_cast<double>(k);
  }
}

}  // namespace hamjet::univariate
