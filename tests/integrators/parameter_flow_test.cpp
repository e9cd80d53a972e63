#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "dynamics/fields/point_mass_field.hpp"
#include "dynamics/fields/spherical_harmonic_field.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "support/exponential_air.hpp"
#include "support/flow.hpp"
#include "support/line_of_flights.hpp"
#include "support/turning_axes.hpp"

// Several parameters at once as variables of a jet: mu, a zonal coefficient, C_D A / m, the
// density, C_R A / m and a thrust, against differences of flights whose forces are written here by
// hand.

namespace hamjet {
namespace {

using test::Numbers;

constexpr double tilt = 0.3, rate = 0.06;  // the tilt and the rate of the axes and of the air
constexpr double J2 = 1.1e-3, J3 = -2e-5, radius = 0.95;
constexpr double lowest_km = 100, density = 0.3, scale_height_km = 120;
constexpr std::array<double, 3> sun = {5, 2, 1}, sun_rate = {-0.02, 0.05, 0.01};
constexpr double sunlight = 2;  // the acceleration by it at the distance 1
constexpr double mu_unit = 4;   // mu as a parameter is 4, in a unit of which one is 1/4

enum Parameter : std::size_t {
  drag,
  factor,
  mu,
  second_zonal,
  thrust_R,
  thrust_T,
  thrust_N,
  light,
  count
};

DynamicalSystem system_with_parameters() {
  SphericalHarmonicCoefficients field(3, 0);
  field.C(0, 0) = 1;
  field.C(2, 0) = -J2 / std::sqrt(5.0);
  field.C(3, 0) = -J3 / std::sqrt(7.0);
  SphericalHarmonicCoefficients unit(2, 0);
  unit.C(0, 0) = 0;
  unit.C(2, 0) = -1 / std::sqrt(5.0);
  GravityOfTurningBody body;
  body.potential = std::make_shared<const SphericalHarmonicField>(1.0, radius, field);
  body.axes = std::make_shared<const test::TurningAxes>(tilt, rate);
  body.variations = {
      {std::make_shared<const SphericalHarmonicField>(1.0, radius, unit), {J2, second_zonal}}};
  body.scale = {1, mu};
  body.unit_of_scale = Extended(1) / mu_unit;
  body.parameters = count;
  RadiationPressure pressure;
  pressure.potential = std::make_shared<const PointMassField>(sunlight);
  pressure.sun = std::make_shared<const test::MovingPoint>(sun, sun_rate);
  pressure.coefficient = {0, light};
  body.radiation = pressure;
  TurningAtmosphere air;
  air.least = test::exponential_air(lowest_km, density, scale_height_km);
  air.rate = rate;
  air.factor = {1, factor};
  OrbitThrust thrust;
  thrust.along = {SpacecraftCoefficient{0, thrust_R}, SpacecraftCoefficient{0, thrust_T},
                  SpacecraftCoefficient{0, thrust_N}};
  thrust.unit = 1e-2;
  return with_drag(with_thrust(earth_gravity(body), thrust), body.axes, air, {0, drag});
}

using Triple = std::array<Extended, 3>;

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Extended inner(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The same forces by their formulas: J2 and J3 about the tilted axis as in Montenbruck and Gill,
/// chapter 3, air that falls exponentially above a sphere, light that falls as the square of the
/// distance of a Sun that moves, the thrust along R, T, N.
Numbers rates(const Numbers& z, Extended t) {
  const Triple q = {z[0], z[1], z[2]}, p = {z[3], z[4], z[5]};
  const Triple axis = {0, -sin(Extended(tilt)), cos(Extended(tilt))};
  const Extended r = sqrt(inner(q, q)), s = inner(q, axis) / r;
  const Extended a = radius / r, gravity = z[6 + mu] / mu_unit / (r * r);
  const Extended j2 = z[6 + second_zonal] * a * a, j3 = J3 * a * a * a;
  // U = mu/r (1 - j2 P2(s) - j3 P3(s)): its derivatives by r and by s.
  const Extended P2 = (3 * s * s - 1) / 2, P3 = (5 * s * s * s - 3 * s) / 2;
  const Extended by_r = -gravity * (1 - 3 * j2 * P2 - 4 * j3 * P3);
  const Extended by_s = -gravity * (j2 * 3 * s + j3 * (15 * s * s - 3) / 2);
  const Triple turning = cross(axis, q);
  const Triple v = {p[0] - rate * turning[0], p[1] - rate * turning[1], p[2] - rate * turning[2]};
  const Extended height_km = (r - 1) * test::air_radius_km;
  const Extended air = z[6 + factor] * density * exp(-(height_km - lowest_km) / scale_height_km);
  const Extended braking = -z[6 + drag] * air * sqrt(inner(v, v)) / 2;
  const Triple h = cross(q, p);
  const Extended size = sqrt(inner(h, h));
  const Triple R = {q[0] / r, q[1] / r, q[2] / r}, N = {h[0] / size, h[1] / size, h[2] / size};
  const Triple T = cross(N, R);
  Triple from_sun;
  for (std::size_t i = 0; i < 3; ++i) from_sun[i] = q[i] - sun[i] - sun_rate[i] * t;
  const Extended near = sqrt(inner(from_sun, from_sun));
  const Extended push = z[6 + light] * sunlight / (near * near * near);
  Numbers result(z.size(), 0);
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = p[i];
    result[3 + i] =
        by_r * R[i] + by_s * (axis[i] - s * R[i]) + braking * v[i] + push * from_sun[i] +
        1e-2 * (z[6 + thrust_R] * R[i] + z[6 + thrust_T] * T[i] + z[6 + thrust_N] * N[i]);
  }
  return result;
}

TEST(ParameterFlow, DerivativesByAllParametersAreThoseOfFlights) {
  std::vector<double> start = {0.8, -0.5, 0.43, 0.594, 0.756, -0.216};
  start.resize(6 + count, 0);
  start[6 + drag] = 0.03;
  start[6 + factor] = 1;
  start[6 + mu] = mu_unit;
  start[6 + second_zonal] = J2;
  start[6 + light] = 0.02;
  const double time = 2.5;
  const FlowJet<double> jet =
      test::run_gauss(test::Flow<double>{system_with_parameters(), start, time, 3});
  ASSERT_EQ(jet.size(), start.size());
  const auto differences = [&](const std::vector<double>& direction, Extended h) {
    return test::coefficients_by_differences(
        [&](Extended s) {
          Numbers z(start.begin(), start.end());
          for (std::size_t i = 0; i < z.size(); ++i) z[i] += s * direction[i];
          return test::extrapolated_flight(rates, z, 0, time, 8);
        },
        h);
  };
  constexpr double steps[count] = {0.03, 0.5, 0.3, 0.02, 3, 3, 3, 0.5};
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> direction(start.size(), 0);
    direction[6 + k] = steps[k];
    EXPECT_LT(test::largest_difference(jet, direction, differences(direction, 2e-4), 6), 1e-9) << k;
  }
  // All numbers at once take every mixed derivative.
  std::vector<double> all = {0.03, -0.02, 0.05, 0.04, 0.01, -0.03};
  for (std::size_t k = 0; k < count; ++k) all.push_back((k % 2 == 0 ? 0.2 : -0.3) * steps[k]);
  EXPECT_LT(test::largest_difference(jet, all, differences(all, 2e-4), 6), 1e-9);
}

/// Without parameters the list of operations is what it was: no product is added.
TEST(ParameterFlow, FieldsWithoutParametersCostNothing) {
  GravityOfTurningBody body;
  body.potential = std::make_shared<const SphericalHarmonicField>(1.0, radius, [] {
    SphericalHarmonicCoefficients field(2, 0);
    field.C(0, 0) = 1;
    return field;
  }());
  body.axes = std::make_shared<const test::TurningAxes>(tilt, rate);
  const DynamicalSystem plain = earth_gravity(body);
  body.scale = {1, 0};
  body.parameters = 1;
  const DynamicalSystem varied = earth_gravity(body);
  // Three components of the force are multiplied by mu.
  EXPECT_EQ(varied.vector_field.nonlinear_operations(),
            plain.vector_field.nonlinear_operations() + 3);
}

}  // namespace
}  // namespace hamjet
