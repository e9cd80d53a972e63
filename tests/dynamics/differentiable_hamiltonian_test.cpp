#include "hamjet/detail/dynamics/differentiable_hamiltonian.hpp"

#include <gtest/gtest.h>

#include "dynamics/double_well.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet {
namespace {

// H = p^2/2 + (q^4 - q^2)/2 differentiated by hand.
TEST(DifferentiableHamiltonian, OfTheDoubleWell) {
  RecordedHamiltonian<double> h(double_well());
  const Vector<double> z = Vector<double>{{0.7, -0.4}};
  EXPECT_NEAR(h.value(z), 0.08 + (0.2401 - 0.49) / 2, 1e-16);
  const auto& at = h.derivatives(z);
  EXPECT_NEAR(at.gradient(0), 2 * 0.343 - 0.7, 1e-15);
  EXPECT_NEAR(at.gradient(1), -0.4, 1e-16);
  EXPECT_NEAR(at.hessian(0, 0), 6 * 0.49 - 1, 1e-15);
  EXPECT_EQ(at.hessian(0, 1), 0);
  EXPECT_EQ(at.hessian(1, 0), 0);
  EXPECT_NEAR(at.hessian(1, 1), 1, 1e-16);
}

// Central differences of the value in extended precision: an error near 1e-20 for the gradient and,
// of the gradient, for the Hessian.
TEST(DifferentiableHamiltonian, OfAnOrbit) {
  RecordedHamiltonian<Extended> h(zonal_gravity({1.0, 0.9, {{2, 1e-3}, {3, -2e-6}}}));
  Vector<Extended> z(6);
  z << Extended(1), Extended(0.2), Extended(-0.3), Extended(0.1), Extended(0.8), Extended(0.4);
  const HamiltonianDerivatives<Extended> at = h.derivatives(z);
  const Extended width = 1e-10;
  for (Eigen::Index i = 0; i < 6; ++i) {
    Vector<Extended> above = z;
    Vector<Extended> below = z;
    above(i) += width;
    below(i) -= width;
    const Extended slope = (h.value(above) - h.value(below)) / (above(i) - below(i));
    EXPECT_NEAR(static_cast<double>(Extended(at.gradient(i) - slope)), 0, 1e-18);
    const Vector<Extended> upper = h.derivatives(above).gradient;
    const Vector<Extended> lower = h.derivatives(below).gradient;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const Extended curvature = (upper(j) - lower(j)) / (above(i) - below(i));
      EXPECT_NEAR(static_cast<double>(Extended(at.hessian(i, j) - curvature)), 0, 1e-18);
    }
  }
}

}  // namespace
}  // namespace hamjet
