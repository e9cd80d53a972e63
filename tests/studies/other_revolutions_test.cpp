#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "formation_scenes.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/lambert.hpp"

// Transfers with other numbers of revolutions. Expected: they are the ends of orbits that Kepler's
// equation was followed along, from which the problem was made.

namespace hamjet {
namespace {

/// A state on an ellipse about mu = 1 after a time, by Kepler's equation.
class Ellipse {
 public:
  Ellipse(double axis, double eccentricity, double inclination, double anomaly)
      : a_(axis), e_(eccentricity), i_(inclination), first_(anomaly) {}

  /// Position and velocity.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> at(double time) const {
    const double rate = std::pow(a_, -1.5);
    const double mean = first_ - e_ * std::sin(first_) + rate * time;
    double anomaly = mean;
    for (int step = 0; step < 100; ++step) {
      anomaly -= (anomaly - e_ * std::sin(anomaly) - mean) / (1 - e_ * std::cos(anomaly));
    }
    const double root = std::sqrt(1 - e_ * e_);
    const double speed = std::sqrt(a_) / (a_ * (1 - e_ * std::cos(anomaly)));
    return {turned(a_ * (std::cos(anomaly) - e_), a_ * root * std::sin(anomaly)),
            turned(-speed * std::sin(anomaly), speed * root * std::cos(anomaly))};
  }
  double period() const { return 2 * std::numbers::pi * std::pow(a_, 1.5); }
  Eigen::Vector3d momentum() const { return at(0).first.cross(at(0).second); }

 private:
  Eigen::Vector3d turned(double x, double y) const {
    return {x, y * std::cos(i_), y * std::sin(i_)};
  }
  double a_, e_, i_, first_;
};

TEST(Lambert, FindsTheOrbitThatTheEndsAreOf) {
  std::mt19937_64 generator(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  int two = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Ellipse orbit(between(0.5, 2), between(0, 0.8), between(0, 3), between(0, 6));
    const int revolutions = draw % 5;
    const double time = orbit.period() * (revolutions + between(0.02, 0.98));
    const auto [first, velocity] = orbit.at(0);
    const Eigen::Vector3d last = orbit.at(time).first;
    // Anomalies over a whole revolution need not turn through the same number of whole turns as
    // the time has periods only if the angle is the fraction's; it is, for both run from the start.
    const auto found = lambert_ellipses(first, last, time, revolutions, orbit.momentum());
    ASSERT_FALSE(found.empty()) << draw;
    EXPECT_LE(found.size(), revolutions == 0 ? 1U : 2U);
    two += found.size() == 2;
    double nearest = 1;
    for (const LambertEllipse& one : found) {
      const double angle = angle_about(first, last, orbit.momentum());
      // Near a whole or half turn the plane is that of rounding.
      if (std::abs(std::sin(angle)) < 1e-2) nearest = 0;
      nearest = std::min(nearest, (one.start_velocity - velocity).norm() / velocity.norm());
    }
    // At the least time of a number of revolutions two orbits meet, and half the digits are lost.
    EXPECT_LT(nearest, 1e-6) << draw;
  }
  EXPECT_GT(two, 150);
}

/// A chief on a circle, with a deputy beside it that is to leave on an ellipse.
struct Phasing {
  Scene scene;
  Eigen::Vector3d impulse;  ///< at the start, inertial, canonical
};

Phasing phasing(double axis, double eccentricity, double anomaly, double time) {
  const Ellipse orbit(axis, eccentricity, 0.002, anomaly);
  const auto [first, velocity] = orbit.at(0);
  const auto [last, last_velocity] = orbit.at(time);
  Phasing made{kepler_chief(0, 7000, std::sqrt(std::pow(7000.0, 3) / 398600.4415), 3), {}};
  TransferSettings settings;
  settings.frame = RelativeFrame::inertial;
  const Eigen::Vector3d place(1, 0, 0), speed(0, 1, 0);
  settings.start.position_m = (first - place) * made.scene.units.length_km * 1000;
  settings.end.own_state = {last[0],          last[1],          last[2],
                            last_velocity[0], last_velocity[1], last_velocity[2]};
  settings.times = {time};
  settings.refined_miss_m = 1e-3;
  made.scene.transfer = settings;
  made.impulse = velocity - speed;
  return made;
}

// The chief turns by the time; the deputy leaves for an orbit of shorter or longer period, on which
// it makes one revolution more or fewer until a place near the chief.
TEST(OtherRevolutions, AreTheOrbitsThatTheEndsAreOf) {
  struct Case {
    double axis, eccentricity, anomaly;
    double time;  ///< the chief's revolutions
    int difference;
  };
  for (const Case& one : {Case{0.83, 0.2, 3.14, 3.97, 1}, Case{1.35, 0.26, 0.001, 3.15, -1}}) {
    Phasing made =
        phasing(one.axis, one.eccentricity, one.anomaly, 2 * std::numbers::pi * one.time);
    made.scene.transfer->revolutions = {one.difference};
    const TransferResult result = study_transfer(made.scene);
    ASSERT_TRUE(result.revolutions.has_value());
    double nearest_m_s = 1e9;
    for (const RevolutionTransfer& transfer : result.revolutions->transfers) {
      EXPECT_EQ(transfer.difference, one.difference);
      if (!transfer.failure.empty()) continue;
      ASSERT_EQ(transfer.plan.impulses.size(), 2U);
      EXPECT_LE(transfer.plan.legs[0].miss_m, 1e-3);
      const MetricUnits units{made.scene.units.length_km * 1000, made.scene.units.time_s};
      const Eigen::Vector3d expected = made.impulse * units.velocity_m_s();
      const double off = (transfer.plan.impulses[0].change_m_s - expected).norm() +
                         transfer.plan.impulses[1].change_m_s.norm();
      nearest_m_s = std::min(nearest_m_s, off);
    }
    // The bound is a millimetre's miss over some revolutions.
    EXPECT_LT(nearest_m_s, 1e-5) << one.difference;
    EXPECT_TRUE(result.revolutions->best.has_value());
  }
}

// In the field of J2 and J3, which turns Kepler's ellipses by hundreds of kilometres: flown, they
// come to the chief, and on the circle Kepler's values say about what they cost.
TEST(OtherRevolutions, AreFlownInTheWholeField) {
  Scene scene = paper_chief(3);
  TransferSettings settings;
  settings.start.position_m = {0, -5000, 0};
  settings.times = {2.93 * paper_period};
  settings.revolutions = {1, -1, 0};
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.revolutions && result.revolutions->best) << result.revolutions->failure;
  int found = 0;
  for (const RevolutionTransfer& one : result.revolutions->transfers) {
    if (!one.failure.empty()) continue;
    ++found;
    EXPECT_LE(one.plan.legs[0].miss_m, settings.refined_miss_m);
    EXPECT_GT(one.plan.total_change_m_s(), result.points[0].change_m_s());
  }
  EXPECT_GE(found, 2);
  const RevolutionTransfer& best = result.revolutions->transfers[*result.revolutions->best];
  EXPECT_GT(best.plan.total_change_m_s(), 100);  // a period a third longer or a quarter shorter
}

