#include "studies/bounded/box_control.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "../poincare/independent_flight.hpp"
#include "formation_scenes.hpp"
#include "hamjet/error.hpp"
#include "impulses/circle_transfers.hpp"
#include "studies/exact_flow.hpp"

namespace hamjet {
namespace {

constexpr double boxed_radius_m = 7.121e6;

/// The chief of heyoka's box-control example (a circle at 750 km and 98.2 degrees), without its J2,
/// with a box about a place at which the deputy starts at rest.
Scene boxed(const Eigen::Vector3d& place_m, double half_width_m, double days) {
  Scene scene =
      kepler_chief(0, boxed_radius_m / 1000, std::sqrt(std::pow(7121.0, 3) / 398600.4418), 3);
  const double angle = 98.2 * std::numbers::pi / 180;
  scene.nominal = {1, 0, 0, 0, std::cos(angle), std::sin(angle)};
  scene.bounded = BoundedSettings{};
  BoxSettings& box = scene.bounded->box;
  box.half_widths_m = Eigen::Vector3d::Constant(half_width_m);
  box.reference = BoxReference::rest;
  box.position_m = place_m;
  box.days = days;
  return scene;
}
Scene oblate(Scene scene) {
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = 1082.645e-6;
  scene.canonical_radius = 6371.0 / 7121;
  return scene;
}

// From rest 10 m above a circular orbit a deputy rises by 3 x (1 - cos t) and falls behind by
// 6 x (t - sin t), and leaves a box of 5 m through its upper face when cos t = 5/6. The impulses
// are those that Clohessy's and Wiltshire's equations ask for, to the ratio of 10 m and the radius.
TEST(BoxControl, LeavesAndReturnsAfterClohessyAndWiltshire) {
  constexpr double x = 10, half_width = 5;
  Scene scene = boxed({x, 0, 0}, half_width, 0.06);
  scene.bounded->box.return_orbits = {0.25};
  const BoxControl box = keep_in_box(scene, {}, 2 * std::numbers::pi);
  ASSERT_GE(box.returns.size(), 1U);
  const BoxReturn& first = box.returns.front();
  constexpr double relative = 1e-5;  // a few times 10 m over 7121 km
  const double exit = std::acos(1 - half_width / (3 * x));
  EXPECT_NEAR(first.time, exit, relative);
  Vector6 at_rest = Vector6::Zero();
  at_rest[0] = x;
  const Vector6 out = clohessy_wiltshire(exit) * at_rest;
  const double span = std::numbers::pi / 2;
  EXPECT_NEAR(first.duration, span, 1e-12);
  // The velocity that leads from there to (x, 0, 0).
  const Eigen::Matrix<double, 6, 6> flow = clohessy_wiltshire(span);
  const Eigen::Vector3d velocity = flow.topRightCorner<3, 3>().inverse() *
                                   (at_rest.head<3>() - flow.topLeftCorner<3, 3>() * out.head<3>());
  const Eigen::Vector3d arrival =
      flow.bottomLeftCorner<3, 3>() * out.head<3>() + flow.bottomRightCorner<3, 3>() * velocity;
  const double unit = 1 / scene.units.time_s;  // converts rates of metres to m/s
  const Eigen::Vector3d first_change = (velocity - out.tail<3>()) * unit;
  const double size = first_change.norm();
  EXPECT_LT((first.first_m_s - first_change).norm(), 10 * relative * size);
  EXPECT_LT((first.second_m_s + arrival * unit).norm(), 10 * relative * size);
  EXPECT_LT(first.miss_m, 1e-6);
}

/// A place, a velocity and a constant acceleration about a centre with mu = 1.
using LongState = std::array<long double, 6>;
LongState long_state(const std::vector<double>& z) { return {z[0], z[1], z[2], z[3], z[4], z[5]}; }

/// Flies by the classical Runge-Kutta method in long double.
LongState flown(LongState z, long double time, const Eigen::Vector3d& thrust) {
  constexpr int steps = 2000;
  const long double h = time / steps;
  const auto rate = [&](const LongState& y) {
    const long double r = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    LongState f;
    for (std::size_t i = 0; i < 3; ++i) {
      f[i] = y[3 + i];
      f[3 + i] = -y[i] / (r * r * r) + static_cast<long double>(thrust[static_cast<int>(i)]);
    }
    return f;
  };
  const auto along = [](const LongState& y, long double part, const LongState& f) {
    LongState result = y;
    for (std::size_t i = 0; i < 6; ++i) result[i] += part * f[i];
    return result;
  };
  for (int k = 0; k < steps; ++k) {
    const LongState k1 = rate(z);
    const LongState k2 = rate(along(z, h / 2, k1));
    const LongState k3 = rate(along(z, h / 2, k2));
    const LongState k4 = rate(along(z, h, k3));
    for (std::size_t i = 0; i < 6; ++i) z[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return z;
}

BoxControl burned(double acceleration_m_s2) {
  Scene scene = boxed({10, 0, 0}, 5, 0.06);
  scene.bounded->box.return_orbits = {0.1};
  scene.thruster.emplace();
  scene.thruster->acceleration_m_s2 = acceleration_m_s2;
  scene.thruster->attitude = BurnAttitude::inertial;
  return keep_in_box(scene, {}, 2 * std::numbers::pi);
}

// Burns lead from the orbit before a return's first impulse to that behind its second: flown by
// another program they end within the ten-thousandth of the box that is allowed.
TEST(BoxControl, BurnsReplaceImpulses) {
  const Scene scene = boxed({10, 0, 0}, 5, 0.06);
  const BoxControl box = burned(1e-4);
  ASSERT_GE(box.returns.size(), 1U);
  EXPECT_EQ(box.burns_failure(), "");
  EXPECT_TRUE(box.is_kept());
  const double metres = scene.units.length_km * 1000;
  const double unit_m_s2 = metres / (scene.units.time_s * scene.units.time_s);
  for (const BoxReturn& one : box.returns) {
    ASSERT_TRUE(one.burns && one.burns->plan.is_found());
    const std::vector<FiniteBurn>& burns = one.burns->plan.burns;
    ASSERT_EQ(burns.size(), 2U);
    LongState z = long_state(one.deputy_before);
    double now = 0;
    for (const FiniteBurn& burn : burns) {
      EXPECT_GT(burn.end - burn.start, 60 / scene.units.time_s);
      z = flown(z, burn.start - now, Eigen::Vector3d::Zero());
      z = flown(z, burn.end - burn.start, burn.direction * (1e-4 / unit_m_s2));
      now = burn.end;
    }
    z = flown(z, one.duration - now, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(static_cast<double>(z[i]), one.deputy_after[i], 1e-4 * 5 / metres);
      EXPECT_NEAR(static_cast<double>(z[3 + i]), one.deputy_after[3 + i], 1e-4 * 5 / metres);
    }
    EXPECT_LE(one.burns->farthest, 1 + BoxControl::rounding);
    EXPECT_GT(one.burns->farthest, 0.5);
  }
}

// What burns take above the impulses falls with the square of their length.
TEST(BoxControl, BurnsOfStrongThrustersAreImpulses) {
  const auto loss = [](double acceleration_m_s2) {
    const BoxReturn one = burned(acceleration_m_s2).returns.front();
    return one.burns->plan.change_m_s() / one.change_m_s() - 1;
  };
  EXPECT_NEAR(loss(4e-4) / loss(8e-4), 4, 0.05);
  EXPECT_LT(std::abs(loss(8e-4)), 1e-2);
}

TEST(BoxControl, TellsThatAThrusterIsTooWeak) {
  const BoxControl box = burned(1e-7);
  EXPECT_TRUE(box.is_held());
  EXPECT_FALSE(box.is_kept());
  EXPECT_NE(box.burns_failure().find("return 1: "), std::string::npos) << box.burns_failure();
  EXPECT_NE(box.burns_failure().find("m/s^2 would do"), std::string::npos) << box.burns_failure();
}

using test::IndependentFlight;
using LongVector3 = Eigen::Matrix<long double, 3, 1>;

LongVector3 long_place(const IndependentFlight::State& z) { return {z[0], z[1], z[2]}; }
LongVector3 long_velocity(const IndependentFlight::State& z) { return {z[3], z[4], z[5]}; }

/// The axes R, T and N of a chief, as rows.
Eigen::Matrix<long double, 3, 3> long_axes(const IndependentFlight::State& chief) {
  const LongVector3 r = long_place(chief).normalized();
  const LongVector3 n = long_place(chief).cross(long_velocity(chief)).normalized();
  Eigen::Matrix<long double, 3, 3> axes;
  axes << r.transpose(), n.cross(r).transpose(), n.transpose();
  return axes;
}

/// The chief and a deputy in J2, flown in long double by Fehlberg's method of Boost.odeint.
class IndependentPair {
 public:
  IndependentPair(const Scene& scene, const std::vector<double>& deputy)
      : flight_(field_of(scene)) {
    for (std::size_t i = 0; i < 6; ++i) {
      chief_[i] = scene.nominal[i];
      deputy_[i] = deputy[i];
    }
    metres_ = scene.units.length_km * 1000;
    metres_a_second_ = metres_ / scene.units.time_s;
  }
  void advance(long double time) {
    if (time <= 0) return;
    chief_ = flight_(chief_, time);
    deputy_ = flight_(deputy_, time);
  }
  LongVector3 relative_m() const {
    return long_axes(chief_) * (long_place(deputy_) - long_place(chief_)) * metres_;
  }
  void push(const Eigen::Vector3d& change_m_s) {
    const LongVector3 change =
        long_axes(chief_).transpose() * change_m_s.cast<long double>() / metres_a_second_;
    for (int i = 0; i < 3; ++i) deputy_[static_cast<std::size_t>(3 + i)] += change[i];
  }

 private:
  static ZonalGravity field_of(const Scene& scene) {
    ZonalGravity field;
    field.radius = scene.canonical_radius;
    field.J[2] = scene.system.J[2];
    return field;
  }

  IndependentFlight flight_;
  IndependentFlight::State chief_{};
  IndependentFlight::State deputy_{};
  long double metres_;
  long double metres_a_second_;
};

// The reported path of a stationkept deputy is flown again from its start with the impulses alone,
// by another integrator in long double with forces written by hand. The deputy must be within the
// box at all times between the impulses, and each return must end at the reference's place.
TEST(BoxControl, StaysInTheBoxByAnIndependentIntegration) {
  const Eigen::Vector3d place(0, -100, 0);
  constexpr double half_width = 0.2;
  const Scene scene = oblate(boxed(place, half_width, 0.5));
  const BoxControl box = keep_in_box(scene, {}, 2 * std::numbers::pi);
  ASSERT_GE(box.returns.size(), 2U);
  EXPECT_GT(box.farthest, 0.999);
  EXPECT_LE(box.farthest, 1.001);
  IndependentPair pair(scene, box.start);
  long double time = 0;
  long double farthest = 0;
  const auto fly_to = [&](double end) {
    constexpr int places = 25;
    const long double step = (end - time) / places;
    for (int k = 0; k < places; ++k) {
      pair.advance(step);
      const LongVector3 from = pair.relative_m() - place.cast<long double>();
      farthest = std::max(farthest, from.cwiseAbs().maxCoeff() / half_width);
    }
    time = end;
  };
  double sum = 0;
  for (const BoxReturn& one : box.returns) {
    fly_to(one.time);
    pair.push(one.first_m_s);
    fly_to(one.time + one.duration);
    // Rounding of both states after each impulse, 2 u of 7121 km, grows by no more than 3 times the
    // angle that is flown, some 50 radians here: 3e-7 m; polynomials of order 3 miss by less.
    EXPECT_LT((pair.relative_m() - place.cast<long double>()).norm(), 1e-6L);
    pair.push(one.second_m_s);
    sum += one.first_m_s.norm() + one.second_m_s.norm();
  }
  fly_to(box.days * 86400 / scene.units.time_s);
  EXPECT_LE(farthest, 1.001L);
  EXPECT_DOUBLE_EQ(box.change_m_s(), sum);
}

// The chief's own orbit, a little later, is an orbit of the field too: brought onto it once, the
// deputy needs no further impulse in a box that is wider than the beat of the two.
TEST(BoxControl, NeedsOneReturnOntoTheChiefsOwnOrbit) {
  Scene scene = oblate(boxed({0, 0, 0}, 0.5, 4));
  scene.bounded->box.reference = BoxReference::member;
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{0, -100, 0}, {0, 0, 0}}};
  const std::vector<double> follower = exact_flow(SharedSystem(make_system(scene)), scene.nominal,
                                                  scene.start_time, -100 / boxed_radius_m);
  const BoxControl box = keep_in_box(scene, follower, 2 * std::numbers::pi);
  ASSERT_EQ(box.returns.size(), 1U);
  EXPECT_LE(box.farthest, 1.001);
  // From the follower's own start no impulse is needed.
  scene.deputy.reset();
  EXPECT_EQ(keep_in_box(scene, follower, 2 * std::numbers::pi).returns.size(), 0U);
}

TEST(BoxControl, RefusesAStartOutsideAndABoxBelowRounding) {
  Scene scene = oblate(boxed({0, -100, 0}, 5, 1));
  scene.deputy = DeputySettings{RelativeFrame::rtn_rotating, {{0, -94, 0}, {0, 0, 0}}};
  const auto message = [&] {
    try {
      keep_in_box(scene, {}, 2 * std::numbers::pi);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message().find("starts outside of it, at 1.2 of its half widths"), std::string::npos)
      << message();
  scene.deputy.reset();
  // The value is below the rounding of flights, some 1e-9 m.
  scene.bounded->box.half_widths_m = Eigen::Vector3d::Constant(1e-12);
  EXPECT_NE(message().find("bounded.box: "), std::string::npos) << message();
}

}  // namespace
}  // namespace hamjet
