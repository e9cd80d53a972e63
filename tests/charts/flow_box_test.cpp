#include "hamjet/charts/flow_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "orbits.hpp"

namespace hamjet {
namespace {

using test::bound_orbits;
using test::ChiefOrbit;
using test::orbit_of;

GaussSettings gauss(double tolerance = 1e-13) {
  GaussSettings settings;
  settings.tolerance = tolerance;
  return settings;
}

FlowBoxMap<double> map_of(const ChiefOrbit& orbit, double time, int order,
                          std::optional<ChartName> chart = {}) {
  FlowBoxPropagation<double> propagation(
      orbit.field, chart.value_or(section_chart(orbit.start, 1.0)), orbit.start, order, gauss());
  return propagation.advance_to(time);
}

/// Flies by an explicit method, which shares no code with Gauss's or Taylor's methods or the
/// charts.
SixNumbers<double> flown(const ZonalGravity& field, const SixNumbers<double>& start, double time) {
  FlowProblem<double> problem{zonal_gravity(field),         SeriesSpace::create(1, 0), {0},
                              {start.begin(), start.end()}, ClockTime::epoch(),        time};
  IntegrationStatistics statistics;
  const auto jet = integrate_fehlberg78<double>(problem, {.tolerance = 1e-14}, statistics);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet[i][0];
  return end;
}

/// The largest miss in position over deputies of one size.
double largest_miss(const ChiefOrbit& orbit, const DeputyFlow& flow, double time, double size,
                    int degree) {
  std::mt19937_64 generator(5);
  double largest = 0;
  for (int k = 0; k < 6; ++k) {
    const SixNumbers<double> deviation = test::random_deviation(generator, size);
    SixNumbers<double> deputy = orbit.start;
    for (std::size_t i = 0; i < 6; ++i) deputy[i] += deviation[i];
    const SixNumbers<double> end = flown(orbit.field, deputy, time);
    const SixNumbers<double> predicted = flow.predict(deviation, degree).deviation;
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      square += std::pow(flow.chief_end()[i] + predicted[i] - end[i], 2);
    }
    largest = std::max(largest, std::sqrt(square));
  }
  return largest;
}

// In the charts of elements Kepler's motion is known in closed form: the time of flight is that of
// the steady motion, and the section's coordinates are constant, to the rounding of the
// integration.
TEST(FlowBox, HasNothingLeftOfKeplersMotion) {
  for (const double i : {0.2, 50.0}) {
    const ChiefOrbit orbit = orbit_of(9000, 0.2, i, 40, 50, 60, 0, 0);
    const double time = 2.3 * orbit.period;
    const FlowBoxMap<double> map = map_of(orbit, time, 4);
    for (const double c : map.time.coefficients()) EXPECT_NEAR(c, 0, 1e-10);
    const SpacePointer& space = map.time.space_pointer();
    for (std::size_t k = 0; k < map.end->places().size(); ++k) {
      const std::size_t place = map.end->places()[k];
      Series<double> left = map.coordinates[k] - Series<double>::variable(space, k + 1);
      left[0] -= map.start->chief()[place];
      for (const double c : left.coefficients()) EXPECT_NEAR(c, 0, 1e-10) << i << ' ' << place;
    }
  }
}

// In the sections' canonical coordinates, time and energy the map is symplectic at every degree, to
// the error of the integration (its tolerance, grown over the revolutions).
TEST(FlowBox, IsSymplecticAtEveryDegree) {
  for (const ChiefOrbit& orbit : bound_orbits()) {
    for (const bool is_spherical : {false, true}) {
      FlowBoxMap<double> map =
          map_of(orbit, 1.7 * orbit.period, 4,
                 is_spherical ? std::optional(ChartName::spherical) : std::nullopt);
      for (const SymplecticityDefect& defect : map.symplecticity()) {
        EXPECT_LT(defect.scaled, 1e-9) << defect.degree;
      }
      // The test notices one coefficient that is wrong by a thousandth of the largest of its
      // degree.
      const SeriesSpace& space = map.time.space();
      map.time[space.first(3) + 4] += 1e-3;
      double largest = 0;
      for (const SymplecticityDefect& defect : map.symplecticity()) {
        largest = std::max(largest, defect.absolute);
      }
      EXPECT_GT(largest, 1e-4);
    }
  }
}

// An independent integration flies deputies drawn at random. The prediction's error falls as the
// separation to the power of the degree + 1.
TEST(FlowBox, PredictsDeputiesThatAreFlownIndependently) {
  for (const ChiefOrbit& orbit : bound_orbits()) {
    const double time = 1.4 * orbit.period;
    const auto flow = flow_box_deputy_flow(orbit.field, map_of(orbit, time, 4));
    const double coarse = largest_miss(orbit, *flow, time, 4e-4, 1);
    const double fine = largest_miss(orbit, *flow, time, 1e-4, 1);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4), 2, 0.35);
    // Explicit flights are right to about 1e-11 here.
    EXPECT_LT(largest_miss(orbit, *flow, time, 1e-4, 4), 1e-9);
  }
}

