#include "hamjet/dynamics/dynamical_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

ZonalGravity paper_field() { return test::paper_orbit().field; }

TEST(ZonalGravity, HandWrittenVectorFieldIsTheHamiltonians) {
  test::RandomNumbers random(51);
  const ZonalGravity strong{.mu = 1.25, .radius = 0.9, .J = {{2, 0.3}, {3, -0.2}}};
  for (const ZonalGravity& field :
       {paper_field(), strong, ZonalGravity{.radius = 0.9, .J = {{2, 0.3}}},
        ZonalGravity{.radius = 0.9, .J = {{3, 0.3}}}, ZonalGravity{}}) {
    const auto written = zonal_gravity(field);
    const auto derived = make_system("derived", written.hamiltonian);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<Extended> z;
      for (int i = 0; i < 6; ++i) {
        z.push_back((random.integer(0, 1) == 0 ? -1 : 1) * random.uniform(0.4, 1.2));
      }
      const auto a = test::evaluate_list(written.vector_field, z);
      const auto b = test::evaluate_list(derived.vector_field, z);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_LE(test::magnitude_of(a[i] - b[i]), 1e-30);
    }
    // The same holds for series, with all derivatives to degree 4.
    const auto space = SeriesSpace::create(6, 4);
    std::vector<Series<Extended>> z;
    const double point[] = {0.8, -0.5, 0.6, 0.3, 0.7, -0.2};
    for (std::size_t i = 0; i < 6; ++i) z.push_back(Series<Extended>::variable(space, i, point[i]));
    const std::vector<Series<Extended>>& inputs = z;
    const auto a = evaluate_on_series(written.vector_field, inputs);
    const auto b = evaluate_on_series(derived.vector_field, inputs);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LE(test::largest_coefficient(a[i] - b[i]),
                1e-31 * (10 + test::largest_coefficient(a[i])));
    }
  }
}

TEST(ZonalGravity, HasThePrintedSignOfJ3) {
  // V = -mu/r [1 - sum Jn (R/r)^n Pn]: on the axis Pn(1) = 1, Pn(-1) = (-1)^n, so above the pole
  // V = -1/r [1 - J2 (R/r)^2 - J3 (R/r)^3] and below it the J3 term changes sign. A positive J3
  // raises the potential in the north; the Earth's own is negative (data/paper/README.md).
  const Extended R = 0.75;
  const Extended J2 = 0.125;
  const Extended J3 = 0.0625;
  const auto system = zonal_gravity({.mu = 1, .radius = 0.75, .J = {{2, 0.125}, {3, 0.0625}}});
  const Extended r = 1.5;
  const auto potential = [&](const Extended& z) {
    return test::energy(system, std::vector<Extended>{0, 0, z, 0, 0, 0});
  };
  const Extended ratio = R / r;
  const Extended north = -1 / r * (1 - J2 * ratio * ratio - J3 * ratio * ratio * ratio);
  const Extended south = -1 / r * (1 - J2 * ratio * ratio + J3 * ratio * ratio * ratio);
  EXPECT_LE(test::magnitude_of(potential(r) - north), 1e-32);
  EXPECT_LE(test::magnitude_of(potential(-r) - south), 1e-32);
  EXPECT_GT(potential(r), potential(-r));
  // Mirroring space corresponds to mirroring J3.
  const auto mirrored = zonal_gravity({.mu = 1, .radius = 0.75, .J = {{2, 0.125}, {3, -0.0625}}});
  const std::vector<double> point{0.7, 0.4, 0.9, 0.1, 0.2, 0.3};
  const std::vector<double> image{0.7, 0.4, -0.9, 0.1, 0.2, -0.3};
  EXPECT_EQ(test::energy(system, point), test::energy(mirrored, image));
}

TEST(ZonalGravity, HasThePublishedEnergyAtTheStartOfThePaperOrbit) {
  const auto& orbit = test::paper_orbit();
  const auto system = zonal_gravity(orbit.field);
  const std::vector<Extended> start(orbit.start.begin(), orbit.start.end());
  const Extended expected = test::from_decimal(test::reference_case(orbit.id)["energy0"]);
  EXPECT_LE(test::magnitude_of(test::energy(system, start) - expected), 1e-33);
  // |p|^2 = 1.3 at r = 1, not v^2 1.3 (data/paper/README.md, the stray v): e = 0.3 of the Kepler
  // orbit.
  double speed2 = 0;
  for (std::size_t i = 3; i < 6; ++i) speed2 += orbit.start[i] * orbit.start[i];
  EXPECT_NEAR(speed2, 1.3, 1e-15);
}

