#include "studies/flights/extreme_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "studies/flights/paced_times.hpp"
#include "studies/formation/deputy_motion.hpp"
#include "studies/formation/keep_out.hpp"

namespace hamjet {
namespace {

using Real = long double;

/// A place and a velocity in the plane of a Kepler ellipse with a = 1 and mu = 1, by Kepler's
/// equation; times are from perigee, which lies at an angle from the x axis.
struct PlaneState {
  Real x, y, vx, vy;
};
PlaneState on_ellipse(Real e, Real angle, Real time) {
  Real E = time;
  for (int i = 0; i < 20; ++i) E -= (E - e * std::sin(E) - time) / (1 - e * std::cos(E));
  const Real b = std::sqrt(1 - e * e), rate = 1 / (1 - e * std::cos(E));
  const Real x = std::cos(E) - e, y = b * std::sin(E);
  const Real vx = -std::sin(E) * rate, vy = b * std::cos(E) * rate;
  const Real c = std::cos(angle), s = std::sin(angle);
  return {c * x - s * y, s * x + c * y, c * vx - s * vy, s * vx + c * vy};
}

std::vector<double> state_of(const PlaneState& at, Real shift = 0) {
  return {static_cast<double>(at.x),  static_cast<double>(at.y),  static_cast<double>(shift),
          static_cast<double>(at.vx), static_cast<double>(at.vy), 0};
}

/// A chief at an eccentricity of 0.9, flown from its apogee, and a deputy on the same ellipse
/// turned by a small angle and later by a time at which both pass perigee at the same place, the
/// one above the other: closest there, for a moment, and a hundred times further away elsewhere.
struct Passage {
  static constexpr Real e = 0.9L, angle = 1e-6L;
  static constexpr Real apogee = std::numbers::pi_v<Real>;
  Real delay = angle * (1 - e) / std::sqrt((1 + e) / (1 - e));

