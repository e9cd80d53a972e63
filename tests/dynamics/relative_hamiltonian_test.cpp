#include "hamjet/dynamics/relative_hamiltonian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/algebra/composition.hpp"
#include "support/errors.hpp"
#include "support/flow.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

TEST(RelativeHamiltonian, OfTheOscillatorIsTheOscillatorItself) {
  // H is quadratic: about any point the terms of degree 2 are H, and there are no others.
  const auto system = harmonic_oscillator(2, 3);
  const std::vector<double> point{0.7, -0.4};
  const auto h = relative_hamiltonian(system, std::span<const double>(point), 3);
  ASSERT_EQ(h.order(), 4);
  for (std::size_t k = 0; k < h.size(); ++k) {
    EXPECT_EQ(h[k], k == 3 ? 1.5 : (k == 5 ? 0.25 : 0)) << "monomial " << k;
  }
  const auto field = canonical_vector_field(h);
  EXPECT_EQ(field[0][2], 0.5);   // q' = p / m
  EXPECT_EQ(field[1][1], -3.0);  // p' = -k q
}

TEST(RelativeHamiltonian, OfAQuarticIsItsTaylorExpansion) {
  // H = p^2/2 + q^4 about q = 2: 6 q^2 a^2 = 24 a^2, 4 q a^3 = 8 a^3, a^4.
  const auto system = make_system(
      "quartic", 1, [](auto q, auto p) { return p[0] * p[0] / 2 + square(square(q[0])); });
  const std::vector<double> point{2, 1};
  const auto h = relative_hamiltonian(system, std::span<const double>(point), 3);
  EXPECT_EQ(h[0], 0);
  EXPECT_EQ(h[1], 0);
  EXPECT_EQ(h[2], 0);
  EXPECT_EQ(h[h.space().first(2)], 24);
  EXPECT_EQ(h[h.space().first(3)], 8);
  EXPECT_EQ(h[h.space().first(4)], 1);
}

TEST(RelativeHamiltonian, MovesTheJetAsTheVectorFieldDoes) {
  // J grad H^h, composed with the jet of the deviations, equals the vector field on the jet minus
  // its value on the nominal. The orbit is the paper's, in extended precision.
  constexpr int order = 3;
  auto flow = test::flow_of<Extended>(test::paper_orbit(), order);
  flow.duration = 4;
  const auto jet = test::run_gauss(flow, test::adaptive(8, 1e-14));
  const auto nominal = test::final_state(jet);
  const auto h = relative_hamiltonian(flow.system, std::span<const Extended>(nominal), order);
  ASSERT_EQ(h.order(), order + 1);
  const auto deviations = without_constants(jet);
  const auto composed = compose(canonical_vector_field(h), deviations);
  const auto direct = without_constants(evaluate_on_series(flow.system.vector_field, jet));
  for (std::size_t i = 0; i < 6; ++i) {
    for (int d = 0; d <= order; ++d) {
      // Products of up to d coefficients of the linear growth, each rounded to 34 digits.
      EXPECT_LE(test::largest_of_degree(composed[i] - direct[i], d),
                1e-32 * std::pow(30.0, d) * (1 + test::largest_of_degree(direct[i], d)));
    }
    EXPECT_GT(test::largest_of_degree(direct[i], order), 1e-3);
  }
}

TEST(RelativeHamiltonian, RefusesANominalOfAnotherSize) {
  const std::vector<double> point{1, 2, 3};
  test::expect_error(ErrorKind::usage, "wrong size", [&] {
    relative_hamiltonian(harmonic_oscillator(), std::span<const double>(point), 2);
  });
}

TEST(EvaluateOnSeries, RefusesInputsThatDoNotFit) {
  const auto list = harmonic_oscillator().hamiltonian;
  const auto evaluate = [&](const std::vector<Series<double>>& inputs) {
    evaluate_on_series(list, inputs);
  };
  const Series<double> a(SeriesSpace::create(2, 2));
  const Series<double> b(SeriesSpace::create(2, 3));
  test::expect_error(ErrorKind::usage, "number of inputs", [&] { evaluate({a}); });
  test::expect_error(ErrorKind::usage, "different spaces", [&] { evaluate({a, b}); });
}

}  // namespace
}  // namespace hamjet