TEST(SecondOrderForm, IsFoundWhereTheVelocityIsAConstantMultipleOfTheMomentum) {
  const auto oscillator = harmonic_oscillator(4, 2);
  ASSERT_TRUE(oscillator.second_order.has_value());
  EXPECT_EQ(oscillator.second_order->inverse_mass, (std::vector<Extended>{Extended(0.25)}));
  EXPECT_EQ(test::evaluate_list(oscillator.second_order->force, std::vector<double>{3})[0], -6);
  const auto gravity = zonal_gravity(paper_field());
  ASSERT_TRUE(gravity.second_order.has_value());
  const std::vector<Extended> unit{1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_EQ(gravity.second_order->inverse_mass, unit);
  ASSERT_TRUE(make_system("derived", gravity.hamiltonian).second_order.has_value());
}

TEST(SecondOrderForm, IsAbsentWhereMomentumAndPositionMix) {
  // A rotating frame, H = p^2/2 - w (q_1 p_2 - q_2 p_1) + V; a relativistic kinetic energy; a
  // velocity that depends on the position; a force that depends on the momentum.
  EXPECT_FALSE(make_system("rotating", 2, [](auto q, auto p) {
                 return (p[0] * p[0] + p[1] * p[1]) / 2 - (q[0] * p[1] - q[1] * p[0]) -
                        1 / sqrt(q[0] * q[0] + q[1] * q[1]);
               }).second_order.has_value());
  EXPECT_FALSE(make_system("relativistic", 1, [](auto q, auto p) {
                 return sqrt(1 + p[0] * p[0]) + q[0] * q[0] / 2;
               }).second_order.has_value());
  EXPECT_FALSE(make_system("geodesic", 1, [](auto q, auto p) {
                 return p[0] * p[0] * (1 + q[0] * q[0]) / 2;
               }).second_order.has_value());
  EXPECT_FALSE(make_system("drifting", 1, [](auto q, auto p) {
                 return square(p[0] - 1) / 2 + q[0] * q[0];
               }).second_order.has_value());
}

TEST(MakeSystem, TakesAHamiltonianInTenLines) {
  // The pendulum: p' = -sin q.
  const auto pendulum =
      make_system("pendulum", 1, [](auto q, auto p) { return p[0] * p[0] / 2 - cos(q[0]); });
  EXPECT_EQ(pendulum.degrees_of_freedom, 1u);
  const auto field = test::evaluate_list(pendulum.vector_field, std::vector<double>{0.5, 0.25});
  EXPECT_EQ(field[0], 0.25);
  EXPECT_DOUBLE_EQ(field[1], -std::sin(0.5));
  ASSERT_TRUE(pendulum.second_order.has_value());
  EXPECT_FALSE(pendulum.vector_field.is_linear_system());
  EXPECT_TRUE(harmonic_oscillator().vector_field.is_linear_system());
  // The flow conserves its energy: H at the end equals H at the start.
  const test::Flow<double> flow{pendulum, {0.5, 0.25}, 5, 1, {}};
  const auto state = test::final_state(test::run_gauss(flow));
  EXPECT_NEAR(test::energy(pendulum, state), 0.25 * 0.25 / 2 - std::cos(0.5), 1e-14);
}

TEST(MakeSystem, RefusesListsWhoseSizesDoNotFit) {
  const auto list = [](std::size_t inputs, std::size_t outputs) {
    return record(inputs, [&](std::span<const Expression> x) {
      return std::vector<Expression>(outputs, x[0]);
    });
  };
  test::expect_error(ErrorKind::usage, "2n inputs", [&] { make_system("odd", list(3, 1)); });
  test::expect_error(ErrorKind::usage, "one output", [&] { make_system("two", list(2, 2)); });
  test::expect_error(ErrorKind::usage, "vector field",
                     [&] { make_system("short", list(2, 1), list(2, 1)); });
}

std::vector<std::size_t> needed(const ZonalGravity& field, const std::vector<double>& start,
                                const std::vector<std::size_t>& variables) {
  return needed_degrees_of_freedom(zonal_gravity(field), start, variables);
}

TEST(NeededDegreesOfFreedom, AreThoseOfTheInvariantSubspace) {
  using Indices = std::vector<std::size_t>;
  ZonalGravity field = paper_field();
  const std::vector<double> equatorial{1, 0, 0, 0, 1, 0};
  const std::vector<double> polar{1, 0, 0, 0, 0, 1};
  EXPECT_EQ(needed(field, equatorial, {0, 1, 3, 4}),
            (Indices{0, 1, 2}));  // J3 pulls out of the plane
  EXPECT_EQ(needed(field, polar, {0, 2, 3, 5}), (Indices{0, 2}));
  field.J[3] = 0;
  EXPECT_EQ(needed(field, equatorial, {0, 1, 3, 4}), (Indices{0, 1}));
  EXPECT_EQ(needed(field, equatorial, {0, 5}), (Indices{0, 1, 2}));  // p_z is asked for
  EXPECT_EQ(needed(field, polar, {0}), (Indices{0, 2}));
  EXPECT_EQ(needed(field, test::paper_orbit().start, {0}), (Indices{0, 1, 2}));
  // A radial fall of Kepler's problem has one degree of freedom.
  EXPECT_EQ(needed({}, {1, 0, 0, 0, 0, 0}, {0, 3}), (Indices{0}));
}

TEST(RestrictSystem, IsTheSystemOnTheSubspace) {
  ZonalGravity field = paper_field();
  field.J[3] = 0;
  const auto full = zonal_gravity(field);
  const std::vector<std::size_t> kept{0, 1};
  const auto planar = restrict_system(full, kept);
  EXPECT_EQ(planar.degrees_of_freedom, 2u);
  EXPECT_LT(planar.vector_field.operations().size(), full.vector_field.operations().size());
  ASSERT_TRUE(planar.second_order.has_value());
  const std::vector<Extended> z{Extended(0.75), Extended(-0.5), Extended(0.25), Extended(1.25)};
  const std::vector<Extended> whole{z[0], z[1], 0, z[2], z[3], 0};
  const auto a = test::evaluate_list(planar.vector_field, z);
  const auto b = test::evaluate_list(full.vector_field, whole);
  const std::size_t same[] = {0, 1, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LE(test::magnitude_of(a[i] - b[same[i]]), 1e-32);
  EXPECT_LE(test::magnitude_of(test::energy(planar, z) - test::energy(full, whole)), 1e-32);
}

}  // namespace
}  // namespace hamjet
