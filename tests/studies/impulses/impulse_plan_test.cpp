#include "hamjet/detail/studies/impulse_plan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

#include "../formation_scenes.hpp"
#include "circle_transfers.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/impulses/least_impulses.hpp"

// The least velocity change with any number of impulses. A circle of radius 1 has the mean motion
// 1, so that angles are times.

namespace hamjet {
namespace {

// Any impulses that make a change cost at least what the least ones do, which is the value of the
// dual problem: no random plan is cheaper, and the two values meet.
TEST(LeastImpulses, NothingIsCheaper) {
  const double duration = 3 * std::numbers::pi;
  const std::vector<ImpulseEffect> effects = effects_of_circle(duration, 96);
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 20; ++draw) {
    Vector6 change;
    for (double& x : change) x = normal(generator);
    const LeastImpulses least = least_impulses(effects, change);
    Vector6 made = Vector6::Zero();
    for (const ChosenImpulse& impulse : least.impulses)
      made += effects[impulse.time] * impulse.change;
    EXPECT_LT((made - change).norm(), 1e-12 * change.norm());
    EXPECT_LE(least.impulses.size(), 6U);
    EXPECT_GE(least.cost, least.lower_bound);
    EXPECT_LT(least.cost, least.lower_bound * (1 + 1e-7));
    EXPECT_NEAR(change.dot(least.costate), least.lower_bound, 1e-7 * least.cost);
    for (const ImpulseEffect& effect : effects) {
      EXPECT_LE((effect.transpose() * least.costate).norm(), 1 + 1e-12);
    }
    // Two impulses at random times, and the least cost of other impulses with the same effect.
    for (int other = 0; other < 5; ++other) {
      std::uniform_int_distribution<std::size_t> place(0, effects.size() - 1);
      Vector6 rest = change;
      double cost = 0;
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector3d impulse =
            0.3 * Eigen::Vector3d(normal(generator), normal(generator), normal(generator));
        rest -= effects[place(generator)] * impulse;
        cost += impulse.norm();
      }
      EXPECT_GE(cost + least_impulses(effects, rest).cost, least.lower_bound);
    }
  }
}

TEST(LeastImpulses, OneTimeDoesNotReachEverything) {
  EXPECT_THROW(least_impulses({effects_of_circle(1, 1).front()}, Vector6::Ones()), Error);
}

// n a |delta i|: one impulse at the node. (Gaias and D'Amico, Journal of Guidance 38, 2015.)
TEST(ImpulsePlan, OutOfThePlane) {
  const TransferResult result =
      study_transfer(metres_from_circle({{0, 0, 3}, {0, 0, 4}}, 3.3 * std::numbers::pi));
  expect_flown(result);
  EXPECT_NEAR(total_of(result), 5, 1e-5);
}

// n a |delta e| / 2: tangential impulses of both signs half a revolution apart, an ellipse of the
// same size and phase as the chief's. (Gaias and D'Amico, the same.)
TEST(ImpulsePlan, RelativeEccentricity) {
  const TransferResult result =
      study_transfer(metres_from_circle({{-1, 0, 0}, {0, 2, 0}}, 20 * std::numbers::pi));
  expect_flown(result);
  EXPECT_NEAR(total_of(result), 0.5, 1e-5);
}

// Hohmann's transfer between circles a metre apart: n da / 2, where the phase is right. (Curtis,
// Orbital Mechanics for Engineering Students, section 6.2.)
TEST(ImpulsePlan, Hohmann) {
  const TransferResult result = study_transfer(
      metres_from_circle({{-1, -0.75 * std::numbers::pi, 0}, {0, 1.5, 0}}, std::numbers::pi));
  expect_flown(result);
  EXPECT_NEAR(total_of(result), 0.5, 1e-5);
}

// Expected for a change of place along the orbit in half a revolution: two radial impulses of n x /
// 4. (Fehse, Automated Rendezvous and Docking of Spacecraft, 2003, section 3.3.)
TEST(ImpulsePlan, RadialAlongTheOrbit) {
  const TransferResult result =
      study_transfer(metres_from_circle({{0, -1, 0}, {0, 0, 0}}, std::numbers::pi));
  expect_flown(result);
  EXPECT_NEAR(total_of(result), 0.5, 1e-5);
  EXPECT_FALSE(result.primer.has_value());  // F1 is singular after half a revolution.
}

