#include "hamjet/charts/canonical_chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../../src/charts/linear_chart.hpp"
#include "hamjet/error.hpp"
#include "orbits.hpp"

namespace hamjet {
namespace {

using test::bound_orbits;
using test::ChiefOrbit;
using test::orbit_of;

/// Whether a chart exists at an orbit; a chart that does not exist is refused by name.
bool exists(ChartName name, const ChiefOrbit& orbit) {
  try {
    CanonicalChart<double>(name, orbit.start, 1.0);
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_NE(std::string(error.what()).find(name_of(name)), std::string::npos);
    return false;
  }
}

double norm(const Matrix<double>& matrix) { return matrix.cwiseAbs().maxCoeff(); }

// Both directions are closed formulas: one after the other, they leave only rounding, amplified by
// the derivatives of both.
TEST(CanonicalChart, IsInvertedByItsOwnFormulas) {
  std::mt19937_64 generator(1);
  for (const ChiefOrbit& orbit : bound_orbits()) {
    for (const ChartName name : all_charts) {
      if (!exists(name, orbit)) continue;
      const CanonicalChart<double> chart(name, orbit.start, 1.0);
      for (int k = 0; k < 20; ++k) {
        SixNumbers<double> state = test::random_deviation(generator, 0.01);
        for (std::size_t i = 0; i < 6; ++i) state[i] += orbit.start[i];
        const SixNumbers<double> coordinates = chart.coordinates(state);
        const SixNumbers<double> back = chart.state(coordinates);
        const double growth =
            norm(coordinates_derivative(chart, state)) * norm(state_derivative(chart, coordinates));
        for (std::size_t i = 0; i < 6; ++i) {
          EXPECT_NEAR(back[i], state[i], 100 * growth * 0x1p-53) << name_of(name) << ' ' << i;
        }
      }
    }
  }
}

// M J M^T = J with M the derivative of the coordinates by (q, p).
TEST(CanonicalChart, IsSymplectic) {
  Matrix<double> J = Matrix<double>::Zero(6, 6);
  J.topRightCorner(3, 3).setIdentity();
  J.bottomLeftCorner(3, 3) = -Matrix<double>::Identity(3, 3);
  std::mt19937_64 generator(2);
  for (const ChiefOrbit& orbit : bound_orbits()) {
    for (const ChartName name : all_charts) {
      if (!exists(name, orbit)) continue;
      const CanonicalChart<double> chart(name, orbit.start, 1.0);
      SixNumbers<double> state = test::random_deviation(generator, 0.01);
      for (std::size_t i = 0; i < 6; ++i) state[i] += orbit.start[i];
      const Matrix<double> M = coordinates_derivative(chart, state);
      const Matrix<double> defect = M * J * M.transpose() - J;
      EXPECT_LT(norm(defect), 1000 * norm(M) * norm(M) * 0x1p-53) << name_of(name);
    }
  }
}

// Without perturbations an ellipse's elements are constants, and the mean longitude grows as n t.
TEST(CanonicalChart, HasElementsThatAreConstantsOfKeplersMotion) {
  for (const double i : {0.5, 30.0, 98.0, 179.0}) {
    const ChiefOrbit orbit = orbit_of(9000, 0.2, i, 40, 50, 60, 0, 0);
    const double a = 1 / (2 - std::pow(orbit.start[3], 2) - std::pow(orbit.start[4], 2) -
                          std::pow(orbit.start[5], 2));  // r = 1
    const double n = std::pow(a, -1.5);
    const double eccentric = static_cast<double>(mean_anomaly_of_true_deg(60, 0.2));
    const double later = static_cast<double>(true_anomaly_of_eccentric_deg(
        eccentric_anomaly_of_mean_deg(Extended(eccentric) + 20, 0.2), 0.2));
    const ChiefOrbit moved = orbit_of(9000, 0.2, i, 40, 50, later, 0, 0);
    // The state is in the units of the first state.
    SixNumbers<double> state = moved.start;
    const double ratio = orbit.field.radius / moved.field.radius;
    for (std::size_t k = 0; k < 3; ++k) {
      state[k] *= ratio;
      state[3 + k] /= std::sqrt(ratio);
    }
    const double time = 20 * std::acos(-1.0) / 180 / n;
    for (const ChartName name : {ChartName::poincare, ChartName::nodal}) {
      if (!exists(name, orbit)) continue;
      const CanonicalChart<double> chart(name, orbit.start, 1.0);
      const auto before = chart.coordinates(orbit.start);
      const auto after = chart.coordinates(state);
      EXPECT_NEAR(within_half_a_turn(after[0] - before[0] - n * time), 0, 1e-13) << i;
      for (std::size_t k = 1; k < 6; ++k) EXPECT_NEAR(after[k], before[k], 1e-13) << i << ' ' << k;
      EXPECT_NEAR(before[3], std::sqrt(a), 1e-14);
    }
  }
}

// The nodal chart's H is G cos i and its second position the node; spherical angles vanish at the
// chief; cylindrical ones are those of the position.
TEST(CanonicalChart, HasTheCoordinatesThatItsDescriptionSays) {
  const ChiefOrbit orbit = orbit_of(9000, 0.2, 50, 40, 50, 60);
  const auto& z = orbit.start;
  const double H = z[0] * z[4] - z[1] * z[3];
  const double G = std::sqrt(std::pow(z[1] * z[5] - z[2] * z[4], 2) +
                             std::pow(z[2] * z[3] - z[0] * z[5], 2) + H * H);
  const auto nodal = CanonicalChart<double>(ChartName::nodal, z, 1.0).coordinates(z);
  EXPECT_NEAR(nodal[1], 40 * std::acos(-1.0) / 180, 1e-14);
  EXPECT_NEAR(nodal[4], G * std::cos(50 * std::acos(-1.0) / 180), 1e-14);
  const auto spherical = CanonicalChart<double>(ChartName::spherical, z, 1.0).coordinates(z);
  EXPECT_NEAR(spherical[0], 0, 1e-15);
  EXPECT_NEAR(spherical[1], 1, 1e-15);
  EXPECT_NEAR(spherical[2], 0, 1e-15);
  EXPECT_NEAR(spherical[3], G, 1e-14);
  const auto cylindrical = CanonicalChart<double>(ChartName::cylindrical, z, 1.0).coordinates(z);
  EXPECT_NEAR(cylindrical[0], std::atan2(z[1], z[0]), 1e-15);
  EXPECT_NEAR(cylindrical[3], H, 1e-15);
}

TEST(CanonicalChart, RefusesWhereItDoesNotExist) {
  const auto refused = [](ChartName name, const SixNumbers<double>& state) {
    return !exists(name, {{}, state, 0});
  };
  EXPECT_TRUE(refused(ChartName::nodal, {1, 0, 0, 0, 1, 0}));                  // equatorial
  EXPECT_TRUE(refused(ChartName::nodal, {1, 0, 0, 0, 1, 0.005}));              // nearly
  EXPECT_TRUE(refused(ChartName::nodal, {1, 0, 0, 0, -1, 0.005}));             // the other way
  EXPECT_TRUE(refused(ChartName::poincare, {1, 0, 0, 0, 1.5, 0}));             // hyperbola
  EXPECT_TRUE(refused(ChartName::poincare, {1, 0, 0, 0, std::sqrt(2.0), 0}));  // parabola
  EXPECT_TRUE(refused(ChartName::poincare, {1, 0, 0, 0.5, 0, 0}));  // a line to the centre
  EXPECT_TRUE(refused(ChartName::spherical, {1, 0, 0, 1.5, 0.001, 0}));
  EXPECT_TRUE(refused(ChartName::cylindrical, {0.001, 0, 1, 1, 0, 0}));  // above the pole
  EXPECT_FALSE(refused(ChartName::poincare, {1, 0, 0, 0, -1, 0.005}));
  EXPECT_FALSE(refused(ChartName::spherical, {1, 0, 0, 0, 1.5, 0}));
  EXPECT_FALSE(refused(ChartName::nodal, {0, 0, 1, 1, 0, 0}));  // polar, above the pole
}

TEST(CanonicalChart, HasNamesThatAreReadBack) {
  for (const ChartName name : all_charts) EXPECT_EQ(chart_of(name_of(name)), name);
  EXPECT_FALSE(chart_of("flow-box").has_value());
}

// Half turns are at the ends of the range, and whole turns are taken away.
TEST(CanonicalChart, TakesWholeTurnsFromAngles) {
  const double turn = 2 * std::acos(-1.0);
  for (const double angle : {-3.0, 0.0, 1e-9, 2.5}) {
    for (const int turns : {-7, 0, 1, 1000}) {
      EXPECT_NEAR(within_half_a_turn(angle + turns * turn), angle,
                  4e-16 * (1 + std::abs(turns) * 7));
    }
  }
}

}  // namespace
}  // namespace hamjet
