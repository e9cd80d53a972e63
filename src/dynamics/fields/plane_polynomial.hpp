#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "local_polynomial.hpp"

// Polynomials in dx, dy and dz without dz^2 and higher powers. A harmonic polynomial is known by
// them: its value and its slope in the plane dz = 0.

namespace hamjet {

/// The place of dx^i dy^j among the monomials of two variables; degree i + j.
constexpr std::size_t plane_index(int degree, int j) {
  return static_cast<std::size_t>(degree * (degree + 1) / 2 + j);
}

/// Coefficients of a polynomial to a degree: those of dx^i dy^j in slope[0] and those of dx^i dy^j
/// dz in slope[1].
template <class P>
struct PlanePolynomial {
  std::array<std::vector<P>, 2> slope;

  /// Makes it 0, to a degree.
  void reset(int degree) {
    slope[0].assign(plane_index(degree + 1, 0), P());
    slope[1].assign(plane_index(degree, 0), P());
  }
};

/// Adds 1/rho, rho = |e + d|, about a unit vector e, by the recursion of expand_inverse_distance,
/// times a factor. `inverse` is scratch.
template <class P>
void add_inverse_distance(const std::array<P, 3>& e, int degree, const P& factor,
                          PlanePolynomial<P>& inverse, PlanePolynomial<P>& sum) {
  using Real = typename P::real_type;
  inverse.reset(degree);
  inverse.slope[0][0] = factor;
  for (int n = 0; n <= degree; ++n) {
    for (int a = 0; a <= std::min(n, 1); ++a) {
      P* const c = inverse.slope[static_cast<std::size_t>(a)].data();
      const int m = n - a;
      for (int j = 0; j <= m; ++j) {
        P& to = c[plane_index(m, j)];
        if (n > 0) {
          P along;
          P across;
          if (j < m) along += e[0] * c[plane_index(m - 1, j)];
          if (j > 0) along += e[1] * c[plane_index(m - 1, j - 1)];
          if (a == 1) along += e[2] * inverse.slope[0][plane_index(m, j)];
          if (j + 1 < m) across += c[plane_index(m - 2, j)];
          if (j > 1) across += c[plane_index(m - 2, j - 2)];
          to = P(Real(-(2 * n - 1)) / Real(n)) * along + P(Real(-(n - 1)) / Real(n)) * across;
        }
        sum.slope[static_cast<std::size_t>(a)][plane_index(m, j)] += to;
      }
    }
  }
}

/// Sets q' = (E + constant) q / divisor to a degree, for a harmonic polynomial q of one degree
/// more, E = (e + d).grad the derivative by the distance from the origin.
template <class P>
void apply_radial(const std::array<P, 3>& e, const PlanePolynomial<P>& q,
                  const typename P::real_type& constant, int divisor, int degree,
                  PlanePolynomial<P>& to) {
  using Real = typename P::real_type;
  const Real scale = Real(1) / Real(divisor);
  const P x = P(scale) * e[0];
  const P y = P(scale) * e[1];
  const P z = P(scale) * e[2];
  to.slope[0].resize(plane_index(degree + 1, 0));
  to.slope[1].resize(plane_index(degree, 0));
  const P* const value = q.slope[0].data();
  const P* const rise = q.slope[1].data();
  for (int m = 0; m <= degree; ++m) {
    const P* const here = value + plane_index(m, 0);
    const P* const above = value + plane_index(m + 1, 0);
    const P* const rise_here = rise + plane_index(m, 0);
    P* const out = to.slope[0].data() + plane_index(m, 0);
    const P factor(scale * (Real(m) + constant));
    for (int j = 0; j <= m; ++j) {
      out[j] = factor * here[j] + x * (P(Real(m - j + 1)) * above[j]) +
               y * (P(Real(j + 1)) * above[j + 1]) + z * rise_here[j];
    }
  }
  for (int m = 0; m < degree; ++m) {
    const P* const here = rise + plane_index(m, 0);
    const P* const above = rise + plane_index(m + 1, 0);
    const P* const two_above = value + plane_index(m + 2, 0);
    P* const out = to.slope[1].data() + plane_index(m, 0);
    const P factor(scale * (Real(m + 1) + constant));
    for (int j = 0; j <= m; ++j) {
      const int i = m - j;
      // Twice the coefficient of dz^2, from Laplace's equation.
      const P bend =
          P(Real((i + 2) * (i + 1))) * two_above[j] + P(Real((j + 2) * (j + 1))) * two_above[j + 2];
      out[j] = factor * here[j] + x * (P(Real(i + 1)) * above[j]) +
               y * (P(Real(j + 1)) * above[j + 1]) - z * bend;
    }
  }
}

/// Adds the product of s = 1 - rho^2 = -2 e.d - d.d and a polynomial to a sum of the degree.
template <class P>
void add_shrunk(const std::array<P, 3>& e, const PlanePolynomial<P>& from, int degree,
                PlanePolynomial<P>& sum) {
  using Real = typename P::real_type;
  const P x = P(Real(-2)) * e[0];
  const P y = P(Real(-2)) * e[1];
  const P z = P(Real(-2)) * e[2];
  for (int a = 0; a <= 1; ++a) {
    const P* const c = from.slope[static_cast<std::size_t>(a)].data();
    for (int m = 0; m + a <= degree; ++m) {
      P* const out = sum.slope[static_cast<std::size_t>(a)].data() + plane_index(m, 0);
      if (m > 0) {
        const P* const below = c + plane_index(m - 1, 0);
        for (int j = 0; j < m; ++j) out[j] += x * below[j];
        for (int j = 0; j < m; ++j) out[j + 1] += y * below[j];
      }
      if (m > 1) {
        const P* const two_below = c + plane_index(m - 2, 0);
        for (int j = 0; j < m - 1; ++j) out[j] -= two_below[j];
        for (int j = 0; j < m - 1; ++j) out[j + 2] -= two_below[j];
      }
      if (a == 1) {
        const P* const value = from.slope[0].data() + plane_index(m, 0);
        for (int j = 0; j <= m; ++j) out[j] += z * value[j];
      }
    }
  }
}

/// Kelvin's transform: makes V into U(e + d) = V((e + d) / rho^2) / rho about a unit vector e, for
/// a harmonic V. As rho^(-2n-1) = (1 - s)^(-n-1/2) with s = 1 - rho^2, and E multiplies what is
/// homogeneous of degree n by n,
///
///   U = sum over j of s^j Q_j,    Q_0 = V(e + d),   Q_j = (E + j - 1/2) Q_(j-1) / j .
///
/// `Q` is scratch.
template <class P>
void kelvin_transform(const std::array<P, 3>& e, int degree, std::vector<PlanePolynomial<P>>& Q,
                      PlanePolynomial<P>& V) {
  using Real = typename P::real_type;
  if (Q.size() < static_cast<std::size_t>(degree)) Q.resize(static_cast<std::size_t>(degree));
  const auto factor = [&](int j) -> PlanePolynomial<P>& {
    return j == 0 ? V : Q[static_cast<std::size_t>(j - 1)];
  };
  for (int j = 1; j <= degree; ++j) {
    apply_radial(e, factor(j - 1), Real(2 * j - 1) / Real(2), j, degree - j, factor(j));
  }
  // Horner's rule in s, in place.
  for (int j = degree; j > 0; --j) add_shrunk(e, factor(j), degree - j + 1, factor(j - 1));
}

}  // namespace hamjet
