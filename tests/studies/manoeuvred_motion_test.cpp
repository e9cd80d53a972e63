#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/error.hpp"
#include "studies/flights/manoeuvred_flight.hpp"
#include "studies/formation/deputy_motion.hpp"

// Motions with the manoeuvres of orbit messages, beside closed forms of circles.

namespace hamjet {
namespace {

constexpr double length_km = 7000;
constexpr double mu_km3_s2 = 398600.4415;

/// A circle of Kepler's problem, with the deputy a little behind its chief.
Scene circle(double revolutions) {
  Scene scene = kepler_chief(0, length_km, std::sqrt(std::pow(length_km, 3) / mu_km3_s2), 2);
  scene.duration = 2 * std::numbers::pi * revolutions;
  RelativeState start;
  start.position_m = {0, -1, 0};
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, start};
  return scene;
}

double radius(const std::vector<double>& state) { return std::hypot(state[0], state[1], state[2]); }

Manoeuvre impulse_at(double time, ThrustAxes axes, const Eigen::Vector3d& change) {
  Manoeuvre one;
  one.start = time;
  one.axes = axes;
  one.change = change;
  return one;
}

// Hohmann's transfer between circles of radius 1 and a: the first impulse is sqrt(2 a / (1 + a)) -
// 1, the second a^-1/2 (1 - sqrt(2 / (1 + a))), half an ellipse of semi-major axis (1 + a) / 2
// apart.
TEST(ManoeuvredMotion, HohmannsImpulsesLeadTheChiefToTheOtherCircle) {
  constexpr double a = 1.02;
  const double half = std::numbers::pi * std::pow((1 + a) / 2, 1.5);
  for (const ThrustAxes axes : {ThrustAxes::rtn, ThrustAxes::tnw}) {
    const Eigen::Vector3d along =
        axes == ThrustAxes::rtn ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    Scene scene = circle(1.5);
    scene.manoeuvres = {
        impulse_at(0.5, axes, along * (std::sqrt(2 * a / (1 + a)) - 1)),
        impulse_at(0.5 + half, axes, along * (1 - std::sqrt(2 / (1 + a))) / std::sqrt(a))};
    const DeputyMotion motion = study_deputy_motion(scene);
    EXPECT_EQ(motion.manoeuvres, 2);
    EXPECT_FALSE(motion.drift);
    ASSERT_EQ(motion.flown.times.back(), scene.duration);
    for (std::size_t i = 0; i < motion.flown.times.size(); ++i) {
      const double time = motion.flown.times[i];
      const double r = radius(motion.flown.chief[i]);
      const bool is_between = time > 0.5 && time <= 0.5 + half;
      if (!is_between) {
        EXPECT_NEAR(r, time <= 0.5 ? 1 : a, 1e-12);
      }
      EXPECT_LT(std::abs(radius(motion.flown.deputy[i]) - 1), 1e-12);
    }
    EXPECT_NEAR(motion.points.back().state.position_m.norm(),
                motion.flown.states.back().position_m.norm(), 1e-6);
  }
}

// As a burn of fixed change grows shorter it tends to the impulse at its middle, with the square of
// its length: a burn that is half as long is four times as near.
TEST(ManoeuvredMotion, ShortBurnsTendToTheImpulseAboutTheirMiddle) {
  const auto end_of = [](double length, double mass_share) {
    Scene scene = circle(0.5);
    Manoeuvre burn = impulse_at(1 - length / 2, ThrustAxes::rtn, {1e-4, 2e-4, -1e-4});
    burn.length = length;
    burn.mass_share = mass_share;
    scene.deputy->manoeuvres = {burn};
    return study_deputy_motion(scene).flown.deputy.back();
  };
  const std::vector<double> impulse = end_of(0, 0);
  const auto distance = [&](double length) {
    const std::vector<double> end = end_of(length, 0);
    return std::hypot(end[0] - impulse[0], end[1] - impulse[1], end[2] - impulse[2]);
  };
  const double far = distance(0.2), near = distance(0.1);
  EXPECT_GT(far, 1e-8);
  EXPECT_NEAR(std::log2(far / near), 2, 0.05);
}

// A burn of falling mass has the same change: in the burn's own integral w ln(m0 / m1) of
// Tsiolkovsky.
TEST(ManoeuvredMotion, AFallingMassChangesTheVelocityByAsMuch) {
  Scene scene = circle(0.25);
  Manoeuvre burn = impulse_at(0, ThrustAxes::inertial, {0, 0, 1e-3});
  burn.length = 1e-3;
  burn.mass_share = 0.75;
  const std::vector<double> start = scene.nominal;
  const std::vector<double> end =
      burnt_flow(make_system(scene), start, scene.start_time, burn, 0, burn.length);
  EXPECT_NEAR(end[5], 1e-3, 1e-9);
  // Later than in the middle: to first order the place is the integral of the remaining change,
  // dv T ((1 - s) ln(1 - s) / s + 1) / -ln(1 - s).
  const double s = burn.mass_share;
  const double share = (std::log1p(-s) * (1 - s) / s + 1) / -std::log1p(-s);
  EXPECT_NEAR(end[2], 1e-3 * burn.length * share, 1e-12);
  const Manoeuvre even{0, burn.length, ThrustAxes::inertial, burn.change, 0};
  const std::vector<double> other =
      burnt_flow(make_system(scene), start, scene.start_time, even, 0, burn.length);
  EXPECT_NEAR(other[2], 1e-3 * burn.length / 2, 1e-12);
}

// Both spacecraft with the same burn along their own axes stay together: a deputy that is the
// chief.
TEST(ManoeuvredMotion, ADeputyThatBurnsAsItsChiefStaysWithIt) {
  Scene scene = circle(1);
  scene.deputy->start = {};
  Manoeuvre burn = impulse_at(0.75, ThrustAxes::tnw, {1e-3, 1e-4, 2e-4});
  burn.length = 0.25;
  burn.mass_share = 0.1;
  scene.manoeuvres =
      scene.deputy->manoeuvres = {burn, impulse_at(2, ThrustAxes::inertial, {1e-3, -1e-3, 1e-3})};
  const DeputyMotion motion = study_deputy_motion(scene);
  EXPECT_EQ(motion.manoeuvres, 4);
  for (const RelativeState& state : motion.flown.states) {
    EXPECT_EQ(state.position_m.norm(), 0);
  }
  EXPECT_GT(std::abs(radius(motion.flown.chief.back()) - 1), 1e-4);
}

TEST(ManoeuvredMotion, OtherStudiesRefuseManoeuvres) {
  Scene scene = circle(1);
  scene.manoeuvres = {impulse_at(0.5, ThrustAxes::rtn, {0, 1e-4, 0})};
  try {
    make_problem(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_NE(std::string(error.what()).find("which `hamjet motion` alone flies"),
              std::string::npos);
  }
  EXPECT_NO_THROW(make_problem(without_manoeuvres(scene)));
  scene.duration = -1;
  EXPECT_THROW(study_deputy_motion(scene), Error);
}

}  // namespace
}  // namespace hamjet
