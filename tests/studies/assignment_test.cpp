#include "hamjet/studies/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "../../src/studies/formation/least_assignment.hpp"
#include "../../src/studies/formation/nearest_pairs.hpp"
#include "formation_scenes.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The least sum over all assignments of the rows from `row` on to columns of their own, with
/// `left` of the columns free.
double least_of_all(const std::vector<std::vector<double>>& costs, std::size_t row,
                    std::vector<bool>& is_taken, std::size_t left) {
  if (row == costs.size()) return 0;
  double least = left > 0 ? least_of_all(costs, row + 1, is_taken, left - 1) : infinite;
  for (std::size_t j = 0; j < costs[row].size(); ++j) {
    if (is_taken[j]) continue;
    is_taken[j] = true;
    least = std::min(least, costs[row][j] + least_of_all(costs, row + 1, is_taken, left));
    is_taken[j] = false;
  }
  return least;
}

// Expected: the least over all assignments, for equal and for different numbers of rows and
// columns.
TEST(LeastAssignment, IsTheLeastOfAll) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.1, 50);
  int without = 0, unequal = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const std::size_t rows = 1 + generator() % 5;
    const std::size_t columns = trial % 2 == 0 ? rows : 1 + generator() % 5;
    std::vector<std::vector<double>> costs(rows, std::vector<double>(columns));
    for (auto& row : costs) {
      for (double& cost : row) {
        cost = trial % 3 == 0 && generator() % 2 == 0 ? infinite : uniform(generator);
      }
    }
    std::vector<bool> is_taken(columns);
    const std::size_t pairs = std::min(rows, columns);
    const double least = least_of_all(costs, 0, is_taken, rows - pairs);
    const auto found = least_assignment(costs);
    if (std::isinf(least)) {
      ++without;
      EXPECT_FALSE(found.has_value());
      continue;
    }
    ASSERT_TRUE(found.has_value());
    unequal += rows != columns ? 1 : 0;
    double total = 0;
    std::vector<bool> is_used(columns);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      if (!(*found)[i]) continue;
      EXPECT_FALSE(is_used[*(*found)[i]]);
      is_used[*(*found)[i]] = true;
      total += costs[i][*(*found)[i]];
      ++count;
    }
    EXPECT_EQ(count, pairs);
    EXPECT_NEAR(total, least, 1e-6);
  }
  EXPECT_GT(without, 5);
  EXPECT_GT(unequal, 50);
}

/// The deputies rest near slots of their own, and the slots are listed in another order.
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

// With a thrust that lasts the total of the integrals of |u|^2 / 2 is the least: no permutation of
// the costs is cheaper, and each cost is what a transfer of the pair alone finds.
TEST(Assignment, OfAThrustThatLastsTheTotalEnergyIsTheLeast) {
  Scene scene = swarm();
  scene.transfer->thrust = TransferThrust::energy_optimal;
  scene.transfer->thrust_order = 2;
  scene.transfer->times = {2.0, 3.0};
  scene.assignment->time = AssignmentTime::common;
  const AssignmentResult result = study_assignment(scene);
  ASSERT_TRUE(result.failure.empty()) << result.failure;
  ASSERT_EQ(result.transfers.size(), 4U);
  ASSERT_TRUE(result.common_time);
  std::vector<std::vector<double>> energies(4);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) energies[i].push_back(result.costs[i][j].energy_m2_s3);
  }
  std::vector<bool> is_taken(4);
  const double least = least_of_all(energies, 0, is_taken, 0);
  double chosen = 0;
  for (const AssignedTransfer& one : result.transfers) {
    ASSERT_TRUE(one.thrust && one.thrust->is_found());
    const double cost = energies[one.deputy][one.slot];
    chosen += cost;
    Scene pair = scene;
    pair.transfer->start = scene.assignment->deputies[one.deputy];
    pair.transfer->end = scene.assignment->slots[one.slot];
    pair.transfer->times = {scene.transfer->times[*result.common_time]};
    pair.assignment.reset();
    const EnergyOptimalTransfer alone = study_transfer(pair).thrust->transfers.front();
    ASSERT_TRUE(alone.is_found()) << alone.failure;
    EXPECT_NEAR(one.thrust->energy_m2_s3, alone.energy_m2_s3, 1e-9 * alone.energy_m2_s3);
    EXPECT_NEAR(cost, alone.energy_m2_s3, 1e-3 * alone.energy_m2_s3);
    EXPECT_LT(one.thrust->refined->miss_m, scene.transfer->refined_miss_m);
  }
  EXPECT_NEAR(chosen, least, 1e-12 * least);
  EXPECT_NEAR(result.total_energy_m2_s3, least, 1e-3 * least);
  EXPECT_TRUE(result.pairs.empty());
  EXPECT_EQ(exit_code(result), 0);
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

