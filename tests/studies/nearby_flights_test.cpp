#include "studies/flights/nearby_flights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hamjet/dynamics/zonal_gravity.hpp"
#include "studies/exact_flow.hpp"

namespace hamjet {
namespace {

// Expected: each flight alone, with a choice of its own. The harmonics above the fourth have waves
// so short that a tolerance has to be tried.
TEST(NearbyFlights, EndWhereEachAloneEnds) {
  ZonalGravity field;
  field.radius = 0.25;
  field.J[2] = 1.08e-3;
  field.J[5] = -2e-7;
  field.J[6] = 5e-7;
  const SharedSystem system = zonal_gravity(field);
  NearbyFlights flights(system);
  NearbyFlights tried_before(system);
  const double speed = std::sqrt(1.74 / 0.26);  // at the perigee of a = 1, e = 0.74
  tried_before.try_tolerance({0.26, 0, 0, 0, 0.8 * speed, 0.6 * speed}, ClockTime::epoch(), 7.0);
  for (const double duration : {0.3, 20.0, 7.0, -12.0}) {
    for (const double away : {0.0, 0.01}) {
      const std::vector<double> start = {0.26 + away, 0, 0, 0, 0.8 * speed, 0.6 * speed};
      const std::vector<double> end = flights.end(start, ClockTime::epoch(), duration);
      const std::vector<double> tried = tried_before.end(start, ClockTime::epoch(), duration);
      const std::vector<double> alone = exact_flow(system, start, ClockTime::epoch(), duration);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(end[i], alone[i], 1e-11) << duration;
        EXPECT_NEAR(tried[i], alone[i], 1e-11) << duration;
      }
    }
  }
}

}  // namespace
}  // namespace hamjet