TEST(FlowBox, PredictsDeputiesOfAnOrbitThatIsNoEllipse) {
  ChiefOrbit orbit = orbit_of(9000, 0.2, 40, 40, 50, 60);
  for (std::size_t i = 3; i < 6; ++i) orbit.start[i] *= 1.5;  // a hyperbola
  ASSERT_EQ(section_chart(orbit.start, 1.0), ChartName::spherical);
  const auto flow = flow_box_deputy_flow(orbit.field, map_of(orbit, 3, 4));
  EXPECT_LT(largest_miss(orbit, *flow, 3, 1e-4, 4), 1e-10);
  EXPECT_GT(largest_miss(orbit, *flow, 3, 1e-3, 1), 1e-8);
}

// The position along the orbit is not a variable of the polynomials: the prediction for a deputy a
// tenth of a turn ahead, or with another node, is as right as for the chief.
TEST(FlowBox, DoesNotSeparateWhatItLeavesOut) {
  const ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  const double time = 2 * orbit.period;
  const auto flow = flow_box_deputy_flow(orbit.field, map_of(orbit, time, 1));
  for (const double turn : {0.0, 1.0}) {
    SixNumbers<double> deputy = flown(orbit.field, orbit.start, 0.1 * orbit.period);
    const double c = std::cos(turn), s = std::sin(turn);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) {
      const double x = deputy[i];
      deputy[i] = c * x - s * deputy[i + 1];
      deputy[i + 1] = s * x + c * deputy[i + 1];
    }
    SixNumbers<double> deviation;
    for (std::size_t i = 0; i < 6; ++i) deviation[i] = deputy[i] - orbit.start[i];
    const SixNumbers<double> end = flown(orbit.field, deputy, time);
    const SixNumbers<double> predicted = flow->predict(deviation, 1).deviation;
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(flow->chief_end()[i] + predicted[i], end[i], 3e-12) << turn;
    }
  }
}

// A map over a time is the same whether or not other maps were made on the way, and the map over no
// time is the identity.
TEST(FlowBox, GoesOnFromTimeToTime) {
  const ChiefOrbit orbit = orbit_of(10000, 0.3, 60, 20, 40, 10);
  FlowBoxPropagation<double> propagation(orbit.field, ChartName::nodal, orbit.start, 3, gauss());
  std::mt19937_64 generator(3);
  const SixNumbers<double> deviation = test::random_deviation(generator, 1e-3);
  const auto none = flow_box_deputy_flow(orbit.field, propagation.advance_to(0));
  const auto same = none->predict(deviation, 3).deviation;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(same[i], deviation[i], 1e-14);
  propagation.advance_to(0.8 * orbit.period);
  const auto last = flow_box_deputy_flow(orbit.field, propagation.advance_to(2 * orbit.period));
  const auto once = flow_box_deputy_flow(orbit.field, map_of(orbit, 2 * orbit.period, 3));
  const auto a = last->predict(deviation, 3).deviation;
  const auto b = once->predict(deviation, 3).deviation;
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(a[i], b[i], 1e-11);
}

