#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dynamics/harmonic_oscillator.hpp"
#include "hamjet/maps/generating_function.hpp"
#include "support/errors.hpp"
#include "support/map.hpp"
#include "support/random_series.hpp"

namespace hamjet {
namespace {

/// The 2n variables w as series in the initial deviations.
template <class T>
std::vector<Series<T>> chosen_variables(const FlowJet<T>& jet, const GeneratingFunctionKind& kind) {
  std::vector<Series<T>> w;
  const std::size_t n = kind.degrees_of_freedom();
  for (std::size_t i = 0; i < n; ++i) {
    w.push_back(jet[kind.final_variable(i)]);
    w.back()[0] = T(0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    w.push_back(Series<T>::variable(jet[0].space_pointer(), kind.initial_variable(i)));
  }
  return w;
}

TEST(PartialInversion, GivesBackTheDeviationsForAllKinds) {
  const auto jet = test::paper_jet<Extended>(test::quarter_period, 3, test::adaptive(8, 1e-14));
  for (const auto& kind : all_kinds(3)) {
    const auto inversion = test::inverted_jet(jet, kind);
    if (inversion.condition > 1e4) continue;
    const auto w = chosen_variables(jet, kind);
    const std::vector<Series<Extended>>& inner = w;
    const auto initial = compose(inversion.remaining_initial, inner);
    const auto final_rest = compose(inversion.remaining_final, inner);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto x =
          Series<Extended>::variable(jet[0].space_pointer(), kind.initial_variable(i, false));
      auto y = jet[kind.final_variable(i, false)];
      y[0] = 0;
      for (int d = 1; d <= 3; ++d) {
        // The bound is extended round-off times a power of the condition that grows with the
        // degree.
        const double bound = 1e-30 * std::pow(10 * inversion.condition, 2 * d);
        EXPECT_LE(test::largest_of_degree(initial[i] - x, d), bound) << kind.name();
        EXPECT_LE(test::largest_of_degree(final_rest[i] - y, d), bound) << kind.name();
      }
    }
  }
}

TEST(PartialInversion, AlmostAllKindsAreWellConditionedAtAQuarterPeriod) {
  const auto jet = test::paper_jet<double>(test::quarter_period, 1);
  std::size_t count = 0;
  for (const auto& kind : all_kinds(3)) {
    const auto block = inverted_block(jet, kind);
    if (condition_number(block) < 1e4) ++count;
  }
  EXPECT_EQ(count, 64u);
}

TEST(ConditionNumber, OfTheClassicalKindsMatchesTheReference) {
  // block_condition_numbers_seed: A = dq/dq0 belongs to F2, B = dq/dp0 to F1, C = dp/dq0 to F4,
  // D = dp/dp0 to F3; four digits are printed.
  const struct {
    const char* block;
    const char* kind;
  } blocks[] = {{"A", "F2"}, {"B", "F1"}, {"C", "F4"}, {"D", "F3"}};
  const auto& table = test::reference_cases()["block_condition_numbers_seed"];
  for (const char* model : {"J2J3", "Kepler"}) {
    for (const auto& entry : table[model]) {
      auto flow = test::flow_of(test::paper_orbit(), 1);
      if (std::string(model) == "Kepler") flow.system = kepler();
      flow.duration = std::stod(entry["t"].get<std::string>());
      const auto jet = test::run_gauss(flow, test::adaptive(8, 1e-16));
      for (const auto& [block, kind] : blocks) {
        const double expected = std::stod(entry["cond"][block].get<std::string>());
        const double condition = condition_number(inverted_block(jet, parse_kind(kind, 3)));
        if (expected > 1e13) {
          EXPECT_GT(condition, 1e12) << model << " " << kind << " at " << flow.duration;
        } else {
          EXPECT_NEAR(condition, expected, 1e-3 * expected)
              << model << " " << kind << " at " << flow.duration;
        }
      }
    }
  }
}

TEST(ConditionNumber, OfKnownMatrices) {
  EXPECT_EQ(condition_number<double>(Matrix<double>::Identity(3, 3)), 1);
  EXPECT_EQ(condition_number<double>(Matrix<double>::Zero(2, 2)),
            std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(condition_number<double>((Matrix<double>(2, 2) << 0, 8, 2, 0).finished()), 4);
}

TEST(PartialInversion, RefusesKindsThatDoNotExistAtTheTime) {
  // After a full period of Kepler's problem dq/dp0 has rank one: no F1, no F4; F2 and F3 exist.
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.system = kepler();
  flow.duration = 4 * test::quarter_period;
  const auto jet = test::run_gauss(flow, test::adaptive(8, 1e-16));
  test::expect_error(ErrorKind::numerical, "qqq-qqq", [&] { test::inverted_jet(jet, "F1"); });
  test::expect_error(ErrorKind::numerical, "ppp-ppp", [&] { test::inverted_jet(jet, "F4"); });
  test::expect_error(ErrorKind::numerical, "singular value",
                     [&] { test::inverted_jet(jet, "F1"); });
  EXPECT_NO_THROW(test::inverted_jet(jet, "F2"));
  EXPECT_NO_THROW(test::inverted_jet(jet, "F3"));
  // The identity map: F1 and F4 do not exist, F2 and F3 do.
  const auto identity = test::paper_jet<double>(0, 2);
  test::expect_error(ErrorKind::numerical, "qqq-qqq", [&] { test::inverted_jet(identity, "F1"); });
  EXPECT_EQ(test::inverted_jet(identity, "F2").condition, 1);
}

TEST(BestConditionedKind, HasTheSmallestCondition) {
  const auto jet = test::paper_jet<double>(test::paper_orbit().duration, 1);
  const std::vector<Series<double>>& map = jet;
  const auto best = best_conditioned_kind(map);
  for (const auto& kind : all_kinds(3)) {
    EXPECT_LE(condition_number(inverted_block(map, best)),
              condition_number(inverted_block(map, kind)));
  }
  EXPECT_LT(condition_number(inverted_block(map, best)),
            195.3);  // that of F4, the best of the four
}

TEST(PartialInversion, RefusesJetsInFewerVariables) {
  auto flow = test::flow_of(test::paper_orbit(), 2);
  flow.duration = 1;
  flow.variables = {0, 1, 2};
  const auto jet = test::run_gauss(flow);
  test::expect_error(ErrorKind::usage, "6 components in 6 variables",
                     [&] { test::inverted_jet(jet, "F1"); });
}

TEST(PartialInversion, OfTheOscillatorIsKnown) {
  // q = q0 cos t + p0 sin t: p0 = (q - q0 cos t) / sin t and p = (q cos t - q0) / sin t.
  const double t = 0.7;
  const test::Flow<double> flow{harmonic_oscillator(), {0.2, 0.1}, t, 2, {}};
  const auto inversion = test::inverted_jet(test::run_gauss(flow), "F1");
  const double s = std::sin(t);
  const double c = std::cos(t);
  EXPECT_NEAR(inversion.remaining_initial[0][1], 1 / s, 1e-14);
  EXPECT_NEAR(inversion.remaining_initial[0][2], -c / s, 1e-14);
  EXPECT_NEAR(inversion.remaining_final[0][1], c / s, 1e-14);
  EXPECT_NEAR(inversion.remaining_final[0][2], -1 / s, 1e-14);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_EQ(inversion.remaining_final[0][k], 0);
}

}  // namespace
}  // namespace hamjet