// In one and a half revolutions along the orbit two impulses are not optimal, the primer vector of
// two exceeds 1, and four are, which lie symmetrically. (Prussing, AIAA Journal 8, 1970.)
TEST(ImpulsePlan, FourImpulsesLieSymmetrically) {
  const double duration = 2.9 * std::numbers::pi;
  const TransferResult result =
      study_transfer(metres_from_circle({{0, 1, 0}, {0, 0, 0}}, duration));
  expect_flown(result);
  ASSERT_TRUE(result.primer.has_value());
  EXPECT_TRUE(result.primer->calls_for_impulse());
  const ImpulsePlan& plan = *result.optimal->plan;
  ASSERT_EQ(plan.impulses.size(), 4U);
  EXPECT_EQ(plan.impulses[0].time, 0);
  EXPECT_EQ(plan.impulses[3].time, duration);
  EXPECT_NEAR(plan.impulses[1].time + plan.impulses[2].time, duration, 1e-3);
  EXPECT_NEAR(plan.impulses[0].change_m_s.norm(), plan.impulses[3].change_m_s.norm(),
              1e-4 * plan.total_change_m_s());
  EXPECT_LT(plan.total_change_m_s(), 0.999 * result.points[0].best().total_change_m_s());
}

// Every leg is a flight of its own, whose rounding at both ends the flow carries to the end: that
// of Clohessy and Wiltshire, in axes that rest. Frobenius's norm is the same along any axes.
TEST(ImpulsePlan, ItsFloorHasEveryLeg) {
  const double duration = 2.9 * std::numbers::pi;
  const TransferResult result =
      study_transfer(metres_from_circle({{0, 1, 0}, {0, 0, 0}}, duration));
  expect_flown(result);
  const ImpulsePlan& plan = *result.optimal->plan;
  ASSERT_EQ(plan.impulses.size(), 4U);
  Eigen::Matrix<double, 6, 6> to_rest = Eigen::Matrix<double, 6, 6>::Identity();
  to_rest(3, 1) = -1;
  to_rest(4, 0) = 1;
  const auto growth = [&](double from) {
    return (to_rest * clohessy_wiltshire(duration - from) * to_rest.inverse()).norm();
  };
  const double ulps =
      1 + growth(0) + 2 * growth(plan.impulses[1].time) + 2 * growth(plan.impulses[2].time);
  const double ulp_m = std::ldexp(7e6, -52);
  // A deputy a metre away has the chief's flow.
  EXPECT_NEAR(plan.flight_floor_m, ulps * ulp_m, 1e-6 * ulps * ulp_m);
  EXPECT_NEAR(result.flight_floor_m, (1 + growth(0)) * ulp_m, 1e-6 * ulps * ulp_m);
}

// Half of the plan's cost is one radial impulse, and the way is half an ellipse of 2 by 1 along the
// orbit, a quarter of the distance above or below the chief's orbit at its middle (Fehse, the
// same).
TEST(ImpulsePlan, IsMarkedWhereTheSceneDoesNotAllowIt) {
  Scene scene = metres_from_circle({{0, -1, 0}, {0, 0, 0}}, std::numbers::pi);
  scene.transfer->end.position_m = {0, 1, 0};
  const double impulse = 0.5 / scene.units.time_s;
  const auto plan = [&] {
    const TransferResult result = study_transfer(scene);
    EXPECT_EQ(result.optimal->is_found(), result.optimal->plan->forbidden.empty());
    EXPECT_EQ(exit_code(result), result.optimal->is_found() ? 0 : 1);
    return *result.optimal->plan;
  };
  scene.transfer->largest_impulse_m_s = 1.01 * impulse;
  scene.transfer->keep_out_m = Eigen::Vector3d(0.45, 0.9, 1);
  EXPECT_EQ(plan().forbidden, "");
  scene.transfer->keep_out_m = Eigen::Vector3d(0.55, 0.9, 1);
  EXPECT_NE(plan().forbidden.find("its way comes within 0.9"), std::string::npos)
      << plan().forbidden;
  // If the ends are the only times, the limit cannot divide the impulses.
  scene.transfer->keep_out_m.reset();
  scene.transfer->impulse_gap = 0.75 * std::numbers::pi;
  scene.transfer->largest_impulse_m_s = 0.99 * impulse;
  const TransferResult none = study_transfer(scene);
  EXPECT_FALSE(none.optimal->plan.has_value());
  EXPECT_EQ(exit_code(none), 1);
}