// The same map in extended precision differs by the error of double precision.
TEST(FlowBox, AgreesWithExtendedPrecision) {
  const ChiefOrbit orbit = orbit_of(10000, 0.3, 60, 20, 40, 10);
  const FlowBoxMap<double> map = map_of(orbit, orbit.period, 2);
  SixNumbers<Extended> start;
  for (std::size_t i = 0; i < 6; ++i) start[i] = orbit.start[i];
  FlowBoxPropagation<Extended> propagation(orbit.field, ChartName::nodal, start, 2, gauss(1e-20));
  const FlowBoxMap<Extended> exact = propagation.advance_to(Extended(orbit.period));
  for (std::size_t k = 0; k < map.time.size(); ++k) {
    EXPECT_NEAR(map.time[k], static_cast<double>(exact.time[k]), 1e-11);
    for (std::size_t c = 0; c < map.coordinates.size(); ++c) {
      EXPECT_NEAR(map.coordinates[c][k], static_cast<double>(exact.coordinates[c][k]), 1e-11);
    }
  }
}

// At e = 0.9 the shear along the orbit costs a Cartesian jet the digits of its high degrees. The
// polynomials here do not contain the shear: all their degrees are as right as the first, relative
// to the largest coefficient of each.
TEST(FlowBox, KeepsItsHighDegreesOnAnEccentricOrbit) {
  const ChiefOrbit orbit = orbit_of(70000, 0.9, 63, 0, 0, 0);
  const double time = 3.5 * orbit.period;
  const FlowBoxMap<double> map = map_of(orbit, time, 4);
  SixNumbers<Extended> start;
  for (std::size_t i = 0; i < 6; ++i) start[i] = orbit.start[i];
  GaussSettings fine = gauss(1e-14);
  fine.stages = 16;
  FlowBoxPropagation<Extended> propagation(orbit.field, ChartName::nodal, start, 4, fine);
  const FlowBoxMap<Extended> exact = propagation.advance_to(Extended(time));
  const SeriesSpace& space = map.time.space();
  std::vector<double> errors;
  for (int degree = 0; degree <= 4; ++degree) {
    double error = 0;
    double size = 0;
    const auto compare = [&](const Series<double>& a, const Series<Extended>& b) {
      for (std::size_t k = space.first(degree); k < space.first(degree + 1); ++k) {
        const auto wanted = static_cast<double>(b[k]);
        error = std::max(error, std::abs(a[k] - wanted));
        size = std::max(size, std::abs(wanted));
      }
    };
    compare(map.time, exact.time);
    for (std::size_t c = 0; c < map.coordinates.size(); ++c) {
      compare(map.coordinates[c], exact.coordinates[c]);
    }
    errors.push_back(error / size);
  }
  EXPECT_LT(errors[1], 1e-9);
  EXPECT_LT(errors[3], 10 * errors[1]);
  EXPECT_LT(errors[4], 10 * errors[1]);
}

// A prediction of many deputies equals the predictions of each, and the prediction of a deputy
// without coordinates is not a number.
TEST(FlowBox, PredictsManyAsEach) {
  const ChiefOrbit orbit = orbit_of(10000, 0.3, 60, 20, 40, 10);
  const auto flow = flow_box_deputy_flow(orbit.field, map_of(orbit, orbit.period, 3));
  std::mt19937_64 generator(4);
  std::vector<SixNumbers<double>> deviations;
  for (int k = 0; k < 21; ++k) deviations.push_back(test::random_deviation(generator, 1e-2));
  for (std::size_t i = 0; i < 3; ++i) deviations[5][i] = -orbit.start[i];  // a deputy in the centre
  std::vector<DeputyPrediction> all(deviations.size());
  flow->predict(deviations, 2, all);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == 5) {
      EXPECT_FALSE(std::isfinite(all[k].deviation[0]));
      continue;
    }
    const DeputyPrediction one = flow->predict(deviations[k], 2);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(all[k].deviation[i], one.deviation[i], 1e-13);
      EXPECT_NEAR(all[k].highest[0][i], one.highest[0][i], 1e-13);
    }
  }
  EXPECT_THROW(flow->predict(deviations[0], 4), Error);
  EXPECT_THROW(flow->predict(deviations[0], 0), Error);
}

}  // namespace
}  // namespace hamjet
