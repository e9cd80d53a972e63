#include "dynamics/fields/atmosphere_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "atmosphere_reference.hpp"
#include "dynamics/fields/geodetic_height.hpp"
#include "dynamics/fields/harris_priester_table.hpp"
#include "hamjet/error.hpp"
#include "local_values.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

constexpr double factor = 3;

AtmosphereField harris_priester_field(bool of_maximum) {
  const HarrisPriesterTable table = harris_priester_table();
  return AtmosphereField(of_maximum ? table.maximum : table.minimum, 1000, factor);
}

std::vector<Extended> expected_coefficients(const test::AtmosphereReference& reference) {
  std::vector<Extended> result;
  for (const char* digits : reference.coefficients) result.push_back(factor * Extended(digits));
  return result;
}

template <class Real>
void expect_reference(const test::AtmosphereReference& reference) {
  const AtmosphereField field = harris_priester_field(reference.of_maximum);
  const std::array<Real, 3> r = {reference.point[0], reference.point[1], reference.point[2]};
  const auto c = test::expanded(field, r, 6);
  const auto expected = expected_coefficients(reference);
  // The height is right to a few roundings of the distance from the centre.
  for (int n = 0; n <= 6; ++n) {
    const double condition = reference.condition[static_cast<std::size_t>(n)];
    EXPECT_LE(test::roundings(c, expected, n), 16 * condition) << n;
  }
}

TEST(AtmosphereField, ItsPolynomialIsTheDefinitions) {
  for (const auto& reference : test::atmosphere_references) {
    SCOPED_TRACE(reference.point[0]);
    expect_reference<double>(reference);
    expect_reference<DoubleDouble>(reference);
    expect_reference<Extended>(reference);
  }
}

// The error of a polynomial of degree n at half the distance is 2^(n+1) times as small.
TEST(AtmosphereField, HigherDegreesBelongToTheSameFunction) {
  const AtmosphereField field = harris_priester_field(false);
  const std::array<Extended, 3> r = {Extended(4.25), Extended(-3.5), Extended(3.875)};
  const auto c = test::expanded(field, r, 9);
  const auto error = [&](const Extended& scale, int degree) {
    const std::array<Extended, 3> d = {scale, scale / -2, scale / 2};
    const std::array<Extended, 3> there = {r[0] + d[0], r[1] + d[1], r[2] + d[2]};
    return Extended(test::polynomial_value(c, d, degree) - test::expanded(field, there, 0)[0]);
  };
  const Extended step = Extended(1) / 4096;
  for (int n = 0; n <= 9; ++n) {
    const Extended ratio = error(step, n) / error(step / 2, n);
    EXPECT_NEAR(static_cast<double>(ratio) / std::exp2(n + 1), 1, 0.05) << n;
  }
}

// Expected densities below and above the table come from the same program as atmosphere_references.
TEST(AtmosphereField, TheDensityGoesOnBeyondItsTable) {
  const AtmosphereField field = harris_priester_field(false);
  const Extended low = test::expanded<Extended>(field, {3, 4.5, 3.515625}, 0)[0];
  const Extended low_expected = factor * Extended("1.38643538150728653981909823499392287e-5");
  EXPECT_LE(test::magnitude_of(low / low_expected - 1), 1e-29);
  const Extended far = test::expanded<Extended>(field, {-1.5, 30, 40.5}, 0)[0];
  const Extended far_expected = factor * Extended("2.27992379095184487988589774316133033e-156");
  EXPECT_LE(test::magnitude_of(far / far_expected - 1), 1e-29);
  EXPECT_NEAR(field.height_km(3, 4.5, 3.515625), 78.7890547485083880, 1e-11);
  // More than 25 km below the table nothing is known.
  EXPECT_TRUE(isnan(test::expanded<Extended>(field, {3, 4.5, 3.4}, 0)[0]));
  EXPECT_NEAR(field.height_km(-1.5, 30, 40.5), 44058.8638335032817, 1e-10);
}

