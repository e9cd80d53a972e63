#include "hamjet/integrators/symmetric_composition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/integrators/stormer_verlet.hpp"
#include "integrator_checks.hpp"
#include "support/convergence.hpp"
#include "support/errors.hpp"
#include "support/magnitude.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

template <class Real>
FlowJet<Real> compose_verlet(const FlowProblem<Real>& problem, int order, double step) {
  IntegrationStatistics statistics;
  return integrate_symmetric_composition(problem, {.order = order, .step = step}, statistics);
}

/// A polynomial in the non-commuting A_1, A_3, A_5, ...: the coefficient of each word. A word's
/// weight is the sum of its letters.
using Word = std::vector<int>;
using WordPolynomial = std::map<Word, Extended>;

int weight(const Word& word) {
  int sum = 0;
  for (const int letter : word) sum += letter;
  return sum;
}

/// All words of odd letters up to a weight.
std::vector<Word> words_up_to(int largest) {
  std::vector<Word> words{{}};
  for (std::size_t k = 0; k < words.size(); ++k) {
    for (int letter = 1; weight(words[k]) + letter <= largest; letter += 2) {
      Word longer = words[k];
      longer.push_back(letter);
      words.push_back(longer);
    }
  }
  return words;
}

/// A symmetric method is the flow exp(h A_1 + h^3 A_3 + h^5 A_5 + ...) with h A_1 the exact one;
/// the composition is the product of those with gamma_k h. The largest coefficient of all words of
/// one weight in its difference to exp(h A_1) vanishes below the order (Hairer, Lubich and Wanner,
/// sections III.3 and V.3.2).
std::vector<double> order_defects(const std::vector<Extended>& gammas, int largest) {
  const std::vector<Word> words = words_up_to(largest);
  WordPolynomial product;
  product[{}] = 1;
  const auto exponential = [](const Word& word, const Extended& gamma) {
    Extended value = 1;
    for (std::size_t k = 0; k < word.size(); ++k) {
      value *= pow(gamma, word[k]) / static_cast<int>(k + 1);
    }
    return value;
  };
  for (const Extended& gamma : gammas) {
    WordPolynomial next;
    for (const Word& word : words) {
      for (std::size_t cut = 0; cut <= word.size(); ++cut) {
        const auto middle = word.begin() + static_cast<std::ptrdiff_t>(cut);
        next[word] +=
            product[Word(word.begin(), middle)] * exponential(Word(middle, word.end()), gamma);
      }
    }
    product = next;
  }
  std::vector<double> defects(static_cast<std::size_t>(largest) + 1, 0.0);
  for (const Word& word : words) {
    const bool is_power = static_cast<int>(word.size()) == weight(word);
    const Extended expected = is_power ? exponential(word, 1) : Extended(0);
    double& defect = defects[static_cast<std::size_t>(weight(word))];
    defect =
        test::larger(defect, std::abs(static_cast<double>(Extended(product[word] - expected))));
  }
  return defects;
}

TEST(SymmetricComposition, SubstepsFulfilTheOrderConditionsAndNoMore) {
  for (const int order : {4, 6, 8}) {
    const auto gammas = composition_substeps(order);
    EXPECT_EQ(gammas.size(), order == 4 ? 5u : order == 6 ? 9u : 17u);
    for (std::size_t k = 0; k < gammas.size(); ++k) {
      EXPECT_EQ(gammas[k], gammas[gammas.size() - 1 - k]);
    }
    const auto defects = order_defects(gammas, order + 1);
    for (int w = 0; w <= order; ++w) {
      EXPECT_LE(defects[static_cast<std::size_t>(w)], 1e-32)
          << "order " << order << " weight " << w;
    }
    EXPECT_GE(defects.back(), 1e-6) << order;
  }
}

// Expected: Suzuki's closed form, and the digits printed by Kahan and Li as Hairer, Lubich and
// Wanner quote them, eqs. (V.3.11) and (V.3.13): 26 decimals.
TEST(SymmetricComposition, SubstepsAreThePublishedOnes) {
  const Extended suzuki = 1 / (4 - pow(Extended(4), Extended(1) / 3));
  EXPECT_LE(abs(composition_substeps(4)[0] - suzuki), 1e-33);
  EXPECT_LE(abs(composition_substeps(6)[4] - Extended("0.79854399093482996339895035")), 1e-26);
  EXPECT_LE(abs(composition_substeps(8)[8] - Extended("-0.60550853383003451169892108")), 1e-26);
}

