#include "maps/hamilton_jacobi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "maps/legendre_transformation.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

template <class T>
std::vector<HamiltonJacobiResidual> residuals(const DynamicalSystem& system, const FlowJet<T>& jet,
                                              const PartialInversion<T>& inversion) {
  return hamilton_jacobi_by_degree<T>(system, test::final_state(jet), inversion);
}

double worst(const std::vector<HamiltonJacobiResidual>& entries) {
  double result = 0;
  for (const auto& entry : entries) result = test::larger(result, entry.scaled);
  return result;
}

const DynamicalSystem& paper_system() {
  static const DynamicalSystem system = zonal_gravity(test::paper_orbit().field);
  return system;
}

const FlowJet<double>& quarter_jet() {
  static const FlowJet<double> jet =
      test::paper_jet<double>(test::quarter_period, 4, test::adaptive(8, 1e-16));
  return jet;
}

/// The oscillator's F1 = ((q^2 + q0^2) cos t - 2 q q0) / (2 sin t).
PartialInversion<double> oscillator_inversion(double t) {
  const double square = std::cos(t) / (2 * std::sin(t));
  const Series<double> S(SeriesSpace::create(2, 2), {0, 0, 0, square, -1 / std::sin(t), square});
  return remaining_variables(S, parse_kind("F1", 1));
}

TEST(TimeDerivative, OfTheOscillatorIsKnown) {
  // p = (q cos t - q0) / sin t and p0 = (q - q0 cos t) / sin t, differentiated by hand:
  // dp/dt = (q0 cos t - q) / sin^2 t, dp0/dt = (q0 - q cos t) / sin^2 t.
  for (const double t : {0.7, 2.5, -1.2}) {
    const double s2 = std::sin(t) * std::sin(t);
    const auto rate = time_derivative<double>(harmonic_oscillator(), std::vector<double>{0.2, 0.1},
                                              oscillator_inversion(t));
    EXPECT_NEAR(rate.remaining_final[0][1], -1 / s2, 4e-15 / s2);
    EXPECT_NEAR(rate.remaining_final[0][2], std::cos(t) / s2, 4e-15 / s2);
    EXPECT_NEAR(rate.remaining_initial[0][1], -std::cos(t) / s2, 4e-15 / s2);
    EXPECT_NEAR(rate.remaining_initial[0][2], 1 / s2, 4e-15 / s2);
  }
}

TEST(TimeDerivative, IsTheLimitOfDifferences) {
  // The paper's orbit: central differences of S over 2 h, wrong by h^2 S''' / 6, in extended
  // precision, whose rounding over h is far below that.
  constexpr double h = 0x1p-27;
  const auto settings = test::adaptive(16, 1e-26);
  const auto before = test::paper_jet<Extended>(test::quarter_period - h, 3, settings);
  const auto at = test::paper_jet<Extended>(test::quarter_period, 3, settings);
  const auto after = test::paper_jet<Extended>(test::quarter_period + h, 3, settings);
  const auto function = [](const FlowJet<Extended>& jet, const GeneratingFunctionKind& kind) {
    return generating_function(one_form(test::inverted_jet(jet, kind)));
  };
  for (const char* name : {"F1", "F2", "F3", "F4", "qpq-qqp", "qqp-pqp"}) {
    const auto kind = parse_kind(name, 3);
    const auto rate = generating_function(one_form(time_derivative<Extended>(
        paper_system(), test::final_state(at), test::inverted_jet(at, kind))));
    const auto difference = (function(after, kind) - function(before, kind)) / Extended(2 * h);
    for (int d = 2; d <= 4; ++d) {
      EXPECT_LE(test::largest_of_degree(difference - rate, d),
                1e-12 * test::largest_of_degree(rate, d))
          << name << ", degree " << d;
    }
  }
}

TEST(HamiltonJacobi, IsSolvedByTheClosedFormOfTheOscillator) {
  // dS/dt = -(q^2 + q0^2 - 2 q q0 cos t) / (2 sin^2 t), the negative of H of the end.
  const std::vector<double> nominal{0.2, 0.1};
  for (const double t : {0.7, 2.5, -1.2, 1.5}) {
    const double s2 = std::sin(t) * std::sin(t);
    const auto inversion = oscillator_inversion(t);
    const auto h = hamiltonian_in_variables<double>(harmonic_oscillator(), nominal, inversion);
    ASSERT_EQ(h.order(), 2);
    const double expected[] = {0, 0, 0, 0.5 / s2, -std::cos(t) / s2, 0.5 / s2};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(h[k], expected[k], 4e-15 / s2);
    const auto residual =
        hamilton_jacobi_by_degree<double>(harmonic_oscillator(), nominal, inversion);
    ASSERT_EQ(residual.size(), 1u);
    EXPECT_EQ(residual[0].degree, 2);
    EXPECT_LE(residual[0].absolute, 4e-15 / s2);
    EXPECT_LE(residual[0].scaled, 2e-15) << t;
  }
}

/// All 64 kinds exist at a quarter period of the paper's orbit, with conditions up to 270. Measured
/// in units of epsilon over all of them: 5 to 10, 11 to 26, 100 and 200 to 500 at degrees 2..5.
template <class T>
void expect_round_off(const FlowJet<T>& jet) {
  const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
  for (const auto& kind : all_kinds(3)) {
    const auto entries = residuals(paper_system(), jet, test::inverted_jet(jet, kind));
    ASSERT_EQ(entries.size(), 4u);
    for (const auto& entry : entries) {
      EXPECT_LE(entry.scaled, 20 * epsilon * std::pow(5, entry.degree - 2))
          << kind.name() << ", degree " << entry.degree;
      EXPECT_GT(entry.absolute, 0);
    }
  }
}