  PlaneState chief(Real time) const { return on_ellipse(e, 0, apogee + time); }
  PlaneState deputy(Real time) const { return on_ellipse(e, angle, apogee + time - delay); }
  Real separation(Real time) const {
    const PlaneState a = chief(time), b = deputy(time);
    return std::hypot(b.x - a.x, b.y - a.y);
  }
  /// By looks at every 1000th of a revolution in the eccentric anomaly, of a closed form, and by
  /// thirds of what is left about the best of them.
  Real extreme(Real time, bool is_least) const {
    const Real direction = time < 0 ? -1 : 1, sign = is_least ? 1 : -1;
    const auto value = [&](Real turned) {
      const Real E = apogee + direction * turned;
      return sign * separation(E - e * std::sin(E) - apogee);
    };
    // Kepler's equation for the flight's end; from apogee on the mean anomaly grows by x + e sin x.
    Real end = std::abs(time);
    for (int i = 0; i < 20; ++i) {
      end -= (end + e * std::sin(end) - std::abs(time)) / (1 + e * std::cos(end));
    }
    const Real step = end / 1000;
    Real best = 0;
    for (int k = 1; k <= 1000; ++k) {
      if (value(k * step) < value(best)) best = k * step;
    }
    Real low = std::max(best - step, Real(0)), high = std::min(best + step, end);
    for (int i = 0; i < 100; ++i) {
      const Real third = (high - low) / 3;
      if (value(low + third) < value(high - third)) {
        high -= third;
      } else {
        low += third;
      }
    }
    return sign * std::min(value(best), value((low + high) / 2));
  }
  std::vector<double> deviation() const {
    std::vector<double> z = state_of(deputy(0));
    const std::vector<double> of_chief = state_of(chief(0));
    for (std::size_t i = 0; i < z.size(); ++i) z[i] -= of_chief[i];
    return z;
  }
  Scene scene(double time) const {
    Scene scene = kepler_chief(0, 10000, 1000, 2);
    scene.nominal = state_of(chief(0));
    scene.duration = time;
    return scene;
  }
};

// Looks equal in time have this passage between two of them. What rounding of the start makes of
// the least, some parts of the distance at apogee, is all that may be between both.
TEST(ExtremeDistance, APassageOfPerigeeIsNotMissed) {
  const Passage passage;
  for (const double time : {6.0, -6.0}) {
    Scene scene = passage.scene(time);
    scene.transfer = TransferSettings{};
    const double semi_axis = 1e-8;
    scene.transfer->keep_out_m = Eigen::Vector3d::Constant(semi_axis * 1e7);
    const double ratio = keep_out_ratio(FlownTogether(scene), scene.nominal, passage.deviation(),
                                        scene.start_time, time);
    const auto least = static_cast<double>(passage.extreme(time, true));
    EXPECT_LT(least, 1e-2 * static_cast<double>(passage.separation(0)));
    EXPECT_NEAR(ratio * semi_axis, least, 1e-13) << time;
    const ExtremeSeparations found =
        extreme_separations(scene, passage.deviation(), RelativeFrame::inertial, time);
    EXPECT_NEAR(separation_m(found.nearest.state) * 1e-7, least, 1e-13) << time;
    EXPECT_NEAR(separation_m(found.farthest.state) * 1e-7,
                static_cast<double>(passage.extreme(time, false)), 1e-12)
        << time;
    EXPECT_LE(std::abs(found.nearest.time), std::abs(time));
  }
}

// A vector that turns at a constant rate and breathes has its extremes where the cosine has.
TEST(ExtremeDistance, FindsAllTurnsOfAPolynomial) {
  const SpacePointer space = SeriesSpace::create(1, 24);
  FlightArc arc;
  arc.start = 3;
  arc.span = 2;
  // |x| = 2 + cos(7 u + 1), x along a line: the square has several turns.
  Series<double> length(space);
  double factor = 1;
  for (std::size_t k = 0; k < length.size(); ++k) {
    length[k] = factor * std::cos(1 + static_cast<double>(k) * std::numbers::pi / 2);
    factor *= 7.0 / static_cast<double>(k + 1);
  }
  length[0] += 2;
  const Series<double> none(space);
  ExtremeDistance least(ExtremeDistance::Kind::least);
  ExtremeDistance greatest(ExtremeDistance::Kind::greatest);
  EXPECT_TRUE(least.add(arc, {length, none, none}));
  EXPECT_TRUE(greatest.add(arc, {length, none, none}));
  // 7 u + 1 = pi, and 2 pi; the polynomial leaves out 7^25/25! = 9e-5 at u = 1.
  EXPECT_NEAR(least.distance(), 1, 1e-9);
  EXPECT_NEAR(least.time(), 3 + 2 * (std::numbers::pi - 1) / 7, 1e-6);
  EXPECT_NEAR(greatest.distance(), 3, 1e-4);
  EXPECT_NEAR(greatest.time(), 3 + 2 * (2 * std::numbers::pi - 1) / 7, 1e-2);
}

// A third of a revolution about perigee, which takes a hundredth of its time, has a third of them.
TEST(PacedTimes, PerigeeHasAsManyAsApogee) {
  const Passage passage;
  const Scene scene = passage.scene(1);
  const double revolution = 2 * std::numbers::pi;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<double> times = paced_times(scene, sign * revolution, 300);
    ASSERT_EQ(times.size(), 301U);
    EXPECT_EQ(times.front(), 0);
    EXPECT_EQ(times.back(), sign * revolution);
    const double half = std::numbers::pi;
    // E within 60 degrees of perigee.
    const double near = std::numbers::pi / 3 - 0.9 * std::sin(std::numbers::pi / 3);
    int count = 0;
    for (const double time : times) count += std::abs(sign * time - half) < near ? 1 : 0;
    EXPECT_NEAR(count, 100, 2);
  }
}

// Flown back from its end, a motion has the same extremes at the same moments.
TEST(DeputyMotion, BackwardsHasTheExtremesOfForwards) {
  Scene scene = paper_chief(1);
  scene.duration = 6;
  scene.deputy = DeputySettings{RelativeFrame::inertial, {}};
  scene.deputy->start.position_m = {100, -2000, 300};
  scene.deputy->start.velocity_m_s = {0.3, 0.1, -0.2};
  const DeputyMotion there = study_deputy_motion(scene);
  Scene back_again = scene;
  back_again.nominal = there.flown.chief.back();
  back_again.deputy->start = there.flown.states.back();
  back_again.duration = -6;
  const DeputyMotion back = study_deputy_motion(back_again);
  const auto compare = [](const SeparationAt& one, const SeparationAt& other) {
    EXPECT_NEAR(one.time, 6 + other.time, 1e-6);
    EXPECT_NEAR(separation_m(one.state), separation_m(other.state), 1e-6);
  };
  compare(there.extremes.nearest, back.extremes.nearest);
  compare(there.extremes.farthest, back.extremes.farthest);
}

}  // namespace
}  // namespace hamjet
