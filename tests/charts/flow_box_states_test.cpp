#include "hamjet/charts/flow_box_states.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamjet/error.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/maps/map_evaluator.hpp"
#include "orbits.hpp"

namespace hamjet {
namespace {

/// Flies by an explicit method, which shares no code with Gauss's methods or the sections.
SixNumbers<double> flown_there(const ZonalGravity& field, const SixNumbers<double>& start,
                               double time) {
  FlowProblem<double> problem{zonal_gravity(field),         SeriesSpace::create(1, 0), {0},
                              {start.begin(), start.end()}, ClockTime::epoch(),        time};
  IntegrationStatistics statistics;
  const auto jet = integrate_fehlberg78<double>(problem, {.tolerance = 1e-14}, statistics);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet[i][0];
  return end;
}

/// v^2/2 - 1/r (1 - J2 (R/r)^2 P2(z/r) - J3 (R/r)^3 P3(z/r)).
double energy_of(const ZonalGravity& field, const SixNumbers<double>& z) {
  const double r = std::hypot(z[0], z[1], z[2]);
  const double s = z[2] / r;
  const double ratio = field.radius / r;
  return (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 -
         (1 - field.J[2] * ratio * ratio * (3 * s * s - 1) / 2 -
          field.J[3] * ratio * ratio * ratio * (5 * s * s * s - 3 * s) / 2) /
             r;
}

// Tests the meaning of the coordinates: a deputy is flown to the end, and from there back by the
// time that the series give. There the angle is the chief's, and the other coordinates differ as
// the series predict.
TEST(FlowBoxCoordinates, AreTimeSinceTheSectionPeriodAndTheSectionsCoordinates) {
  for (const test::ChiefOrbit& orbit : test::bound_orbits()) {
    const double time = 1.7 * orbit.period;
    constexpr int order = 4;
    GaussSettings settings;
    settings.tolerance = 1e-13;
    FlowBoxPropagation<double> propagation(orbit.field, section_chart(orbit.start, 1.0),
                                           orbit.start, order, settings);
    const FlowBoxMap<double> map = propagation.advance_to(time);
    const auto series = flow_box_coordinates(orbit.field, map);
    ASSERT_EQ(series.size(), 6u);
    const MapEvaluator evaluator(series);
    std::mt19937_64 generator(9);
    for (const std::size_t half : {0u, 1u}) {
      const SixNumbers<double> deviation =
          test::random_deviation(generator, half == 0 ? 2e-4 : 1e-4);
      std::array<double, 6> said{};
      evaluator.evaluate(deviation, {.values = said, .last = {}, .last_but_one = {}});
      SixNumbers<double> deputy = orbit.start;
      for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
      const FlowSection<double>& end = *map.end;
      const SixNumbers<double> at_section =
          flown_there(orbit.field, flown_there(orbit.field, deputy, time), -said[0]);
      const SixNumbers<double> c = end.chart().coordinates(at_section);
      EXPECT_NEAR(within_half_a_turn(c[0] - end.chief()[0]), 0, 1e-10);
      const double energy = energy_of(orbit.field, deputy);
      EXPECT_NEAR(said[1], end.variable_of(energy), 1e-10);
      for (std::size_t k = 0; k < end.places().size(); ++k) {
        EXPECT_NEAR(said[2 + k], c[end.places()[k]] - end.chief()[end.places()[k]], 1e-10);
      }
      if (end.ignored()) {
        EXPECT_NEAR(within_half_a_turn(said[5] - c[*end.ignored()] + end.chief()[*end.ignored()]),
                    0, 1e-10);
      }
    }
  }
}

std::vector<test::ChiefOrbit> all_orbits() {
  std::vector<test::ChiefOrbit> orbits = test::bound_orbits();
  orbits.push_back(orbits[1]);  // an orbit that escapes, whose section is described by the energy
  orbits.back().start = {1, 0.1, 0, 0.2, 1.3, 0.8};
  return orbits;
}

FlowJet<double> jet_of(const test::ChiefOrbit& orbit, double time, int order,
                       const GaussSettings& settings) {
  const FlowProblem<double> problem{
      zonal_gravity(orbit.field), SeriesSpace::create(6, order),
      {0, 1, 2, 3, 4, 5},         {orbit.start.begin(), orbit.start.end()},
      ClockTime::epoch(),         time};
  IntegrationStatistics statistics;
  return integrate_gauss<double>(problem, settings, statistics);
}

/// The largest difference of series by degree, relative to the largest coefficient of the degree.
std::vector<double> differences(const std::vector<Series<double>>& found,
                                const std::vector<Series<double>>& right) {
  const SeriesSpace& space = right[0].space();
  std::vector<double> result;
  for (int d = 0; d <= right[0].order(); ++d) {
    double largest = 0;
    double difference = 0;
    for (std::size_t i = 0; i < right.size(); ++i) {
      for (std::size_t k = space.first(d); k < space.first(d + 1); ++k) {
        largest = std::max(largest, std::abs(right[i][k]));
        difference = std::max(difference, std::abs(found[i][k] - right[i][k]));
      }
    }
    result.push_back(difference / largest);
  }
  return result;
}

// The same flow is computed in two ways, which share neither variables nor integration. Degree by
// degree the results differ by the errors of both, 1e-13 for each step relative to the state, which
// grow as the coefficients do.
TEST(FlowBoxJet, IsTheJetOfPositionsAndMomenta) {
  for (const test::ChiefOrbit& orbit : all_orbits()) {
    const double time = 0.8 * orbit.period;
    constexpr int order = 3;
    GaussSettings settings;
    settings.tolerance = 1e-13;
    FlowBoxPropagation<double> propagation(orbit.field, section_chart(orbit.start, 1.0),
                                           orbit.start, order, settings);
    const auto found = flow_box_jet(orbit.field, propagation.advance_to(time)).jet();
    const auto jet = jet_of(orbit, time, order, settings);
    const std::vector<double> apart = differences(found, jet);
    for (std::size_t d = 0; d < apart.size(); ++d) EXPECT_LT(apart[d], 1e-9) << "degree " << d;
  }
}

// The composed map equals the map that is integrated in variables of its own, except for the errors
// of both integrations as above. In positions and momenta it equals the jet that it was made of,
// except for the rounding of some thousand operations for each coefficient, which cancel by a
// factor of up to ten.
TEST(FlowBoxMapOfJet, IsTheIntegratedMapAndTheInverseOfItsJet) {
  for (const test::ChiefOrbit& orbit : all_orbits()) {
    const double time = 0.8 * orbit.period;
    constexpr int order = 3;
    GaussSettings settings;
    settings.tolerance = 1e-13;
    const ChartName chart = section_chart(orbit.start, 1.0);
    const FlowMap<double> jet(jet_of(orbit, time, order, settings));
    const FlowBoxMap<double> found =
        flow_box_map_of_jet<double>(orbit.field, chart, orbit.start, time, jet);
    FlowBoxPropagation<double> propagation(orbit.field, chart, orbit.start, order, settings);
    const auto beside =
        differences(flow_box_coordinates(orbit.field, found),
                    flow_box_coordinates(orbit.field, propagation.advance_to(time)));
    const auto back = differences(flow_box_jet(orbit.field, found).jet(), jet.jet());
    for (int d = 1; d <= order; ++d) {
      EXPECT_LT(beside[static_cast<std::size_t>(d)], 1e-9) << "degree " << d;
      EXPECT_LT(back[static_cast<std::size_t>(d)], 2e-12) << "degree " << d;
    }
  }
}

TEST(FlowBoxMapOfJet, RefusesAJetOfFewerVariables) {
  const test::ChiefOrbit orbit = test::bound_orbits().front();
  const SpacePointer space = SeriesSpace::create(4, 2);
  const FlowMap<double> small(FlowJet<double>(4, Series<double>(space)));
  EXPECT_THROW(
      flow_box_map_of_jet<double>(orbit.field, ChartName::nodal, orbit.start, orbit.period, small),
      Error);
}

}  // namespace
}  // namespace hamjet
