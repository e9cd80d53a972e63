#include "hamjet/dynamics/zonal_gravity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

// The zonal terms are compared with an independent evaluation in extended precision, which uses
// Legendre polynomials by their explicit sums and the gradient in spherical components.

namespace hamjet {
namespace {

using Point = std::array<Extended, 3>;

Extended length_of(const Point& v) {
  return sqrt(Extended(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
}

Extended binomial(int n, int k) {
  Extended result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// P_n(s) = 2^-n sum_k (-1)^k C(n, k) C(2n - 2k, n) s^(n-2k), and its derivative. At n = 20 the
/// terms are a million times larger than the sum at most, of 34 digits.
std::pair<Extended, Extended> legendre(int n, const Extended& s) {
  Extended value = 0;
  Extended derivative = 0;
  for (int k = 0; 2 * k <= n; ++k) {
    const int power = n - 2 * k;
    const Extended coefficient =
        (k % 2 == 0 ? 1 : -1) * binomial(n, k) * binomial(2 * n - 2 * k, n) / (1 << n);
    value += coefficient * pow(s, power);
    if (power > 0) derivative += coefficient * power * pow(s, power - 1);
  }
  return {value, derivative};
}

/// Z_n = P_n(z/r) / r^(n+1).
Extended solid_zonal(int n, const Point& q) {
  const Extended r = length_of(q);
  return legendre(n, Extended(q[2] / r)).first / pow(r, n + 1);
}

/// Its gradient: along the radius, and at right angles to it in the meridian, where the unit vector
/// is (e_z - s e_r) / cos(latitude) and the slope P'_n(s) cos(latitude) / r^(n+2).
Point solid_zonal_gradient(int n, const Point& q) {
  const Extended r = length_of(q);
  const Extended s = q[2] / r;
  const auto [value, derivative] = legendre(n, s);
  const Extended scale = 1 / pow(r, n + 2);
  Point result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Extended radial = q[i] / r;
    const Extended axis = i == 2 ? 1 : 0;
    result[i] = scale * (-(n + 1) * value * radial + derivative * (axis - s * radial));
  }
  return result;
}

/// A thousand points at all latitudes, r from R = 1 to 10. Every tenth is within 1e-9 to 0.1 of a
/// pole or of the equator, in terms of z/r; the first four are on the axis and in the equator.
std::vector<std::array<double, 3>> random_points() {
  test::RandomNumbers random(2020);
  std::vector<std::array<double, 3>> points = {
      {0, 0, 1.25}, {0, 0, -3}, {1.5, 0, 0}, {-0.75, 1.25, 0}};
  while (points.size() < 1000) {
    const double r = std::pow(10, random.uniform(0, 1));
    double s = random.uniform(-1, 1);
    const double small = std::pow(10, random.uniform(-9, -1));
    const double sign = s < 0 ? -1 : 1;
    if (points.size() % 20 == 0) s = sign * small;
    if (points.size() % 20 == 10) s = sign * (1 - small);
    const double longitude = random.uniform(0, 2 * std::numbers::pi);
    const double rho = r * std::sqrt((1 - s) * (1 + s));
    points.push_back({rho * std::cos(longitude), rho * std::sin(longitude), r * s});
  }
  return points;
}

/// A single coefficient so large that the central attraction is small beside its term: the measured
/// error is that of the term.
ZonalGravity term_alone(int n) {
  ZonalGravity field{.mu = 1, .radius = 1};
  field.J[n] = 1e40;
  return field;
}

Point exact_force(const ZonalGravity& field, const Point& q) {
  const Extended r = length_of(q);
  Point force;
  for (std::size_t i = 0; i < 3; ++i) force[i] = -q[i] / (r * r * r);
  for (int n = 2; n <= 20; ++n) {
    if (field.J[n] == 0) continue;
    const Point gradient = solid_zonal_gradient(n, q);
    const Extended c = Extended(field.J[n]) * pow(Extended(field.radius), n);
    for (std::size_t i = 0; i < 3; ++i) force[i] -= c * gradient[i];
  }
  for (Extended& component : force) component *= field.mu;
  return force;
}

Extended exact_potential(const ZonalGravity& field, const Point& q) {
  Extended sum = 1 / length_of(q);
  for (int n = 2; n <= 20; ++n) {
    if (field.J[n] == 0) continue;
    sum -= Extended(field.J[n]) * pow(Extended(field.radius), n) * solid_zonal(n, q);
  }
  return -Extended(field.mu) * sum;
}

/// |force of the list - exact force|.
template <class Real>
Extended force_error(const OperationList& force, const ZonalGravity& field, const Point& q) {
  std::vector<Real> position;
  for (const Extended& x : q) position.push_back(static_cast<Real>(x));
  const std::vector<Real> computed = test::evaluate_list(force, position);
  const Point exact = exact_force(field, q);
  Point difference;
  for (std::size_t i = 0; i < 3; ++i) difference[i] = Extended(computed[i]) - exact[i];
  return length_of(difference);
}

TEST(ZonalTerms, LegendrePolynomialsOfTheTestAreThoseOfBoost) {
  for (int n = 0; n <= 20; ++n) {
    for (const double s : {-1.0, -0.7, 0.0, 0.1, 0.93, 1.0}) {
      const Extended from_boost = boost::math::legendre_p(n, Extended(s));
      EXPECT_LE(test::magnitude_of(legendre(n, Extended(s)).first - from_boost), 1e-26)
          << n << " " << s;
    }
  }
}

/// Checks that every single term is right at a thousand points; `error` is relative to the term's
/// size.
template <class Error>
void expect_right_to_one_part_in_1e14(const Error& error) {
  const auto points = random_points();
  for (int n = 2; n <= 20; ++n) {
    const ZonalGravity field = term_alone(n);
    const DynamicalSystem system = zonal_gravity(field);
    double worst = 0;
    for (const auto& point : points) worst = test::larger(worst, error(n, field, system, point));
    EXPECT_LT(worst, 1e-14) << "J" << n;
    testing::Test::RecordProperty("J" + std::to_string(n), std::to_string(worst * 1e15) + "e-15");
  }
}

// The size of a term is the magnitude of its own force, |grad(J_n R^n Z_n)|, which vanishes nowhere
// (P_n and P'_n have no common zero).
TEST(ZonalTerms, ForceIsRightToOnePartIn1e14AtAThousandPoints) {
  expect_right_to_one_part_in_1e14([](int n, const ZonalGravity& field,
                                      const DynamicalSystem& system,
                                      const std::array<double, 3>& point) {
    const Point q{point[0], point[1], point[2]};
    const Extended size = Extended(field.J[n]) * length_of(solid_zonal_gradient(n, q));
    const Extended error = force_error<double>(system.second_order->force, field, q);
    return static_cast<double>(Extended(error / size));
  });
}

// P_n vanishes at n latitudes, so that the size of a potential is J_n (R/r)^n / r, its bound.
TEST(ZonalTerms, PotentialIsRightToOnePartIn1e14AtAThousandPoints) {
  expect_right_to_one_part_in_1e14([](int n, const ZonalGravity& field,
                                      const DynamicalSystem& system,
                                      const std::array<double, 3>& point) {
    const Point q{point[0], point[1], point[2]};
    const Extended size = Extended(field.J[n]) / pow(length_of(q), n + 1);
    const double computed =
        test::energy(system, std::vector<double>{point[0], point[1], point[2], 0, 0, 0});
    const Extended error = Extended(computed) - exact_potential(field, q);
    return test::magnitude_of(error / size);
  });
}

ZonalGravity all_terms() {
  ZonalGravity field{.mu = 1.25, .radius = 0.875};
  for (int n = 2; n <= 20; ++n) field.J[n] = (n % 3 == 0 ? -1.0 : 1.0) / (n * n);
  return field;
}

TEST(ZonalTerms, AllTogetherAreRightInExtendedPrecision) {
  const ZonalGravity field = all_terms();
  const DynamicalSystem system = zonal_gravity(field);
  const auto points = random_points();
  for (std::size_t i = 0; i < points.size(); i += 10) {
    const Point q{points[i][0], points[i][1], points[i][2]};
    // The sums of the test lose six of 34 digits.
    const Extended size = length_of(exact_force(field, q));
    EXPECT_LE(force_error<Extended>(system.second_order->force, field, q), size * 1e-27);
    const Extended potential =
        test::energy(system, std::vector<Extended>{q[0], q[1], q[2], 0, 0, 0});
    EXPECT_LE(test::magnitude_of(potential - exact_potential(field, q)), 1e-27);
  }
}

// As series: the force is minus the gradient of the Hamiltonian to degree 4, for the whole set and
// for subsets that start and end anywhere.
TEST(ZonalTerms, ForceIsTheGradientOfTheHamiltonianAsSeries) {
  const auto space = SeriesSpace::create(6, 4);
  std::vector<Series<Extended>> z;
  const double point[] = {0.8, -0.5, 0.6, 0.3, 0.7, -0.2};
  for (std::size_t i = 0; i < 6; ++i) z.push_back(Series<Extended>::variable(space, i, point[i]));
  const std::vector<Series<Extended>>& inputs = z;
  for (const std::vector<int>& subset : std::vector<std::vector<int>>{
           {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20},
           {2, 4, 6},
           {5},
           {7, 8},
           {9},
           {3, 20}}) {
    ZonalGravity field{.mu = 1.25, .radius = 0.875};
    for (const int n : subset) field.J[n] = 1.0 / n;
    const auto written = zonal_gravity(field);
    const auto derived = make_system("derived", written.hamiltonian);
    const auto a = evaluate_on_series(written.vector_field, inputs);
    const auto b = evaluate_on_series(derived.vector_field, inputs);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LE(test::largest_coefficient(a[i] - b[i]),
                1e-29 * (10 + test::largest_coefficient(a[i])))
          << subset.front() << " to " << subset.back();
    }
  }
}

// The number of operations that each coefficient adds to an evaluation: an absent highest
// coefficient adds none, an absent lower coefficient costs the recursion's steps, and odd
// coefficients cost a product with z.
TEST(ZonalTerms, CostWhatTheTableSays) {
  const auto operations = [](const std::vector<int>& present) {
    ZonalGravity field{.mu = 1, .radius = 0.9};
    for (const int n : present) field.J[n] = 1e-3;
    return zonal_gravity(field).second_order->force.nonlinear_operations();
  };
  const auto up_to = [](int highest) {
    std::vector<int> present;
    for (int n = 2; n <= highest; ++n) present.push_back(n);
    return present;
  };
  // Three products for two degrees to J7, and four from J8 on; J3 brings 1/r^2 and z, J8 s^2 and y.
  const std::vector<std::size_t> expected = {7,  10, 13, 15, 16, 18, 19, 23, 25, 27,
                                             29, 31, 33, 35, 37, 39, 41, 43, 45, 47};
  for (int highest = 1; highest <= 20; ++highest) {
    EXPECT_EQ(operations(up_to(highest)), expected[static_cast<std::size_t>(highest - 1)])
        << "J2 to J" << highest;
  }
  EXPECT_EQ(operations({2, 4, 6}), 17U);
  EXPECT_EQ(operations({3}), 13U);
}

TEST(ZonalTerms, AnEquatorialOrbitStaysInItsPlaneWithEvenOnesAlone) {
  const std::vector<double> equatorial{1, 0, 0, 0, 1, 0};
  const std::vector<std::size_t> plane{0, 1, 3, 4};
  ZonalGravity field{.mu = 1, .radius = 0.9};
  for (int n = 2; n <= 20; n += 2) field.J[n] = 1e-3;
  EXPECT_TRUE(field.J.is_even());
  EXPECT_EQ(needed_degrees_of_freedom(zonal_gravity(field), equatorial, plane),
            (std::vector<std::size_t>{0, 1}));
  for (int n = 3; n <= 19; n += 2) {
    ZonalGravity odd = field;
    odd.J[n] = 1e-9;
    EXPECT_FALSE(odd.J.is_even());
    EXPECT_EQ(needed_degrees_of_freedom(zonal_gravity(odd), equatorial, plane),
              (std::vector<std::size_t>{0, 1, 2}))
        << n;
  }
}

// Mirrored space: z to -z turns the sign of the odd coefficients, bit by bit.
TEST(ZonalTerms, OddOnesChangeSignInMirroredSpace) {
  ZonalGravity mirrored = all_terms();
  for (int n = 3; n <= 19; n += 2) mirrored.J[n] = -mirrored.J[n];
  const auto system = zonal_gravity(all_terms());
  const auto image = zonal_gravity(mirrored);
  for (const auto& q : random_points()) {
    const auto force =
        test::evaluate_list(system.second_order->force, std::vector<double>{q[0], q[1], q[2]});
    const auto reflected =
        test::evaluate_list(image.second_order->force, std::vector<double>{q[0], q[1], -q[2]});
    EXPECT_EQ(force, (std::vector<double>{reflected[0], reflected[1], -reflected[2]}));
    if (testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace hamjet
