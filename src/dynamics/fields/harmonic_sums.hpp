#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "hamjet/algebra/extended.hpp"
#include "hamjet/detail/algebra/pack.hpp"
#include "local_polynomial.hpp"
#include "spherical_harmonic_coefficients.hpp"

// A field of spherical harmonics without its central term, as local polynomial. Lengths are in units
// of the distance r of the point, so that the point is the unit vector (x, y, z) and R the number
// kappa = R/r. With zeta = x + i y, w = zeta conj(zeta), and A_nm = d^m P_n / dz^m,
//
//   U = Re sum over n, m of (C_nm - i S_nm) zeta^m G_nm(z, w),   G_nm = kappa^n A_nm(z) at |r| = 1.
//
// Of each order m, the sums over n are functions h_m(z, w), whose derivatives are sums of the same
// harmonics of another degree and order, because of
//
//   dG_nm/dw = -G_(n+1,m+1) / (2 kappa),        dG_nm/dz = -(n - m + 1) G_(n+1,m) / kappa .
//
// So few are needed: by Laplace's equation all derivatives follow from those with at most one dz.
// The sum over m is evaluated together with its derivatives by zeta, by Horner's rule. Its polynomial
// in the deviations (eta, omega) of (zeta, w) becomes one of the coordinates' deviations by
// omega = conj(zeta) eta + zeta conj(eta) + eta conj(eta).
//
// On the axis, zeta = 0 is an ordinary point. G_nm / (2m - 1)!! = kappa^n C_(n-m)^(m+1/2)(z), a
// Gegenbauer polynomial, is at most binomial(n + m, 2m) kappa^n: of degree 129, at most 1e54.

