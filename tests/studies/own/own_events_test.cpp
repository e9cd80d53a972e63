#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "report/bounded/event_report.hpp"
#include "studies/bounded/event_study.hpp"
#include "support/errors.hpp"

// Events whose surface is an expression, of systems that a scene writes and of orbits.

namespace hamjet {
namespace {

std::string pendulum(const std::string& event) {
  return "[system]\nmodel = \"own\"\ncoordinates = [\"angle\"]\nmomenta = [\"L\"]\n"
         "parameters = { lowest = 0 }\ndefinitions = { above = \"angle - lowest\" }\n"
         "hamiltonian = \"L^2/2 - cos(angle)\"\n[nominal]\ncoordinates = [1]\nmomenta = "
         "[0]\n[jet]\n"
         "order = 3\nduration_canonical = 20\n[event]\nsurface = \"expression\"\n" +
         event;
}

EventStudy event_of(const std::string& event) {
  return study_event(io::parse_scene(pendulum(event), "pendulum.toml"));
}

// From rest at an angle a the lowest point is reached after K(k), k = sin(a/2), with the momentum
// sqrt(2 (1 - cos a)); dK/dk = E / (k (1 - k^2)) - K / k.
TEST(OwnEvents, APendulumPassesItsLowestPoint) {
  const EventStudy study = event_of("expression = \"above\"\n");
  const double k = std::sin(0.5);
  const double K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
  const FlowJet<double> told = io::told_polynomials(study);
  ASSERT_EQ(told.size(), 3U);
  ASSERT_EQ(told[0].space().variables(), 2U);
  EXPECT_NEAR(told[0][0], K, 1e-13);
  EXPECT_NEAR(told[2][0], -std::sqrt(2 * (1 - std::cos(1.0))), 1e-13);
  const double by_angle = (E / (k * (1 - k * k)) - K / k) * std::cos(0.5) / 2;
  EXPECT_NEAR(told[0][1], by_angle, 1e-12);
  // On the surface the angle stays what it is, whatever the start.
  for (std::size_t m = 0; m < told[1].size(); ++m) EXPECT_NEAR(told[1][m], 0, 1e-12) << m;
  // The energy is that of the start: L^2 / 2 = cos(angle) - cos(a), here of a neighbour; order 3
  // leaves the fourth power.
  const double change = 1e-3;
  double momentum = 0, power = 1;
  for (int degree = 0; degree <= 3; ++degree, power *= change) {
    const std::array<std::uint8_t, 2> monomial = {static_cast<std::uint8_t>(degree), 0};
    momentum += told[2][told[2].space().index(monomial)] * power;
  }
  EXPECT_NEAR(momentum, -std::sqrt(2 * (1 - std::cos(1 + change))), 1e-12);
  // Deputies that were flown agree, up to a twentieth of the nominal's size.
  ASSERT_EQ(study.misses.size(), 7U);
  for (const EventMisses& miss : study.misses) {
    ASSERT_TRUE(miss.position_m.has_value());
    EXPECT_LT(*miss.position_m, 1e-4 * miss.amplitude_m + 1e-14);
  }
}

TEST(OwnEvents, DirectionAndNumberCount) {
  const double K = std::comp_ellint_1(std::sin(0.5));
  EXPECT_NEAR(event_of("expression = \"angle\"\ndirection = \"rising\"\n").map.time[0], 3 * K,
              1e-12);
  EXPECT_NEAR(event_of("expression = \"L\"\nnumber = 2\n").map.time[0], 4 * K, 1e-12);
}

// Of an orbit the expression is in km and km/s, whatever the scene's units are.
TEST(OwnEvents, AnExpressionOfAnOrbitIsOneOfItsSurfaces) {
  const auto study = [](const std::string& event) {
    return study_event(io::parse_scene(
        "[units]\nlength_km = 1000\n[system]\nmodel = \"zonal-gravity\"\nmu_km3_s2 = 398600.4415\n"
        "radius_km = 6378.1363\nJ2 = 1e-3\n[nominal]\na_km = 9000\ne = 0.2\nraan_deg = 0\nargp_deg "
        "= 0\ni_deg = 50\nta_deg = "
        "90\n[jet]\norder = 2\n"
        "duration_orbits = 2\n[event]\n" +
            event,
        "orbit.toml"));
  };
  const auto expect_same = [&](const std::string& surface, const std::string& expression) {
    const EventStudy one = study(surface);
    const EventStudy other = study("surface = \"expression\"\nexpression = \"" + expression + "\"");
    for (std::size_t m = 0; m < one.map.time.size(); ++m) {
      const double size = 1e-11 * (1 + std::abs(one.map.time[m]));
      EXPECT_NEAR(other.map.time[m], one.map.time[m], size) << expression << " " << m;
    }
    EXPECT_NEAR(other.misses.at(0).linear_position_m.value(),
                one.misses.at(0).linear_position_m.value(), 1e-6);
  };
  expect_same("surface = \"distance\"\ndistance_km = 9500\n", "x^2 + y^2 + z^2 - 9500^2");
  expect_same("surface = \"apsis\"\n", "x*px + y*py + z*pz");
  // At a place of the same energy in km^2/s^2, half of v^2 is what mu/r leaves.
  const EventStudy at_speed =
      study("surface = \"expression\"\nexpression = \"px^2 + py^2 + pz^2 - 36\"");
  const std::vector<double> state = at_speed.state();
  const double speed = std::hypot(state[3], state[4], state[5]) * at_speed.scene.units.length_km /
                       at_speed.scene.units.time_s;
  EXPECT_NEAR(speed, 6, 1e-11);
}

std::string oscillator(const std::string& mass, const std::string& expression, int order) {
  return "[system]\nmodel = \"own\"\ncoordinates = [\"q\"]\nmomenta = [\"p\"]\n"
         "parameters = { m = " +
         mass +
         " }\nhamiltonian = \"p^2/(2*m) + m*q^2/2\"\n[nominal]\ncoordinates = [1]\n"
         "momenta = [0]\n[jet]\norder = " +
         std::to_string(order) +
         "\nduration_canonical = 9\n[event]\nsurface = \"expression\"\nexpression = \"" +
         expression + "\"\n";
}

// q = A cos(t - f) with A = |(1 + dq, dp/m)| and f its angle: at first order the event is at
// pi/2 + dp/m, where q is A sin(f - dp/m). Deputies lie at both sides of dq and of the rate dp/m,
// which is that over the event's time.
TEST(OwnEvents, DeputiesHaveTheDeviationsThatAreTold) {
  constexpr double amplitude = 0.05;
  const double rate = amplitude / (std::numbers::pi / 2);
  double largest = 0;
  for (const double dq : {-amplitude, amplitude}) {
    for (const double dp : {-rate, rate}) {
      const double A = std::hypot(1 + dq, dp), f = std::atan2(dp, 1 + dq);
      largest = std::max(largest, std::abs(A * std::sin(f - dp)));
    }
  }
  for (const std::string mass : {"1e-6", "1", "1e6"}) {
    const EventStudy study = study_event(
        io::parse_scene(oscillator(mass, "q", 2) + "amplitudes_m = [0.05]\n", "oscillator.toml"));
    ASSERT_EQ(study.misses.size(), 1U);
    EXPECT_NEAR(study.misses[0].linear_position_m.value(), largest, 1e-9 * largest) << mass;
  }
}

// -cot t = 2 at pi - atan(1/2) and a half turn later; between them is a pole. 1/q has poles alone.
TEST(OwnEvents, APoleIsNoEvent) {
  const EventStudy study =
      study_event(io::parse_scene(oscillator("1", "q/p - 2", 1) + "number = 2\n", "pole.toml"));
  EXPECT_NEAR(study.map.time[0], 2 * std::numbers::pi - std::atan(0.5), 1e-12);
  test::expect_error([] { study_event(io::parse_scene(oscillator("1", "1/q", 1), "pole.toml")); },
                     ErrorKind::scene, {"event.number: no such event", "has none"}, "1/q");
}

}  // namespace
}  // namespace hamjet
