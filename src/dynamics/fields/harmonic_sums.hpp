#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "hamjet/detail/dynamics/spherical_harmonic_coefficients.hpp"
#include "local_polynomial.hpp"
#include "plane_polynomial.hpp"

// A field of spherical harmonics as local polynomial. Lengths are in units of the distance r of the
// point, so that the point is a unit vector e = (x, y, z) and R the number kappa = R/r. The field
// is Kelvin's transform of one that grows outwards, U(p) = V(p / |p|^2) / |p|, which leaves e where
// it is. With zeta = x + i y, w = zeta conj(zeta), and A_nm = d^m P_n / dz^m,
//
//   V = Re sum over n, m of (C_nm - i S_nm) kappa^n zeta^m G_nm(z, w),    G_nm = A_nm(z) at |p|
//   = 1.
//
// Of each order m, the sums over n are functions h_m(z, w), whose derivatives are sums of the same
// harmonics of another degree and order, because of
//
//   dG_nm/dw = -G_(n-1,m+1) / 2,        dG_nm/dz = (n + m) G_(n-1,m) .
//
// Few are needed: by Laplace's equation all derivatives follow from those with at most one dz. The
// sum over m is evaluated together with its derivatives by zeta, by Horner's rule. Its polynomial
// in the deviations (eta, omega) of (zeta, w) becomes one of the coordinates' deviations by omega =
// conj(zeta) eta + zeta conj(eta) + eta conj(eta).
//
// The same can be done with U itself, without V, but then the powers of zeta and those of 1/r, both
// large of high order, cancel each other: at the equator the terms are 3^k times as large as the
// derivative of order k that they add up to.
//
// On the axis, zeta = 0 is an ordinary point. A_nm / (2m - 1)!! is a Gegenbauer polynomial and at
// most binomial(n + m, 2m): of degree 120, at most 1e50.

namespace hamjet {

template <class Real>
class HarmonicSums {
 public:
  /// Makes the tables from normalised coefficients; C_00 stands apart.
  explicit HarmonicSums(const SphericalHarmonicCoefficients& field)
      : degree_(field.degree()), order_(field.order()), central_(field.C(0, 0)) {
    rows_.reserve(static_cast<std::size_t>(order_) + 1);
    for (int m = 0; m <= order_; ++m) {
      // A row of the order m holds for l = n - m, side by side, C, -S, and those of l + 1 times
      // n + m = 2m + l + 1; behind them zeros, so that rows of several orders can be read to one
      // length.
      std::vector<Real> row(4 * static_cast<std::size_t>(degree_ - m + 1 + padding));
      // N (2m - 1)!! for n = m, with the norm N^2 = (2 - delta) (2n + 1) (n - m)! / (n + m)!.
      Real scale_squared = m == 0 ? Real(1) : Real(2);
      for (int j = 1; j <= m; ++j) scale_squared *= Real(2 * j - 1) / Real(2 * j);
      for (int n = m; n <= degree_; ++n) {
        const auto l = static_cast<std::size_t>(n - m);
        if (n > m) scale_squared *= Real(n - m) / Real(n + m);
        using std::sqrt;
        const Real scale = sqrt(Real(scale_squared * Real(2 * n + 1)));
        if (n == 0) continue;
        row[4 * l] = scale * Real(field.C(n, m));
        row[4 * l + 1] = -scale * Real(field.S(n, m));
        if (l > 0) {
          row[4 * l - 2] = Real(n + m) * row[4 * l];
          row[4 * l - 1] = Real(n + m) * row[4 * l + 1];
        }
      }
      rows_.push_back(std::move(row));
    }
  }

  /// Sets the coefficients to a degree, as local_index orders them, in the unit of mu / r.
  template <int Lanes>
  void expand(const std::array<Pack<Real, Lanes>, 3>& point, const Pack<Real, Lanes>& kappa,
              int degree, Pack<Real, Lanes>* out) const {
    Expansion<Lanes>(*this, point, kappa, degree).run(out);
  }

  /// Multiply-adds of an expansion at one point: of the recursion, the sums over n, and Horner's
  /// rule.
  static double multiply_adds(int field_degree, int order, int degree) {
    double count = 0;
    for (int m = 0; m <= std::min(order + degree, field_degree); ++m) {
      count += 4 * (field_degree - m + 1);
      for (int c = std::max(0, m - order); c <= std::min({degree, m, field_degree - m}); ++c) {
        count += (c == degree ? 2 : 4) * (field_degree - m - c + 1);
        count += 4 * (degree - c + 1) + 4 * (degree - c);
      }
    }
    return count;
  }

 private:
  static constexpr int padding = 3;

  template <int Lanes>
  class Expansion {
   public:
    using P = Pack<Real, Lanes>;