// A whole number of revolutions along the orbit by tangential impulses at both ends costs
// 2 x / (3 T), and no more is needed than that.
TEST(ImpulsePlan, DriftAlongTheOrbit) {
  const double duration = 20 * std::numbers::pi;
  const TransferResult result =
      study_transfer(metres_from_circle({{0, 1, 0}, {0, 0, 0}}, duration));
  expect_flown(result);
  EXPECT_LT(total_of(result), 2 / (3 * duration) * (1 + 1e-6));
  EXPECT_GT(total_of(result), 2 / (3 * duration) * (1 - 1e-3));
}

// Kilometres from the paper's orbit the linear theory misses by metres, and the plan is corrected.
TEST(ImpulsePlan, IsCorrectedByFlying) {
  Scene scene = paper_chief(3);
  TransferSettings settings;
  settings.start.position_m = {3000, -20000, 1000};
  settings.times = equal_times(2.4 * paper_period, 12);
  settings.impulses = TransferImpulses::optimal;
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  expect_flown(result);
  const ImpulsePlan& plan = *result.optimal->plan;
  EXPECT_GT(plan.flights, 1);
  EXPECT_EQ(result.optimal->by_time.size(), 12U);
  for (const TransferPoint& point : result.points) {
    if (!point.is_candidate()) continue;
    EXPECT_GT(point.best().total_change_m_s(), plan.total_change_m_s());
  }
  // More time never costs more if the deputy may wait near the end.
  for (std::size_t k = 1; k < result.optimal->by_time.size(); ++k) {
    EXPECT_LE(result.optimal->by_time[k].change_m_s.value(),
              result.optimal->by_time[k - 1].change_m_s.value() * (1 + 1e-3));
  }
}

/// A deputy 220 km behind on the chief's circle that is to come 50 km nearer in a little more than
/// five revolutions: the straight axes of the linear theory about the chief do not see that it is
/// on the same orbit.
Scene far_behind() {
  const double radius = 7e6, behind = 220e3, nearer = 170e3;
  Scene scene = metres_from_circle({{}, {}}, 10.3 * std::numbers::pi);
  const auto on_circle = [&](double along) {
    const double angle = along / radius;
    RelativeState state;
    state.position_m = {radius * (std::cos(angle) - 1), -radius * std::sin(angle), 0};
    return state;  // the deputy is at rest in the rotating axes
  };
  scene.order = 3;
  scene.transfer->refined_miss_m = 1e-3;
  scene.transfer->start = on_circle(behind);
  scene.transfer->end = on_circle(nearer);
  scene.transfer->times = equal_times(10.3 * std::numbers::pi, 3);
  scene.transfer->longest_coast = 1;
  return scene;
}

