#pragma once

#include <span>
#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Constants of a zonal gravity field, in any consistent units (canonical: mu = 1).
struct ZonalGravity {
  double mu = 1;
  double radius = 0;  ///< reference radius of the zonal coefficients
  double J2 = 0;      ///< 0: absent
  double J3 = 0;      ///< 0: absent; the Earth's own is negative
};

/// H = |p|^2/2 - mu/r [1 - J2 (R/r)^2 P2(z/r) - J3 (R/r)^3 P3(z/r)],
/// P2(s) = (3 s^2 - 1)/2, P3(s) = (5 s^3 - 3 s)/2, z along the axis of the body. Momenta are per
/// unit mass. Source: Guibout and Bloch, section "Earth orbit"; sign convention of J3 as printed
/// there.
struct ZonalGravityHamiltonian {
  ZonalGravity field;

  template <class T>
  T operator()(std::span<const T> q, std::span<const T> p) const {
    const T mu(field.mu);
    const T radius(field.radius);
    const T s2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const T inverse_s2 = T(1) / s2;
    const T z2 = q[2] * q[2];
    T bracket(1);
    if (field.J2 != 0) {
      const T c2 = T(field.J2) * radius * radius / T(2);
      bracket -= c2 * inverse_s2 * (T(3) * z2 * inverse_s2 - T(1));
    }
    if (field.J3 != 0) {
      const T c3 = T(field.J3) * radius * radius * radius / T(2);
      bracket -= c3 * inverse_s2 * inverse_s2 * q[2] * (T(5) * z2 * inverse_s2 - T(3));
    }
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / T(2) - mu * bracket / sqrt(s2);
  }
};

/// The force -dV/dq of the same potential, arranged for few products of series. With
/// u = 1/r^2, w = r^-3, t = z u, s^2 = z t, c2 = 3/2 J2 R^2 and c3 = 5/2 J3 R^3:
///
///   F_x = -mu x w [1 + c2 u (1 - 5 s^2) + c3 u t (3 - 7 s^2)],   F_y alike,
///   F_z = -mu z w [same bracket] - mu w [2 c2 t + (3/5) c3 u (5 s^2 - 1)].
struct ZonalGravityForce {
  ZonalGravity field;

  template <class T>
  std::vector<T> operator()(std::span<const T> q) const {
    const T mu(field.mu);
    const T radius(field.radius);
    const T s2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const T w = mu * pow(s2, T(-1.5));
    if (field.J2 == 0 && field.J3 == 0) return {-w * q[0], -w * q[1], -w * q[2]};

    const T c2 = T(1.5) * T(field.J2) * radius * radius;
    const T c3 = T(2.5) * T(field.J3) * radius * radius * radius;
    const T u = T(1) / s2;
    const T t = q[2] * u;
    const T sine2 = q[2] * t;
    const T latitude = u * (T(1) - T(5) * sine2);
    T bracket = c2 * latitude;
    T axial = T(2) * c2 * t;
    if (field.J3 != 0) {
      bracket += c3 * (u * (t * (T(3) - T(7) * sine2)));
      axial -= T(3) / T(5) * c3 * latitude;
    }
    const T total = w + w * bracket;
    return {-total * q[0], -total * q[1], -total * q[2] - w * axial};
  }
};

/// The system in z = (x, y, z, p_x, p_y, p_z); with J2 = J3 = 0 it is Kepler's problem.
DynamicalSystem zonal_gravity(const ZonalGravity& field);

/// Kepler's problem, H = |p|^2/2 - mu/r, in three dimensions.
DynamicalSystem kepler(double mu = 1);

}  // namespace hamjet
