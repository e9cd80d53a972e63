#pragma once

#include <vector>

#include "local_polynomial.hpp"
#include "plane_polynomial.hpp"

// Functions that have the symmetry of rotation about the z axis, as polynomials in the deviations
// dP of P = x^2 + y^2 and dz of z. They are smooth on the axis too, where the distance from it is
// not. The coefficient of dP^(n-j) dz^j stands at plane_index(n, j).

namespace hamjet {

/// Adds a factor times the product of what two polynomials have of degrees a and b.
template <class P>
void add_homogeneous_product(const P* first, int a, const P* second, int b, const P& factor,
                             P* to) {
  const P* const row = second + plane_index(b, 0);
  P* const sum = to + plane_index(a + b, 0);
  for (int i = 0; i <= a; ++i) {
    const P scaled = factor * first[plane_index(a, i)];
    for (int j = 0; j <= b; ++j) sum[i + j] += scaled * row[j];
  }
}

/// Sets the terms of degree n of 1 / from, of which those of lower degree are set.
template <class P>
void set_reciprocal(const P* from, int n, P* to) {
  const P factor = -to[0];
  for (int j = 0; j <= n; ++j) to[plane_index(n, j)] = P();
  for (int m = 1; m <= n; ++m) add_homogeneous_product(from, m, to, n - m, factor, to);
}

/// Sets the terms of degree n of from^2.
template <class P>
void set_square(const P* from, int n, P* to) {
  using Real = typename P::real_type;
  for (int j = 0; j <= n; ++j) to[plane_index(n, j)] = P();
  for (int m = 0; 2 * m <= n; ++m) {
    add_homogeneous_product(from, m, from, n - m, P(Real(2 * m == n ? 1 : 2)), to);
  }
}

/// Sets the terms of degree n of the root of `from`, of which those of lower degree are set, with
/// half the reciprocal of its value: from w^2 = f, 2 w_0 w_n = f_n - sum over 0 < m < n of w_m
/// w_(n-m).
template <class P>
void set_root(const P* from, const P& half_reciprocal, int n, P* to) {
  using Real = typename P::real_type;
  P* const row = to + plane_index(n, 0);
  for (int j = 0; j <= n; ++j) row[j] = from[plane_index(n, j)];
  for (int m = 1; 2 * m <= n; ++m) {
    add_homogeneous_product(to, m, to, n - m, P(Real(2 * m == n ? -1 : -2)), to);
  }
  for (int j = 0; j <= n; ++j) row[j] *= half_reciprocal;
}

/// Sets the terms of degree n of (P + dP) a + factor (z + dz)^2 b.
template <class P>
void set_quadratic_form(const P& square, const P* a, const P& factor, const P& z, const P* b, int n,
                        P* to) {
  using Real = typename P::real_type;
  const P constant = factor * z * z;
  const P slope = P(Real(2)) * factor * z;
  P* const row = to + plane_index(n, 0);
  for (int j = 0; j <= n; ++j) {
    row[j] = square * a[plane_index(n, j)] + constant * b[plane_index(n, j)];
  }
  if (n == 0) return;
  for (int j = 0; j < n; ++j) {
    row[j] += a[plane_index(n - 1, j)];
    row[j + 1] += slope * b[plane_index(n - 1, j)];
  }
  for (int j = 0; j + 1 < n; ++j) row[j + 2] += factor * b[plane_index(n - 2, j)];
}

/// Sets the polynomial of f(v) where f is the polynomial in the deviation of v whose coefficients
/// are `outer`, by Horner's rule. The constant of v is not used.
template <class P>
void compose(const P* outer, const P* v, int degree, P* to) {
  using Real = typename P::real_type;
  const P one(Real(1));
  to[0] = outer[degree];
  for (int i = degree - 1; i >= 0; --i) {
    // The product is formed in place, as its terms need those of lower degree alone.
    for (int n = degree - i; n > 0; --n) {
      for (int j = 0; j <= n; ++j) to[plane_index(n, j)] = P();
      for (int m = 1; m <= n; ++m) add_homogeneous_product(v, m, to, n - m, one, to);
    }
    to[0] = outer[i];
  }
}

/// Sets the polynomial in dx, dy and dz, in the order of LocalField, of one in dP and dz: dP = 2 x
/// dx + 2 y dy + dx^2 + dy^2. `plane` is scratch for one polynomial in dx and dy.
template <class P>
void expand_about_axis(const P& x, const P& y, const P* from, int degree, P* plane, P* to) {
  using Real = typename P::real_type;
  const P along_x = P(Real(2)) * x;
  const P along_y = P(Real(2)) * y;
  for (int k = 0; k <= degree; ++k) {
    // The coefficient of dz^k, by Horner's rule in dP; the coefficient of dx^(n-j) dy^j is at
    // plane_index(n, j).
    plane[0] = from[plane_index(degree, k)];
    for (int i = degree - k - 1; i >= 0; --i) {
      for (int n = degree - k - i; n > 0; --n) {
        P* const row = plane + plane_index(n, 0);
        const P* const below = plane + plane_index(n - 1, 0);
        row[n] = along_y * below[n - 1];
        for (int j = n - 1; j > 0; --j) row[j] = along_x * below[j] + along_y * below[j - 1];
        row[0] = along_x * below[0];
        if (n < 2) continue;
        const P* const two_below = plane + plane_index(n - 2, 0);
        for (int j = 0; j + 1 < n; ++j) {
          row[j] += two_below[j];
          row[j + 2] += two_below[j];
        }
      }
      plane[0] = from[plane_index(i + k, k)];
    }
    for (int n = 0; n + k <= degree; ++n) {
      for (int j = 0; j <= n; ++j) to[local_index(n - j, j, k)] = plane[plane_index(n, j)];
    }
  }
}

}  // namespace hamjet
