#include <gtest/gtest.h>

#include <cmath>

#include "comparison_scenes.hpp"
#include "support/reference_data.hpp"

// The reference of a comparison is compared with computations that share nothing with it.

namespace hamjet {
namespace {

TEST(ComparisonReference, IsTheOscillatorsClosedForm) {
  const auto result = compared(oscillator_scene(), {series_of("one", {{gauss("one", 4, 0.5)}})});
  const auto& jet = result.reference.jet;
  const Extended c = cos(Extended(5));
  const Extended s = sin(Extended(5));
  // q = q0 cos t + p0 sin t, p = -q0 sin t + p0 cos t; monomials 1, q0, p0, and three of degree 2.
  const std::vector<std::vector<Extended>> expected = {{c, c, s, 0, 0, 0}, {-s, -s, c, 0, 0, 0}};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(static_cast<double>(abs(jet[i][k] - expected[i][k])), 1e-22) << i << " " << k;
    }
  }
}

TEST(ComparisonReference, HasTheDigitsOfThePaperOrbit) {
  const test::ReferenceOrbit& orbit = test::paper_orbit();
  Scene scene = kepler_scene();
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = orbit.field.J[2];
  scene.system.J[3] = orbit.field.J[3];
  scene.canonical_radius = orbit.field.radius;
  ASSERT_EQ(orbit.field.mu, 1);
  scene.nominal = orbit.start;
  scene.duration = orbit.duration;
  scene.order = 1;
  const auto result = compared(scene, {series_of("one", {{gauss("one", 8, 0.5)}})});
  for (std::size_t i = 0; i < 6; ++i) {
    const Series<Extended>& component = result.reference.jet[i];
    EXPECT_LT(static_cast<double>(abs(component[0] - orbit.state[i])), 1e-20) << i;
    for (std::size_t j = 0; j < 6; ++j) {
      const std::size_t k = component.space().linear_index(j);
      EXPECT_LT(static_cast<double>(abs(component[k] - orbit.matrix[i][j])),
                1e-20 * orbit.matrix_norm)
          << i << " " << j;
    }
  }
}

TEST(ComparisonReference, IsTheClosedFormOfKeplersJet) {
  // After a revolution from (1, 0) with the velocity (0, 1 + d) on the circular orbit:
  // x = 1 - 18 pi^2 d^2, y = -6 pi d - 24 pi d^2, from the change of the period.
  Scene scene = kepler_scene();
  scene.nominal = {1, 0, 0, 0, 1, 0};
  scene.duration = 6.283185307179586;  // 2 pi is known to 2.4e-16, which limits the comparison
  scene.variables = {4};
  const auto result = compared(scene, {series_of("one", {{gauss("one", 8, 0.2)}})});
  const double pi = std::acos(-1.0);
  const auto coefficient = [&](std::size_t component, std::size_t degree) {
    return static_cast<double>(result.reference.jet[component][degree]);
  };
  EXPECT_NEAR(coefficient(0, 0), 1, 1e-15);
  EXPECT_NEAR(coefficient(0, 1), 0, 1e-14);
  EXPECT_NEAR(coefficient(0, 2), -18 * pi * pi, 1e-12);
  EXPECT_NEAR(coefficient(1, 0), 0, 1e-15);
  EXPECT_NEAR(coefficient(1, 1), -6 * pi, 1e-13);
  EXPECT_NEAR(coefficient(1, 2), -24 * pi, 1e-12);
}

}  // namespace
}  // namespace hamjet
