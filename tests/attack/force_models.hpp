#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "line_series.hpp"

// The equations of motion of every model that a scene can name, written from the formulas of the
// literature: q' = p / m, p' = force(q).

namespace hamjet::attack {

enum class ModelKind {
  zonal_gravity,  ///< Kepler's problem if there are no zonal coefficients; mu = 1
  harmonic_oscillator,
  double_well,
  oscillator_pair,
  spring_pendulum,
  fermi_pasta_ulam,
};

struct Model {
  ModelKind kind = ModelKind::zonal_gravity;
  std::size_t degrees_of_freedom = 3;
  double radius = 0;               ///< radius of the zonal coefficients
  std::array<double, 21> zonal{};  ///< J_n at index n
  double mass = 1;
  double stiffness = 1;
  double second_stiffness = 1;
  double length = 1;
  double gravity = 0;
  double omega = 1;
};

/// The momentum of an oscillation of amplitude 1, which is mass times the fastest frequency. It
/// makes the momenta of a model comparable with positions, near rest too. It is 0 for an orbit,
/// whose nominal always has a position and a momentum of its own.
inline double momentum_of_amplitude(const Model& model) {
  switch (model.kind) {
    case ModelKind::zonal_gravity:
      return 0;
    case ModelKind::fermi_pasta_ulam:
      return model.omega;
    case ModelKind::double_well:
      return 1;
    default:
      return std::sqrt(model.stiffness * model.mass);
  }
}

/// Of V = -(1/r) (1 - sum J_n (R/r)^n P_n(s)), s = z/r. With e_r the radial unit vector,
///
///   force = -e_r / r^2 + sum J_n R^n / r^(n+2) (P'_(n+1)(s) e_r - P'_n(s) e_z) ,
///
/// for (n+1) P_n + s P'_n = P'_(n+1). D_n = u^(n-1) P'_n(s), u = R/r, follows from
/// n P'_(n+1) = (2n+1) s P'_n - (n+1) P'_(n-1) (Abramowitz and Stegun 8.5.3, differentiated):
///
///   D_0 = 0, D_1 = 1, n D_(n+1) = (2n+1) (s u) D_n - (n+1) u^2 D_(n-1) .
template <class T, int N>
void zonal_force(const Model& model, const LineSeries<T, N>* q, LineSeries<T, N>* force) {
  using S = LineSeries<T, N>;
  const S square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
  const S inverse_cube = half_power(square, -3);
  for (int i = 0; i < 3; ++i) force[i] = T(-1) * (inverse_cube * q[i]);
  int highest = 20;
  while (highest > 1 && model.zonal[static_cast<std::size_t>(highest)] == 0) --highest;
  if (highest < 2) return;
  const S inverse_square = half_power(square, -2);
  const T radius(model.radius);
  const S u_square = (radius * radius) * inverse_square;  // u^2
  const S z_part = radius * (q[2] * inverse_square);      // s u
  S before;                                               // D_(n-1)
  S now(T(1));                                            // D_n
  S radial, axial;                                        // sum J_n D_(n+1), sum J_n D_n
  for (int n = 1; n <= highest; ++n) {
    S next = T(2 * n + 1) * (z_part * now);
    if (n > 1) next -= T(n + 1) * (u_square * before);
    next *= T(1) / T(n);
    const double coefficient = model.zonal[static_cast<std::size_t>(n)];
    if (n >= 2 && coefficient != 0) {
      radial += T(coefficient) * next;
      axial += T(coefficient) * now;
    }
    before = now;
    now = next;
  }
  // e_r / r^2 = q / r^3, and J_n R^n / r^(n+2) P'_n = J_n D_n R / r^3.
  for (int i = 0; i < 3; ++i) force[i] += radial * (inverse_cube * q[i]);
  force[2] -= radius * (axial * inverse_cube);
}

/// The force on each coordinate.
template <class T, int N>
void force_of(const Model& model, const LineSeries<T, N>* q, LineSeries<T, N>* force) {
  using S = LineSeries<T, N>;
  switch (model.kind) {
    case ModelKind::zonal_gravity:
      zonal_force(model, q, force);
      return;
    case ModelKind::harmonic_oscillator:
      force[0] = T(-model.stiffness) * q[0];
      return;
    case ModelKind::oscillator_pair:
      force[0] = T(-model.stiffness) * q[0];
      force[1] = T(-model.second_stiffness) * q[1];
      return;
    case ModelKind::double_well:  // V = (q^4 - q^2) / 2
      force[0] = q[0] - T(2) * (q[0] * q[0] * q[0]);
      return;
    case ModelKind::spring_pendulum: {  // tension k (|q| - l) along the spring, weight
      const S inverse = half_power(q[0] * q[0] + q[1] * q[1], -1);
      S pull = T(model.stiffness) * (T(model.length) * inverse);
      pull[0] -= T(model.stiffness);
      force[0] = pull * q[0];
      force[1] = pull * q[1];
      force[1][0] -= T(model.mass) * T(model.gravity);
      return;
    }
    case ModelKind::fermi_pasta_ulam: {
      const std::size_t points = model.degrees_of_freedom;
      for (std::size_t i = 0; i < points; ++i) force[i] = S();
      // Springs 0 to `points`; spring i lies between points i - 1 and i, and there are walls at
      // both ends. Springs of odd number are stiff, with the energy omega^2/4 stretch^2; the others
      // have the energy stretch^4.
      const T stiff = T(model.omega) * T(model.omega) * T(0.5);
      for (std::size_t i = 0; i <= points; ++i) {
        S stretch = i < points ? q[i] : S();
        if (i > 0) stretch -= q[i - 1];
        const S tension = i % 2 == 1 ? stiff * stretch : T(4) * (stretch * stretch * stretch);
        if (i < points) force[i] -= tension;
        if (i > 0) force[i - 1] += tension;
      }
      return;
    }
  }
}

}  // namespace hamjet::attack
