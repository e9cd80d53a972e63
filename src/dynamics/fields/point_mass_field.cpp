#include "point_mass_field.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hamjet/error.hpp"
#include "local_polynomial.hpp"
#include "points_in_packs.hpp"

namespace hamjet {
namespace {

template <class P>
P dot_of(const std::array<P, 3>& a, const std::array<P, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Sets the coefficients of mu / |r + d|.
template <class P>
void expand_point_mass(const P& mu, const std::array<P, 3>& r, int degree, P* c) {
  using Real = typename P::real_type;
  const P inverse = P(Real(1)) / sqrt(dot_of(r, r));
  const std::array<P, 3> unit = {r[0] * inverse, r[1] * inverse, r[2] * inverse};
  expand_inverse_distance(unit, degree, c);
  scale_by_degree(mu * inverse, inverse, degree, c);
}

template <class Real>
void expand_direct(double mu, std::size_t count, const Real* x, const Real* y, const Real* z,
                   int degree, Real* out) {
  for_points_in_packs<Real, 3>(count, {x, y, z}, local_field_size(degree), out,
                               [&]<class P>(const std::array<P, 3>& r, P* c) {
                                 expand_point_mass(P(Real(mu)), r, degree, c);
                               });
}

/// With D = |s|, y = |r - s| / D and q = y^2 - 1 = r.(r - 2 s) / D^2 (R. H. Battin, An Introduction
/// to the Mathematics and Methods of Astrodynamics, section 8.4, for the gradient),
///
///   U = mu / D [q^2 (y + 2) / (2 y (1 + y)^2) - r.r / (2 D^2)],
///   grad U = -mu / |r - s|^3 [r + s q (y^2 + y + 1) / (1 + y)] .
template <class P>
void set_low_degrees(const P& mu, const std::array<P, 3>& r, const std::array<P, 3>& s,
                     const std::array<P, 3>& from_mass, int degree, P* c) {
  using Real = typename P::real_type;
  const P one(Real(1));
  const P two(Real(2));
  const P inverse = one / sqrt(dot_of(s, s));
  const P inverse2 = inverse * inverse;
  const P distance = sqrt(dot_of(from_mass, from_mass));
  const P y = distance * inverse;
  const std::array<P, 3> beyond = {r[0] - two * s[0], r[1] - two * s[1], r[2] - two * s[2]};
  const P q = dot_of(r, beyond) * inverse2;
  c[0] = mu * inverse *
         (q * q * (y + two) / (two * y * (one + y) * (one + y)) - dot_of(r, r) * inverse2 / two);
  if (degree == 0) return;
  const P attraction = mu / (distance * distance * distance);
  const P along_mass = q * (y * y + y + one) / (one + y);
  for (std::size_t i = 0; i < 3; ++i) c[1 + i] = -attraction * (r[i] + along_mass * s[i]);
}

template <class Real>
void expand_relative(double mu, std::size_t count, const std::array<const Real*, 6>& inputs,
                     int degree, Real* out) {
  for_points_in_packs<Real, 6>(
      count, inputs, local_field_size(degree), out, [&]<class P>(const std::array<P, 6>& v, P* c) {
        const std::array<P, 3> r = {v[0], v[1], v[2]};
        const std::array<P, 3> s = {v[3], v[4], v[5]};
        const std::array<P, 3> from_mass = {r[0] - s[0], r[1] - s[1], r[2] - s[2]};
        expand_point_mass(P(Real(mu)), from_mass, degree, c);
        set_low_degrees(P(Real(mu)), r, s, from_mass, degree, c);
      });
}

}  // namespace

PointMassField::PointMassField(double mu) : mu_(mu) {
  if (!(mu > 0) || !std::isfinite(mu)) {
    throw Error(ErrorKind::usage,
                fmt::format("the gravity constant of a body must be positive, got {}", mu));
  }
}

void PointMassField::expand(std::size_t count, const double* x, const double* y, const double* z,
                            int degree, double* out) const {
  expand_direct(mu_, count, x, y, z, degree, out);
}
void PointMassField::expand(std::size_t count, const Extended* x, const Extended* y,
                            const Extended* z, int degree, Extended* out) const {
  expand_direct(mu_, count, x, y, z, degree, out);
}
void PointMassField::expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                            const DoubleDouble* z, int degree, DoubleDouble* out) const {
  expand_direct(mu_, count, x, y, z, degree, out);
}

void PointMassField::expand_tide(std::size_t count, const double* x, const double* y,
                                 const double* z, const double* sx, const double* sy,
                                 const double* sz, int degree, double* out) const {
  expand_relative<double>(mu_, count, {x, y, z, sx, sy, sz}, degree, out);
}
void PointMassField::expand_tide(std::size_t count, const Extended* x, const Extended* y,
                                 const Extended* z, const Extended* sx, const Extended* sy,
                                 const Extended* sz, int degree, Extended* out) const {
  expand_relative<Extended>(mu_, count, {x, y, z, sx, sy, sz}, degree, out);
}
void PointMassField::expand_tide(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                                 const DoubleDouble* z, const DoubleDouble* sx,
                                 const DoubleDouble* sy, const DoubleDouble* sz, int degree,
                                 DoubleDouble* out) const {
  expand_relative<DoubleDouble>(mu_, count, {x, y, z, sx, sy, sz}, degree, out);
}

double PointMassField::multiply_adds(int degree) const {
  // The recursion takes seven for each coefficient at most.
  return 7 * static_cast<double>(local_field_size(degree));
}

}  // namespace hamjet
