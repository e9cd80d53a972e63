#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "hamjet/scene/scene_reader.hpp"
#include "report/bounded/event_report.hpp"
#include "studies/bounded/event_study.hpp"

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

// Of an orbit the expression is in the units in which the scene gives its states.
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
  const EventStudy surface = study("surface = \"distance\"\ndistance_km = 9500\n");
  const EventStudy expression =
      study("surface = \"expression\"\nexpression = \"x^2 + y^2 + z^2 - 90.25\"\n");
  for (std::size_t m = 0; m < surface.map.time.size(); ++m) {
    const double size = 1e-11 * (1 + std::abs(surface.map.time[m]));
    EXPECT_NEAR(expression.map.time[m], surface.map.time[m], size) << m;
  }
}

}  // namespace
}  // namespace hamjet
