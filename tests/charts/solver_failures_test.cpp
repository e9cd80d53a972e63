#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../support/errors.hpp"
#include "charts/plane_elements.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/charts/flow_section.hpp"
#include "orbits.hpp"

namespace hamjet::test {
namespace {

// An orbit of an energy above that of a parabola is not an ellipse, and no orbit of this momentum
// has an energy far below.
TEST(SolverFailures, ASectionHasNoStateOfAnEnergyFarFromTheChiefs) {
  const ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  const FlowSection<double> section(orbit.field, ChartName::nodal, orbit.start);
  expect_error(ErrorKind::numerical,
               "section:", [&] { section.state(-1e3 * section.energy(), section.chief()); });
}

TEST(SolverFailures, KeplersEquationInChartsOfNoNumberHasNoRoot) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(eccentric_longitude<double>(nan, 0.1, 0.2).angle));
  EXPECT_TRUE(std::isnan(eccentric_longitude<double>(1, nan, 0.2).sine));
}

// At the chief's own energy and coordinates the state is the chief's, to rounding.
TEST(SolverFailures, ASectionFindsItsChief) {
  for (const ChiefOrbit& orbit : bound_orbits()) {
    const FlowSection<double> section(orbit.field, section_chart(orbit.start, 1.0), orbit.start);
    const SixNumbers<double> state = section.state(section.energy(), section.chief());
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(state[i], orbit.start[i], 1e-12);
  }
}

}  // namespace
}  // namespace hamjet::test