// Tangential impulses at the ends of T take 2 x / (3 T) by the linear theory along the orbit, at
// the ends of whole revolutions and at best in all of the time, and no other part of the study
// finds less than the plan.
TEST(ImpulsePlan, FarAwayIsNotDearerThanOtherWays) {
  const Scene scene = far_behind();
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  const ImpulsePlan& plan = *result.optimal->plan;
  EXPECT_LE(plan.miss_m, scene.transfer->refined_miss_m);
  const double total = plan.total_change_m_s() * (1 - 1e-6);
  for (const TransferPoint& point : result.points) {
    if (point.is_candidate()) {
      EXPECT_LE(total, point.change_m_s());
    }
  }
  if (result.least_between) {
    EXPECT_LE(total, result.least_between->change_m_s());
  }
  ASSERT_TRUE(result.coasting->plan.has_value());
  EXPECT_LE(total, result.coasting->plan->total_change_m_s());
  EXPECT_GT(total_of(result), 0.99 * 2 * 50e3 / (3 * 10.3 * std::numbers::pi));
  EXPECT_LT(total_of(result), 1.01 * 2 * 50e3 / (3 * 10 * std::numbers::pi));
  ASSERT_TRUE(plan.lower_bound_m_s.has_value());
  EXPECT_NEAR(*plan.lower_bound_m_s, plan.total_change_m_s(), 1e-3 * plan.total_change_m_s());
  // The prediction of the theory about the chief is reported beside the flown result, and differs
  // much from it.
  for (const LeastChange& one : result.optimal->by_time) {
    ASSERT_TRUE(one.change_m_s.has_value());
    EXPECT_GT(*one.change_m_s, 2 * plan.total_change_m_s());
  }
}

// A deputy x below drifts by 3/2 x a unit of angle towards its chief. No listed time lets it come
// so far, but a start that waits does: then n x / 2 takes it from circle to circle (Hohmann).
TEST(ImpulsePlan, IsNotDearerThanAStartThatDrifts) {
  const double below = 10, behind = 350;
  Scene scene = metres_from_circle({{-below, -behind, 0}, {0, 1.5 * below, 0}}, 3);
  scene.transfer->times = {2.8, 3};
  scene.transfer->longest_coast = 25;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.coasting && result.coasting->plan.has_value());
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  EXPECT_LE(result.optimal->plan->total_change_m_s(),
            result.coasting->plan->total_change_m_s() * (1 + 1e-6));
  EXPECT_NEAR(total_of(result), below / 2, 0.1 * below / 2);
}

// Half a revolution apart two impulses reach no change of every kind; those that correct the flight
// are left out where it does not need them, and no two are seconds apart.
TEST(ImpulsePlan, HasNoImpulsesOfNoUse) {
  Scene scene = metres_from_circle({{0, 1000, 0}, {500, 0, 1000}}, 3.4 * std::numbers::pi);
  scene.transfer->refined_miss_m = 1e-3;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  const auto& impulses = result.optimal->plan->impulses;
  for (std::size_t k = 1; k < impulses.size(); ++k) {
    EXPECT_GT(impulses[k].time - impulses[k - 1].time, 2 * std::numbers::pi / 144);
  }
}

// A deputy that is already there needs no impulse.
TEST(ImpulsePlan, IsNoneWhereTheDeputyComesByItself) {
  Scene scene = metres_from_circle({{0, 1, 0}, {0, 0, 0}}, 3);
  scene.transfer->end = RelativeState{{0, 1, 0}, {0, 0, 0}};
  scene.transfer->refined_miss_m = 1e-3;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  EXPECT_TRUE(result.optimal->plan->impulses.empty());
  EXPECT_EQ(result.optimal->plan->total_change_m_s(), 0);
  EXPECT_EQ(exit_code(result), 0);
}

// In a hundredth of a revolution a metre takes impulses above the limit, in most of one it does
// not: the time without an answer is marked, and is not the least. Where the solver failed, the
// least may be another, and the exit code says so.
TEST(ImpulsePlan, TimesWithoutAnAnswerAreMarked) {
  Scene scene = metres_from_circle({{0, 1, 0}, {0, 0, 0}}, 5);
  scene.transfer->times = {0.06, 5};
  scene.transfer->largest_impulse_m_s = 1 / scene.units.time_s;
  TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  ASSERT_EQ(result.optimal->by_time.size(), 2U);
  LeastChange& first = result.optimal->by_time[0];
  EXPECT_FALSE(first.change_m_s.has_value());
  EXPECT_NE(first.failure.find("no impulses of at most"), std::string::npos);
  EXPECT_FALSE(first.is_unproved);
  EXPECT_EQ(result.optimal->plan->duration, 5);
  EXPECT_EQ(exit_code(result), 0);
  first.is_unproved = true;
  EXPECT_EQ(exit_code(result), 1);
}

}  // namespace
}  // namespace hamjet