    Expansion(const HarmonicSums& sums, const std::array<P, 3>& point, const P& kappa, int degree)
        : sums_(sums),
          point_(point),
          x_(point[0]),
          y_(point[1]),
          K_(degree),
          last_(std::min(sums.order_ + degree, sums.degree_)),
          kappa_(kappa),
          scratch_(scratch_of_thread()) {
      const auto length = static_cast<std::size_t>(sums.degree_) + 2;
      const auto triangle = plane_index(degree + 1, 0);
      for (auto& column : scratch_.column) column.resize(length);
      scratch_.powers.resize(static_cast<std::size_t>(last_) + 1);
      scratch_.state.assign(4 * triangle, P());
      state_ = {scratch_.state.data(), scratch_.state.data() + 2 * triangle};
      scratch_.powers[0] = P(Real(1));
      for (std::size_t m = 1; m < scratch_.powers.size(); ++m) {
        scratch_.powers[m] = scratch_.powers[m - 1] * kappa;
      }
      auto& inverses = scratch_.inverses;
      while (inverses.size() < std::max(length, static_cast<std::size_t>(degree)) + 1) {
        const auto n = static_cast<double>(inverses.size());
        inverses.push_back(n == 0 ? Real(0) : Real(1) / Real(n));
      }
    }

    void run(P* out) {
      for (int m = last_; m >= 0; m -= 2) {
        fill_columns(m);
        take_column(m, scratch_.column[0].data());
        if (m > 0) take_column(m - 1, scratch_.column[1].data());
      }
      scratch_.plane.reset(K_);
      for (int a = 0; a <= std::min(K_, 1); ++a) {
        substitute(a);
        to_monomials(a, scratch_.plane.slope[static_cast<std::size_t>(a)]);
      }
      kelvin_transform(point_, K_, scratch_.factors, scratch_.plane);
      // The central term has a recursion of its own, which loses no digit at any degree.
      add_inverse_distance(point_, K_, P(sums_.central_), scratch_.inverse, scratch_.plane);
      for (int a = 0; a <= std::min(K_, 1); ++a) {
        const std::vector<P>& from = scratch_.plane.slope[static_cast<std::size_t>(a)];
        for (int n = 0; n + a <= K_; ++n) {
          for (int j = 0; j <= n; ++j) out[local_index(n - j, j, a)] = from[plane_index(n, j)];
        }
      }
      complete_harmonic(K_, out);
    }

   private:
    struct Scratch {
      std::array<std::vector<P>, 2> column;
      std::vector<P> powers;
      std::vector<P> state;
      std::vector<Real> inverses;
      PlanePolynomial<P> plane;
      PlanePolynomial<P> inverse;
      std::vector<PlanePolynomial<P>> factors;
    };
    static Scratch& scratch_of_thread() {
      static thread_local Scratch scratch;
      return scratch;
    }

    /// Forms kappa^n A_nm / (2m - 1)!! for the orders m and m - 1, two at a time because each value
    /// waits for the one before it:
    ///
    ///   (l + 1) G_(l+1) = (2m + 2l + 1) kappa z G_l - (2m + l) kappa^2 G_(l-1),   l = n - m .
    void fill_columns(int m) {
      const int length = sums_.degree_ - m + 2;
      const P t = kappa_ * point_[2];
      const P kappa2 = kappa_ * kappa_;
      const P twice_t = t + t;
      const P t1 = P(Real(2 * m - 1)) * t;
      const P k1 = P(Real(2 * m - 1)) * kappa2;
      const P t2 = P(Real(2 * m - 3)) * t;
      const P k2 = P(Real(2 * m - 3)) * kappa2;
      const Real* const inverses = scratch_.inverses.data();
      P* const column1 = scratch_.column[0].data();
      P* const column2 = scratch_.column[1].data();
      const P* const start = scratch_.powers.data() + m;
      P before1;
      P before2;
      P now1 = start[0];
      P now2 = m > 0 ? start[-1] : P();
      for (int l = 0; l < length; ++l) {
        column1[l] = now1;
        column2[l] = now2;
        const P inverse(inverses[l + 1]);
        const P next1 = (twice_t + t1 * inverse) * now1 - (kappa2 + k1 * inverse) * before1;
        const P next2 = (twice_t + t2 * inverse) * now2 - (kappa2 + k2 * inverse) * before2;
        before1 = now1;
        before2 = now2;
        now1 = next1;
        now2 = next2;
      }
    }

    /// Adds to the sums over m what the harmonics of the order m contribute: the derivatives (1/c!)
    /// (d/dw)^c of h of the order m - c, and these of dh/dz.
    void take_column(int m, const P* column) {
      const int first = std::max(0, m - sums_.order_);
      const int last = std::min({K_, m, sums_.degree_ - m});
      // (-1/2)^c / c! times (2m - 1)!! / (2(m - c) - 1)!! kappa^c.
      P scale(Real(1));
      for (int c = 1; c < first; ++c) scale *= scale_step(m, c);
      // As many sums at a time as the machine has registers for.
      constexpr int most = P::parts == 1 && P::width > 1 ? 3 : 1;
      for (int c = first; c <= last;) {
        const int orders = std::min(most, last - c + 1);
        const bool has_last = c + orders - 1 == K_;
        if (most >= 3 && orders == 3) {
          take_orders<3>(m, c, has_last, column, scale);
        } else if (most >= 2 && orders == 2) {
          take_orders<2>(m, c, has_last, column, scale);
        } else {
          take_orders<1>(m, c, has_last, column, scale);
        }
        c += orders;
      }
    }

