#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "circle_transfers.hpp"
#include "support/errors.hpp"

// Optimal impulses that are all below a limit. Expected: closed forms if the impulses fill up in
// the order of their effects, and duality.

namespace hamjet {
namespace {

/// Each time has an effect on the first three components alone or on the last one; `efficiencies`
/// gives the sizes.
std::vector<ImpulseEffect> separate_effects(const std::vector<double>& efficiencies) {
  std::vector<ImpulseEffect> effects;
  for (const bool is_first : {true, false}) {
    for (const double efficiency : efficiencies) {
      ImpulseEffect effect = ImpulseEffect::Zero();
      if (is_first) effect.topRows<3>() = efficiency * Eigen::Matrix3d::Identity();
      if (!is_first) effect.bottomRows<3>() = efficiency * Eigen::Matrix3d::Identity();
      effects.push_back(effect);
    }
  }
  return effects;
}

// The times fill up from the one at which an impulse has the largest effect.
TEST(LimitedImpulses, FillUpInTheOrderOfTheirEffects) {
  const std::vector<double> efficiencies = {0.5, 2, 1, 0.25, 1.5};
  const double most = 0.3;
  Vector6 change;
  change << 0, 1.1, 0, 0.4, 0, -0.3;  // the last three have the size 0.5
  const auto found = least_impulses(separate_effects(efficiencies), change, most).least;
  ASSERT_TRUE(found.has_value());
  // 1.1 = 0.3 (2 + 1.5) + 0.05 x 1, and 0.5 = 0.25 x 2.
  EXPECT_NEAR(found->cost, 0.6 + 0.05 + 0.25, 1e-9);
  EXPECT_NEAR(found->lower_bound, found->cost, 1e-8);
  ASSERT_EQ(found->impulses.size(), 4U);
  EXPECT_NEAR(found->impulses[0].change[1], 0.3, 1e-9);   // at the time of efficiency 2
  EXPECT_NEAR(found->impulses[1].change[1], 0.05, 1e-9);  // at the time of efficiency 1
  EXPECT_NEAR(found->impulses[2].change[1], 0.3, 1e-9);   // at the time of efficiency 1.5
  EXPECT_NEAR((found->impulses[3].change - Eigen::Vector3d(0.2, 0, -0.15)).norm(), 0, 1e-9);
  // All together reach 0.3 (0.5 + 2 + 1 + 0.25 + 1.5) = 1.575.
  change[1] = 1.57;
  EXPECT_TRUE(least_impulses(separate_effects(efficiencies), change, most).least.has_value());
  change[1] = 1.58;
  const LimitedImpulses none = least_impulses(separate_effects(efficiencies), change, most);
  EXPECT_FALSE(none.least.has_value());
  EXPECT_GT(none.limit_needed, most);
  EXPECT_LT(none.limit_needed, 1.58 / 5.25 * (1 + 1e-9));
}

// Whatever makes a change with impulses below the limit costs at least the dual's value, which
// holds for any costate: sum |v_k| >= change . y - most sum max(0, |B_k^T y| - 1).
TEST(LimitedImpulses, NothingIsCheaper) {
  const std::vector<ImpulseEffect> effects = effects_of_circle(3 * std::numbers::pi, 48);
  std::mt19937_64 generator(4);
  std::normal_distribution<double> normal;
  int limited = 0;
  for (int draw = 0; draw < 40; ++draw) {
    Vector6 change;
    for (double& x : change) x = normal(generator);
    const LeastImpulses free = least_impulses(effects, change);
    double largest = 0;
    for (const ChosenImpulse& one : free.impulses) largest = std::max(largest, one.change.norm());
    const double most = largest * (0.2 + 0.02 * draw);
    const auto found = least_impulses(effects, change, most).least;
    if (!found) continue;
    Vector6 made = Vector6::Zero();
    double cost = 0;
    for (const ChosenImpulse& one : found->impulses) {
      made += effects[one.time] * one.change;
      cost += one.change.norm();
      EXPECT_LE(one.change.norm(), most * (1 + 1e-12));
      limited += one.change.norm() > most * (1 - 1e-9);
    }
    EXPECT_LT((made - change).norm(), 1e-12 * change.norm()) << draw;
    EXPECT_NEAR(cost, found->cost, 1e-12 * cost);
    double bound = change.dot(found->costate);
    for (const ImpulseEffect& effect : effects) {
      bound -= most * std::max(0.0, (effect.transpose() * found->costate).norm() - 1);
    }
    EXPECT_NEAR(found->lower_bound, bound, 1e-12 * cost) << draw;
    EXPECT_LT(cost, bound * (1 + 1e-7)) << draw;
    EXPECT_GE(cost, free.lower_bound * (1 - 1e-12));
    for (std::size_t k = 1; k < found->impulses.size(); ++k) {
      EXPECT_GT(found->impulses[k].time, found->impulses[k - 1].time);
    }
  }
  EXPECT_GT(limited, 40);
}

/// Out of the plane, over two revolutions, with a velocity at the node of 5 times the mean motion
/// and a metre.
Scene out_of_plane(double most, double gap) {
  Scene scene = metres_from_circle({{0, 0, 0}, {0, 0, 5}}, 4 * std::numbers::pi);
  scene.transfer->largest_impulse_m_s = most / scene.units.time_s;
  scene.transfer->impulse_gap = gap * (1 - 1e-9);
  return scene;
}

// An impulse at an angle from a node does its cosine. At spaces of pi / 8 there are five nodes,
// which take 0.9 each, and an eighth of a revolution beside them the rest, in pairs of which
// nothing is left across.
TEST(LimitedImpulses, AreDividedAmongNodesAndThenTheirNeighbours) {
  const Scene scene = out_of_plane(0.9, std::numbers::pi / 8);
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal && result.optimal->plan) << result.optimal->failure;
  const ImpulsePlan& plan = *result.optimal->plan;
  EXPECT_EQ(plan.failure, "");
  EXPECT_EQ(plan.forbidden, "");
  EXPECT_EQ(exit_code(result), 0);
  EXPECT_LE(plan.miss_m, scene.transfer->refined_miss_m);
  EXPECT_NEAR(total_of(result), 4.5 + 0.5 / std::cos(std::numbers::pi / 8), 1e-5);
  EXPECT_NEAR(plan.lower_bound_m_s.value_or(0), plan.total_change_m_s(),
              2e-5 * plan.total_change_m_s());
  EXPECT_NEAR(*plan.spacing, std::numbers::pi / 8, 1e-12);
  for (const Impulse& impulse : plan.impulses) {
    EXPECT_LE(impulse.change_m_s.norm(), *scene.transfer->largest_impulse_m_s * (1 + 1e-12));
    EXPECT_NEAR(std::remainder(impulse.time, std::numbers::pi / 8), 0, 1e-9);
  }
}

// At spaces of a quarter of a revolution five times are nodes, and the others do nothing: 5 takes
// at least 1 each.
TEST(LimitedImpulses, ThatDoNotSufficeAreSaid) {
  const TransferResult enough = study_transfer(out_of_plane(1.1, std::numbers::pi / 2));
  ASSERT_TRUE(enough.optimal->is_found()) << enough.optimal->failure;
  EXPECT_NEAR(total_of(enough), 5, 1e-5);
  const TransferResult none = study_transfer(out_of_plane(0.9, std::numbers::pi / 2));
  EXPECT_FALSE(none.optimal->is_found());
  EXPECT_EQ(exit_code(none), 1);
  EXPECT_NE(none.optimal->failure.find("no impulses of at most"), std::string::npos)
      << none.optimal->failure;
}

// A limit above all impulses of the plan changes nothing.
TEST(LimitedImpulses, BelowTheLimitAreAsTheyAre) {
  Scene scene = metres_from_circle({{0, 1, 0}, {0, 0, 0}}, 2.9 * std::numbers::pi);
  const TransferResult free = study_transfer(scene);
  scene.transfer->largest_impulse_m_s = 1;
  const TransferResult limited = study_transfer(scene);
  // Corrections are divided by the room below the limit, which changes their cost to second order.
  EXPECT_NEAR(limited.optimal->plan->total_change_m_s(), free.optimal->plan->total_change_m_s(),
              1e-6 * free.optimal->plan->total_change_m_s());
  EXPECT_FALSE(limited.optimal->plan->spacing.has_value());
}

// Kilometres from the paper's orbit, where the linear theory is corrected by flying.
TEST(LimitedImpulses, AreCorrectedByFlyingBelowTheLimit) {
  Scene scene = paper_chief(3);
  TransferSettings settings;
  settings.start.position_m = {3000, -20000, 1000};
  settings.times = {2.4 * paper_period};
  settings.impulses = TransferImpulses::optimal;
  scene.transfer = settings;
  const TransferResult free = study_transfer(scene);
  double largest = 0;
  for (const Impulse& one : free.optimal->plan->impulses) {
    largest = std::max(largest, one.change_m_s.norm());
  }
  scene.transfer->largest_impulse_m_s = 0.4 * largest;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal->is_found()) << result.optimal->failure;
  const ImpulsePlan& plan = *result.optimal->plan;
  EXPECT_LE(plan.miss_m, settings.refined_miss_m);
  EXPECT_GT(plan.flights, 1);
  EXPECT_GT(plan.total_change_m_s(), free.optimal->plan->total_change_m_s() * (1 - 1e-6));
  EXPECT_LT(plan.total_change_m_s(), plan.lower_bound_m_s.value_or(0) * (1 + 1e-3));
  for (const Impulse& one : plan.impulses) {
    EXPECT_LE(one.change_m_s.norm(), 0.4 * largest * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace hamjet
