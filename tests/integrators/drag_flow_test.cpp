#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/fields/point_mass_field.hpp"
#include "hamjet/dynamics/earth_gravity.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/integrators/energy_conserving.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/gauss_many.hpp"
#include "support/errors.hpp"
#include "support/exponential_air.hpp"
#include "support/flow.hpp"
#include "support/turning_axes.hpp"

namespace hamjet {
namespace {

constexpr double radius_km = test::air_radius_km;
constexpr double scale_height_km = 50;

/// An exponential atmosphere; `density` is that of 400 km, times the unit of length.
TurningAtmosphere exponential(double density, double rate) {
  TurningAtmosphere air;
  air.least =
      test::exponential_air(200, density * std::exp(200 / scale_height_km), scale_height_km);
  air.rate = rate;
  return air;
}

/// Motion about a point mass, braked by air, with C_D A / m as the parameter of states.
DynamicalSystem braked(double density, double rate = 0.06) {
  GravityOfTurningBody body;
  body.potential = std::make_shared<const PointMassField>(1.0);
  body.axes = std::make_shared<const test::TurningAxes>(0.3, rate);
  body.parameters = 1;
  return with_drag(earth_gravity(body), body.axes, exponential(density, rate), {0, 0});
}

constexpr double height_400 = 1 + 400 / radius_km;

std::vector<double> circle(double ballistic) {
  const double speed = 1 / std::sqrt(height_400);
  return {height_400, 0, 0, 0, speed * std::cos(1.2), speed * std::sin(1.2), ballistic};
}

/// King-Hele, Theory of Satellite Orbits in an Atmosphere (1964), chapter 4: on a circle
/// da/dt = -B rho sqrt(mu a), so that with rho = rho_0 exp(-(a - a_0) / H), and to first order in
/// H / a_0, a - a_0 = H ln(1 - B rho_0 sqrt(mu a_0) t / H).
TEST(DragFlow, CircleDecaysAsByKingHele) {
  const double density = 1e-4, ballistic = 0.02;
  const double height = scale_height_km / radius_km;
  const double revolution = 2 * M_PI * std::pow(height_400, 1.5);
  // Air at rest, as in the closed form; it falls by 1.2 km, a fortieth of the scale height.
  const test::Flow<double> flow{braked(density, 0), circle(ballistic), 15 * revolution, 1};
  const FlowJet<double> end = test::run_gauss(flow);
  const double q2 = end[0][0] * end[0][0] + end[1][0] * end[1][0] + end[2][0] * end[2][0];
  const double p2 = end[3][0] * end[3][0] + end[4][0] * end[4][0] + end[5][0] * end[5][0];
  const double axis = 1 / (2 / std::sqrt(q2) - p2);
  const double fall =
      -height * std::log(1 - ballistic * density * std::sqrt(height_400) * flow.duration / height);
  EXPECT_GT(fall, 0.02 * height);
  // What is left out are terms of relative size B rho a and fall / a: the orbit's own radial
  // speed, the density at the radius in place of the axis.
  EXPECT_NEAR(height_400 - axis, fall, 2 * fall * (fall + density * ballistic));
}

/// A deputy with more drag than its chief gets ahead by 3/2 da t^2, da = B' rho v^2 / 2 more.
TEST(DragFlow, MoreDragGetsAhead) {
  const double density = 1e-7, ballistic = 0.02;
  const double revolution = 2 * M_PI * std::pow(height_400, 1.5);
  const test::Flow<double> flow{braked(density, 0), circle(ballistic), 10 * revolution, 2};
  const FlowJet<double> end = test::run_gauss(flow);
  const std::size_t drag = end[0].space().linear_index(6);
  double along = 0, speed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += end[i][drag] * end[3 + i][0];
    speed += end[3 + i][0] * end[3 + i][0];
  }
  along /= std::sqrt(speed);
  const double acceleration = density / height_400 / 2;
  const double right = 1.5 * acceleration * flow.duration * flow.duration;
  // Beside the growing term is one that turns with the orbit: 8 a / n^2 at most at these times.
  EXPECT_NEAR(along, right,
              8 * acceleration * std::pow(height_400, 3) + 1e-3 * right * density / 1e-7);
}

/// The coefficients by the parameter, to degree 3, against differences of flights in extended
/// precision, which hold B as a number of their start.
TEST(DragFlow, JetsInTheParameterAreDerivativesOfFlights) {
  const DynamicalSystem system = braked(1e-2);
  const double ballistic = 0.03, time = 20;
  const FlowJet<double> jet =
      test::run_gauss(test::Flow<double>{system, circle(ballistic), time, 3});
  const auto end = [&](const Extended& b) {
    test::Flow<Extended> flow{system, {}, time, 1, {6}};
    for (const double x : circle(ballistic)) flow.start.emplace_back(x);
    flow.start[6] = b;
    return test::run_gauss(flow, test::adaptive(12, 1e-26));
  };
  // Central differences of steps h and 2h, whose error is h^4 relative to a sixth derivative.
  const Extended h = Extended(1) / 1000000;
  std::vector<FlowJet<Extended>> at;
  for (int k = -2; k <= 2; ++k) at.push_back(end(Extended(ballistic) + k * h));
  const SeriesSpace& space = jet[0].space();
  for (std::size_t i = 0; i < 6; ++i) {
    const Extended f[5] = {at[0][i][0], at[1][i][0], at[2][i][0], at[3][i][0], at[4][i][0]};
    const Extended derivatives[3] = {
        (f[0] - 8 * f[1] + 8 * f[3] - f[4]) / (12 * h),
        (-f[0] + 16 * f[1] - 30 * f[2] + 16 * f[3] - f[4]) / (12 * h * h) / 2,
        (-f[0] + 2 * f[1] - 2 * f[3] + f[4]) / (2 * h * h * h) / 6};
    for (int degree = 1; degree <= 3; ++degree) {
      std::vector<int> exponents(7, 0);
      exponents[6] = degree;
      std::size_t index = space.first(degree);
      while (space.exponents(index)[6] != degree) ++index;
      double largest = 0;
      for (std::size_t c = 0; c < 6; ++c) largest = std::max(largest, std::abs(jet[c][index]));
      EXPECT_NEAR(jet[i][index], static_cast<double>(derivatives[degree - 1]), 1e-8 * largest)
          << "component " << i << ", degree " << degree;
    }
  }
}

/// Methods that share no step agree on the flow and on its first derivatives.
TEST(DragFlow, MethodsAgree) {
  const test::Flow<double> flow{braked(1e-3), circle(0.03), 12, 2};
  const FlowJet<double> gauss = test::run_gauss(flow);
  ExplicitRungeKuttaSettings settings;
  settings.tolerance = 1e-13;
  IntegrationStatistics statistics;
  const FlowJet<double> fehlberg =
      integrate_fehlberg78<double>(test::problem_of(flow), settings, statistics);
  for (std::size_t i = 0; i < gauss.size(); ++i) {
    for (std::size_t k = 0; k < gauss[i].size(); ++k) {
      EXPECT_NEAR(gauss[i][k], fehlberg[i][k], 1e-9 * (1 + std::abs(gauss[i][k]))) << i << " " << k;
    }
  }
}

/// Kepler's problem with a drag of -0.01 p, in units of `length` of the unit in which the
/// pericentre is 1: with mu = 1 momenta and times follow from the length.
test::Flow<double> slowed_ellipse(double length) {
  const double time = std::pow(length, 1.5);
  const DynamicalSystem system = with_force(kepler(), [time](std::span<const Expression> z) {
    return std::vector<Expression>{-0.01 * time * z[3], -0.01 * time * z[4], -0.01 * time * z[5]};
  });
  const double momentum = 1 / std::sqrt(length);
  return {system, {1 / length, 0, 0, 0, 1.2 / momentum, 0.1 / momentum}, 15 / time, 2};
}

TEST(DragFlow, TheUnitOfLengthChangesNoStep) {
  const test::Flow<double> natural = slowed_ellipse(1);
  ASSERT_FALSE(natural.system.second_order);
  const auto fly = [](const test::Flow<double>& flow, bool in_lanes) {
    if (in_lanes) {
      const auto outcome =
          integrate_gauss_many(test::problem_of(flow), {flow.start}, test::adaptive(8, 1e-12))[0];
      EXPECT_FALSE(outcome.was_alone);
      return std::pair(outcome.statistics.steps, outcome.jet);
    }
    IntegrationStatistics statistics;
    FlowJet<double> jet = test::run_gauss(flow, test::adaptive(8, 1e-12), &statistics);
    return std::pair(statistics.steps, std::move(jet));
  };
  for (const bool in_lanes : {false, true}) {
    const auto [steps, jet] = fly(natural, in_lanes);
    for (const double length : {0x1p-30, 0x1p-6, 0x1p10, 0x1p30}) {
      const auto [other_steps, other] = fly(slowed_ellipse(length), in_lanes);
      // A step that is accepted in one unit may be refused in another by rounding of its measures
      // alone.
      EXPECT_NEAR(static_cast<double>(other_steps), static_cast<double>(steps), 1) << length;
      for (std::size_t i = 0; i < 6; ++i) {
        const double unit = i < 3 ? length : 1 / std::sqrt(length);
        EXPECT_NEAR(other[i][0] * unit, jet[i][0], 1e-11) << length << " " << i;
      }
    }
  }
}

/// A method that is made of the Hamiltonian alone would leave the drag out without a word.
TEST(DragFlow, MethodsOfTheHamiltonianRefuse) {
  const DynamicalSystem slowed = with_force(kepler(), [](std::span<const Expression> z) {
    return std::vector<Expression>{-0.01 * z[3], -0.01 * z[4], -0.01 * z[5]};
  });
  EXPECT_TRUE(slowed.is_autonomous());
  EXPECT_EQ(slowed.conserved_quantity(), ConservedQuantity::none);
  EnergyConservingProblem<double> problem;
  problem.system = slowed;
  problem.initial_state = {1, 0, 0, 0, 1, 0};
  test::expect_error(ErrorKind::usage, "Hamiltonian",
                     [&] { integrate_energy_conserving<double>(problem); });
}

}  // namespace
}  // namespace hamjet
