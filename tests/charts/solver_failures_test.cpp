#include <gtest/gtest.h>

#include "../support/errors.hpp"
#include "hamjet/charts/flow_box.hpp"
#include "hamjet/charts/flow_section.hpp"
#include "orbits.hpp"

namespace hamjet::test {
namespace {

// An energy above that of a parabola has no ellipse, and one far below no orbit of this momentum.
TEST(SolverFailures, ASectionHasNoStateOfAnEnergyFarFromTheChiefs) {
  const ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  const FlowSection<double> section(orbit.field, ChartName::nodal, orbit.start);
  expect_error(ErrorKind::numerical,
               "section:", [&] { section.state(-1e3 * section.energy(), section.chief()); });
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
