#include "poincare/bounded_family.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../charts/orbits.hpp"
#include "../support/flow.hpp"
#include "charts/secular_motion.hpp"
#include "hamjet/error.hpp"
#include "independent_flight.hpp"
#include "studies/bounded/mean_element_deputies.hpp"

namespace hamjet {
namespace {

using test::ChiefOrbit;
using test::IndependentFlight;
using test::orbit_of;

const GaussSettings integration_gauss = test::adaptive(8, 1e-13);

ChiefOrbit in_egm96(ChiefOrbit orbit) {
  orbit.field = test::egm96(orbit.field.radius);
  return orbit;
}

/// The slopes of least squares of the differences between a deputy's passages through the chief's
/// mean argument of latitude and the chief's own, and of the nodes then, over the family's window;
/// as lengths relative to a size, a revolution; flown by the test's own integrator.
struct Slopes {
  double along;
  double cross;
};
Slopes flown_slopes(const ChiefOrbit& orbit, const BoundedFamily& family,
                    const SixNumbers<double>& deputy, double size) {
  const IndependentFlight flight(orbit.field);
  auto chief_state = test::long_state(orbit.start);
  auto deputy_state = test::long_state(deputy);
  const auto& chart = family.section().chart();
  const auto& times = family.times();
  const auto& chief = family.section().chief();
  const double G =
      chief[3] - (chief[q_place] * chief[q_place] + chief[p_place] * chief[p_place]) / 2;
  const double cosine = chief[momentum_place] / G;
  const double a = chief[3] * chief[3];
  const double motion = 2 * std::numbers::pi / family.nodal_period();
  const double middle = times.back() / 2;
  double along = 0, cross = 0, squares = 0;
  double first_delay = 0, first_node = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      chief_state = flight(chief_state, times[k] - times[k - 1]);
      deputy_state = flight(deputy_state, times[k] - times[k - 1]);
    }
    const auto c = chart.coordinates(test::rounded(chief_state));
    auto state = deputy_state;
    long double delay = 0;
    auto z = chart.coordinates(test::rounded(state));
    // The rate of the angle is that of the mean anomaly to some percent.
    for (int i = 0; i < 12 && std::abs(within_half_a_turn(c[0] - z[0])) > 2e-14; ++i) {
      const long double step = within_half_a_turn(c[0] - z[0]) / motion;
      state = flight(state, step);
      delay += step;
      z = chart.coordinates(test::rounded(state));
    }
    if (k == 0) {
      first_delay = static_cast<double>(delay);
      first_node = z[1] - c[1];
    }
    const double node = within_half_a_turn(z[1] - c[1] - first_node);
    const double late = static_cast<double>(delay) - first_delay;
    along += (times[k] - middle) * a * (-motion * late + cosine * node);
    cross += (times[k] - middle) * a * std::sqrt(1 - cosine * cosine) * node;
    squares += std::pow(times[k] - middle, 2);
  }
  const double unit = family.nodal_period() / squares / size;
  return {along * unit, cross * unit};
}

/// The size of a deputy whose eccentricity vector differs by so much: twice that, along the track.
double size_of(const BoundedFamily& family, double amplitude) {
  return 2 * std::pow(family.section().chief()[3], 2) * amplitude;
}

/// Must show: drifts below 1e-6 of the size a revolution over 1000 revolutions of J2 to J6, beside
/// first-order J2 invariance; here at order 4 to 100 km about a sun-synchronous chief.
void expect_it_stays(int revolutions) {
  const ChiefOrbit orbit = in_egm96(orbit_of(7086, 0.00113, 98.2, 0, 90, 0));
  const BoundedFamily family(orbit.field, orbit.start, 4, revolutions, integration_gauss);
  const double unit = std::sqrt(family.section().chief()[3]);
  for (const double amplitude : {1e-4, 7e-3}) {
    const double q = 0.8 * amplitude * unit, p = 0.6 * amplitude * unit;
    const auto member = family.member(q, p, 4);
    const Slopes slopes = flown_slopes(orbit, family, member.state, size_of(family, amplitude));
    EXPECT_LT(std::abs(slopes.along), 1e-7) << amplitude;
    EXPECT_LT(std::abs(slopes.cross), 1e-7) << amplitude;
    const auto invariant =
        mean_element_deputy(orbit.field, orbit.start, MeanElementRule::j2_invariant, q, p);
    const Slopes of_first_order =
        flown_slopes(orbit, family, invariant, size_of(family, amplitude));
    EXPECT_GT(std::abs(of_first_order.along), 10 * std::abs(slopes.along)) << amplitude;
  }
}