/// The error of the height, in roundings of the distance from the centre, of the point that lies h
/// above the ellipsoid at a latitude, lengths in radii of the equator: p = (N + h) cos(latitude), z
/// = (N b^2 + h) sin(latitude), N = 1 / sqrt(1 - (1 - b^2) sin^2).
template <class Real>
double height_error(const Extended& b, const Extended& sine, const Extended& cosine,
                    const Extended& h) {
  using P = Pack<Real, 1>;
  const Extended b2 = b * b;
  const Extended N = 1 / sqrt(Extended(1 - (1 - b2) * sine * sine));
  const Extended p = (N + h) * cosine;
  const Extended z = (N * b2 + h) * sine;
  GeodeticHeight<P> height;
  const Real x = convert<Real>(p);
  const P found = height.expand(P(Real(x * x)), P(convert<Real>(z)), P(convert<Real>(b2)), 0)[0];
  const Extended error = Extended(found.lane(0)) - h;
  return test::magnitude_of(error / sqrt(Extended(p * p + z * z))) / test::rounding_of<Real>();
}

TEST(AtmosphereField, HeightsAreRightFromPoleToEquator) {
  std::array<double, 3> largest{};
  for (const double flattening : {0.0, 1 / 298.257223563, 0.1}) {
    // The heights range from 80 km below the ground to 60000 km above it.
    for (const double h : {-0.0125, 0.0125, 0.06, 0.3, 1.0, 9.4}) {
      for (const double angle : {0.0, 1e-9, 0.01, 0.3, 0.8, 1.2, 1.57, 1.570796326794}) {
        const Extended b = Extended(1) - flattening;
        const Extended sine = angle == 0 ? Extended(0) : Extended(sin(Extended(angle)));
        const Extended cosine = sqrt(Extended(1 - sine * sine));
        // The angle and its complement, both ends exactly.
        for (const bool swapped : {false, true}) {
          const Extended& s = swapped ? cosine : sine;
          const Extended& c = swapped ? sine : cosine;
          largest[0] = test::larger(largest[0], height_error<double>(b, s, c, h));
          largest[1] = test::larger(largest[1], height_error<DoubleDouble>(b, s, c, h));
          largest[2] = test::larger(largest[2], height_error<Extended>(b, -s, c, h));
        }
      }
    }
  }
  for (const double error : largest) EXPECT_LE(error, 16);
}

// A point of which the density is asked stands among others, which are far or have no height.
TEST(AtmosphereField, LanesDoNotDependOnEachOther) {
  const AtmosphereField field = harris_priester_field(true);
  constexpr int degree = 5;
  const auto expand = [&](double other) {
    std::array<double, 8> x;
    x.fill(other);
    x[3] = 4.25;
    std::array<double, 8> y{};
    y[3] = -3.5;
    std::array<double, 8> z{};
    z[3] = 3.875;
    std::vector<double> c(8 * local_field_size(degree));
    field.expand(8, x.data(), y.data(), z.data(), degree, c.data());
    return c;
  };
  const auto first = expand(6.75);
  for (const double other : {0.0, 0.02, 50.0, std::numeric_limits<double>::infinity()}) {
    const auto c = expand(other);
    for (std::size_t k = 0; k < local_field_size(degree); ++k) {
      EXPECT_EQ(c[k * 8 + 3], first[k * 8 + 3]);
      EXPECT_EQ(std::isfinite(c[k * 8]), other == 50.0) << other;
    }
  }
}

TEST(AtmosphereField, RefusesWhatIsNoUnitAndNoEllipsoid) {
  const DensityTable table = harris_priester_table().minimum;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, infinity, std::nan("")}) {
    EXPECT_THROW(AtmosphereField(table, bad), Error);
    EXPECT_THROW(AtmosphereField(table, 1, bad), Error);
    EXPECT_THROW(AtmosphereField(table, 1, 1, {bad, 0}), Error);
  }
  for (const double bad : {-0.1, 0.5, std::nan("")}) {
    EXPECT_THROW(AtmosphereField(table, 1, 1, {6378.137, bad}), Error);
  }
}

}  // namespace
}  // namespace hamjet
