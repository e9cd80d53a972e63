#include "studies/checks/flight_checks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/keep_out.hpp"
#include "studies/formation/single_transfer.hpp"

namespace hamjet {
namespace {

/// A chief that starts at perigee at distance 1 = 7000 km, about a body with a radius in
/// kilometres.
Scene chief(double eccentricity, double radius_km) {
  Scene scene = kepler_chief(eccentricity, 7000, 1000, 1);
  scene.system.radius_km = radius_km;
  scene.canonical_radius = radius_km / 7000;
  scene.duration = 10;
  return scene;
}

const SelfCheck& surface(const std::vector<SelfCheck>& checks) { return checks.at(1); }

// From apogee at 1, an ellipse comes down to (1 - e)/(1 + e) after half its period.
TEST(FlightChecks, FindTheLowestPointOfEveryFlight) {
  Scene scene = chief(0, 5000);
  const double e = 0.5;
  const std::vector<double> falling = {1, 0, 0, 0, std::sqrt(1 - e), 0};
  const std::vector<SelfCheck> checks =
      flight_checks(scene, {{"the chief", scene.nominal, scene.start_time, 3},
                            {"the deputy", falling, scene.start_time, -4}});
  EXPECT_EQ(checks[0].name, SelfCheckName::energy);
  EXPECT_EQ(checks[0].state, SelfCheckState::passed);
  EXPECT_EQ(surface(checks).state, SelfCheckState::failed);
  EXPECT_NEAR(*surface(checks).value, 7000 * (1 - e) / (1 + e), 1e-6);
  const double half = std::numbers::pi * std::pow(1 + e, -1.5);
  EXPECT_NE(surface(checks).text.find(fmt::format(
                "the deputy passes 2666.67 km below the surface at t = {:.6g} s", -1000 * half)),
            std::string::npos)
      << surface(checks).text;
  EXPECT_TRUE(has_failed(checks));
  EXPECT_FALSE(
      has_failed(flight_checks(scene, {{"the chief", scene.nominal, scene.start_time, 3}})));
}

// Flights that begin and end together share their arcs. The deputy's lowest point is that of an
// ellipse as above.
TEST(FlightChecks, FlownTogetherAreJudgedOneByOne) {
  const Scene scene = chief(0, 1000);
  const double e = 0.5;
  const CheckedFlight circle = {"the chief", scene.nominal, scene.start_time, 3};
  const CheckedFlight falling = {
      "the deputy", {1, 0, 0, 0, std::sqrt(1 - e), 0}, scene.start_time, 3};
  double flown = 0;
  const auto observe = [&](const FlightArc& arc) {
    ASSERT_EQ(arc.spacecraft.size(), 2u);
    EXPECT_EQ(arc.start, flown);
    flown = arc.time_at(1);
    const std::vector<double> z = arc.state(0, 1);
    EXPECT_NEAR(z[0], std::cos(flown), 1e-12);
  };
  const std::vector<SelfCheck> checks = flight_checks(scene, {circle, falling}, observe);
  EXPECT_EQ(flown, 3);
  EXPECT_FALSE(has_failed(checks));
  EXPECT_NEAR(*surface(checks).value, 7000 * (1 - e) / (1 + e), 1e-6);
  const CheckedFlight at_rest = {"the deputy", {1, 0, 0, 0, 0, 0}, scene.start_time, 3};
  EXPECT_NE(
      surface(flight_checks(scene, {circle, at_rest})).text.find("the deputy cannot be followed"),
      std::string::npos);
  EXPECT_THROW(flight_checks(scene, {circle, at_rest}, [](const FlightArc&) {}), Error);
}

// An observer sees the flights of a scene that checks nothing.
TEST(FlightChecks, AreObservedIfTheyAreOff) {
  Scene scene = chief(0, 1000);
  scene.checks[SelfCheckName::surface] = {false, std::nullopt};
  scene.checks[SelfCheckName::energy] = {false, std::nullopt};
  double flown = 0;
  flight_checks(scene, flights_of(scene, 3, false),
                [&](const FlightArc& arc) { flown = arc.time_at(1); });
  EXPECT_EQ(flown, 3);
}

TEST(FlightChecks, AreTheScenes) {
  Scene scene = chief(0, 7500);
  const std::vector<CheckedFlight> flights = flights_of(scene, 3, false);
  EXPECT_TRUE(has_failed(flight_checks(scene, flights)));
  scene.checks[SelfCheckName::surface].limit = 6900;
  EXPECT_FALSE(has_failed(flight_checks(scene, flights)));
  scene.checks[SelfCheckName::surface] = {false, std::nullopt};
  EXPECT_EQ(surface(flight_checks(scene, flights)).state, SelfCheckState::off);
  EXPECT_FALSE(surface_limit(scene).has_value());
  scene.checks[SelfCheckName::energy].limit = 1e-30;
  EXPECT_EQ(flight_checks(scene, flights)[0].state, SelfCheckState::failed);
}

TEST(FlightChecks, AFallIntoTheCentreFails) {
  Scene scene = chief(0, 1000);
  const std::vector<double> at_rest = {1, 0, 0, 0, 0, 0};
  const std::vector<SelfCheck> checks =
      flight_checks(scene, {{"the deputy", at_rest, scene.start_time, 3}});
  EXPECT_EQ(surface(checks).state, SelfCheckState::failed);
  EXPECT_NE(surface(checks).text.find("the deputy cannot be followed"), std::string::npos);
}

// At its middle the path is half a kilometre above or below the chief's circle.
TEST(FlightChecks, ATransferBelowTheSurfaceIsMarked) {
  Scene scene = half_revolution_along_the_track();
  const auto study = [&](double radius_km) {
    scene.system.radius_km = radius_km;
    scene.canonical_radius = radius_km / 7000;
    return study_transfer(scene);
  };
  const TransferResult high = study(6999.45);
  ASSERT_TRUE(high.points[0].lowest.has_value());
  EXPECT_EQ(exit_code(high), 0);
  // Forward along the track the deputy goes below.
  const TransferResult low = study(6999.6);
  EXPECT_NEAR(*low.points[0].lowest * 7000, 6999.5, 0.02);
  EXPECT_TRUE(low.points[0].is_below_surface);
  EXPECT_FALSE(low.points[0].is_candidate());
  EXPECT_EQ(exit_code(low), 1);
  // The path of a plan does the same.
  RelativeState start = scene.transfer->start;
  start.velocity_m_s += low.points[0].best().start_change_m_s;
  WayLimits way(scene);
  way.fly(scene.nominal,
          ChiefFrame(scene.nominal, metric_units(scene), scene.transfer->frame).deviation(start),
          scene.start_time, scene.transfer->times[0]);
  EXPECT_NE(way.forbidden().find("km below the surface"), std::string::npos) << way.forbidden();
  scene.checks[SelfCheckName::surface].is_on = false;
  EXPECT_EQ(exit_code(study(6999.6)), 0);
}

}  // namespace
}  // namespace hamjet
