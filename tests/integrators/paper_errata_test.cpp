#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/integrators/newmark.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "support/errors.hpp"
#include "support/map.hpp"

// Misprints of Guibout and Bloch that no other test covers: the corrected formula holds, and the
// printed one does not. data/paper/README.md lists all misprints.

namespace hamjet {
namespace {

/// H = p^2/(2 m) - cos q with m = 2.5, so that a lost mass shows.
constexpr double mass = 2.5;
DynamicalSystem heavy_pendulum() {
  return make_system("pendulum", 1,
                     [](auto q, auto p) { return p[0] * p[0] / (2 * mass) - cos(q[0]); });
}
double slope(double q) { return std::sin(q); }

struct Point {
  double q;
  double p;
};

/// Start and every step of a trajectory.
template <class Integrate>
std::vector<Point> trajectory(const Integrate& integrate) {
  const DynamicalSystem system = heavy_pendulum();
  const test::Flow<double> flow{system, {1.2, 0.4}, 2, 0, {}};
  std::vector<Point> points{{1.2, 0.4}};
  const StepObserver<double> observer = [&](const double&, const FlowJet<double>& jet) {
    points.push_back({jet[0][0], jet[1][0]});
  };
  IntegrationStatistics statistics;
  integrate(test::problem_of(flow), statistics, observer);
  return points;
}

/// Newmark, Hamiltonian side: with p_(k+1) = M Delta q^d_k, q^d_k = q_k - beta h^2 a_k,
///   p_(k+1) - p_k = -h V'(q_k)   and   q'_k = M^-1 p_(k+1) - (h/2) a_k;
/// the print has + (h/2) a_k with p^d_k, which is p_(k+1).
TEST(PaperErrata, NewmarkOnTheHamiltonianSide) {
  constexpr double h = 0.125;
  for (const double beta : {0.1, 0.25, 0.5}) {
    const auto points =
        trajectory([&](const auto& problem, auto& statistics, const auto& observer) {
          integrate_newmark(problem, {.beta = beta, .step = h}, statistics, observer);
        });
    ASSERT_EQ(points.size(), 17U);
    const auto acceleration = [&](std::size_t k) { return -slope(points[k].q) / mass; };
    const auto discrete = [&](std::size_t k) {
      return points[k].q - beta * h * h * acceleration(k);
    };
    const auto momentum = [&](std::size_t k) {  // p_(k+1)
      return mass * (discrete(k + 1) - discrete(k)) / h;
    };
    double printed_velocity = 0;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      EXPECT_NEAR(momentum(k) - momentum(k - 1), -h * slope(points[k].q), 1e-13);
      EXPECT_NEAR(points[k].p / mass, momentum(k) / mass - h / 2 * acceleration(k), 1e-13);
      printed_velocity =
          std::max(printed_velocity,
                   std::abs(points[k].p / mass - momentum(k) / mass - h / 2 * acceleration(k)));
    }
    EXPECT_GE(printed_velocity, 1e-2);
  }
}

/// Eq. legendre_vv: p_(k+1) = p_k - (h/2) (V'(q_k) + V'(q_k + h Delta q_k)), and q_k + h Delta q_k
/// is q_(k+1); the print has V'(q_k + Delta q_k).
TEST(PaperErrata, VelocityVerletTakesTheForceAtTheNextPosition) {
  constexpr double h = 0.125;
  const auto points = trajectory([](const auto& problem, auto& statistics, const auto& observer) {
    integrate_velocity_verlet(problem, {.step = h}, statistics, observer);
  });
  double printed = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double velocity = (points[k + 1].q - points[k].q) / h;
    const double before = points[k].p - h / 2 * slope(points[k].q);
    EXPECT_NEAR(points[k + 1].p, before - h / 2 * slope(points[k].q + h * velocity), 1e-14);
    printed = std::max(printed,
                       std::abs(points[k + 1].p - before + h / 2 * slope(points[k].q + velocity)));
  }
  EXPECT_GE(printed, 1e-3);
}

/// Eq. stm_harm: a_21' = -k a_11, a_22' = -k a_12, so that a_11 = cos t. With the printed signs the
/// coefficients are those of H = p^2/2 - q^2/2, hyperbolic functions.
TEST(PaperErrata, FlowOfTheOscillatorIsNotHyperbolic) {
  const double t = 1.5;
  const auto coefficients = [&](const DynamicalSystem& system) {
    const auto jet = test::run_gauss(test::Flow<double>{system, {0, 0}, t, 1, {}});
    return std::vector<double>{jet[0][1], jet[1][1]};
  };
  const auto right = coefficients(harmonic_oscillator());
  EXPECT_NEAR(right[0], std::cos(t), 1e-14);
  EXPECT_NEAR(right[1], -std::sin(t), 1e-14);
  const auto printed = coefficients(
      make_system("printed", 1, [](auto q, auto p) { return (p[0] * p[0] - q[0] * q[0]) / 2; }));
  EXPECT_NEAR(printed[0], std::cosh(t), 1e-13);
}

/// The paper's orbit: without the stray v in p_z, |p|^2 = 1.3 and e = 0.3 at r = 1, as its text
/// says; with v = |p| it would be another orbit.
TEST(PaperErrata, OrbitHasTheEccentricityOfTheText) {
  const auto eccentricity = [](double p_y, double p_z) {
    return p_y * p_y + p_z * p_z - 1;  // at perigee at distance 1, mu = 1
  };
  const std::vector<double>& start = test::paper_orbit().start;
  EXPECT_NEAR(eccentricity(start[4], start[5]), 0.3, 1e-15);
  EXPECT_GE(std::abs(eccentricity(start[4], std::sqrt(1.3) * start[5]) - 0.3), 0.1);
}

/// 10 pi is no multiple of 0.01: 3142 equal steps.
TEST(PaperErrata, OrbitTakes3142EqualSteps) {
  auto flow = test::flow_of(test::paper_orbit(), 1);
  EXPECT_NEAR(flow.duration, 10 * std::numbers::pi, 1e-14);
  IntegrationStatistics statistics;
  test::run_gauss(flow, test::fixed_step(1, 0.01), &statistics);
  EXPECT_EQ(statistics.steps, 3142);
}

/// S_1 and S_2 exist where det dPhi_1/dp_0 is not 0; the footnote asks for |dPhi/dp_0|, which has
/// no determinant, and the whole matrix of the flow always has determinant 1: F1 does not exist at
/// t = pi.
TEST(PaperErrata, ExistenceOfTheGradientsIsThatOfABlock) {
  const test::Flow<double> flow{harmonic_oscillator(), {0.3, 0.2}, std::numbers::pi, 1, {}};
  const auto jet = test::run_gauss(flow);
  EXPECT_NEAR(jet[0][1] * jet[1][2] - jet[0][2] * jet[1][1], 1, 1e-14);
  EXPECT_NEAR(jet[0][2], 0, 1e-14);
  test::expect_error(ErrorKind::numerical, "q-q: it does not exist",
                     [&] { test::inverted_jet(jet, "F1"); });
}

}  // namespace
}  // namespace hamjet
