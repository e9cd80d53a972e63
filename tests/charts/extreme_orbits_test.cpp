#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/charts/deputy_flow.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "orbits.hpp"

// Flow boxes at the edges of their charts: each orbit is answered as an independent integration
// flies it, to the rounding that the flow itself amplifies, or refused with the reason.

namespace hamjet {
namespace {

using test::ChiefOrbit;
using test::orbit_of;

struct Case {
  const char* name;
  ChiefOrbit orbit;
  double time;                    ///< canonical
  const char* refused = nullptr;  ///< a word of the reason; null: it must be answered
};

ChiefOrbit state(const SixNumbers<double>& z, double J2 = 1e-3) {
  ChiefOrbit orbit{{.mu = 1, .radius = 0.9}, z, 2 * std::acos(-1.0)};
  orbit.field.J[2] = J2;
  return orbit;
}

/// The same orbit with its lengths in another unit.
ChiefOrbit in_unit(ChiefOrbit orbit, double length) {
  orbit.field.radius *= length;
  for (std::size_t i = 0; i < 3; ++i) {
    orbit.start[i] *= length;
    orbit.start[3 + i] /= std::sqrt(length);
  }
  orbit.period *= std::pow(length, 1.5);
  return orbit;
}

ChiefOrbit high_zonals() {
  ChiefOrbit orbit = orbit_of(6800, 0.001, 90, 0, 0, 0);
  for (int n = 4; n <= 20; ++n) orbit.field.J[n] = (n % 2 == 0 ? -1 : 1) * 1e-6 / n;
  return orbit;
}

std::vector<Case> cases() {
  const auto of = [](double e, double i, double anomaly, double a = 9000) {
    return orbit_of(a / (1 - std::min(e, 0.9)), e, i, 30, 40, anomaly);
  };
  const auto turn = [](const char* name, const ChiefOrbit& orbit, double revolutions,
                       const char* refused = nullptr) {
    return Case{name, orbit, revolutions * orbit.period, refused};
  };
  return {
      turn("circle in the equator", state({1, 0, 0, 0, 1, 0}), 1.3),
      turn("circle, the other way in the equator", state({1, 0, 0, 0, -1, 0}), 1.3),
      turn("inclination 1e-6 deg", of(0.1, 1e-6, 10), 1.3),
      turn("inclination just where a node is defined", of(0.1, 0.58, 10), 1.3),
      turn("inclination just where none is", of(0.1, 0.56, 10), 1.3),
      turn("inclination 179.43", of(0.1, 179.43, 10), 1.3),
      turn("polar, from the pole", state({0, 0, 1, 1, 0, 0}), 1.3),
      turn("polar, from the equator", state({1, 0, 0, 0, 0, 1}), 1.3),
      turn("circle, inclined", state({1, 0, 0, 0, std::sqrt(0.5), std::sqrt(0.5)}, 0), 1.3),
      turn("eccentricity 1e-9", of(1e-9, 50, 0), 1.3),
      turn("critical inclination", of(0.1, 63.4349, 10), 3),
      turn("e 0.8 from perigee", of(0.8, 50, 0), 1.3),
      turn("e 0.9 from perigee", of(0.9, 50, 0), 1.3),
      turn("e 0.9 from apogee", of(0.9, 50, 180), 1.3),
      turn("e 0.95 from perigee", of(0.95, 50, 0, 20000), 1.0),
      turn("e 0.98 from apogee", of(0.98, 50, 180, 60000), 0.4),
      turn("e 0.99 from apogee", of(0.99, 50, 180, 120000), 0.3),
      Case{"e 0.995 from perigee", orbit_of(2e6, 0.995, 50, 0, 0, 0), 5},
      Case{"parabola", state({1, 0, 0, 0, std::sqrt(1.0), 1.0}, 0), 4},
      Case{"energy just below zero", state({1, 0, 0, 0, 1.0, 0.999}), 4},
      Case{"hyperbola", state({1, 0, 0, 0.2, 1.3, 0.8}), 4},
      Case{"hyperbola in the equator", state({1, 0, 0, 0, 1.6, 0}), 4},
      Case{"flight past the centre", state({4, 1, 0, -0.7, 0.1, 0.1}), 6},
      turn("backwards", of(0.3, 50, 100), -1.3),
      turn("no time", of(0.3, 50, 100), 0),
      turn("a quarter of a turn", of(0.3, 50, 100), 0.25),
      turn("thirty revolutions", of(0.01, 50, 100), 30),
      turn("lengths in units of 1e-3", in_unit(of(0.3, 50, 100), 1000), 1.3),
      turn("lengths in units of 1e6", in_unit(of(0.3, 50, 100), 1e-6), 1.3),
      turn("zonals to J20", high_zonals(), 1.3),
      turn("an oblate body", state({1, 0, 0, 0, 0.8, 0.7}, 0.05), 1.3),
      turn("a line through the centre", state({1, 0, 0, 0.1, 0, 0}), 0.05, "line"),
      turn("almost a line", state({1, 0, 0, 0.5, 0.002, 0.001}), 0.05, "line"),
      Case{"a fall into the centre", state({1, 0, 0, -0.5, 0.006, 0.001}), 3, "collision"},
  };
}

SixNumbers<double> flown(const ChiefOrbit& orbit, const SixNumbers<double>& start, double time) {
  FlowProblem<double> problem{zonal_gravity(orbit.field),
                              SeriesSpace::create(1, 0),
                              {0},
                              {start.begin(), start.end()},
                              time};
  IntegrationStatistics statistics;
  const auto jet = integrate_fehlberg78<double>(problem, {.tolerance = 1e-14}, statistics);
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet[i][0];
  return end;
}

/// The largest of the derivatives of the final positions, with velocities in units of the chief's.
double growth(const ChiefOrbit& orbit, double time) {
  FlowProblem<double> problem{zonal_gravity(orbit.field),
                              SeriesSpace::create(6, 1),
                              {0, 1, 2, 3, 4, 5},
                              {orbit.start.begin(), orbit.start.end()},
                              time};
  GaussSettings settings;
  settings.tolerance = 1e-8;
  IntegrationStatistics statistics;
  const Matrix<double> flow = linear_part(integrate_gauss<double>(problem, settings, statistics));
  const double r = std::hypot(orbit.start[0], orbit.start[1], orbit.start[2]);
  const double v = std::hypot(orbit.start[3], orbit.start[4], orbit.start[5]);
  return std::max(flow.topLeftCorner(3, 3).cwiseAbs().maxCoeff() * r,
                  flow.topRightCorner(3, 3).cwiseAbs().maxCoeff() * v);
}

TEST(FlowBoxExtremes, AreAnsweredOrRefusedWithTheReason) {
  std::mt19937_64 generator(11);
  int answered = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const SixNumbers<double>& start = c.orbit.start;
    GaussSettings settings;
    settings.tolerance = 1e-13;
    std::unique_ptr<DeputyFlow> flow;
    try {
      FlowBoxPropagation<double> propagation(c.orbit.field, section_chart(start, 1.0), start, 2,
                                             settings);
      flow = flow_box_deputy_flow(c.orbit.field, propagation.advance_to(c.time));
    } catch (const Error& error) {
      ASSERT_NE(c.refused, nullptr) << error.what();
      EXPECT_EQ(error.kind(), ErrorKind::numerical);
      EXPECT_NE(std::string(error.what()).find(c.refused), std::string::npos) << error.what();
      continue;
    }
    ASSERT_EQ(c.refused, nullptr);
    ++answered;
    const double r = std::hypot(start[0], start[1], start[2]);
    const double v = std::hypot(start[3], start[4], start[5]);
    for (int k = 0; k < 4; ++k) {
      // So near that what the missing degrees would add is rounding.
      SixNumbers<double> deviation = test::random_deviation(generator, 1e-7);
      SixNumbers<double> deputy = start;
      for (std::size_t i = 0; i < 6; ++i) {
        deviation[i] *= i < 3 ? r : v;
        deputy[i] += deviation[i];
      }
      const SixNumbers<double> end = flown(c.orbit, deputy, c.time);
      const SixNumbers<double> predicted = flow->predict(deviation, 2).deviation;
      // A start that is rounded by 2^-53 moves the end by as much times the growth. Flights and
      // sections round some tens of times, and the flights' tolerance is 90 roundings: measured are
      // up to 100 of them, and 340 from apogee at e = 0.9.
      const double allowed = 2000 * 0x1p-53 * (growth(c.orbit, c.time) + r);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(flow->chief_end()[i] + predicted[i], end[i], allowed);
      }
    }
  }
  EXPECT_GE(answered, 25);
}

