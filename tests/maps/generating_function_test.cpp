#include "hamjet/maps/generating_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/algebra/calculus.hpp"
#include "support/map.hpp"

namespace hamjet {
namespace {

std::vector<double> coefficients(const Series<double>& u) {
  return {u.coefficients().begin(), u.coefficients().end()};
}

TEST(GeneratingFunction, OfTheOscillatorHasItsClosedForms) {
  // F1 = ((q^2 + q0^2) cos t - 2 q q0) / (2 sin t); F2(q, p0) = q p0 / cos t - (q^2 + p0^2) tan t /
  // 2; F3(p, q0) = -p q0 / cos t - (p^2 + q0^2) tan t / 2; F4(p, p0) = ((p^2 + p0^2) cos t - 2 p
  // p0) / (2 sin t), each by inserting the rotation.
  const double t = 0.7;
  const double s = std::sin(t);
  const double c = std::cos(t);
  const test::Flow<double> flow{harmonic_oscillator(), {0.2, 0.1}, t, 1, {}};
  const auto jet = test::run_gauss(flow);
  const struct {
    const char* kind;
    double squares[2];
    double mixed;
  } forms[] = {{"F1", {c / (2 * s), c / (2 * s)}, -1 / s},
               {"F2", {-s / (2 * c), -s / (2 * c)}, 1 / c},
               {"F3", {-s / (2 * c), -s / (2 * c)}, -1 / c},
               {"F4", {c / (2 * s), c / (2 * s)}, -1 / s}};
  for (const auto& form : forms) {
    const auto S = generating_function(one_form(test::inverted_jet(jet, form.kind)));
    ASSERT_EQ(S.order(), 2);
    const std::vector<double> expected{0, 0, 0, form.squares[0], form.mixed, form.squares[1]};
    for (std::size_t k = 0; k < 6; ++k) {
      // The map is inverted once, which costs a few units in the last place.
      EXPECT_NEAR(S[k], expected[k], 2e-14) << form.kind << ", monomial " << k;
    }
  }
}

TEST(GeneratingFunction, HasTheOneFormAsItsGradient) {
  const auto jet = test::paper_jet<double>(test::quarter_period, 3, test::adaptive(8, 1e-16));
  const auto wide = convert_map<Extended>(jet);
  for (const char* kind : {"F1", "F2", "F3", "F4", "qpq-qqp", "qqp-pqp"}) {
    const auto inversion = test::inverted_jet(wide, kind);
    const auto sigma = one_form(inversion);
    const auto S = generating_function(sigma);
    ASSERT_EQ(S.order(), 4);
    for (std::size_t k = 0; k < S.space().first(2); ++k) EXPECT_EQ(S[k], 0);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto gradient = derivative(S, i);
      for (std::size_t k = 1; k < sigma[i].size(); ++k) {
        // The gradient differs from the form by the amount by which the form is not closed:
        // round-off of the jet times the powers of the condition that the inversion costs.
        const int d = sigma[i].space().degree(k);
        EXPECT_NEAR(static_cast<double>(gradient[k] - sigma[i][k]), 0,
                    1e-14 * std::pow(4 * inversion.condition, d))
            << kind << ", variable " << i << ", degree " << d;
      }
    }
  }
}

TEST(GeneratingFunction, SeesOneFormsThatAreNotClosed) {
  // x dy has no potential: the homotopy integral gives x y / 2, whose gradient is (y, x) / 2.
  const auto space = SeriesSpace::create(2, 1);
  const auto x = Series<double>::variable(space, 0);
  const auto S = generating_function<double>({Series<double>(space), x});
  EXPECT_EQ(coefficients(S), (std::vector<double>{0, 0, 0, 0, 0.5, 0}));
}

TEST(OneForm, HasTheSignsOfItsKind) {
  // Final pair: p for w = q, -q for w = p; initial pair: -p0 for w = q0, q0 for w = p0.
  const auto space = SeriesSpace::create(4, 1);
  PartialInversion<double> inversion;
  inversion.kind = parse_kind("qp-pq", 2);
  inversion.remaining_final = {Series<double>::variable(space, 0),
                               Series<double>::variable(space, 1)};
  inversion.remaining_initial = {Series<double>::variable(space, 2),
                                 Series<double>::variable(space, 3)};
  const auto sigma = one_form(inversion);
  const int signs[] = {1, -1, 1, -1};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(sigma[i][1 + i], signs[i]);
}

}  // namespace
}  // namespace hamjet