TEST(BoundedFamily, StaysOverRevolutionsFlownIndependently) { expect_it_stays(100); }

TEST(BoundedFamilyAtLength, StaysOverAThousandRevolutionsFlownIndependently) {
  expect_it_stays(1000);
}

// Must show: relative orbits of a thousand kilometres about eccentric chiefs at order 6, over 1000
// revolutions; about a Molniya chief and one on its way to the geostationary ring.
TEST(BoundedFamilyAtLength, StaysWithEccentricChiefsFlownIndependently) {
  struct Case {
    ChiefOrbit orbit;
    double phase;  ///< the phase of the difference of the eccentricity vectors
  };
  for (const Case& one : {Case{in_egm96(orbit_of(26600, 0.74, 63.4, 0, 270, 0)), 1.6},
                          Case{in_egm96(orbit_of(24400, 0.73, 7, 0, 180, 0)), 1.5}}) {
    const ChiefOrbit& orbit = one.orbit;
    const BoundedFamily family(orbit.field, orbit.start, 6, 1000, integration_gauss);
    const auto& chief = family.section().chief();
    const double amplitude = 500 * orbit.field.radius / 6378.1363 / (chief[3] * chief[3]);
    const double unit = amplitude * std::sqrt(chief[3]);
    const double direction = std::atan2(-chief[q_place], chief[p_place]) + one.phase;
    const auto member = family.member(-unit * std::sin(direction), unit * std::cos(direction), 6);
    const Slopes slopes = flown_slopes(orbit, family, member.state, size_of(family, amplitude));
    EXPECT_LT(std::abs(slopes.along), 1e-6) << one.phase;
    EXPECT_LT(std::abs(slopes.cross), 1e-6) << one.phase;
  }
}

// Each degree of the polynomials takes the drift of a large formation down.
TEST(BoundedFamily, DriftsFallWithTheDegree) {
  const ChiefOrbit orbit = in_egm96(orbit_of(9000, 0.15, 50, 0, 30, 0));
  const BoundedFamily family(orbit.field, orbit.start, 4, 60, integration_gauss);
  const double unit = std::sqrt(family.section().chief()[3]);
  const double amplitude = 0.04;
  const double size = size_of(family, amplitude);
  std::vector<double> drifts;
  for (const int degree : {1, 2, 4}) {
    const auto member = family.member(0.6 * amplitude * unit, 0.8 * amplitude * unit, degree);
    drifts.push_back(std::abs(flown_slopes(orbit, family, member.state, size).along));
  }
  EXPECT_LT(drifts[1], 0.3 * drifts[0]);
  EXPECT_LT(drifts[2], 0.1 * drifts[1]);
}

// In a weak field too it is the same family in any unit of length: energies, told by periods, stay,
// and momenta go as the root of the length.
TEST(BoundedFamily, IsTheSameInAnyUnitOfLength) {
  const ChiefOrbit orbit = orbit_of(10000, 0.2, 50, 0, 20, 0, 1e-6, 0);
  const BoundedFamily family(orbit.field, orbit.start, 1, 4, integration_gauss);
  const double pair = 1e-3;
  const auto member = family.member(0.6 * pair, 0.8 * pair, 1);
  for (const double unit : {1e-5, 1e10}) {
    const double root = std::sqrt(unit);
    ZonalGravity field = orbit.field;
    field.radius *= unit;
    SixNumbers<double> start = orbit.start;
    for (std::size_t i = 0; i < 3; ++i) start[i] *= unit;
    for (std::size_t i = 3; i < 6; ++i) start[i] /= root;
    const BoundedFamily scaled(field, start, 1, 4, integration_gauss);
    const double size = pair * std::sqrt(root);
    const auto found = scaled.member(0.6 * size, 0.8 * size, 1);
    EXPECT_NEAR(found.energy, member.energy, 1e-3 * std::abs(member.energy)) << unit;
    EXPECT_NEAR(found.momentum / root, member.momentum, 1e-3 * std::abs(member.momentum)) << unit;
  }
}

