#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/harmonic_oscillator.hpp"
#include "dynamics/spring_pendulum.hpp"
#include "support/flow.hpp"

// Gauss methods on flows with a time scale far below the step.

namespace hamjet {
namespace {

// Four stages with steps of 312 times the spring's period over 2 pi. Among the roots of the stage
// equations are some with the spring stretched several times its length, and an energy of 1e8. The
// expected state is the same discrete map by another program, in 69 decimal digits.
TEST(GaussStiff, StaysWithTheRootOfTheStageEquationsThatIsConnectedToTheStart) {
  const test::Flow<double> flow{spring_pendulum(1, 1e8, 1, 10), {0.6, -0.8, 0, 0}, 2, 1, {}};
  const auto end = test::final_state(test::run_gauss(flow, test::fixed_step(4, 0x1p-5)));
  // Half a unit in the last place of a position changes a step's momentum by 3e-10.
  EXPECT_NEAR(end[0], 0.5962347188201002, 1e-13);
  EXPECT_NEAR(end[1], -0.8028102443908424, 1e-13);
  EXPECT_NEAR(end[2], 0.18984949154094477, 3e-9);
  EXPECT_NEAR(end[3], 0.14199179504894774, 3e-9);
}

// The energy at the end of the same discrete maps, by the same other program. A stiff spring makes
// an even number of stages poor (order reduction), but no energy is that of a detached root.
// (Two stages at 1e10, 3000 times the fast time scale, take one all the same; the command's checks
// of steps and energy mark it.)
TEST(GaussStiff, HasTheEnergyOfTheDiscreteMapWhateverStagesAndStiffness) {
  const struct {
    double stiffness;
    int stages;
    double energy;
  } cases[] = {{1e6, 1, -7.99999744788},  {1e6, 2, -7.9996715017},  {1e6, 3, -7.99999946058},
               {1e6, 5, -7.99999999966},  {1e8, 1, -7.98972966989}, {1e8, 2, -3.38597526178},
               {1e8, 3, -7.99999507671},  {1e8, 5, -8.00000000968}, {1e10, 1, -6.75823997415},
               {1e10, 3, -7.99425228975}, {1e10, 5, -7.99999915849}};
  for (const auto& one : cases) {
    const test::Flow<double> flow{
        spring_pendulum(1, one.stiffness, 1, 10), {0.6, -0.8, 0, 0}, 2, 1, {}};
    const auto end = test::final_state(test::run_gauss(flow, test::fixed_step(one.stages, 0x1p-5)));
    // The bound is the effect of half a unit in the last place of the length on the spring's energy
    // and on the momentum.
    EXPECT_NEAR(test::energy(flow.system, end), one.energy, 1e-6 * std::abs(one.energy))
        << one.stiffness << " " << one.stages;
  }
}

// Twenty thousand controlled steps end at the duration: the rounding of their sum would turn this
// oscillator by 1e-10 too little or too much.
TEST(GaussStiff, ManyControlledStepsEndAtTheDuration) {
  const double k = 1e12, m = 0.25, duration = 0.01;
  const test::Flow<double> flow{harmonic_oscillator(m, k), {1, 0}, duration, 1, {}};
  const auto end = test::final_state(test::run_gauss(flow, test::adaptive(8, 1e-15)));
  const Extended w = sqrt(Extended(k) / Extended(m));
  const Extended phase = w * Extended(duration);
  // A phase of 2e4 is known to 2e4 half units in the last place, 2.2e-12.
  EXPECT_NEAR(end[0], static_cast<double>(Extended(cos(phase))), 2.2e-11);
  EXPECT_NEAR(end[1] / (m * static_cast<double>(w)), -static_cast<double>(Extended(sin(phase))),
              2.2e-11);
}

}  // namespace
}  // namespace hamjet
