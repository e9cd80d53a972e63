#include <gtest/gtest.h>

#include "../charts/orbits.hpp"
#include "../support/errors.hpp"
#include "../support/flow.hpp"
#include "hamjet/poincare/event_map.hpp"
#include "poincare/frozen_orbit.hpp"

// What has no solution is an error, never the last number of the search.

namespace hamjet::test {
namespace {

// The height over the equator plus a constant that the orbit does not reach has no zero.
TEST(SolverFailures, AnEventThatTheChiefDoesNotMeet) {
  const ChiefOrbit orbit = orbit_of(9000, 0.2, 50, 30, 70, 40);
  const auto condition = [](const SixNumbers<Series<double>>& z) {
    Series<double> height = z[2];
    height[0] += 3;
    return height;
  };
  expect_error(ErrorKind::numerical, "event:", [&] {
    event_map<double>(zonal_gravity(orbit.field), orbit.start, ClockTime::epoch(),
                      0.4 * orbit.period, 1, test::adaptive(8, 1e-13), condition);
  });
}

// Where the even harmonics vanish nothing turns the pericentre, and J3 alone moves it for ever.
TEST(SolverFailures, AFieldWithoutAFrozenOrbit) {
  ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  orbit.field.J = {{3, 0.1}};
  expect_error(ErrorKind::numerical, "frozen orbit: Newton's method finds none", [&] {
    find_frozen_orbit<double>(orbit.field, orbit.start, true, test::adaptive(8, 1e-13));
  });
}

}  // namespace
}  // namespace hamjet::test