// In a weak field the family's first degree is that of Brouwer's secular rates: with the pair of an
// eccentric chief moved outwards by little, L - G grows, and the energy and H at which l' + g' and
// h'/(l' + g') are the chief's follow from their closed formulas, solved here by Newton's method.
TEST(BoundedFamily, IsThatOfBrouwersRatesInAWeakField) {
  const double J2 = 1e-6;
  const ChiefOrbit orbit = orbit_of(10000, 0.2, 50, 0, 20, 0, J2, 0);
  const BoundedFamily family(orbit.field, orbit.start, 2, 20, integration_gauss);
  const auto& chief = family.section().chief();
  const double oblateness = J2 * std::pow(orbit.field.radius, 2);
  const double size = std::hypot(chief[q_place], chief[p_place]);
  const double step = 1e-4 * size;
  const auto member = family.member(step * chief[q_place] / size, step * chief[p_place] / size, 1);
  const auto rates = [&](double u0, double H, double pair) {
    const auto r = secular_rates<double, double>(family.section().energy_of(u0), pair * pair / 2, H,
                                                 1, oblateness);
    const double nodal = r.anomaly + r.pericentre;
    return std::array<double, 2>{nodal, r.node / nodal};
  };
  const double H0 = chief[momentum_place];
  const auto wanted = rates(0, H0, size);
  double u0 = 0, H = H0;
  for (int i = 0; i < 20; ++i) {
    const auto at = rates(u0, H, size + step);
    const double h = 1e-5;
    const auto by_u = rates(u0 + h, H, size + step), by_H = rates(u0, H + h, size + step);
    const double a = (by_u[0] - at[0]) / h, b = (by_H[0] - at[0]) / h;
    const double c = (by_u[1] - at[1]) / h, d = (by_H[1] - at[1]) / h;
    const double x = wanted[0] - at[0], y = wanted[1] - at[1];
    u0 += (d * x - b * y) / (a * d - b * c);
    H += (a * y - c * x) / (a * d - b * c);
  }
  ASSERT_GT(std::abs(H - H0), 1e-6);
  EXPECT_NEAR(member.momentum, H - H0, 1e-3 * std::abs(H - H0));
  EXPECT_NEAR(member.energy, u0, 1e-3 * std::abs(u0));
}

// Without J2 there is nothing to solve: all orbits of one period stay together.
TEST(BoundedFamily, RefusesAFieldWithoutOblateness) {
  const ChiefOrbit orbit = orbit_of(9000, 0.1, 50, 0, 30, 0, 0, 0);
  try {
    const BoundedFamily family(orbit.field, orbit.start, 2, 10, integration_gauss);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_NE(std::string(error.what()).find("stay together"), std::string::npos);
  }
}

// Where the node's drift of a wider orbit would take an inclination below 0 there is no deputy.
TEST(BoundedFamily, SaysWhereThereIsNoDeputy) {
  const ChiefOrbit orbit = in_egm96(orbit_of(24400, 0.73, 7, 0, 180, 0));
  const BoundedFamily family(orbit.field, orbit.start, 1, 10, integration_gauss);
  const auto& chief = family.section().chief();
  const double size = std::hypot(chief[q_place], chief[p_place]);
  const double step = -0.05;
  EXPECT_THROW(family.member(step * chief[q_place] / size, step * chief[p_place] / size, 1), Error);
}

}  // namespace
}  // namespace hamjet
