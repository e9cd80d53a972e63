#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "orbits.hpp"

// Flow boxes of deputies at the edges of their charts. Orbits there are cases of `hamjet stability`
// (studies/stability/flow_box_cases.hpp).

namespace hamjet {
namespace {

using test::ChiefOrbit;
using test::orbit_of;

SixNumbers<double> flown(const ChiefOrbit& orbit, const SixNumbers<double>& start, double time) {
  FlowProblem<double> problem{zonal_gravity(orbit.field),   SeriesSpace::create(1, 0), {0},
                              {start.begin(), start.end()}, ClockTime::epoch(),        time};
  IntegrationStatistics statistics;
  const auto jet = integrate_fehlberg78<double>(problem, {.tolerance = 1e-14}, statistics);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet[i][0];
  return end;
}

// Predictions of deputies that are far away, or on other kinds of orbits, are right or are not
// numbers.
TEST(FlowBoxExtremes, AnswerDeputiesFarAwayOrSayNothing) {
  const ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  GaussSettings settings;
  settings.tolerance = 1e-13;
  FlowBoxPropagation<double> propagation(orbit.field, ChartName::nodal, orbit.start, 2, settings);
  const auto flow = flow_box_deputy_flow(orbit.field, propagation.advance_to(orbit.period));
  // The deputy is half a turn ahead.
  const SixNumbers<double> opposite = flown(orbit, orbit.start, 0.49 * orbit.period);
  SixNumbers<double> deviation;
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = opposite[i] - orbit.start[i];
  const SixNumbers<double> end = flown(orbit, opposite, orbit.period);
  const SixNumbers<double> predicted = flow->predict(deviation, 2).deviation;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(flow->chief_end()[i] + predicted[i], end[i], 1e-11);
  }
  // A deputy that escapes has no period.
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = i < 3 ? 0 : orbit.start[i];
  EXPECT_FALSE(std::isfinite(flow->predict(deviation, 2).deviation[0]));
  // A deputy at rest falls into the centre.
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = i < 3 ? 0 : -orbit.start[i];
  EXPECT_FALSE(std::isfinite(flow->predict(deviation, 2).deviation[0]));
}

}  // namespace
}  // namespace hamjet