// A revolution more than a chief of less than one needs an ellipse far below the surface, from
// which Newton's method in the field of J2 comes back to the way beside the chief: it has too few.
TEST(OtherRevolutions, AreAsManyAsTheyAreToldToBe) {
  Scene scene = paper_chief(3);
  scene.nominal = {1, 0, 0, 0, 0.6, std::sqrt(1.23 - 0.36)};  // e = 0.23, from perigee
  const double period = 2 * std::numbers::pi * std::pow(1 - 0.23, -1.5);
  TransferSettings settings;
  settings.start.position_m = {130, -1000, 230};
  settings.times = {0.93 * period, 0.95 * period, 0.97 * period};
  settings.revolutions = {1, -1};
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.revolutions.has_value());
  ASSERT_FALSE(result.revolutions->transfers.empty());
  int told = 0;
  for (const RevolutionTransfer& one : result.revolutions->transfers) {
    told += one.failure.find("revolutions no way of as many") != std::string::npos ? 1 : 0;
    if (!one.failure.empty()) continue;
    // Beside the chief a metre a second or so suffices; a period half as long takes a kilometre.
    EXPECT_GT(one.plan.total_change_m_s(), 500) << one.time << " " << one.difference;
  }
  EXPECT_GT(told, 0);
}

TEST(OtherRevolutions, ThatAreNotThereAreSaid) {
  Scene scene = kepler_chief(0, 7000, std::sqrt(std::pow(7000.0, 3) / 398600.4415), 2);
  TransferSettings settings;
  settings.start.position_m = {0, -5000, 0};
  settings.times = {1};
  settings.revolutions = {-1};
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  EXPECT_FALSE(result.revolutions->best.has_value());
  EXPECT_NE(result.revolutions->failure.find("no ellipse"), std::string::npos);
  EXPECT_EQ(exit_code(result), 1);
}

}  // namespace
}  // namespace hamjet
