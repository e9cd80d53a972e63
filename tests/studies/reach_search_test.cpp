#include "studies/formation/validity/reach_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

// The search for the largest separation that holds, on misses that are given by a formula.

namespace hamjet {
namespace {

/// A miss of `tolerance` at the separation `reach`, which grows as the power order + 1.
ReachProblem power_law(int order, double reach) {
  ReachProblem problem{order, 1e-3, 1e-9, 10};
  problem.miss = [=](double separation) { return 1e-3 * std::pow(separation / reach, order + 1); };
  problem.worst_miss = problem.miss;
  return problem;
}

// The reach is known in closed form; the search ends when bounds are within 3 % of each other.
TEST(ReachSearch, MeetsThePowerLaw) {
  for (const int order : {1, 2, 5}) {
    for (const double predicted : {0.3, 0.01, 9.0}) {
      const FoundReach found = search_reach(power_law(order, 0.3), predicted);
      EXPECT_LE(found.separation, 0.3);
      EXPECT_GE(found.separation, 0.3 / 1.03) << order << " from " << predicted;
      EXPECT_LE(found.miss, 1e-3);
      EXPECT_GT(found.next_miss, 1e-3);
      EXPECT_FALSE(found.is_at_limit || found.is_out_of_trials);
    }
  }
}

TEST(ReachSearch, EndsAtItsLimits) {
  EXPECT_TRUE(search_reach(power_law(2, 50), 1).is_at_limit);
  EXPECT_EQ(search_reach(power_law(2, 50), 1).separation, 10);
  // What misses everywhere holds nowhere, and this is known.
  ReachProblem nowhere = power_law(2, 0.3);
  nowhere.miss = [](double) { return 1.0; };
  EXPECT_EQ(search_reach(nowhere, 1).separation, 0);
  EXPECT_FALSE(search_reach(nowhere, 1).is_out_of_trials);
}

// Deputies that are always found to be a little worse than those that were known.
TEST(ReachSearch, SaysThatItEndedWithoutAnAnswer) {
  ReachProblem problem = power_law(2, 0.3);
  problem.worst_miss = [](double) { return 1.0001e-3; };
  const FoundReach found = search_reach(problem, 0.3);
  EXPECT_TRUE(found.is_out_of_trials);
  EXPECT_EQ(found.separation, 0);
}

}  // namespace
}  // namespace hamjet
