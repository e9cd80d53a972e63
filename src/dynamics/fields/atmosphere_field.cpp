#include "atmosphere_field.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geodetic_height.hpp"
#include "hamjet/error.hpp"
#include "local_polynomial.hpp"
#include "meridian_polynomial.hpp"
#include "points_in_packs.hpp"

namespace hamjet {
namespace {

/// The radius of the poles in radii of the equator, squared.
template <class Real>
Real polar_radius_squared(const ReferenceEllipsoid& ellipsoid) {
  const Real b = Real(1) - Real(ellipsoid.flattening);
  return b * b;
}

/// How far below the lowest height of a table the density is continued, as an exponential.
constexpr double height_below_table_km = 25;

}  // namespace

AtmosphereField::AtmosphereField(DensityProfile profile, double length_km, double factor,
                                 const ReferenceEllipsoid& ellipsoid)
    : profile_(std::move(profile)), ellipsoid_(ellipsoid), length_km_(length_km), factor_(factor) {
  const auto is_positive = [](double value) { return value > 0 && std::isfinite(value); };
  if (!is_positive(length_km) || !is_positive(factor)) {
    throw Error(ErrorKind::usage,
                fmt::format("the unit of length and the factor of an atmosphere must be positive, "
                            "got {} km and {}",
                            length_km, factor));
  }
  if (!is_positive(ellipsoid.equatorial_radius_km) ||
      !(ellipsoid.flattening >= 0 && ellipsoid.flattening < 0.5)) {
    throw Error(ErrorKind::usage,
                fmt::format("an ellipsoid must have a positive radius and a flattening of at least "
                            "0 and below 1/2, got {} km and {}",
                            ellipsoid.equatorial_radius_km, ellipsoid.flattening));
  }
}

template <class Real>
void AtmosphereField::expand_in(std::size_t count, const Real* x, const Real* y, const Real* z,
                                int degree, Real* out) const {
  const Real a = Real(ellipsoid_.equatorial_radius_km);
  const Real radii = Real(length_km_) / a;
  const Real b2 = polar_radius_squared<Real>(ellipsoid_);
  for_points_in_packs<Real, 3>(
      count, {x, y, z}, local_field_size(degree), out,
      [&]<class P>(const std::array<P, 3>& r, P* c) {
        static thread_local GeodeticHeight<P> height;
        static thread_local std::vector<P> density;
        static thread_local std::vector<P> of_meridian;
        static thread_local std::vector<P> plane;
        density.resize(static_cast<std::size_t>(degree) + 1);
        of_meridian.resize(plane_index(degree + 1, 0));
        plane.resize(plane_index(degree + 1, 0));
        const P unit(radii);
        const P ex = unit * r[0];
        const P ey = unit * r[1];
        const P ez = unit * r[2];
        const P* const h = height.expand(ex * ex + ey * ey, ez, P(b2), degree);
        const P height_km = P(a) * h[0];
        profile_.expand(height_km, degree, density.data());
        // A flight that decays is followed no further than the table knows the air: below, density
        // and time of flight are guesses, and steps become ever shorter.
        const double lowest = profile_.table().heights_km.front() - height_below_table_km;
        P scale = P::of_lanes([&](std::size_t lane) {
          const bool is_known = height_km.lane(static_cast<int>(lane)) >= Real(lowest);
          return is_known ? Real(factor_) : Real(std::numeric_limits<double>::quiet_NaN());
        });
        for (P& coefficient : density) {
          coefficient *= scale;
          scale *= P(a);
        }
        compose(density.data(), h, degree, of_meridian.data());
        expand_about_axis(ex, ey, of_meridian.data(), degree, plane.data(), c);
        scale_by_degree(P(Real(1)), unit, degree, c);
      });
}

double AtmosphereField::height_km(double x, double y, double z) const {
  using P = Pack<double, 1>;
  const double radii = length_km_ / ellipsoid_.equatorial_radius_km;
  GeodeticHeight<P> height;
  const P p2 = (radii * x) * (radii * x) + (radii * y) * (radii * y);
  const P b2 = polar_radius_squared<double>(ellipsoid_);
  return ellipsoid_.equatorial_radius_km * height.expand(p2, P(radii * z), b2, 0)[0].lane(0);
}

void AtmosphereField::expand(std::size_t count, const double* x, const double* y, const double* z,
                             int degree, double* out) const {
  expand_in(count, x, y, z, degree, out);
}
void AtmosphereField::expand(std::size_t count, const Extended* x, const Extended* y,
                             const Extended* z, int degree, Extended* out) const {
  expand_in(count, x, y, z, degree, out);
}
void AtmosphereField::expand(std::size_t count, const DoubleDouble* x, const DoubleDouble* y,
                             const DoubleDouble* z, int degree, DoubleDouble* out) const {
  expand_in(count, x, y, z, degree, out);
}

double AtmosphereField::multiply_adds(int degree) const {
  // Six products of polynomials of two variables for the height, as many terms again in the plane
  // of dx and dy, and one such product of each degree in the composition.
  const double n = degree;
  const double product = (n + 1) * (n + 2) * (n + 3) * (n + 4) / 24;
  return 10 * product + product * (n + 5) / 5;
}

}  // namespace hamjet