TEST(Assignment, OfUnequalNumbersTheFewerAllFindOne) {
  const Scene scene = swarm();
  const double all = study_assignment(scene).total_change_m_s;
  Scene few_slots = scene;
  few_slots.assignment->slots.pop_back();  // the slot of deputy 0, which rests nearest to it
  const AssignmentResult three = study_assignment(few_slots);
  ASSERT_EQ(three.transfers.size(), 3U);
  EXPECT_EQ(left_out(three.transfers, 4, &AssignedTransfer::deputy).size(), 1U);
  EXPECT_TRUE(left_out(three.transfers, 3, &AssignedTransfer::slot).empty());
  EXPECT_LT(three.total_change_m_s, all);
  EXPECT_EQ(exit_code(three), 0);
  Scene few_deputies = scene;
  few_deputies.assignment->deputies.erase(few_deputies.assignment->deputies.begin());
  few_deputies.assignment->time = AssignmentTime::common;
  const AssignmentResult others = study_assignment(few_deputies);
  ASSERT_EQ(others.transfers.size(), 3U);
  // Each deputy rests 12 m from a slot of its own and kilometres from the other slots. The slot of
  // the missing deputy, the last one, stays empty.
  EXPECT_EQ(left_out(others.transfers, 4, &AssignedTransfer::slot), (std::vector<std::size_t>{3}));
  EXPECT_EQ(exit_code(others), 0);
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
        // Another sequence of kinds changes the neglected terms of order 3.
        EXPECT_GE(at.costs[i][j].total_change_m_s, any.costs[i][j].total_change_m_s - 1e-6);
      }
    }
  }
}

// Two deputies change places on the chief's circle by radial impulses in half a revolution: each
// way is half an ellipse of 2 by 1, one above and the other below, a quarter of the distance each
// (Fehse, Automated Rendezvous and Docking of Spacecraft, 2003, section 3.3), where they are
// nearest. Flown at a thousand times of its own, each way has the same least.
TEST(NearestPairs, IsWhereTwoWaysComeNearest) {
  Scene scene = kepler_chief(0, 7000, 1000, 2);
  TransferSettings settings;
  settings.times = {std::numbers::pi - 0.02};
  settings.singular_margin = 1e-3;
  scene.transfer = settings;
  scene.assignment = AssignmentSettings{};
  std::vector<AssignedTransfer> transfers;
  std::vector<RelativeTrajectory> flown;
  for (const double place : {-1000.0, 1000.0}) {
    scene.transfer->start.position_m = {0, place, 0};
    scene.transfer->end.position_m = {0, -place, 0};
    scene.assignment->deputies.push_back(scene.transfer->start);
    const TransferResult result = study_transfer(scene);
    transfers.push_back({transfers.size(), transfers.size(), result.points[0]});
    flown.push_back(fly_relative(result, 0, equal_times_from_0(result.points[0].time, 1000)));
  }
  const std::vector<DeputyPair> pairs = nearest_of_pairs(scene, transfers);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].second, 1U);
  EXPECT_NEAR(pairs[0].separation_m, 1000, 20);
  double least = 1e9;
  for (std::size_t k = 0; k < flown[0].states.size(); ++k) {
    least = std::min(least, (flown[0].states[k].position_m - flown[1].states[k].position_m).norm());
  }
  EXPECT_LE(pairs[0].separation_m, least + 1e-3);
  EXPECT_GT(pairs[0].separation_m, least - 0.01);
}

TEST(Assignment, DeputiesKeepApart) {
  Scene scene = swarm();
  const AssignmentResult result = study_assignment(scene);
  ASSERT_EQ(result.pairs.size(), 6U);
  const auto nearest = nearest_pair(result);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_GT(nearest->separation_m, 0);
  scene.assignment->keep_apart_m = 1.01 * nearest->separation_m;
  EXPECT_EQ(exit_code(study_assignment(scene)), 1);
  scene.assignment->keep_apart_m = 0.99 * nearest->separation_m;
  EXPECT_EQ(exit_code(study_assignment(scene)), 0);
}

// The largest impulse decides which transfers are chosen, and an ellipsoid marks the transfers that
// enter it.
TEST(Assignment, KeepsTheLimitsOfTransfers) {
  Scene scene = swarm();
  const AssignmentResult free = study_assignment(scene);
  double largest = 0;
  for (const AssignedTransfer& one : free.transfers) {
    largest = std::max(largest, one.transfer.best().largest_impulse_m_s());
  }
  scene.transfer->largest_impulse_m_s = 0.999 * largest;
  const AssignmentResult limited = study_assignment(scene);
  for (const AssignedTransfer& one : limited.transfers) {
    EXPECT_LE(one.transfer.best().largest_impulse_m_s(), *scene.transfer->largest_impulse_m_s);
  }
  EXPECT_TRUE(!limited.failure.empty() || limited.total_change_m_s > free.total_change_m_s);
  scene.transfer->largest_impulse_m_s.reset();
  scene.transfer->keep_out_m = Eigen::Vector3d(1e6, 1e6, 1e6);
  const AssignmentResult kept_out = study_assignment(scene);
  for (const AssignedTransfer& one : kept_out.transfers) {
    EXPECT_TRUE(one.transfer.enters_keep_out());
  }
  EXPECT_EQ(exit_code(kept_out), 1);
}

TEST(Assignment, NoAnswerAtAnyTimeIsAFailure) {
  Scene scene = swarm();
  scene.transfer->singular_margin = 100;  // everything is near a singularity
  scene.transfer->times = {5.3, 5.4};
  const AssignmentResult result = study_assignment(scene);
  EXPECT_FALSE(result.failure.empty());
  EXPECT_EQ(exit_code(result), 4);
}

}  // namespace
}  // namespace hamjet
