#include "dynamics/fields/spherical_harmonic_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "hamjet/dynamics/relative_hamiltonian.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/error.hpp"
#include "local_values.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"
#include "support/reference_data.hpp"

namespace hamjet {
namespace {

/// The coefficients of data/references/spherical_harmonics.py.
double reference_coefficient(int n, int m, bool is_sine) {
  if (n == 0 || (m == 0 && is_sine)) return 0;
  const auto number = static_cast<std::uint64_t>(n * 7919 + m * 104729 + (is_sine ? 15485863 : 0));
  const std::uint64_t mixed = number * 2654435761 % (std::uint64_t{1} << 32);
  return (static_cast<double>(mixed) * 0x1p-32 - 0.5) / (n * n);
}

SphericalHarmonicCoefficients made_up(int degree, int order) {
  SphericalHarmonicCoefficients result(degree, order);
  for (int n = 1; n <= degree; ++n) {
    for (int m = 0; m <= std::min(n, order); ++m) {
      result.C(n, m) = reference_coefficient(n, m, false);
      result.S(n, m) = reference_coefficient(n, m, true);
    }
  }
  return result;
}

/// What a coefficient of degree k may err, in roundings of the largest one of its degree, where the
/// field has harmonics to degree N. Each value of a recursion of N steps carries as many roundings,
/// and kappa^n, rounded, as many again; what is added up to a derivative is up to 3^k times as
/// large as that. Beside the poles z/r, rounded, changes P_n by n (n + 1) / 2 roundings, because
/// its slope there is that.
template <class Real>
double allowance(int N, int k, const std::array<Real, 3>& r) {
  const auto component = [&](std::size_t i) { return std::abs(static_cast<double>(r[i])); };
  const bool is_polar = std::max(component(0), component(1)) < 0.2 * component(2);
  return (is_polar ? 0.5 * N * (N + 5) : 2 * N) * std::pow(3, k);
}

template <class Real>
void expect_reference_values() {
  const auto data = test::read_reference_file("spherical_harmonics.json");
  SphericalHarmonicCoefficients coefficients = made_up(data["degree"], data["degree"]);
  // Without the central term, beside which the errors of the others would not show.
  coefficients.C(0, 0) = 0;
  const SphericalHarmonicField field(1, 1, coefficients);
  const int order = data["order"];
  ASSERT_EQ(data["points"].size(), 7U);
  for (const auto& point : data["points"]) {
    std::array<Real, 3> r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = Real(test::from_hex(point["point_hex"][i]));
    const std::vector<Extended> expected = test::decimals(point["coefficients"]);
    const std::vector<Real> c = test::expanded(field, r, order);
    for (int k = 0; k <= order; ++k) {
      EXPECT_LE(test::roundings(c, expected, k), allowance(coefficients.degree(), k, r))
          << point["point_hex"] << ", degree " << k;
    }
    // Expanded to a lower degree, they are the same numbers.
    const std::vector<Real> fewer = test::expanded(field, r, 2);
    for (int k = 0; k <= 2; ++k) {
      EXPECT_LE(test::roundings(fewer, expected, k), allowance(coefficients.degree(), k, r));
    }
  }
}

// Random points, the poles, the axis, the equator; numbers of mpmath, of 36 digits.
TEST(SphericalHarmonicField, AllDerivativesToOrderNineOfAField70By70InDouble) {
  expect_reference_values<double>();
}
TEST(SphericalHarmonicField, AllDerivativesToOrderNineOfAField70By70InDoubleDouble) {
  expect_reference_values<DoubleDouble>();
}
TEST(SphericalHarmonicField, AllDerivativesToOrderNineOfAField70By70InExtended) {
  expect_reference_values<Extended>();
}

// The zonal field has formulas of its own, which are evaluated as power series.
TEST(SphericalHarmonicField, ZonalCoefficientsAreThoseOfTheZonalField) {
  ZonalGravity zonal{.mu = 1.25, .radius = 0.875};
  SphericalHarmonicCoefficients coefficients(20, 0);
  for (int n = 2; n <= 20; ++n) {
    zonal.J[n] = (n % 3 == 0 ? -1.0 : 1.0) / (n * n);
    coefficients.C(n, 0) = -zonal.J[n] / std::sqrt(2 * n + 1);
  }
  const SphericalHarmonicField field(zonal.mu, zonal.radius, coefficients);
  const DynamicalSystem system = zonal_gravity(zonal);
  const auto space = SeriesSpace::create(6, 6);
  const auto positions = SeriesSpace::create(3, 6);
  for (const auto& r : std::vector<std::array<double, 3>>{
           {0.8, -0.5, 0.6}, {0, 0, 1.25}, {0, 0, -1}, {1.5, 0, 0}, {1e-9, 1e-3, -0.9}}) {
    std::vector<Series<Extended>> z;
    for (std::size_t i = 0; i < 6; ++i) {
      z.push_back(Series<Extended>::variable(space, i, i < 3 ? Extended(r[i]) : Extended(0)));
    }
    const Series<Extended> energy = evaluate_on_series(system.hamiltonian, z)[0];
    const std::vector<double> c = test::expanded(field, r, 6);
    std::vector<Extended> expected;
    std::vector<std::uint8_t> exponents(6);
    for (std::size_t k = 0; k < positions->size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) exponents[i] = positions->exponents(k)[i];
      expected.push_back(-energy[space->index(exponents)]);
    }
    for (int k = 0; k <= 6; ++k)
      EXPECT_LE(test::roundings(c, expected, k), allowance(20, k, r)) << k;
  }
}

// U_11 = sqrt(3) mu R (C x + S y) / r^3; with N = sqrt(15) / 2, U_22 = N mu R^2 [C (x^2 - y^2) + 2
// S x y] / r^5.
TEST(SphericalHarmonicField, ClosedFormsOfLowDegree) {
  const double mu = 1.5;
  const double R = 0.75;
  const std::array<double, 3> r = {0.625, -1.125, 0.375};
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  SphericalHarmonicCoefficients first(1, 1);
  first.C(0, 0) = 0;
  first.C(1, 1) = 0.25;
  first.S(1, 1) = -0.5;
  const auto c = test::expanded(SphericalHarmonicField(mu, R, first), r, 1);
  const double a = std::sqrt(3) * mu * R / std::pow(length, 3);
  const double plane = 0.25 * r[0] - 0.5 * r[1];
  EXPECT_NEAR(c[0], a * plane, 1e-14);
  const std::array<double, 3> slope = {0.25, -0.5, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(c[1 + i], a * (slope[i] - 3 * plane * r[i] / (length * length)), 1e-14);
  }
  SphericalHarmonicCoefficients second(2, 2);
  second.C(2, 2) = 0.25;
  second.S(2, 2) = 0.125;
  const double b = std::sqrt(15) / 2 * mu * R * R / std::pow(length, 5);
  const double square = 0.25 * (r[0] * r[0] - r[1] * r[1]) + 0.25 * r[0] * r[1];
  const auto d = test::expanded(SphericalHarmonicField(mu, R, second), r, 1);
  EXPECT_NEAR(d[0], mu / length + b * square, 1e-14);
  const std::array<double, 3> rise = {0.5 * r[0] + 0.25 * r[1], -0.5 * r[1] + 0.25 * r[0], 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double expected =
        -mu * r[i] / std::pow(length, 3) + b * (rise[i] - 5 * square * r[i] / (length * length));
    EXPECT_NEAR(d[1 + i], expected, 1e-14);
  }
}

// On the axis, mu / (z + t) = mu / z sum over k of (-t / z)^k.
TEST(SphericalHarmonicField, WithoutHarmonicsItIsThatOfAPointMass) {
  const SphericalHarmonicField field(3, 1, SphericalHarmonicCoefficients(0, 0));
  const auto c = test::expanded<double>(field, {0, 0, -2}, 8);
  for (int k = 0; k <= 8; ++k) {
    EXPECT_NEAR(c[local_field_size(k) - 1], 1.5 * std::pow(0.5, k), 1e-14) << k;
  }
  EXPECT_EQ(field.waves_on_a_circle(), 0);
}

TEST(SphericalHarmonicField, ItsPolynomialsAreHarmonic) {
  const SphericalHarmonicField field(1, 1, made_up(36, 30));
  const int degree = 7;
  const auto c = test::expanded<double>(field, {0.7, 0.6, -0.5}, degree);
  const auto index = [](int i, int j, int k) {
    const int rest = j + k;
    const std::size_t before = i + rest == 0 ? 0 : local_field_size(i + rest - 1);
    return before + static_cast<std::size_t>(rest * (rest + 1) / 2 + k);
  };
  for (int n = 2; n <= degree; ++n) {
    const auto first = c.begin() + static_cast<std::ptrdiff_t>(local_field_size(n - 1));
    const auto end = c.begin() + static_cast<std::ptrdiff_t>(local_field_size(n));
    const double size = std::abs(*std::max_element(
        first, end, [](double a, double b) { return std::abs(a) < std::abs(b); }));
    for (int i = 0; i <= n - 2; ++i) {
      for (int j = 0; i + j <= n - 2; ++j) {
        const int k = n - 2 - i - j;
        const double sum = (i + 2) * (i + 1) * c[index(i + 2, j, k)] +
                           (j + 2) * (j + 1) * c[index(i, j + 2, k)] +
                           (k + 2) * (k + 1) * c[index(i, j, k + 2)];
        EXPECT_LE(std::abs(sum), 8 * n * n * size * 0x1p-53) << i << j << k;
      }
    }
  }
}

// Degree 120 and derivatives to order 9, and the highest degree that is taken, at the poles, beside
// them and 60 radii away: double agrees with double-double numbers.
TEST(SphericalHarmonicField, HighDegreesNeitherOverflowNorLoseDigits) {
  for (const auto& [degree, order] : {std::pair{120, 9}, std::pair{600, 1}}) {
    const SphericalHarmonicField field(1, 1, made_up(degree, degree));
    for (const auto& r : std::vector<std::array<double, 3>>{
             {0, 0, 1}, {1e-7, 0, -1}, {0.8, 0, 0.6}, {0, 60, 0}, {0, 0, 60}}) {
      const auto c = test::expanded(field, r, order);
      const auto precise = test::expanded<DoubleDouble>(field, {r[0], r[1], r[2]}, order);
      const std::vector<Extended> expected(precise.begin(), precise.end());
      for (int k = 0; k <= order; ++k) {
        EXPECT_LE(test::roundings(c, expected, k), allowance(degree, k, r)) << degree << " " << k;
      }
    }
  }
}

// Points side by side, in any number, and in several threads.
TEST(SphericalHarmonicField, NoLaneDependsOnAnother) {
  const SphericalHarmonicField field(1, 1, made_up(12, 8));
  test::RandomNumbers random(7);
  std::array<std::vector<double>, 3> r;
  for (std::size_t lane = 0; lane < 19; ++lane) {
    for (auto& component : r) component.push_back(random.uniform(0.6, 1.4));
  }
  const auto expand = [&](std::size_t first, std::size_t count) {
    std::vector<double> out(local_field_size(4) * count);
    field.expand(count, &r[0][first], &r[1][first], &r[2][first], 4, out.data());
    return out;
  };
  const auto all = expand(0, 19);
  const auto expect_same = [&](std::size_t first, std::size_t count) {
    const auto some = expand(first, count);
    for (std::size_t k = 0; k < local_field_size(4); ++k) {
      for (std::size_t lane = 0; lane < count; ++lane) {
        EXPECT_EQ(some[k * count + lane], all[k * 19 + first + lane]);
      }
    }
  };
  expect_same(0, 8);
  expect_same(3, 2);
  expect_same(11, 8);
  std::vector<std::thread> threads;
  for (std::size_t first : {0, 4, 8}) threads.emplace_back([&, first] { expect_same(first, 7); });
  for (std::thread& thread : threads) thread.join();
}

TEST(SphericalHarmonicField, WavesAndWork) {
  SphericalHarmonicCoefficients coefficients(36, 36);
  coefficients.S(7, 3) = 1e-9;
  EXPECT_EQ(SphericalHarmonicField(1, 1, coefficients).waves_on_a_circle(), 7);
  const SphericalHarmonicField field(1, 1, made_up(20, 20));
  EXPECT_LT(field.multiply_adds(1), field.multiply_adds(5));
}

TEST(SphericalHarmonicField, RefusesWhatIsNoField) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_refused = [](double mu, double radius, const SphericalHarmonicCoefficients& c) {
    try {
      SphericalHarmonicField(mu, radius, c);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    }
  };
  const SphericalHarmonicCoefficients central(2, 2);
  expect_refused(0, 1, central);
  expect_refused(1, -1, central);
  expect_refused(nan, 1, central);
  expect_refused(1, 1, SphericalHarmonicCoefficients(601, 0));
  SphericalHarmonicCoefficients bad = central;
  bad.S(2, 1) = nan;
  expect_refused(1, 1, bad);
}

}  // namespace
}  // namespace hamjet