// Expected: velocity Verlet with the substeps, one after another.
TEST(SymmetricComposition, IsVerletStepByStep) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  for (const int order : {4, 6, 8}) {
    flow.duration = 0.25;
    const auto jet = compose_verlet(test::problem_of(flow), order, 0.25);
    auto part = flow;
    FlowJet<double> expected;
    for (const Extended& gamma : composition_substeps(order)) {
      part.duration = 0.25 * static_cast<double>(gamma);
      IntegrationStatistics statistics;
      const auto next = integrate_velocity_verlet(test::problem_of(part), {.step = 1}, statistics);
      part.start = test::final_state(next);
      expected = expected.empty() ? next : test::chained(next, expected);
    }
    for (int d = 0; d <= 3; ++d) EXPECT_LE(test::relative_error(jet, expected, d), 1e-14) << order;
  }
}

// Expected: orders 4, 6 and 8 of the nominal and of the coefficients of degree 1 and 2, on the
// paper's orbit, two variables, in extended precision, against 16 stages of Gauss.
TEST(SymmetricComposition, OrdersOfConvergenceAreThoseOfTheTable) {
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 2);
  flow.duration = 2;
  flow.variables = {0, 4};
  const auto expected = test::run_gauss(flow, test::adaptive(16, 1e-28));
  for (const int order : {4, 6, 8}) {
    const auto [steps, errors] = test::convergence(
        flow, expected, {32, 48, 64, 96},
        [&](const auto& problem, double step) { return compose_verlet(problem, order, step); });
    for (const auto& error : errors) {
      EXPECT_NEAR(test::fitted_order(steps, error), order, 0.15) << order;
      EXPECT_GT(error.back(), 1e-25) << order;
      EXPECT_LT(error.back(), order == 4 ? 1e-5 : order == 6 ? 1e-8 : 1e-11) << order;
    }
  }
}

// Expected: agreement with eight stages of Gauss on the paper's own orbit and time, all degrees.
TEST(SymmetricComposition, AgreesWithGaussOnThePapersOrbit) {
  const auto flow = test::flow_of(test::paper_orbit(), 4);
  const auto expected = test::run_gauss(flow, test::adaptive(8, 1e-16));
  const auto jet = compose_verlet(test::problem_of(flow), 8, 0.1);
  for (int d = 0; d <= 4; ++d) EXPECT_LE(test::relative_error(jet, expected, d), 1e-8) << d;
}

TEST(SymmetricComposition, JetsAreSymplecticOnThePapersOrbit) {
  const auto nominal = test::flow_of(test::paper_orbit(), 4);
  const auto problem = test::problem_of(nominal);
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 3);
  flow.duration = 4;
  const auto extended = test::problem_of(flow);
  for (const int order : {4, 6, 8}) {
    for (const double step : {1.0, 0.5, 0.2}) {
      EXPECT_LE(test::worst_symplecticity(compose_verlet(problem, order, step)), 1e-13) << order;
    }
    EXPECT_LE(test::worst_symplecticity(compose_verlet(extended, order, 0.5)), 1e-30) << order;
  }
}

// Expected: a symmetric method undoes itself backwards, to round-off, however far from the flow.
TEST(SymmetricComposition, OutAndBackIsTheIdentity) {
  for (const int order : {4, 6, 8}) {
    const auto integrate = [&](const auto& problem, double step) {
      return compose_verlet(problem, order, step);
    };
    EXPECT_LE(test::return_error(integrate, 5, 0.5), 1e-14) << order;
  }
}

TEST(SymmetricComposition, TakesOneEvaluationASubstep) {
  const test::Flow<double> flow{harmonic_oscillator(2, 3), {1, 0}, 1, 2, {}};
  const auto problem = test::problem_of(flow);
  for (const int order : {4, 6, 8}) {
    IntegrationStatistics statistics;
    integrate_symmetric_composition(problem, {.order = order, .step = 0.1}, statistics);
    EXPECT_EQ(statistics.steps, 10);
    const auto substeps = static_cast<long>(composition_substeps(order).size());
    EXPECT_EQ(statistics.vector_field_evaluations, 1 + 10 * substeps);
  }
}

TEST(SymmetricComposition, BadSettingsAreUsageErrors) {
  const test::Flow<double> flow{harmonic_oscillator(), {1, 0}, 1, 1, {}};
  const auto problem = test::problem_of(flow);
  for (const int order : {-4, 0, 2, 3, 5, 10}) {
    test::expect_error(ErrorKind::usage, "the order must be 4, 6 or 8",
                       [&] { compose_verlet(problem, order, 0.1); });
  }
  for (const double step : {0.0, -1.0}) {
    test::expect_error(ErrorKind::usage, "composition of order 6: the step must be positive",
                       [&] { compose_verlet(problem, 6, step); });
  }
  auto general = flow;
  general.system.second_order.reset();
  test::expect_error(ErrorKind::usage, "no second-order form",
                     [&] { compose_verlet(test::problem_of(general), 4, 0.1); });
}

}  // namespace
}  // namespace hamjet
