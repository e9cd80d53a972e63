#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../formation_scenes.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/impulses/least_impulses.hpp"

// Transfers near a circle of radius 1, whose mean motion is 1, so that angles are times.

namespace hamjet {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The matrix of Clohessy and Wiltshire about a circle of mean motion 1, velocities in the rotating
/// axes R, T, N. (Journal of the Aerospace Sciences 27, 1960.)
inline Eigen::Matrix<double, 6, 6> clohessy_wiltshire(double t) {
  const double s = std::sin(t), c = std::cos(t);
  Eigen::Matrix<double, 6, 6> flow;
  flow << 4 - 3 * c, 0, 0, s, 2 - 2 * c, 0,            //
      6 * (s - t), 1, 0, 2 * c - 2, 4 * s - 3 * t, 0,  //
      0, 0, c, 0, 0, s,                                //
      3 * s, 0, 0, c, 2 * s, 0,                        //
      6 * c - 6, 0, 0, -2 * s, 4 * c - 3, 0,           //
      0, 0, -s, 0, 0, c;
  return flow;
}

inline std::vector<ImpulseEffect> effects_of_circle(double duration, int intervals) {
  std::vector<ImpulseEffect> effects;
  for (int k = 0; k <= intervals; ++k) {
    const Eigen::Matrix<double, 6, 6> back = clohessy_wiltshire(-duration * k / intervals);
    effects.emplace_back(back.rightCols<3>());
  }
  return effects;
}

/// A deputy about a metre from a chief on a circle of radius 7000 km. Velocities are in m/s; a unit
/// is the mean motion times a metre.
inline Scene metres_from_circle(const RelativeState& start, double duration) {
  const double radius_km = 7000;
  Scene scene = kepler_chief(0, radius_km, std::sqrt(std::pow(radius_km, 3) / 398600.4415), 2);
  TransferSettings settings;
  settings.start = start;
  settings.start.velocity_m_s /= scene.units.time_s;
  settings.times = {duration};
  settings.impulses = TransferImpulses::optimal;
  settings.refined_miss_m = 1e-6;
  scene.transfer = settings;
  return scene;
}

/// The plan's total in units of the mean motion times a metre.
inline double total_of(const TransferResult& result) {
  return result.optimal->plan->total_change_m_s() * result.scene.units.time_s;
}

inline void expect_flown(const TransferResult& result) {
  ASSERT_TRUE(result.optimal && result.optimal->plan) << result.optimal->failure;
  const ImpulsePlan& plan = *result.optimal->plan;
  EXPECT_EQ(plan.failure, "");
  EXPECT_LE(plan.miss_m, result.scene.transfer->refined_miss_m);
  ASSERT_TRUE(plan.lower_bound_m_s.has_value());
  EXPECT_LE(*plan.lower_bound_m_s, plan.total_change_m_s() * (1 + 1e-12));
  EXPECT_GT(*plan.lower_bound_m_s, plan.total_change_m_s() * (1 - 2e-5));
  for (const PrimerMagnitude& primer : plan.primer) EXPECT_LE(primer.magnitude, 1 + 1e-9);
}

}  // namespace hamjet
