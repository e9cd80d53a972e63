#include "studies/formation/burns/canonical_thruster.hpp"

#include <gtest/gtest.h>

namespace hamjet {
namespace {

// The mean time of a change, the integral of t a(t) over that of a(t), by Simpson's rule, for
// changes on both sides of where its series ends; and its rate by differences.
TEST(CanonicalThruster, MeanTimeOfAChangeIsItsIntegral) {
  ThrusterSettings settings;
  settings.acceleration_m_s2 = 0.5;
  settings.exhaust_m_s = 4;
  const CanonicalThruster thruster(settings, {1, 1});
  constexpr double mass = 0.75;
  for (const double change : {1e-3, 0.039, 0.041, 3.0}) {
    const double length = thruster.length(change, mass);
    double sum = 0, mean = 0;
    constexpr int parts = 1000;
    for (int k = 0; k <= parts; ++k) {
      const double t = length * k / parts;
      const double a = 0.5 / (mass - 0.5 / 4 * t);  // the mass falls by thrust over exhaust
      const double weight = (k == 0 || k == parts ? 1 : k % 2 == 1 ? 4 : 2) * length / parts / 3;
      sum += weight * a;
      mean += weight * a * t;
    }
    EXPECT_NEAR(sum, change, 1e-9 * change);
    EXPECT_NEAR(thruster.centre(change, mass), mean / sum, 1e-9 * length);
    const double step = 1e-4 * change;
    const double rate =
        (thruster.centre(change + step, mass) - thruster.centre(change - step, mass)) / (2 * step);
    EXPECT_NEAR(thruster.centre_rate(change, mass), rate, 1e-6 * rate);
  }
}

}  // namespace
}  // namespace hamjet
