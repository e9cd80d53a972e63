#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "hamjet/detail/algebra/pack.hpp"
#include "meridian_polynomial.hpp"

// The height above an ellipsoid of revolution, with its equatorial radius as unit of length. b is
// the polar radius. The foot (X, Z) of the point (p, z) of a meridian lies along the normal (X, Z /
// b^2) under it,
//
//   p = X (1 + k),   z = Z (1 + k / b^2),   F(k) = p^2 / (1 + k)^2 + b^2 z^2 / (b^2 + k)^2 = 1,
//
// so that the height is h = k sqrt(p^2 / (1 + k)^2 + z^2 / (b^2 + k)^2), a smooth function of
// p^2 = x^2 + y^2 and z.

namespace hamjet {

/// The step of Newton's method for F(k)^(-1/2) = 1, which is nearly linear in k.
template <class P>
P foot_step(const P& p2, const P& z2, const P& b2, const P& k) {
  using Real = typename P::real_type;
  const P one(Real(1));
  const P u = one / (one + k);
  const P v = one / (b2 + k);
  const P across = p2 * u * u;
  const P along = b2 * z2 * v * v;
  const P F = across + along;
  return F * (sqrt(F) - one) / (across * u + along * v);
}

/// The k of the foot in double precision; NaN where the point has no single foot, near the
/// centre.
template <int Lanes>
Pack<double, Lanes> foot_in_double(const Pack<double, Lanes>& p2, const Pack<double, Lanes>& z2,
                                   const Pack<double, Lanes>& b2) {
  using P = Pack<double, Lanes>;
  P k = sqrt(p2 + z2) - P(1.0);
  P step;
  // Each lane takes as many steps, so that none depends on another one. The first error is the
  // flattening at most.
  for (int i = 0; i < 6; ++i) {
    step = foot_step(p2, z2, b2, k);
    k += step;
  }
  for (int lane = 0; lane < Lanes; ++lane) {
    // Beyond the centre k + b^2 is negative.
    if (!(std::abs(step.lane(lane)) <= 0x1p-40 * (k.lane(lane) + b2.lane(lane)))) {
      k.set_lane(lane, std::numeric_limits<double>::quiet_NaN());
    }
  }
  return k;
}

/// Finds what foot_in_double finds, to the precision of P.
template <class P>
P foot_of(const P& p2, const P& z2, const P& b2) {
  using Real = typename P::real_type;
  if constexpr (std::is_same_v<Real, double>) {
    return foot_in_double(p2, z2, b2);
  } else {
    Pack<double, P::lanes> rough_p2;
    Pack<double, P::lanes> rough_z2;
    Pack<double, P::lanes> rough_b2;
    for (int lane = 0; lane < P::lanes; ++lane) {
      rough_p2.set_lane(lane, static_cast<double>(p2.lane(lane)));
      rough_z2.set_lane(lane, static_cast<double>(z2.lane(lane)));
      rough_b2.set_lane(lane, static_cast<double>(b2.lane(lane)));
    }
    const auto rough = foot_in_double(rough_p2, rough_z2, rough_b2);
    P k;
    for (int lane = 0; lane < P::lanes; ++lane) k.set_lane(lane, Real(rough.lane(lane)));
    // The first step doubles the digits, the second one removes what is left of a few roundings.
    for (int i = 0; i < 2; ++i) k += foot_step(p2, z2, b2, k);
    return k;
  }
}

/// The Taylor polynomial of the height in the deviations of x^2 + y^2 and z (see
/// meridian_polynomial.hpp). Objects are scratch that is used again.
template <class P>
class GeodeticHeight {
 public:
  /// The polynomial about a point to a degree, valid until the next call.
  const P* expand(const P& p2, const P& z, const P& b2, int degree) {
    using Real = typename P::real_type;
    const P one(Real(1));
    const P two(Real(2));
    for (auto* v : {&k_, &u_, &v_, &u2_, &v2_, &F_, &normal2_, &normal_, &height_}) {
      v->resize(plane_index(degree + 1, 0));
    }
    k_[0] = foot_of(p2, z * z, b2);
    u_[0] = one / (one + k_[0]);
    v_[0] = one / (b2 + k_[0]);
    u2_[0] = u_[0] * u_[0];
    v2_[0] = v_[0] * v_[0];
    const P u3 = u2_[0] * u_[0];
    const P v3 = v2_[0] * v_[0];
    const P half_slope = one / (two * (p2 * u3 + b2 * z * z * v3));
    // Degree by degree: F = 1 with an unknown k_n gives F_n(k_n = 0) - 2 G k_n = 0, G = -F' / 2.
    for (int n = 1; n <= degree; ++n) {
      const std::size_t first = plane_index(n, 0);
      for (int j = 0; j <= n; ++j) k_[plane_index(n, j)] = P();
      set_reciprocal(k_.data(), n, u_.data());
      set_reciprocal(k_.data(), n, v_.data());
      set_square(u_.data(), n, u2_.data());
      set_square(v_.data(), n, v2_.data());
      set_quadratic_form(p2, u2_.data(), b2, z, v2_.data(), n, F_.data());
      for (std::size_t i = first; i < first + static_cast<std::size_t>(n + 1); ++i) {
        k_[i] = F_[i] * half_slope;
        u_[i] -= u2_[0] * k_[i];
        v_[i] -= v2_[0] * k_[i];
        u2_[i] -= two * u3 * k_[i];
        v2_[i] -= two * v3 * k_[i];
      }
    }
    for (int n = 0; n <= degree; ++n) {
      set_quadratic_form(p2, u2_.data(), one, z, v2_.data(), n, normal2_.data());
    }
    normal_[0] = sqrt(normal2_[0]);
    const P half_reciprocal = one / (two * normal_[0]);
    for (int n = 1; n <= degree; ++n) {
      set_root(normal2_.data(), half_reciprocal, n, normal_.data());
    }
    for (int n = 0; n <= degree; ++n) {
      for (int j = 0; j <= n; ++j) height_[plane_index(n, j)] = P();
      for (int m = 0; m <= n; ++m) {
        add_homogeneous_product(k_.data(), m, normal_.data(), n - m, one, height_.data());
      }
    }
    return height_.data();
  }

 private:
  std::vector<P> k_;
  std::vector<P> u_;  // 1 / (1 + k)
  std::vector<P> v_;  // 1 / (b^2 + k)
  std::vector<P> u2_;
  std::vector<P> v2_;
  std::vector<P> F_;
  std::vector<P> normal2_;  // The square of the normal's length.
  std::vector<P> normal_;
  std::vector<P> height_;
};

}  // namespace hamjet
