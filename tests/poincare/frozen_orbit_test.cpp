#include "poincare/frozen_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../charts/orbits.hpp"
#include "charts/secular_motion.hpp"
#include "hamjet/error.hpp"
#include "independent_flight.hpp"
#include "poincare/rotation_normal_form.hpp"

namespace hamjet {
namespace {

using test::ChiefOrbit;
using test::IndependentFlight;
using test::orbit_of;

const GaussSettings return_gauss = test::gauss_of(1e-14);
constexpr double turn = 2 * std::numbers::pi;

FrozenOrbit<double> frozen_of(const ChiefOrbit& orbit) {
  return find_frozen_orbit<double>(orbit.field, orbit.start, true, return_gauss);
}

double cosine_of_inclination(const SixNumbers<double>& z) {
  return z[momentum_place] / (z[3] - (z[q_place] * z[q_place] + z[p_place] * z[p_place]) / 2);
}

/// A sun-synchronous orbit in J2 to J6.
ChiefOrbit sun_synchronous() {
  ChiefOrbit orbit = orbit_of(7086, 0.001, 98.2, 0, 90, 0);
  orbit.field = test::egm96(orbit.field.radius);
  return orbit;
}

// The orbit found in extended precision is the same after a revolution that is flown by an
// integrator and a field of the test's own, to the rounding of the coordinates of double.
TEST(FrozenOrbit, IsAFixedPointOfAnIndependentFlight) {
  const ChiefOrbit orbit = sun_synchronous();
  SixNumbers<Extended> start;
  for (std::size_t i = 0; i < 6; ++i) start[i] = orbit.start[i];
  const auto frozen = find_frozen_orbit<Extended>(orbit.field, start, true, test::gauss_of(1e-22));
  EXPECT_LT(frozen.residual, Extended(1e-20));
  IndependentFlight::State state;
  for (std::size_t i = 0; i < 6; ++i) state[i] = static_cast<long double>(frozen.state[i]);
  const IndependentFlight flight(orbit.field);
  const auto end = flight(state, static_cast<long double>(frozen.period));
  const CanonicalChart<double> chart(ChartName::nodal, orbit.start, 1);
  const auto before = chart.coordinates(test::rounded(state));
  const auto after = chart.coordinates(test::rounded(end));
  EXPECT_NEAR(after[q_place], before[q_place], 1e-15 * 20);
  EXPECT_NEAR(after[p_place], before[p_place], 1e-15 * 20);
  EXPECT_NEAR(within_half_a_turn(after[0] - before[0]), 0, 1e-13);
  EXPECT_NEAR(within_half_a_turn(after[1] - before[1]), static_cast<double>(frozen.node), 1e-13);
}

// Cook's first order: e = -(J3 R sin i)/(2 J2 a) with the perigee at 90 degrees. In a weak field
// what is left is of the order of J2, the periodic terms at the section, 3/2 J2 R^2/a^2 (1 + ...)
// at most.
TEST(FrozenOrbit, HasTheEccentricityOfFirstOrderInAWeakField) {
  for (const double inclination : {30.0, 50.0, 98.2, 120.0}) {
    const double J2 = 1e-6, J3 = -2e-9;
    const ChiefOrbit orbit = orbit_of(8000, 0.004, inclination, 0, 40, 10, J2, J3);
    const auto frozen = frozen_of(orbit);
    const auto& z = frozen.coordinates;
    const double a = z[3] * z[3];
    const double cosine = cosine_of_inclination(z);
    const double e = -J3 / J2 * orbit.field.radius * std::sqrt(1 - cosine * cosine) / (2 * a);
    EXPECT_NEAR(z[q_place] / std::sqrt(z[3]), -e, 4 * J2) << inclination;
    EXPECT_NEAR(z[p_place], 0, 4 * J2) << inclination;
    EXPECT_GT(e, 2e-4);
  }
}

// Brouwer's secular rates of first order: the pericentre's pair turns by 2 pi g'/(l' + g') and the
// node by 2 pi h'/(l' + g') a revolution. What is left out is J2 of them.
TEST(FrozenOrbit, HasBrouwersRatesInAWeakField) {
  const double J2 = 1e-6;
  for (const double inclination : {30.0, 50.0, 98.2}) {
    const ChiefOrbit orbit = orbit_of(8000, 0.004, inclination, 0, 40, 10, J2, -2e-9);
    const auto frozen = frozen_of(orbit);
    const auto& z = frozen.coordinates;
    const double cosine = cosine_of_inclination(z);
    // p = a (1 - e^2), which is a to the square of an eccentricity of 1e-3.
    const double f = 0.75 * J2 * std::pow(orbit.field.radius / (z[3] * z[3]), 2);
    const double pericentre = turn * f * (5 * cosine * cosine - 1);
    EXPECT_NEAR(2 - frozen.trace(), pericentre * pericentre,
                1e-3 * pericentre * pericentre + 1e-13);
    EXPECT_NEAR(frozen.node, turn * -2 * f * cosine, 2e-5 * turn * f);
    const double rate =
        std::pow(z[3], -3) * (1 + f * (3 * cosine * cosine - 1) + f * (5 * cosine * cosine - 1));
    EXPECT_NEAR(frozen.period * rate, turn, turn * 8 * J2);
  }
}

// The return of one energy and H preserves the area, whatever the orbit.
TEST(FrozenOrbit, ReturnsPreserveTheArea) {
  for (const ChiefOrbit& orbit :
       {orbit_of(7086, 0.001, 98.2, 0, 90, 0), orbit_of(10000, 0.3, 60, 20, 40, 10),
        orbit_of(26600, 0.74, 63.4, 0, 270, 60)}) {
    const auto back = first_return<double>(orbit.field, orbit.start, 1, return_gauss);
    const auto slope = [](const Series<double>& s, NodalVariable v) {
      return s[s.space().linear_index(v)];
    };
    const auto& flight = back.flight;
    EXPECT_NEAR(slope(flight.q, q_variable) * slope(flight.p, p_variable) -
                    slope(flight.q, p_variable) * slope(flight.p, q_variable),
                1, 1e-11);
    EXPECT_NEAR(back.map.end->chief()[0], back.map.start->chief()[0], 1e-13);
  }
}

// On either side of the critical inclination, 5 cos^2 i = 1, the pericentre's pair turns in
// opposite senses; Brouwer's rate vanishes there.
TEST(RotationNormalForm, TurnsTheOtherWayBeyondTheCriticalInclination) {
  for (const auto& [inclination, sign] : {std::pair(58.0, 1.0), std::pair(70.0, -1.0)}) {
    ChiefOrbit orbit = orbit_of(7500, 0.002, inclination, 0, 90, 0);
    const auto frozen = frozen_of(orbit);
    const auto back = first_return<double>(orbit.field, frozen.state, 2, return_gauss);
    const RotationNormalForm form(back.flight);
    EXPECT_GT(sign * form.rotation_number({0, 0, 0}), 1e-6) << inclination;
  }
}

// In a weak field the rotation number at an action I = L - G and the mean nodal period are those
// of Brouwer's secular rates at the same energy and H, a function of I in closed form.
TEST(RotationNormalForm, HasBrouwersRatesAtEveryAmplitude) {
  const double J2 = 1e-6;
  const ChiefOrbit orbit = orbit_of(8000, 0.004, 40, 0, 40, 10, J2, -1e-10);
  const auto frozen = frozen_of(orbit);
  const auto back = first_return<double>(orbit.field, frozen.state, 6, return_gauss);
  const RotationNormalForm form(back.flight);
  const double H = frozen.coordinates[momentum_place];
  const auto rates_at = [&](double action) {
    return secular_rates<double, double>(frozen.energy, action, H, 1,
                                         J2 * std::pow(orbit.field.radius, 2));
  };
  const auto rotation_at = [&](double action) {
    const auto rates = rates_at(action);
    return rates.pericentre / (rates.anomaly + rates.pericentre);
  };
  for (const double radius : {0.05, 0.1, 0.2}) {
    const RotationNormalForm::Circle circle{radius, 0, 0};
    const double action = form.action(circle);
    EXPECT_NEAR(action, radius * radius / 2, 1e-3 * action);
    const double change = rotation_at(action) - rotation_at(0);
    ASSERT_GT(std::abs(change), 1e-10);
    // Rates go as powers of 1 - I/L of up to -8: of the return's degree 6, rotation numbers lack
    // I^3, 8 9 10/3! of the first over 8, and times I^4, 8 9 10 11/4! (L is 1.06).
    const double cubic = 15 * std::pow(action, 2);
    const double quartic = 330 * std::pow(action, 4);
    EXPECT_NEAR(form.rotation_number(circle) - form.rotation_number({0, 0, 0}), change,
                (cubic + 1e-3) * std::abs(change));
    const auto rates = rates_at(action);
    EXPECT_NEAR(form.mean_period(circle), turn / (rates.anomaly + rates.pericentre),
                20 * J2 * J2 + turn * J2 * quartic);
    EXPECT_NEAR(form.mean_node(circle), turn * rates.node / (rates.anomaly + rates.pericentre),
                1e-4 * turn * J2);
  }
}

// Orbits are where the normal form has them after many revolutions of an independent flight, and
// the error falls steeply with the amplitude.
TEST(RotationNormalForm, PredictsOrbitsThatAreFlownIndependently) {
  const ChiefOrbit orbit = sun_synchronous();
  const auto frozen = frozen_of(orbit);
  const auto back = first_return<double>(orbit.field, frozen.state, 4, return_gauss);
  const RotationNormalForm form(back.flight);
  const FlowSection<double> section(orbit.field, ChartName::nodal, frozen.state);
  const IndependentFlight flight(orbit.field);
  constexpr int returns = 100;
  const auto miss = [&](double radius) {
    const RotationNormalForm::Circle circle{radius, 0, 0};
    SixNumbers<double> z = section.chief();
    const auto from = form.pair(circle, 0.3);
    z[q_place] += from[0];
    z[p_place] += from[1];
    auto state = test::long_state(section.state(section.energy(), z));
    state = flight(state, returns * form.mean_period(circle));
    for (int i = 0; i < 4; ++i) {
      const auto at = section.chart().coordinates(test::rounded(state));
      const double left = within_half_a_turn(section.chief()[0] - at[0]);
      if (std::abs(left) > 1e-14) state = flight(state, left / section.rate());
    }
    const auto end = section.chart().coordinates(test::rounded(state));
    const auto wanted = form.pair(circle, form.angle_after(circle, 0.3, returns));
    return std::hypot(end[q_place] - section.chief()[q_place] - wanted[0],
                      end[p_place] - section.chief()[p_place] - wanted[1]);
  };
  const double coarse = miss(0.2);
  const double fine = miss(0.1);
  EXPECT_LT(fine, 1e-4 * 0.1);
  // Terms from the fifth degree on are left out.
  EXPECT_GT(std::log2(coarse / fine), 4);
  EXPECT_LT(miss(0.01), 1e-10);
}

// The mean of a long flight, over a whole turn of the pericentre's pair, is the frozen orbit, to
// the square of the amplitude; nothing of the return map goes into it.
TEST(FrozenOrbit, IsTheMeanOfALongFlight) {
  const ChiefOrbit orbit = sun_synchronous();
  const auto frozen = frozen_of(orbit);
  const auto back = first_return<double>(orbit.field, frozen.state, 2, return_gauss);
  const RotationNormalForm form(back.flight);
  const FlowSection<double> section(orbit.field, ChartName::nodal, frozen.state);
  const double radius = 1e-3;
  SixNumbers<double> z = section.chief();
  z[q_place] += radius;
  const IndependentFlight flight(orbit.field);
  auto state = test::long_state(section.state(section.energy(), z));
  const double turns = 1 / std::abs(form.rotation_number({radius, 0, 0}));
  constexpr int samples = 24;
  // Each sample is a whole number of nodal periods on, nearly a 24th of a turn.
  const auto each = static_cast<int>(std::lround(turns / samples));
  double mean_q = 0, mean_p = 0;
  for (int k = 0; k < samples; ++k) {
    const auto at = section.chart().coordinates(test::rounded(state));
    mean_q += (at[q_place] - section.chief()[q_place]) / samples;
    mean_p += (at[p_place] - section.chief()[p_place]) / samples;
    state = flight(state, each * frozen.period);
  }
  // The turn is whole to half a revolution a sample, 12 in 1700.
  const double whole = radius * std::numbers::pi * samples / turns;
  EXPECT_NEAR(mean_q, 0, whole + 2 * radius * radius);
  EXPECT_NEAR(mean_p, 0, whole + 2 * radius * radius);
  EXPECT_LT(whole, 0.05 * radius);
}

// A frozen orbit that is unstable has multipliers beyond 1, and no normal form.
TEST(RotationNormalForm, RefusesAnUnstableOrbit) {
  ChiefOrbit orbit = orbit_of(26600, 0.74, 63.4, 0, 270, 0);
  orbit.field = test::egm96(orbit.field.radius);
  const auto frozen = find_frozen_orbit<double>(orbit.field, orbit.start, false, return_gauss);
  ASSERT_GT(frozen.trace(), 2);
  const auto back = first_return<double>(orbit.field, frozen.state, 2, return_gauss);
  try {
    const RotationNormalForm form(back.flight);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerical);
    EXPECT_NE(std::string(error.what()).find("unstable"), std::string::npos);
  }
}

TEST(FrozenOrbit, RefusesAnOrbitWithoutANode) {
  const ChiefOrbit orbit = orbit_of(42164, 0.0002, 0.05, 10, 20, 30);
  EXPECT_THROW(frozen_of(orbit), Error);
}

}  // namespace
}  // namespace hamjet
