#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "hamjet/algebra/extended.hpp"

// Polynomials of three variables in the order of LocalField, as they come from potentials.

namespace hamjet {

/// The place of dx^i dy^j dz^k.
constexpr std::size_t local_index(int i, int j, int k) {
  const auto degree = static_cast<std::size_t>(i + j + k);
  const auto rest = static_cast<std::size_t>(j + k);
  return degree * (degree + 1) * (degree + 2) / 6 + rest * (rest + 1) / 2 +
         static_cast<std::size_t>(k);
}

/// The first coefficient of a degree.
constexpr std::size_t local_first(int degree) { return local_index(degree, 0, 0); }

/// Sets the coefficients of 1 / |u + d| about a unit vector u. With the Legendre polynomials,
/// 1/|u + d| = sum over n of (-|d|)^n P_n(u.d/|d|), and their recursion is for each coefficient
///
///   n c_k = -(2n - 1) sum over i of u_i c_(k - e_i) - (n - 1) sum over i of c_(k - 2 e_i) .
///
/// Source: K. Lindsay and R. Krasny, J. Comput. Phys. 172 (2001) 879.
template <class P>
void expand_inverse_distance(const std::array<P, 3>& u, int degree, P* out) {
  using Real = typename P::real_type;
  out[0] = P(Real(1));
  for (int n = 1; n <= degree; ++n) {
    const P first = P(Real(-(2 * n - 1)) / Real(n));
    const P second = P(Real(-(n - 1)) / Real(n));
    for (int i = n; i >= 0; --i) {
      for (int j = n - i; j >= 0; --j) {
        const int k = n - i - j;
        P along(Real(0));
        P across(Real(0));
        if (i > 0) along += u[0] * out[local_index(i - 1, j, k)];
        if (j > 0) along += u[1] * out[local_index(i, j - 1, k)];
        if (k > 0) along += u[2] * out[local_index(i, j, k - 1)];
        if (i > 1) across += out[local_index(i - 2, j, k)];
        if (j > 1) across += out[local_index(i, j - 2, k)];
        if (k > 1) across += out[local_index(i, j, k - 2)];
        out[local_index(i, j, k)] = first * along + second * across;
      }
    }
  }
}

/// Sets the coefficients with dz^2 and higher powers of a harmonic polynomial from those without:
/// by Laplace's equation,
///
///   (k+2)(k+1) c_(i,j,k+2) = -(i+2)(i+1) c_(i+2,j,k) - (j+2)(j+1) c_(i,j+2,k) .
template <class P>
void complete_harmonic(int degree, P* c) {
  using Real = typename P::real_type;
  for (int n = 2; n <= degree; ++n) {
    for (int k = 0; k + 2 <= n; ++k) {
      const Real scale = Real(-1) / Real((k + 2) * (k + 1));
      for (int i = n - k - 2; i >= 0; --i) {
        const int j = n - k - 2 - i;
        c[local_index(i, j, k + 2)] =
            P(scale * Real((i + 2) * (i + 1))) * c[local_index(i + 2, j, k)] +
            P(scale * Real((j + 2) * (j + 1))) * c[local_index(i, j + 2, k)];
      }
    }
  }
}

/// The numbers w(c, j) for one degree n: with b = n - c >= c, the real (j even) or imaginary (j odd)
/// part of the coefficient of x^(n-j) y^j in (x + i y)^b (x - i y)^c = (x^2 + y^2)^c (x + i y)^(b-c):
///
///   w(c, j) = sum over s of binomial(c, s) binomial(b - c, j - 2 s) (-1)^floor((j - 2 s) / 2) .
///
/// They stand row by row, c from 0 to n / 2 and j from 0 to n.
template <class Real>
const std::vector<Real>& plane_weights(int n) {
  constexpr std::size_t most = 64;
  static std::array<std::atomic<const std::vector<Real>*>, most> known{};
  const auto place = static_cast<std::size_t>(n);
  if (const std::vector<Real>* found = known.at(place).load(std::memory_order_acquire)) {
    return *found;
  }
  std::vector<std::vector<Extended>> binomial(place + 1);
  for (std::size_t a = 0; a <= place; ++a) {
    binomial[a].assign(a + 1, Extended(1));
    for (std::size_t b = 1; b < a; ++b) binomial[a][b] = binomial[a - 1][b - 1] + binomial[a - 1][b];
  }
  auto made = std::make_unique<std::vector<Real>>();
  for (std::size_t c = 0; c <= place / 2; ++c) {
    const std::size_t turns = place - 2 * c;
    for (std::size_t j = 0; j <= place; ++j) {
      Extended sum = 0;
      for (std::size_t s = 0; s <= c && 2 * s <= j; ++s) {
        if (j - 2 * s > turns) continue;
        const Extended term = binomial[c][s] * binomial[turns][j - 2 * s];
        sum += (j - 2 * s) / 2 % 2 == 0 ? term : -term;
      }
      made->push_back(convert<Real>(sum));
    }
  }
  // Another thread may have been first; both have made the same numbers.
  const std::vector<Real>* expected = nullptr;
  if (known[place].compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) {
    return *made.release();
  }
  return *expected;
}

}  // namespace hamjet