namespace hamjet {

template <class Real>
class HarmonicSums {
 public:
  /// Makes the tables from normalised coefficients. The degree 0 is left out.
  explicit HarmonicSums(const SphericalHarmonicCoefficients& field)
      : degree_(field.degree()), order_(field.order()) {
    rows_.reserve(static_cast<std::size_t>(order_) + 1);
    for (int m = 0; m <= order_; ++m) {
      // A row of the order m holds for l = n - m, side by side, C, -S, and those of the degree below
      // times l; behind them zeros, so that rows of several orders can be read to one length.
      std::vector<Real> row(4 * static_cast<std::size_t>(degree_ - m + 2 + padding));
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
        row[4 * l + 6] = Real(n - m + 1) * row[4 * l];
        row[4 * l + 7] = Real(n - m + 1) * row[4 * l + 1];
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

  /// Multiply-adds of an expansion at one point: of the recursion, the sums over n, Horner's rule.
  static double multiply_adds(int field_degree, int order, int degree) {
    const double N = field_degree;
    double count = 0;
    for (int m = 0; m <= order + degree; ++m) {
      const int lowest = std::max(m - degree, 0);
      count += 4 * (N - lowest + 2);
      for (int c = std::max(0, m - order); c <= std::min(degree, m); ++c) {
        count += (c == degree ? 2 : 4) * (N - m + c + 1);
        count += 4 * (degree - c + 1) + 4 * std::max(degree - c, 0);
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
        : sums_(sums), x_(point[0]), y_(point[1]), K_(degree) {
      const int last = sums.order_ + degree;
      auto& scratch = scratch_of_thread();
      const auto columns = static_cast<std::size_t>(sums.degree_ + degree + 3 + padding);
      const auto triangle = static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);
      scratch.column[0].resize(columns);
      scratch.column[1].resize(columns);
      scratch.powers.resize(static_cast<std::size_t>(last) + 1);
      scratch.state.assign(4 * triangle, P());
      column_ = {scratch.column[0].data(), scratch.column[1].data()};
      powers_ = scratch.powers.data();
      state_ = {scratch.state.data(), scratch.state.data() + 2 * triangle};
      twice_t_ = kappa * point[2];
      t_ = twice_t_;
      twice_t_ += t_;
      kappa2_ = kappa * kappa;
      powers_[0] = P(Real(1));
      for (int m = 1; m <= last; ++m) powers_[m] = powers_[m - 1] * kappa;
      inverse_kappa_ = P(Real(1)) / kappa;
      auto& inverses = scratch.inverses;
      while (inverses.size() < columns + 1) {
        const std::size_t n = inverses.size();
        inverses.push_back(n == 0 ? Real(0) : Real(1) / Real(static_cast<double>(n)));
      }
      inverses_ = inverses.data();
    }

    void run(P* out) {
      for (int m = sums_.order_ + K_; m >= 0; m -= 2) {
        fill_columns(m);
        take_column(m, column_[0]);
        if (m > 0) take_column(m - 1, column_[1]);
      }
      for (int a = 0; a <= std::min(K_, 1); ++a) {
        substitute(a);
        to_monomials(a, out);
      }
      complete_harmonic(K_, out);
    }

   private:
    struct Scratch {
      std::array<std::vector<P>, 2> column;
      std::vector<P> powers;
      std::vector<P> state;
      std::vector<Real> inverses;
    };
    static Scratch& scratch_of_thread() {
      static thread_local Scratch scratch;
      return scratch;
    }

    /// The number of values of l = n - m in a column that are used: those of the order m - c go to
    /// degree_ - (m - c) + 1.
    int length_of(int m) const {
      const int lowest_order = std::max(m - K_, 0);
      return sums_.degree_ - lowest_order + 2 + padding;
    }

    /// Forms G / (2m - 1)!! for the orders m and m - 1, two at a time because each value waits for
    /// the one before it:
    ///
    ///   (l + 1) G_(l+1) = (2m + 2l + 1) kappa z G_l - (2m + l) kappa^2 G_(l-1),   l = n - m .
    void fill_columns(int m) {
      const int length = length_of(std::max(m - 1, 0));
      const P t1 = P(Real(2 * m - 1)) * t_;
      const P k1 = P(Real(2 * m - 1)) * kappa2_;
      const P t2 = P(Real(2 * m - 3)) * t_;
      const P k2 = P(Real(2 * m - 3)) * kappa2_;
      P before1;
      P before2;
      P now1 = powers_[m];
      P now2 = m > 0 ? powers_[m - 1] : P();
      for (int l = 0; l < length; ++l) {
        column_[0][l] = now1;
        column_[1][l] = now2;
        const P inverse(inverses_[l + 1]);
        const P next1 = (twice_t_ + t1 * inverse) * now1 - (kappa2_ + k1 * inverse) * before1;
        const P next2 = (twice_t_ + t2 * inverse) * now2 - (kappa2_ + k2 * inverse) * before2;
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
      const int last = std::min(K_, m);
      // (-1/2)^c / c! times (2m - 1)!! / (2(m - c) - 1)!! kappa^-c.
      P scale(Real(1));
      for (int c = 1; c < first; ++c) scale *= scale_step(m, c);
      for (int c = first; c <= last;) {
        const int left = last - c + 1;
        const bool ends = last == K_;
        constexpr int most = P::parts == 1 && P::width > 1 ? 3 : 1;
        if (most >= 3 && left >= 3) {
          take_orders<3>(m, c, ends && left == 3, column, scale);
          c += 3;
        } else if (most >= 2 && left >= 2) {
          take_orders<2>(m, c, ends && left == 2, column, scale);
          c += 2;
        } else {
          take_orders<1>(m, c, ends && left == 1, column, scale);
          c += 1;
        }
      }
    }

    P scale_step(int m, int c) const {
      return P(Real(-(2 * m - 2 * c + 1)) * inverses_[c] / Real(2)) * inverse_kappa_;
    }

    /// Orders m - c for `Count` values of c from c on. Of the last one the derivative by z is not
    /// needed if `is_last`.
    template <int Count>
    void take_orders(int m, int c, bool is_last, const P* column, P& scale) {
      if (is_last) {
        take_orders_to<Count, 4 * Count - 2>(m, c, column, scale);
      } else {
        take_orders_to<Count, 4 * Count>(m, c, column, scale);
      }
    }

    template <int Count, int Sums>
    void take_orders_to(int m, int c, const P* column, P& scale) {
      std::array<const Real*, Count> row;
      for (int i = 0; i < Count; ++i) row[i] = sums_.rows_[m - c - i].data();
      std::array<P, Sums> sum{};
      const int length = sums_.degree_ - (m - c - Count + 1) + 2;
      for (int l = 0; l < length; ++l) {
        const P g = column[l];
#pragma GCC unroll 16
        for (int i = 0; i < Sums; ++i) sum[i] += P(row[i / 4][4 * l + i % 4]) * g;
      }
      for (int i = 0; i < Count; ++i) {
        if (c + i > 0) scale *= scale_step(m, c + i);
        add_order(0, c + i, scale * sum[4 * i], scale * sum[4 * i + 1]);
        if (4 * i + 2 < Sums) {
          const P scale_z = -scale * inverse_kappa_;
          add_order(1, c + i, scale_z * sum[4 * i + 2], scale_z * sum[4 * i + 3]);
        }
      }
    }

    /// The coefficient of eta^q omega^c in the polynomial of U (a = 0) or dU/dz (a = 1), real part
    /// and imaginary part side by side.
    P* state_at(int a, int c, int q) const {
      const int size = K_ - a + 1;
      return state_[static_cast<std::size_t>(a)] + 2 * (c * size - c * (c - 1) / 2 + q);
    }

    /// A step of Horner's rule in zeta + eta.
    void add_order(int a, int c, const P& real, const P& imaginary) {
      P* p = state_at(a, c, 0);
      for (int q = K_ - a - c; q >= 0; --q) {
        const P re = p[2 * q];
        const P im = p[2 * q + 1];
        p[2 * q] = (q > 0 ? p[2 * q - 2] : real) + x_ * re - y_ * im;
        p[2 * q + 1] = (q > 0 ? p[2 * q - 1] : imaginary) + x_ * im + y_ * re;
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
    void to_monomials(int a, P* out) const {
      for (int n = 0; n <= K_ - a; ++n) {
        const std::vector<Real>& weights = plane_weights<Real>(n);
        for (int j = 0; j <= n; ++j) out[local_index(n - j, j, a)] = P();
        for (int c = 0; 2 * c <= n; ++c) {
          P re = state_at(a, c, n - c)[0];
          P im = state_at(a, c, n - c)[1];
          if (2 * c < n) {
            re += state_at(a, n - c, c)[0];
            im -= state_at(a, n - c, c)[1];
          }
          for (int j = 0; j <= n; ++j) {
            const P weight(weights[static_cast<std::size_t>(c * (n + 1) + j)]);
            P& to = out[local_index(n - j, j, a)];
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
    P x_;
    P y_;
    int K_;
    P t_;        ///< kappa z
    P twice_t_;  ///< 2 kappa z
    P kappa2_;
    P inverse_kappa_;
    std::array<P*, 2> column_;
    P* powers_;
    std::array<P*, 2> state_;
    const Real* inverses_;
  };

  int degree_;
  int order_;
  std::vector<std::vector<Real>> rows_;
};

}  // namespace hamjet
