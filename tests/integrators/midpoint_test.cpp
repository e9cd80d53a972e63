#include "hamjet/integrators/midpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/double_well.hpp"
#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/symplectic.hpp"

// The midpoint scheme on its own. Expected values: the scheme's defining equations, identities
// (reversibility, conservation of quadratic energies, the two-form), and extended precision.

namespace hamjet::test {
namespace {

template <class Real>
Vector<Real> state(std::initializer_list<double> values) {
  Vector<Real> z(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double x : values) z(i++) = Real(x);
  return z;
}

template <class Real>
Vector<Real> integrate(DifferentiableHamiltonian<Real>& h, Vector<Real> z, const Real& tau,
                       long steps) {
  for (long k = 0; k < steps; ++k) z = midpoint_step<Real>(h, z, tau);
  return z;
}

/// d z' / d z of a map by central differences in extended precision: an error near 1e-24.
template <class Map>
Matrix<Extended> differentiated(const Map& map, const Vector<Extended>& z) {
  const Extended width = 1e-12;
  Matrix<Extended> jacobian(z.size(), z.size());
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    Vector<Extended> above = z;
    Vector<Extended> below = z;
    above(j) += width;
    below(j) -= width;
    jacobian.col(j) = (map(above) - map(below)) / (above(j) - below(j));
  }
  return jacobian;
}

// The defining equations, from the derivatives of H = p^2/2 + (q^4 - q^2)/2 by hand. In print the
// operator lacks the division by tau, and the first equation has Delta p^d on its left side.
TEST(Midpoint, SolvesTheDiscreteHamiltonEquations) {
  RecordedHamiltonian<double> h(double_well());
  const double tau = 0.1;
  const Vector<double> z = state<double>({1, 0.05});
  const Vector<double> next = midpoint_step<double>(h, z, tau);
  const double q = (z(0) + next(0)) / 2;
  const double p = (z(1) + next(1)) / 2;
  const double dq = next(0) - z(0);
  const double dp = next(1) - z(1);
  const double force = -(2 * q * q * q - q);
  EXPECT_NEAR(dq / tau, p, 4e-15);
  EXPECT_NEAR(dp / tau, force, 4e-15);
  EXPECT_GT(std::abs(dp / tau - p), 0.5);  // Delta p^d on the left
  EXPECT_GT(std::abs(dp - force), 0.5);    // without the division
  EXPECT_NEAR(dq, p * tau, 1e-15);         // R_(tau/2) q^d - R_(-tau/2) q^d = q_(k+1) - q_k
}

TEST(Midpoint, SolutionIsThatOfGaussWithOneStage) {
  const DynamicalSystem system = double_well();
  RecordedHamiltonian<double> h(system);
  const double duration = 20;
  for (const double tau : {0.1, 0.2}) {
    const auto steps = std::lround(duration / tau);
    const Vector<double> end = integrate<double>(h, state<double>({1, 0.05}),
                                                 duration / static_cast<double>(steps), steps);
    const Flow<double> flow = {system, {1, 0.05}, duration, 1, {}};
    const auto gauss = final_state(run_gauss(flow, fixed_step(1, tau)));
    // The flow near the barrier amplifies round-off of 1e-16 by three decades in this time.
    EXPECT_NEAR(end(0), gauss[0], 2e-12) << tau;
    EXPECT_NEAR(end(1), gauss[1], 2e-12) << tau;
  }
}

// Against an extended-precision reference of 16 stages. Error = C tau^2 (1 + O(tau^2)): the slope
// of the fit over four halvings is 2 within the O(tau^2).
TEST(Midpoint, HasOrderTwo) {
  const DynamicalSystem system = double_well();
  const Flow<Extended> flow = {system, {Extended(1), Extended(0.05)}, Extended(2), 1, {}};
  const auto reference = final_state(run_gauss(flow, adaptive(16, 1e-28)));
  RecordedHamiltonian<Extended> h(system);
  std::vector<double> logarithms;
  for (const long steps : {40, 80, 160, 320, 640}) {
    const Vector<Extended> end =
        integrate<Extended>(h, state<Extended>({1, 0.05}), Extended(Extended(2) / steps), steps);
    const Extended error =
        abs(Extended(end(0) - reference[0])) + abs(Extended(end(1) - reference[1]));
    logarithms.push_back(std::log2(static_cast<double>(error)));
  }
  double slope = 0;  // least squares over x = -2, -1, 0, 1, 2 halvings
  for (int i = 0; i < 5; ++i) slope -= (i - 2) * logarithms[static_cast<std::size_t>(i)] / 10;
  EXPECT_NEAR(slope, 2, 5e-3);
}

// The scheme is symmetric: a step of -tau is its inverse.
TEST(Midpoint, IsReversible) {
  RandomNumbers random(21);
  for (const std::size_t n : {1U, 2U, 3U}) {
    RecordedHamiltonian<double> h(random_system(n, random));
    const Vector<double> z = random_vector<double>(static_cast<Eigen::Index>(2 * n), random, 0.8);
    const Vector<double> end = integrate<double>(h, z, 0.03, 100);
    EXPECT_GT(largest_entry(end - z), 0.1);
    EXPECT_LE(largest_entry(integrate<double>(h, end, -0.03, 100) - z), 1e-13) << n;
  }
}

// dp ^ dq is preserved: with M the derivative of 50 steps, M^T J M = J. The derivatives are central
// differences in extended precision, so that 1e-20 separates preserved from not.
TEST(Midpoint, PreservesTheTwoForm) {
  RandomNumbers random(22);
  const auto defect = [](const DynamicalSystem& system, const Vector<Extended>& z) {
    RecordedHamiltonian<Extended> h(system);
    const auto map = [&](const Vector<Extended>& x) {
      return integrate<Extended>(h, x, Extended(0.1), 20);
    };
    const Matrix<Extended> m = differentiated(map, z);
    const Matrix<Extended> unit = symplectic_unit<Extended>(z.size() / 2);
    return largest_entry(m.transpose() * unit * m - unit);
  };
  EXPECT_LE(defect(double_well(), state<Extended>({1, 0.05})), 1e-19);
  EXPECT_LE(defect(random_system(2, random), random_vector<Extended>(4, random, 0.5)), 1e-19);
}

// The paper's lemma: a quadratic Hamiltonian is preserved exactly, so that only round-off is left.
// It walks at random: sqrt(1e4) 1e-16 = 1e-14 is its size, and a drift would reach 1e-12.
TEST(Midpoint, PreservesTheEnergyOfLinearSystems) {
  const auto largest_energy_error = [](const DynamicalSystem& system, Vector<double> z,
                                       double tau) {
    RecordedHamiltonian<double> h(system);
    const double energy = h.value(z);
    double largest = 0;
    for (long k = 0; k < 10000; ++k) {
      z = midpoint_step<double>(h, z, tau);
      largest = larger(largest, std::abs((h.value(z) - energy) / energy));
    }
    return largest;
  };
  EXPECT_LE(largest_energy_error(harmonic_oscillator(), state<double>({1, 0}), 0.1), 1e-13);
  EXPECT_LE(largest_energy_error(harmonic_oscillator(2, 5), state<double>({0.3, -1}), 0.7), 1e-13);
  RandomNumbers random(23);
  for (const Eigen::Index n : {2, 3}) {
    const Matrix<double> root = random_matrix<double>(2 * n, 2 * n, random);
    const Matrix<double> symmetric =
        root * root.transpose() + Matrix<double>::Identity(2 * n, 2 * n) * 0.1;
    EXPECT_LE(largest_energy_error(quadratic_system(symmetric),
                                   random_vector<double>(2 * n, random), 0.2),
              1e-13)
        << n;
  }
  // The same steps on the double well, which is not linear, leave an error of tau^2.
  EXPECT_GT(largest_energy_error(double_well(), state<double>({0.9, 0.3}), 0.1), 1e-4);
}

// The erratum on the step that the paper does not state. The start is 0.00125 above the barrier at
// q = 0: the scheme crosses exactly when its energy error, which goes as tau^2, is below that.
TEST(Midpoint, CrossesTheBarrierOfTheDoubleWellWithShortStepsOnly) {
  for (const double tau : {0.01, 0.05, 0.1, 0.17, 0.18, 0.2, 0.3}) {
    RecordedHamiltonian<double> h(double_well());
    Vector<double> z = state<double>({1, 0.05});
    const double energy = h.value(z);
    // Four roundings of terms of H that are up to 1/2 in size at the start, and cancel.
    EXPECT_NEAR(energy, 0.00125, 4 * 0x1p-54);
    double least_position = 1;
    double largest_error = 0;
    for (double t = 0; t < 200; t += tau) {
      z = midpoint_step<double>(h, z, tau);
      least_position = std::min(least_position, z(0));
      largest_error = larger(largest_error, std::abs(h.value(z) - energy));
    }
    if (tau < 0.175) {
      EXPECT_LT(least_position, -0.9) << tau;
      EXPECT_LT(largest_error, 0.00125) << tau;
    } else {
      EXPECT_GT(least_position, 0) << tau;
      EXPECT_GT(largest_error, 0.00125) << tau;
    }
  }
}

// On the barrier H'' = diag(-1, 1), and det(I - (tau/2) J H'') = 1 - tau^2/4: a pole at tau = 2.
TEST(Midpoint, SaysWhereThereIsNoSolution) {
  RecordedHamiltonian<double> well(double_well());
  const auto step_from_the_barrier = [&](double tau) {
    return midpoint_step<double>(well, state<double>({0, 0.001}), tau);
  };
  EXPECT_GT(step_from_the_barrier(1.9)(0), 0.01);
  expect_error(ErrorKind::numerical, "midpoint: a step of 2 has no solution",
               [&] { step_from_the_barrier(2); });
  expect_error(ErrorKind::numerical, "a step of -2.5 has no solution",
               [&] { step_from_the_barrier(-2.5); });
  RecordedHamiltonian<double> centre(kepler());
  expect_error(ErrorKind::numerical, "midpoint: a step of 0.1 has no solution", [&] {
    midpoint_step<double>(centre, state<double>({0, 0, 0, 1, 0, 0}), 0.1);
  });
  expect_error(ErrorKind::usage, "the state has 4 components, the Hamiltonian takes 2", [&] {
    midpoint_step<double>(well, state<double>({1, 0, 0, 0}), 0.1);
  });
}

}  // namespace
}  // namespace hamjet::test
