#pragma once

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet::test {

/// Flights by Boost.odeint in long double, with the zonal field's acceleration written by hand:
///
///   a = -mu r^ / r^2 - sum_n mu J_n R^n / r^(n+2) [ P_n'(s) (z^ - s r^) - (n+1) P_n(s) r^ ] ,
///
/// s = z/r. It shares nothing with hamjet's operation lists, integrators and sections.
class IndependentFlight {
 public:
  using State = std::array<long double, 6>;

  explicit IndependentFlight(const ZonalGravity& field, long double tolerance = 1e-17L)
      : field_(field), tolerance_(tolerance) {}

  State operator()(State state, long double time) const {
    namespace odeint = boost::numeric::odeint;
    const auto slope = [&](const State& z, State& dz, long double) { derivative(z, dz); };
    const auto stepper = odeint::make_controlled(
        tolerance_, tolerance_,
        odeint::runge_kutta_fehlberg78<State, long double, State, long double>());
    odeint::integrate_adaptive(stepper, slope, state, 0.0L, time, time / 100);
    return state;
  }

 private:
  void derivative(const State& z, State& dz) const {
    const long double r = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const long double s = z[2] / r;
    long double radial = -field_.mu / (r * r);
    long double axial = 0;
    long double before = 1, legendre = s;     // P_(n-1), P_n
    long double slope_before = 0, slope = 1;  // the derivatives of both
    long double power = field_.mu * field_.radius / (r * r * r);
    for (int n = 2; n <= 6; ++n) {
      const long double next = ((2 * n - 1) * s * legendre - (n - 1) * before) / n;
      const long double next_slope = slope_before + (2 * n - 1) * legendre;
      before = legendre;
      legendre = next;
      slope_before = slope;
      slope = next_slope;
      power *= field_.radius / r;
      const long double size = field_.J[static_cast<std::size_t>(n)] * power;
      radial += size * ((n + 1) * legendre + s * slope);
      axial -= size * slope;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      dz[i] = z[i + 3];
      dz[i + 3] = radial * z[i] / r;
    }
    dz[5] += axial;
  }

  ZonalGravity field_;
  long double tolerance_;
};

inline IndependentFlight::State long_state(const SixNumbers<double>& z) {
  return {z[0], z[1], z[2], z[3], z[4], z[5]};
}
inline SixNumbers<double> rounded(const IndependentFlight::State& z) {
  SixNumbers<double> result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = static_cast<double>(z[i]);
  return result;
}

/// J2 to J6 of EGM96, rounded.
inline ZonalGravity egm96(double radius) {
  ZonalGravity field;
  field.radius = radius;
  field.J[2] = 1.0826266835e-3;
  field.J[3] = -2.5326564853e-6;
  field.J[4] = -1.6196215914e-6;
  field.J[5] = -2.2729608287e-7;
  field.J[6] = 5.4068123911e-7;
  return field;
}

}  // namespace hamjet::test