    P scale_step(int m, int c) const {
      return P(Real(-(2 * m - 2 * c + 1)) * scratch_.inverses[c] / Real(2)) * kappa_;
    }

    /// Takes the orders m - c for `Count` values of c from c on. Of the last one the derivative by
    /// z is not needed if `has_last`.
    template <int Count>
    void take_orders(int m, int c, bool has_last, const P* column, P& scale) {
      if (has_last) {
        take_orders_to<Count, 4 * Count - 2>(m, c, column, scale);
      } else {
        take_orders_to<Count, 4 * Count>(m, c, column, scale);
      }
    }

    template <int Count, int Sums>
    void take_orders_to(int m, int c, const P* column, P& scale) {
      std::array<const Real*, Count> row;
      for (int i = 0; i < Count; ++i) row[i] = sums_.rows_[m - c - i].data() + 8 * (c + i);
      std::array<P, Sums> sum{};
      const int length = sums_.degree_ - m - c + 1;
      for (int l = 0; l < length; ++l) {
        const P g = column[l];
#pragma GCC unroll 16
        for (int i = 0; i < Sums; ++i) sum[i] += P(row[i / 4][4 * l + i % 4]) * g;
      }
      for (int i = 0; i < Count; ++i) {
        if (c + i > 0) scale *= scale_step(m, c + i);
        add_order(0, c + i, scale * sum[4 * i], scale * sum[4 * i + 1]);
        if (4 * i + 2 < Sums) {
          const P scale_z = scale * kappa_;
          add_order(1, c + i, scale_z * sum[4 * i + 2], scale_z * sum[4 * i + 3]);
        }
      }
    }

    /// The coefficient of eta^q omega^c in the polynomial of V (a = 0) or dV/dz (a = 1), real part
    /// and imaginary part side by side.
    P* state_at(int a, int c, int q) const {
      const int size = K_ - a + 1;
      return state_[static_cast<std::size_t>(a)] + 2 * (c * size - c * (c - 1) / 2 + q);
    }

    /// A step of Horner's rule in zeta + eta.
    void add_order(int a, int c, const P& real, const P& imaginary) {
      P* p = state_at(a, c, 0);
      P* const end = p + 2 * (K_ - a - c + 1);
      // Copies stay in registers; members would be read again after each write.
      const P x = x_;
      const P y = y_;
      P re = real;
      P im = imaginary;
      for (; p != end; p += 2) {
        const P old_re = p[0];
        const P old_im = p[1];
        p[0] = re + x * old_re - y * old_im;
        p[1] = im + x * old_im + y * old_re;
        re = old_re;
        im = old_im;
      }
    }

    /// Turns the polynomial in (eta, omega) into one in (eta, conj(eta)).
    void substitute(int a) {
      const int top = K_ - a;
      // omega = conj(zeta) eta + omega', degree by degree.
      for (int total = 1; total <= top; ++total) {
        for (int i = 0; i < total; ++i) {
          for (int c = total - 1; c >= i; --c) {
            const P* from = state_at(a, c + 1, total - c - 1);
            P* to = state_at(a, c, total - c);
            to[0] += x_ * from[0] + y_ * from[1];
            to[1] += x_ * from[1] - y_ * from[0];
          }
        }
      }
      // omega' = (zeta + eta) conj(eta).
      for (int c = 1; c <= top; ++c) {
        for (int i = 0; i < c; ++i) add_order(a, c, P(), P());
      }
    }

    /// Sets the coefficients of dx^i dy^j dz^a of the real part.
    void to_monomials(int a, std::vector<P>& out) const {
      for (int n = 0; n <= K_ - a; ++n) {
        const std::vector<Real>& weights = plane_weights<Real>(n);
        for (int c = 0; 2 * c <= n; ++c) {
          P re = state_at(a, c, n - c)[0];
          P im = state_at(a, c, n - c)[1];
          if (2 * c < n) {
            re += state_at(a, n - c, c)[0];
            im -= state_at(a, n - c, c)[1];
          }
          for (int j = 0; j <= n; ++j) {
            const P weight(weights[static_cast<std::size_t>(c * (n + 1) + j)]);
            P& to = out[plane_index(n, j)];
            if (j % 2 == 0) {
              to += weight * re;
            } else {
              to -= weight * im;
            }
          }
        }
      }
    }

    const HarmonicSums& sums_;
    std::array<P, 3> point_;
    P x_;
    P y_;
    int K_;
    int last_;  ///< the highest order of the columns
    P kappa_;
    Scratch& scratch_;
    std::array<P*, 2> state_;
  };

  int degree_;
  int order_;
  Real central_;
  std::vector<std::vector<Real>> rows_;
};

}  // namespace hamjet
