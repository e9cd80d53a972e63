#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "support/flow.hpp"
#include "support/magnitude.hpp"

// Tests the purpose of the compensated summation of the steps, and that it can be turned off.

namespace hamjet {
namespace {

struct Run {
  FlowJet<double> jet;
  double largest_energy_error = 0;
};

Run run(const test::Flow<double>& flow, GaussSettings settings, bool is_compensated) {
  settings.compensated_summation = is_compensated;
  IntegrationStatistics statistics;
  const double before = test::energy(flow.system, flow.start);
  Run result;
  result.jet = integrate_gauss<double>(
      test::problem_of(flow), settings, statistics, [&](double, const FlowJet<double>& jet) {
        const double after = test::energy(flow.system, test::final_state(jet));
        result.largest_energy_error =
            test::larger(result.largest_energy_error, std::abs(after / before - 1));
      });
  return result;
}

// A Gauss method keeps a quadratic energy exactly, so that what is lost is round-off: each of the
// 32768 steps loses half a unit in the last place or so where the sums are plain, a random walk of
// some 1e-14. With compensation only what a step adds is rounded, 2^-9 of that.
TEST(CompensatedSummation, KeepsRoundOffFromGrowing) {
  const test::Flow<double> flow{harmonic_oscillator(), {0.7, 0.6}, 64, 1, {}};
  const auto settings = test::fixed_step(1, 0x1p-9);
  const double compensated = run(flow, settings, true).largest_energy_error;
  const double plain = run(flow, settings, false).largest_energy_error;
  EXPECT_LE(compensated, 2e-15);
  EXPECT_GE(plain, 5 * compensated);
  EXPECT_LE(plain, 1e-12);
}

// Both are the same method: the jets of all degrees agree to the round-off of a few steps. The
// first step loses nothing at its start, and a step of 1 rounds nothing in its products. Therefore
// higher degrees agree bit by bit, and the nominal, to which a step adds twice, agrees to a unit in
// the last place.
TEST(CompensatedSummation, ChangesRoundOffAlone) {
  auto flow = test::flow_of(test::paper_orbit(), 3);
  flow.duration = 1;
  for (const double step : {1.0, 0.1}) {
    const auto a = run(flow, test::fixed_step(4, step), true).jet;
    const auto b = run(flow, test::fixed_step(4, step), false).jet;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < a[i].size(); ++k) {
        if (step == 1 && k == 0) {
          EXPECT_NEAR(a[i][0], b[i][0], 0x1p-52 * std::abs(a[i][0]));
        } else if (step == 1) {
          EXPECT_EQ(a[i][k], b[i][k]);
        } else {
          EXPECT_NEAR(a[i][k], b[i][k], 1e-14 * (10 + std::abs(a[i][k])));
        }
      }
    }
  }
}

}  // namespace
}  // namespace hamjet
