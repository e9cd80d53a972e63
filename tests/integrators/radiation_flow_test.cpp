#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "dynamics/fields/point_mass_field.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "support/flow.hpp"
#include "support/turning_axes.hpp"

namespace hamjet {
namespace {

/// Motion about a point mass in light from a Sun so far away that its direction and strength are
/// constant: the acceleration f away from (distance, 0, 0).
DynamicalSystem lit(double acceleration) {
  constexpr double distance = 1e7;
  GravityOfTurningBody body;
  body.potential = std::make_shared<const PointMassField>(1.0);
  body.axes = std::make_shared<const test::TurningAxes>(0.3, 0.06);
  RadiationPressure light;
  light.potential = std::make_shared<const PointMassField>(distance * distance);
  light.sun = std::make_shared<const test::MovingPoint>(std::array<double, 3>{distance, 0, 0},
                                                        std::array<double, 3>{0, 0, 0});
  light.coefficient = {acceleration};
  body.radiation = light;
  return earth_gravity(body);
}

/// The eccentricity vector of an orbit with mu = 1.
std::array<double, 3> eccentricity(const std::vector<double>& z) {
  const double r = std::hypot(z[0], z[1], z[2]);
  const double v2 = z[3] * z[3] + z[4] * z[4] + z[5] * z[5];
  const double rv = z[0] * z[3] + z[1] * z[4] + z[2] * z[5];
  std::array<double, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) e[i] = (v2 - 1 / r) * z[i] - rv * z[3 + i];
  return e;
}

/// In constant light from the plane of an orbit its eccentricity vector grows across the Sun's
/// direction by de/dt = 3/2 sqrt(1 - e^2) f / (n a) in the mean of a revolution (H. Koelle, or
/// Soop, Handbook of Geostationary Orbits, section 4.2), with n = a = 1 here.
TEST(RadiationFlow, EccentricityGrowsAcrossTheSunsDirection) {
  const double f = 1e-6;
  const double time = 5 * 2 * M_PI;
  test::Flow<double> flow{lit(f), {1, 0, 0, 0, 1, 0}, time, 1};
  const std::vector<double> end = test::final_state(test::run_gauss(flow));
  const std::array<double, 3> e = eccentricity(end);
  const double growth = 1.5 * f * time;
  // Light slows what moves towards the Sun, along +x at -y, so that the perigee is at +y. Terms of
  // the second order are f^2 time^2.
  EXPECT_NEAR(std::hypot(e[0], e[1], e[2]), growth, 10 * f * growth * time);
  EXPECT_NEAR(e[1], growth, 10 * f * growth * time);
  EXPECT_NEAR(end[2], 0, 1e-14);
}

/// Light that falls from one side at all times is a uniform field: H = p^2/2 - 1/r + f x, so that
/// the energy of the two is kept.
TEST(RadiationFlow, UniformLightKeepsTheEnergyWithIt) {
  const double f = 1e-3;
  const std::vector<double> start = {1, 0.2, 0.1, 0.1, 0.9, 0.2};
  const auto energy = [&](const std::vector<double>& z) {
    return (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 - 1 / std::hypot(z[0], z[1], z[2]) +
           f * z[0];
  };
  test::Flow<double> flow{lit(f), start, 20, 1};
  const std::vector<double> end = test::final_state(test::run_gauss(flow));
  // The Sun at 1e7 leaves f/1e7 of what is uniform.
  EXPECT_NEAR(energy(end), energy(start), 1e-9);
}

}  // namespace
}  // namespace hamjet
