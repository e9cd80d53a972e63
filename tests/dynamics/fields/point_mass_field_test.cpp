#include "dynamics/fields/point_mass_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hamjet/error.hpp"
#include "local_values.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

using Point = std::array<Extended, 3>;

Extended length_of(const Point& v) {
  return sqrt(Extended(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
}

template <class Real>
Point extended(const std::array<Real, 3>& v) {
  return {Extended(v[0]), Extended(v[1]), Extended(v[2])};
}

/// At d = r/32 the terms beyond degree 12 are below 32^-13 = 3e-20 of the value.
TEST(PointMassField, ItsPolynomialIsThePotentialNearby) {
  const PointMassField field(2.5);
  const Point r = {Extended(1), Extended(-2), Extended(2)};
  const Point d = {Extended(1) / 32, Extended(1) / 16, Extended(-1) / 16};
  const auto c = test::expanded(field, r, 12);
  const Extended expected = Extended(2.5) / length_of({r[0] + d[0], r[1] + d[1], r[2] + d[2]});
  EXPECT_LE(test::magnitude_of(test::polynomial_value(c, d, 12) - expected), 3e-20);
  const auto rounded = test::expanded<double>(field, {1, -2, 2}, 12);
  for (int k = 0; k <= 12; ++k) EXPECT_LE(test::roundings(rounded, c, k), 16 * (k + 1)) << k;
}

/// U = mu (1 / |r - s| - 1 / |s| - r.s / |s|^3) and its gradient as they are written, in extended
/// precision, of which the cancellation leaves 24 digits at least.
void expect_tide(const std::array<double, 3>& r, const std::array<double, 3>& s) {
  const double mu = 1.25;
  const PointMassField field(mu);
  std::vector<double> c(local_field_size(4));
  field.expand_tide(1, &r[0], &r[1], &r[2], &s[0], &s[1], &s[2], 4, c.data());
  const Point x = extended(r);
  const Point body = extended(s);
  const Point apart = {x[0] - body[0], x[1] - body[1], x[2] - body[2]};
  const Extended D = length_of(body);
  const Extended rho = length_of(apart);
  const Extended along = x[0] * body[0] + x[1] * body[1] + x[2] * body[2];
  const Extended value = mu * (1 / rho - 1 / D - along / (D * D * D));
  // The size of a tide, which vanishes nowhere but at the centre.
  const Extended square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
  const Extended size = mu * square / (rho * D * D);
  EXPECT_LE(test::magnitude_of((Extended(c[0]) - value) / size), 40 * 0x1p-53);
  for (std::size_t i = 0; i < 3; ++i) {
    const Extended slope = -mu * (apart[i] / (rho * rho * rho) + body[i] / (D * D * D));
    const Extended scale = mu * sqrt(square) / (rho * rho * std::min(rho, D));
    EXPECT_LE(test::magnitude_of((Extended(c[1 + i]) - slope) / scale), 40 * 0x1p-53) << i;
  }
  const std::array<double, 3> difference = {r[0] - s[0], r[1] - s[1], r[2] - s[2]};
  const auto direct = test::expanded(field, difference, 4);
  for (std::size_t k = local_field_size(1); k < c.size(); ++k) EXPECT_EQ(c[k], direct[k]);
}

// Kilometres: the Sun and the Moon from a low orbit, the Moon from far out and from beside it; a
// satellite at right angles to the mass.
TEST(PointMassField, ATideKeepsItsDigits) {
  expect_tide({-2436.45, -2436.45, 6891.037}, {1.2e8, -8.1e7, 3.5e7});
  expect_tide({-2436.45, -2436.45, 6891.037}, {-3.1e5, 2.0e5, 9.1e4});
  expect_tide({1.1e5, 2.7e5, -4.0e4}, {-3.1e5, 2.0e5, 9.1e4});
  expect_tide({-3.0e5, 1.9e5, 9.0e4}, {-3.1e5, 2.0e5, 9.1e4});
  expect_tide({0, 7000, 0}, {3.8e5, 0, 0});
}

// The coefficients of degree 0 and 1 belong to those above them: all together they are the
// potential nearby.
TEST(PointMassField, TheTidesPolynomialIsOneOfOnePotential) {
  const PointMassField field(2);
  const Point s = {Extended(2), Extended(-1), Extended(2)};
  const Point r = {Extended(1) / 4, Extended(1) / 2, Extended(-1) / 4};
  const Point d = {Extended(1) / 64, Extended(-1) / 32, Extended(1) / 32};
  const auto expand = [&](const Point& at, int degree) {
    std::vector<Extended> c(local_field_size(degree));
    field.expand_tide(1, &at[0], &at[1], &at[2], &s[0], &s[1], &s[2], degree, c.data());
    return c;
  };
  const Extended here = test::polynomial_value(expand(r, 14), d, 14);
  const Extended there = expand({r[0] + d[0], r[1] + d[1], r[2] + d[2]}, 0)[0];
  // The distance of the mass is above 3.2, and |d| = 3/64: (3/64/3.2)^15 = 3e-28.
  EXPECT_LE(test::magnitude_of(here - there), 3e-28);
}

TEST(PointMassField, RefusesWhatIsNoMass) {
  for (const double mu : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(PointMassField{mu}, Error);
  }
}

}  // namespace
}  // namespace hamjet
