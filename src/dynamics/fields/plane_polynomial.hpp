#pragma once

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

/// Coefficients of a polynomial to a degree: those of dx^i dy^j in slope[0] and those of dx^i dy^j dz
/// in slope[1].
template <class P>
struct PlanePolynomial {
  std::array<std::vector<P>, 2> slope;

  /// Makes it 0, to a degree.
  void reset(int degree) {
    slope[0].assign(plane_index(degree + 1, 0), P());
    slope[1].assign(plane_index(degree, 0), P());
  }
};

/// Sets 1/rho, rho = |e + d|, about a unit vector e, by the recursion of expand_inverse_distance, and
/// 1/rho^2 - 1 by that of the geometric series (1 + 2 e.d + d.d) / rho^2 = 1.
template <class P>
void expand_distance_powers(const std::array<P, 3>& e, int degree, PlanePolynomial<P>& inverse,
                            PlanePolynomial<P>& square) {
  using Real = typename P::real_type;
  const auto expand = [&](PlanePolynomial<P>& to, const auto& first, const auto& second) {
    to.reset(degree);
    to.slope[0][0] = P(Real(1));
    for (int n = 1; n <= degree; ++n) {
      const P along_factor = P(first(n));
      const P across_factor = P(second(n));
      for (int a = 0; a <= 1; ++a) {
        std::vector<P>& c = to.slope[static_cast<std::size_t>(a)];
        const int m = n - a;
        for (int j = 0; j <= m; ++j) {
          P along;
          P across;
          if (j < m) along += e[0] * c[plane_index(m - 1, j)];
          if (j > 0) along += e[1] * c[plane_index(m - 1, j - 1)];
          if (a == 1) along += e[2] * to.slope[0][plane_index(m, j)];
          if (j + 1 < m) across += c[plane_index(m - 2, j)];
          if (j > 1) across += c[plane_index(m - 2, j - 2)];
          c[plane_index(m, j)] = along_factor * along + across_factor * across;
        }
      }
    }
  };
  expand(
      inverse, [](int n) { return Real(-(2 * n - 1)) / Real(n); },
      [](int n) { return Real(-(n - 1)) / Real(n); });
  expand(
      square, [](int) { return Real(-2); }, [](int) { return Real(-1); });
  square.slope[0][0] = P();
}

/// Adds a product to a sum, to a degree. The factors begin at their lowest degrees `from_a` and
/// `from_b`.
template <class P>
void add_plane_product(const PlanePolynomial<P>& a, int from_a, const PlanePolynomial<P>& b,
                       int from_b, int degree, PlanePolynomial<P>& sum) {
  const auto add = [](const std::vector<P>& x, int from_x, const std::vector<P>& y, int from_y,
                      int top, std::vector<P>& to) {
    for (int m = from_x; m <= top - from_y; ++m) {
      for (int n = from_y; m + n <= top; ++n) {
        for (int i = 0; i <= m; ++i) {
          const P factor = x[plane_index(m, i)];
          const P* const from = &y[plane_index(n, 0)];
          P* const out = &to[plane_index(m + n, i)];
          for (int j = 0; j <= n; ++j) out[j] += factor * from[j];
        }
      }
    }
  };
  add(a.slope[0], from_a, b.slope[0], from_b, degree, sum.slope[0]);
  add(a.slope[1], from_a > 0 ? from_a - 1 : 0, b.slope[0], from_b, degree - 1, sum.slope[1]);
  add(a.slope[0], from_a, b.slope[1], from_b > 0 ? from_b - 1 : 0, degree - 1, sum.slope[1]);
}

/// Sets q' = (E - lowered) q / divisor to a degree, for a harmonic polynomial q of one degree more,
/// E = (e + d).grad the derivative by the distance from the origin.
template <class P>
void apply_radial(const std::array<P, 3>& e, const PlanePolynomial<P>& q, int lowered, int divisor,
                  int degree, PlanePolynomial<P>& to) {
  using Real = typename P::real_type;
  const Real scale = Real(1) / Real(divisor);
  to.reset(degree);
  for (int a = 0; a <= 1; ++a) {
    const std::vector<P>& c = q.slope[static_cast<std::size_t>(a)];
    for (int m = 0; m + a <= degree; ++m) {
      for (int j = 0; j <= m; ++j) {
        const int i = m - j;
        P sum = P(Real(m + a - lowered)) * c[plane_index(m, j)] +
                e[0] * (P(Real(i + 1)) * c[plane_index(m + 1, j)]) +
                e[1] * (P(Real(j + 1)) * c[plane_index(m + 1, j + 1)]);
        if (a == 0) {
          sum += e[2] * q.slope[1][plane_index(m, j)];
        } else {
          // Twice the coefficient of dz^2, from Laplace's equation.
          sum -= e[2] * (P(Real((i + 2) * (i + 1))) * q.slope[0][plane_index(m + 2, j)] +
                         P(Real((j + 2) * (j + 1))) * q.slope[0][plane_index(m + 2, j + 2)]);
        }
        to.slope[static_cast<std::size_t>(a)][plane_index(m, j)] = P(scale) * sum;
      }
    }
  }
}

/// Kelvin's transform: sets U(e + d) = V((e + d) / rho^2) / rho about a unit vector e, for a harmonic
/// V. With V scaled by 1/rho^2 = 1 + s about the origin,
///
///   U = 1/rho sum over j of s^j Q_j,    Q_0 = V(e + d),   Q_j = (E - j + 1) Q_(j-1) / j .
template <class P>
void kelvin_transform(const std::array<P, 3>& e, int degree, const PlanePolynomial<P>& V,
                      PlanePolynomial<P>& U) {
  static thread_local std::vector<PlanePolynomial<P>> Q;
  static thread_local std::array<PlanePolynomial<P>, 3> work;
  auto& [inverse, s, next] = work;
  if (Q.size() < static_cast<std::size_t>(degree) + 1) Q.resize(static_cast<std::size_t>(degree) + 1);
  expand_distance_powers(e, degree, inverse, s);
  const auto factor = [&](int j) -> PlanePolynomial<P>& { return Q[static_cast<std::size_t>(j)]; };
  factor(0) = V;
  for (int j = 1; j <= degree; ++j) apply_radial(e, factor(j - 1), j - 1, j, degree - j, factor(j));
  // Horner's rule in s, in place: Q_(j-1) becomes the sum from there on.
  for (int j = degree; j > 0; --j) {
    add_plane_product(s, 1, factor(j), 0, degree - j + 1, factor(j - 1));
  }
  U.reset(degree);
  add_plane_product(inverse, 0, factor(0), 0, degree, U);
}

}  // namespace hamjet