// Deputies that are far away, or of other kinds of orbits, are right or no numbers.
TEST(FlowBoxExtremes, AnswerDeputiesFarAwayOrSayNothing) {
  const ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  GaussSettings settings;
  settings.tolerance = 1e-13;
  FlowBoxPropagation<double> propagation(orbit.field, ChartName::nodal, orbit.start, 2, settings);
  const auto flow = flow_box_deputy_flow(orbit.field, propagation.advance_to(orbit.period));
  // Half a turn ahead.
  const SixNumbers<double> opposite = flown(orbit, orbit.start, 0.49 * orbit.period);
  SixNumbers<double> deviation;
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = opposite[i] - orbit.start[i];
  const SixNumbers<double> end = flown(orbit, opposite, orbit.period);
  const SixNumbers<double> predicted = flow->predict(deviation, 2).deviation;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(flow->chief_end()[i] + predicted[i], end[i], 1e-11);
  }
  // One that escapes has no period.
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = i < 3 ? 0 : orbit.start[i];
  EXPECT_FALSE(std::isfinite(flow->predict(deviation, 2).deviation[0]));
  // One at rest falls into the centre.
  for (std::size_t i = 0; i < 6; ++i) deviation[i] = i < 3 ? 0 : -orbit.start[i];
  EXPECT_FALSE(std::isfinite(flow->predict(deviation, 2).deviation[0]));
}

}  // namespace
}  // namespace hamjet