TEST(HamiltonJacobi, IsSolvedToRoundOffByAllKindsOfThePaperOrbit) {
  expect_round_off(quarter_jet());
  expect_round_off(test::paper_jet<Extended>(test::quarter_period, 4, test::adaptive(16, 1e-28)));
}

TEST(HamiltonJacobi, IsNoAccuracy) {
  // The midpoint rule with a step of 0.3 is wrong in the first digit, but its map is symplectic.
  const auto jet = test::paper_jet<Extended>(test::quarter_period, 3, test::fixed_step(1, 0.3));
  EXPECT_GT(test::relative_error(quarter_jet(), jet, 1), 1e-2);
  EXPECT_LE(worst(residuals(paper_system(), jet, test::inverted_jet(jet, "F1"))), 1e-30);
}

TEST(HamiltonJacobi, SeesTheSignOfEveryEntryOfTheOneForm) {
  const auto& jet = quarter_jet();
  const auto nominal = test::final_state(jet);
  for (const char* name : {"F1", "F2", "F3", "F4", "qpq-qqp"}) {
    const auto inversion = test::inverted_jet(jet, name);
    const auto h = hamiltonian_in_variables<double>(paper_system(), nominal, inversion);
    for (std::size_t i = 0; i < 6; ++i) {
      auto rate = one_form(time_derivative<double>(paper_system(), nominal, inversion));
      rate[i] *= -1;
      const auto residual = generating_function(rate) + h;
      double scaled = 0;
      for (int d = 2; d <= 5; ++d) {
        scaled =
            std::max(scaled, test::largest_of_degree(residual, d) / test::largest_of_degree(h, d));
      }
      EXPECT_GT(scaled, 1e-2) << name << ", entry " << i;
    }
    // The residual itself shows the change too: an initial variable enters with its one-form alone.
    for (std::size_t i = 0; i < 3; ++i) {
      auto turned = inversion;
      turned.remaining_initial[i] *= -1;
      EXPECT_GT(worst(residuals(paper_system(), jet, turned)), 1e-2) << name << ", entry " << i;
    }
  }
}

TEST(HamiltonJacobi, SeesAHamiltonianThatIsNotThatOfTheEquations) {
  auto field = test::paper_orbit().field;
  field.J[3] = -field.J[3];
  DynamicalSystem system = paper_system();
  system.hamiltonian = zonal_gravity(field).hamiltonian;
  const auto& jet = quarter_jet();
  for (const char* name : {"F1", "F2", "F3", "F4", "qpq-qqp"}) {
    const auto inversion = test::inverted_jet(jet, name);
    EXPECT_LE(worst(residuals(paper_system(), jet, inversion)), 1e-13) << name;
    EXPECT_GT(worst(residuals(system, jet, inversion)), 1e-8) << name;
  }
}

TEST(HamiltonJacobi, SeesAChangeOfTheJet) {
  const auto& jet = quarter_jet();
  const SeriesSpace& space = jet[0].space();
  // The test changes every linear coefficient and one coefficient of each higher degree.
  std::vector<std::size_t> monomials{1, 2, 3, 4, 5, 6};
  for (int d = 2; d <= 4; ++d) monomials.push_back(space.first(d) + 1);
  for (const char* name : {"F1", "F2", "qpq-qqp"}) {
    const auto floor = residuals(paper_system(), jet, test::inverted_jet(jet, name));
    for (std::size_t i = 0; i < 6; ++i) {
      for (const std::size_t k : monomials) {
        auto changed = jet;
        changed[i][k] += 1e-6;
        const auto found = residuals(paper_system(), jet, test::inverted_jet(changed, name));
        double above_floor = 0;
        for (std::size_t e = 0; e < found.size(); ++e) {
          above_floor = std::max(above_floor, found[e].scaled / floor[e].scaled);
        }
        EXPECT_GT(above_floor, 1000) << name << ", component " << i << ", monomial " << k;
        // A change at degree d affects S from degree d + 1 on.
        for (int below = 2; below <= space.degree(k); ++below) {
          EXPECT_LE(found[static_cast<std::size_t>(below - 2)].scaled, 1e-13);
        }
      }
    }
  }
}

TEST(HamiltonJacobi, ResidualOfExplicitMethodsFollowsTheTolerance) {
  auto flow = test::flow_of(test::paper_orbit(), 4);
  flow.duration = test::quarter_period;
  std::vector<double> found;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    IntegrationStatistics statistics;
    const auto jet =
        integrate_fehlberg78(test::problem_of(flow), {.tolerance = tolerance}, statistics);
    found.push_back(worst(residuals(paper_system(), jet, test::inverted_jet(jet, "F1"))));
  }
  // For a hundredth of the tolerance the residual is a hundredth, within a factor of ten, and far
  // above the round-off of a symplectic jet.
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GT(found[i - 1] / found[i], 10);
    EXPECT_LT(found[i - 1] / found[i], 1000);
  }
  EXPECT_GT(found.back(), 100 * worst(residuals(paper_system(), quarter_jet(),
                                                test::inverted_jet(quarter_jet(), "F1"))));
}

TEST(HamiltonJacobi, RefusesSizesThatDoNotFit) {
  const auto inversion = oscillator_inversion(0.7);
  const std::vector<double> point{0.2, 0.1};
  test::expect_error(ErrorKind::usage, "degrees of freedom",
                     [&] { hamilton_jacobi_by_degree<double>(kepler(), point, inversion); });
  test::expect_error(ErrorKind::usage, "degrees of freedom", [&] {
    time_derivative<double>(harmonic_oscillator(), std::vector<double>{0.2}, inversion);
  });
}

}  // namespace
}  // namespace hamjet
