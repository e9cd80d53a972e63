#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/fermi_pasta_ulam.hpp"
#include "dynamics/oscillator_pair.hpp"
#include "dynamics/spring_pendulum.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"
#include "support/random_series.hpp"

// The stiff mechanical models: their Hamiltonians are written by hand, their vector fields are
// compared with differences of these, and their flows must conserve the known invariants.

namespace hamjet {
namespace {

using State = std::vector<Extended>;

State random_state(test::RandomNumbers& random, std::size_t dimension) {
  State z;
  for (std::size_t i = 0; i < dimension; ++i) z.push_back(random.uniform(-1.5, 1.5));
  return z;
}

/// The recorded Hamiltonian is `energy`; the vector field is (dH/dp, -dH/dq), by central
/// differences of `energy`, whose error is near 1e-20 of its third derivatives in 113 bits.
template <class Energy>
void expect_model(const DynamicalSystem& system, const Energy& energy, double scale) {
  test::RandomNumbers random(7);
  const std::size_t n = system.degrees_of_freedom;
  const Extended step = 1e-10;
  for (int trial = 0; trial < 5; ++trial) {
    const State z = random_state(random, 2 * n);
    EXPECT_LE(test::magnitude_of(test::energy(system, z) - energy(z)), 1e-31 * scale);
    const State field = test::evaluate_list(system.vector_field, z);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const std::size_t conjugate = (i + n) % (2 * n);
      State above = z, below = z;
      above[conjugate] += step;
      below[conjugate] -= step;
      const Extended difference = (energy(above) - energy(below)) / (2 * step);
      EXPECT_LE(test::magnitude_of(field[i] - (i < n ? difference : Extended(-difference))),
                1e-18 * scale)
          << system.name << " " << i;
    }
  }
}

TEST(OscillatorPair, HasTheHamiltonian) {
  expect_model(
      oscillator_pair(2.5, 0.5, 1e6),
      [](const State& z) {
        return Extended((z[2] * z[2] + z[3] * z[3]) / 5 + z[0] * z[0] / 4 + 5e5 * z[1] * z[1]);
      },
      1e6);
}

TEST(SpringPendulum, HasTheHamiltonian) {
  expect_model(
      spring_pendulum(0.5, 1000, 1.25, 9.5),
      [](const State& z) {
        const Extended stretch = sqrt(z[0] * z[0] + z[1] * z[1]) - 1.25;
        return Extended(z[2] * z[2] + z[3] * z[3] + 500 * stretch * stretch + 4.75 * z[1]);
      },
      1e5);
}

// Hairer, Lubich and Wanner give the Hamiltonian in x_0 = (q_2i + q_2i-1)/sqrt 2 and
// x_1 = (q_2i - q_2i-1)/sqrt 2 too (their equation I.5.3), which is another sum: 1/2 |y|^2 +
// omega^2/2 |x_1|^2 + 1/4 [(x_01 - x_11)^4 + sum (x_0,i+1 - x_1,i+1 - x_0,i - x_1,i)^4 +
// (x_0m + x_1m)^4].
TEST(FermiPastaUlam, HasTheHamiltonianOfTheBook) {
  for (const std::size_t m : {1, 2, 3, 4}) {
    const auto energy = [m](const State& z) {
      const Extended root = sqrt(Extended(2));
      const auto fourth = [](const Extended& x) { return Extended(x * x * x * x); };
      State slow, fast;
      Extended sum = 0;
      for (std::size_t i = 0; i < m; ++i) {
        slow.push_back((z[2 * i + 1] + z[2 * i]) / root);
        fast.push_back((z[2 * i + 1] - z[2 * i]) / root);
        const Extended y0 = (z[2 * m + 2 * i + 1] + z[2 * m + 2 * i]) / root;
        const Extended y1 = (z[2 * m + 2 * i + 1] - z[2 * m + 2 * i]) / root;
        sum += (y0 * y0 + y1 * y1) / 2 + 2500 * fast[i] * fast[i] / 2;
      }
      Extended soft = fourth(slow[0] - fast[0]) + fourth(slow[m - 1] + fast[m - 1]);
      for (std::size_t i = 0; i + 1 < m; ++i) {
        soft += fourth(slow[i + 1] - fast[i + 1] - slow[i] - fast[i]);
      }
      return Extended(sum + soft / 4);
    };
    expect_model(fermi_pasta_ulam(50, m), energy, 1e6);
  }
}

TEST(MechanicalModels, HaveTheSecondOrderForm) {
  for (const auto& system :
       {oscillator_pair(2, 3, 5), spring_pendulum(2, 3, 1, 5), fermi_pasta_ulam(5, 2)}) {
    ASSERT_TRUE(system.second_order.has_value()) << system.name;
    const Extended inverse = system.name == "fermi-pasta-ulam" ? 1 : 0.5;
    const std::size_t n = system.degrees_of_freedom;
    for (std::size_t i = 0; i < n * n; ++i) {
      EXPECT_EQ(system.second_order->inverse_mass[i], i % (n + 1) == 0 ? inverse : Extended(0));
    }
  }
  EXPECT_TRUE(oscillator_pair(2, 3, 5).vector_field.is_linear_system());
  EXPECT_FALSE(spring_pendulum(2, 3, 1, 5).vector_field.is_linear_system());
}

// The flow keeps the energy.
TEST(MechanicalModels, KeepTheirEnergy) {
  const std::vector<std::pair<DynamicalSystem, std::vector<double>>> cases = {
      {oscillator_pair(2, 3, 500), {1, 0.5, -1, 2}},
      {spring_pendulum(0.5, 1000, 1, 10), {0.9, -0.5, 0.1, 0.3}},
      {fermi_pasta_ulam(50, 3), {0.69, 0.72, 0, 0, 0, 0, 0, 1.4, 0, 0, 0, 0}}};
  for (const auto& [system, start] : cases) {
    const test::Flow<double> flow{system, start, 2, 1, {}};
    const auto end = test::final_state(test::run_gauss(flow));
    const double before = test::energy(system, start);
    EXPECT_NEAR(test::energy(system, end), before, 1e-13 * std::abs(before)) << system.name;
  }
}

/// d z_i(t)/d z_k of the flow about an equilibrium.
double derivative(const FlowJet<double>& jet, std::size_t i, std::size_t k) {
  return jet[i][jet[i].space().linear_index(k)];
}

// About the mass at rest below the point of suspension the flow is, to first order, two rotations
// of the frequencies sqrt(g/(l + m g/k)) and sqrt(k/m).
TEST(SpringPendulum, HasTheFrequenciesOfSmallOscillations) {
  const double m = 0.5, k = 200, l = 1.25, g = 10, t = 1.5;
  const double length = l + m * g / k;
  const test::Flow<double> flow{spring_pendulum(m, k, l, g), {0, -length, 0, 0}, t, 1, {}};
  const auto jet = test::run_gauss(flow);
  EXPECT_NEAR(jet[1][0], -length, 1e-14);
  const double frequencies[] = {std::sqrt(g / length), std::sqrt(k / m)};
  for (std::size_t i = 0; i < 2; ++i) {
    const double w = frequencies[i];
    EXPECT_NEAR(derivative(jet, i, i), std::cos(w * t), 1e-12);
    EXPECT_NEAR(derivative(jet, i, 2 + i), std::sin(w * t) / (m * w), 1e-12);
    EXPECT_NEAR(derivative(jet, 2 + i, i), -m * w * std::sin(w * t), 1e-11);
    EXPECT_NEAR(derivative(jet, i, 1 - i), 0, 1e-12);
  }
}

// To first order about the origin the soft springs have no effect: the stretches of the stiff
// springs oscillate with the frequency omega, and their centres move freely.
TEST(FermiPastaUlam, HasTheFrequencyOfTheStiffSprings) {
  const double omega = 50, t = 0.7;
  const test::Flow<double> flow{fermi_pasta_ulam(omega, 2), std::vector<double>(8, 0), t, 1, {}};
  const auto jet = test::run_gauss(flow);
  const auto mean = [&](std::size_t i, std::size_t k) {
    return (derivative(jet, i, k) + derivative(jet, i + 1, k)) / 2;
  };
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    const double stretch = derivative(jet, i + 1, i + 1) - derivative(jet, i, i + 1);
    EXPECT_NEAR(stretch, std::cos(omega * t), 1e-12);
    EXPECT_NEAR(mean(i, i), 0.5, 1e-12);
    EXPECT_NEAR(mean(i, 4 + i), t / 2, 1e-12);
    EXPECT_NEAR(derivative(jet, i, 2 - i), 0, 1e-12);
  }
}

// The flow is two rotations, each with the frequency of its own spring.
TEST(OscillatorPair, IsTwoRotations) {
  const double m = 2, t = 3;
  const double stiffnesses[] = {0.5, 5000};
  const test::Flow<double> flow{oscillator_pair(m, 0.5, 5000), {1, 2, 3, 4}, t, 1, {}};
  const auto jet = test::run_gauss(flow);
  for (std::size_t i = 0; i < 2; ++i) {
    const double w = std::sqrt(stiffnesses[i] / m);
    const double q = flow.start[i], p = flow.start[2 + i];
    EXPECT_NEAR(jet[i][0], q * std::cos(w * t) + p / (m * w) * std::sin(w * t), 1e-12);
    EXPECT_NEAR(jet[2 + i][0], p * std::cos(w * t) - q * m * w * std::sin(w * t), 1e-10);
  }
}

}  // namespace
}  // namespace hamjet
