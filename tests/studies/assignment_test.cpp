#include "hamjet/studies/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "../../src/studies/formation/least_assignment.hpp"
#include "formation_scenes.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double total_of(const std::vector<std::vector<double>>& costs,
                const std::vector<std::size_t>& columns) {
  double total = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) total += costs[i][columns[i]];
  return total;
}

// Expected: all permutations.
TEST(LeastAssignment, IsTheLeastOfAllPermutations) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.1, 50);
  int without = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t n = 1 + static_cast<std::size_t>(trial) % 6;
    std::vector<std::vector<double>> costs(n, std::vector<double>(n));
    for (auto& row : costs) {
      for (double& cost : row) {
        cost = trial % 3 == 0 && generator() % 2 == 0 ? infinite : uniform(generator);
      }
    }
    std::vector<std::size_t> columns(n);
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    double least = infinite;
    do {
      least = std::min(least, total_of(costs, columns));
    } while (std::next_permutation(columns.begin(), columns.end()));
    const auto found = least_assignment(costs);
    if (std::isinf(least)) {
      ++without;
      EXPECT_FALSE(found.has_value());
      continue;
    }
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(total_of(costs, *found), least, 1e-6);
    std::vector<std::size_t> sorted = *found;
    std::sort(sorted.begin(), sorted.end());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    EXPECT_EQ(sorted, columns);
  }
  EXPECT_GT(without, 5);
}

/// Deputies that rest near slots of their own, listed in another order.
Scene swarm() {
  Scene scene = paper_chief(3);
  TransferSettings transfer;
  transfer.times = {2.0, 3.0, 4.0};
  scene.transfer = transfer;
  AssignmentSettings assignment;
  for (int k = 0; k < 4; ++k) {
    const double angle = 1.5 * k;
    RelativeState place;
    place.position_m = {3000 * std::cos(angle), 3000 * std::sin(angle), 500.0 * k};
    assignment.deputies.push_back(place);
    RelativeState slot = place;
    slot.position_m += Eigen::Vector3d(10, -5, 5);
    assignment.slots.insert(assignment.slots.begin(), slot);
  }
  scene.assignment = assignment;
  return scene;
}

TEST(Assignment, TotalIsTheLeastOfItsCostsAndIsFlown) {
  for (const AssignmentTime time : {AssignmentTime::per_pair, AssignmentTime::common}) {
    Scene scene = swarm();
    scene.assignment->time = time;
    const AssignmentResult result = study_assignment(scene);
    ASSERT_TRUE(result.failure.empty()) << result.failure;
    ASSERT_EQ(result.transfers.size(), 4U);
    double total = 0;
    for (const AssignedTransfer& assigned : result.transfers) {
      const AssignmentCost& cost = result.costs[assigned.deputy][assigned.slot];
      ASSERT_TRUE(cost.time.has_value());
      if (time == AssignmentTime::common) {
        EXPECT_EQ(cost.time, result.common_time);
      }
      EXPECT_EQ(assigned.transfer.time, scene.transfer->times[*cost.time]);
      EXPECT_NEAR(assigned.transfer.best().total_change_m_s(), cost.total_change_m_s, 1e-9);
      EXPECT_LT(assigned.transfer.best().miss_m, 1);
      total += cost.total_change_m_s;
    }
    EXPECT_NEAR(result.total_change_m_s, total, 1e-8);
    EXPECT_EQ(exit_code(result), 0);
    // No permutation of the same matrix is cheaper.
    std::vector<std::size_t> columns = {0, 1, 2, 3};
    do {
      double other = 0;
      for (std::size_t i = 0; i < 4; ++i) other += result.costs[i][columns[i]].total_change_m_s;
      EXPECT_GE(other, total - 1e-8);
    } while (std::next_permutation(columns.begin(), columns.end()));
  }
}

TEST(Assignment, AFailedRefinementCountsWithThePolynomialsAnswer) {
  Scene scene = swarm();
  const AssignmentResult plain = study_assignment(scene);
  scene.transfer->refine = true;
  scene.transfer->refined_miss_m = 1e-15;  // below the rounding of the flights
  const AssignmentResult result = study_assignment(scene);
  EXPECT_NEAR(result.total_change_m_s, plain.total_change_m_s, 1e-9);
  EXPECT_EQ(exit_code(result), 0);
  scene.transfer->strict = true;
  EXPECT_EQ(exit_code(study_assignment(scene)), 1);
}

TEST(Assignment, EachPairsTimeIsItsBest) {
  Scene scene = swarm();
  const AssignmentResult any = study_assignment(scene);
  for (std::size_t t = 0; t < 3; ++t) {
    Scene one = scene;
    one.transfer->times = {scene.transfer->times[t]};
    const AssignmentResult at = study_assignment(one);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        // Another history of kinds changes what order 3 leaves out.
        EXPECT_GE(at.costs[i][j].total_change_m_s, any.costs[i][j].total_change_m_s - 1e-6);
      }
    }
  }
}

TEST(Assignment, NoAnswerAtAnyTimeIsAFailure) {
  Scene scene = swarm();
  scene.transfer->singular_margin = 100;  // everything is near a singularity
  scene.transfer->times = {5.3, 5.4};
  const AssignmentResult result = study_assignment(scene);
  EXPECT_FALSE(result.failure.empty());
  EXPECT_EQ(exit_code(result), 4);
  scene.assignment->slots.pop_back();
  EXPECT_THROW(study_assignment(scene), Error);
}

}  // namespace
}  // namespace hamjet
