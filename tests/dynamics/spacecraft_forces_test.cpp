#include "hamjet/dynamics/spacecraft_forces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "dynamics/fields/point_mass_field.hpp"
#include "hamjet/detail/dynamics/differentiable_function.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "support/errors.hpp"
#include "support/exponential_air.hpp"
#include "support/turning_axes.hpp"

namespace hamjet {
namespace {

using Triple = std::array<double, 3>;

constexpr double rate = 0.06;  // the rate of the axes and of the air, in canonical units
constexpr double tilt = 0.3;   // the tilt of the axis, so that no component of it vanishes
constexpr double lag = 0.5;

double inner(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

TurningAtmosphere bulging() {
  TurningAtmosphere air;
  air.least = test::exponential_air(100, 2, 50 / 1.1);
  air.greatest = test::exponential_air(100, 3, 50 / 0.8);
  air.sun = std::make_shared<const test::MovingPoint>(Triple{200, 90, 40}, Triple{-0.5, 2, 0.3});
  air.lag = lag;
  air.exponent = 4;
  air.rate = rate;
  air.factor = {1.5};
  return air;
}

GravityOfTurningBody gravity(std::size_t parameters) {
  GravityOfTurningBody result;
  result.potential = std::make_shared<const PointMassField>(1.0);
  result.axes = std::make_shared<const test::TurningAxes>(tilt, rate);
  result.parameters = parameters;
  return result;
}

std::vector<double> rates(const DynamicalSystem& system, const std::vector<double>& state,
                          double time) {
  DifferentiableFunction<double> field(system.vector_field);
  field.evaluate(state, time);
  std::vector<double> result;
  for (std::size_t i = 0; i < state.size(); ++i) {
    result.push_back(field.value(static_cast<Eigen::Index>(i)));
  }
  return result;
}

TEST(SpacecraftForces, DragIsThatOfItsFormula) {
  const TurningAtmosphere air = bulging();
  const GravityOfTurningBody body = gravity(1);
  const DynamicalSystem alone = earth_gravity(body);
  const DynamicalSystem braked = with_drag(alone, body.axes, air, {0, 0});
  EXPECT_FALSE(braked.is_hamiltonian);
  EXPECT_EQ(braked.conserved_quantity(), ConservedQuantity::none);
  EXPECT_EQ(braked.dimension(), 7U);
  const double time = 1.7;
  const double ballistic = 0.03;
  const std::vector<double> state = {0.8, -0.5, 0.43, 0.3, 0.7, -0.6, ballistic};
  const Triple q = {state[0], state[1], state[2]};
  // The air's axis, by hand: the z axis turned by the tilt about x.
  const Triple axis = {0, -std::sin(tilt), std::cos(tilt)};
  const Triple v = {state[3] - rate * (axis[1] * q[2] - axis[2] * q[1]),
                    state[4] - rate * (axis[2] * q[0] - axis[0] * q[2]),
                    state[5] - rate * (axis[0] * q[1] - axis[1] * q[0])};
  const Triple sun = {200 - 0.5 * time, 90 + 2 * time, 40 + 0.3 * time};
  const Triple apex = {std::cos(lag) * sun[0] - std::sin(lag) * sun[1],
                       std::sin(lag) * sun[0] + std::cos(lag) * sun[1], sun[2]};
  const double radius = std::sqrt(inner(q, q));
  const double cosine = inner(q, apex) / radius / std::sqrt(inner(apex, apex));
  // cos^4(psi / 2) by the angle itself.
  const double bulge = std::pow(std::cos(std::acos(cosine) / 2), 4);
  const double height = (radius - 1) * test::air_radius_km;
  const double least = 2 * std::exp(-1.1 * (height - 100) / 50);
  const double greatest = 3 * std::exp(-0.8 * (height - 100) / 50);
  const double rho = 1.5 * (least + (greatest - least) * bulge);
  const double speed = std::sqrt(inner(v, v));
  const std::vector<double> with = rates(braked, state, time);
  const std::vector<double> without = rates(alone, state, time);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(with[i], without[i]);
    const double force = -0.5 * ballistic * rho * speed * v[i];
    // The rounding of the density, whose logarithm is some tens of times as steep as the height.
    EXPECT_NEAR(with[3 + i] - without[3 + i], force, 1e-12 * std::abs(rho * ballistic)) << i;
  }
  EXPECT_EQ(with[6], 0);
}

TEST(SpacecraftForces, RadiationPushesAwayFromTheSun) {
  GravityOfTurningBody body = gravity(1);
  const DynamicalSystem alone = earth_gravity(body);
  const Triple sun = {20, 9, 4};
  RadiationPressure radiation;
  radiation.potential = std::make_shared<const PointMassField>(0.25);
  radiation.sun = std::make_shared<const test::MovingPoint>(sun, Triple{});
  radiation.coefficient = {0, 0};
  body.radiation = radiation;
  const DynamicalSystem lit = earth_gravity(body);
  EXPECT_TRUE(lit.is_hamiltonian);
  const std::vector<double> state = {0.8, -0.5, 0.43, 0.3, 0.7, -0.6, 0.02};
  const std::vector<double> with = rates(lit, state, 0.4);
  const std::vector<double> without = rates(alone, state, 0.4);
  const Triple d = {state[0] - sun[0], state[1] - sun[1], state[2] - sun[2]};
  const double cube = std::pow(inner(d, d), 1.5);
  for (std::size_t i = 0; i < 3; ++i) {
    // Subtracting the gravity of the body, of size 1, leaves its rounding.
    EXPECT_NEAR(with[3 + i] - without[3 + i], 0.02 * 0.25 * d[i] / cube, 1e-15) << i;
  }
}

TEST(SpacecraftForces, PartsThatAreMissingAreRefused) {
  const GravityOfTurningBody body = gravity(0);
  const DynamicalSystem alone = earth_gravity(body);
  TurningAtmosphere air = bulging();
  air.exponent = 3;
  test::expect_error(ErrorKind::usage, "even", [&] { with_drag(alone, body.axes, air, {0.01}); });
  air = bulging();
  air.sun = nullptr;
  test::expect_error(ErrorKind::usage, "Sun", [&] { with_drag(alone, body.axes, air, {0.01}); });
  air.least = nullptr;
  test::expect_error(ErrorKind::usage, "density",
                     [&] { with_drag(alone, body.axes, air, {0.01}); });
}

}  // namespace
}  // namespace hamjet
