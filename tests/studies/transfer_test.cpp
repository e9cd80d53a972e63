#include "hamjet/studies/transfer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "formation_scenes.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "support/magnitude.hpp"

namespace hamjet {
namespace {

/// A transfer from rest at one point to rest at another, far from singular times.
TransferSettings short_hop(double separation_m, std::vector<double> times) {
  TransferSettings settings;
  settings.start.position_m = Eigen::Vector3d(0.6, -0.7, 0.4).normalized() * separation_m;
  settings.end.position_m = Eigen::Vector3d(-0.3, 0.8, -0.5).normalized() * separation_m;
  settings.times = std::move(times);
  return settings;
}

// Curtis, Orbital Mechanics for Engineering Students: n = 0.00115697 rad/s, 8 h, from
// (20, 20, 20) km and (-20, 20, -5) m/s to rest at the target.
TEST(Transfer, ClohessyWiltshireRendezvousByDegreeOne) {
  const double n = 0.00115697;
  const double mu = 398600.4415;
  Scene scene = kepler_chief(0, std::cbrt(mu / (n * n)), 1 / n, 1);
  TransferSettings settings;
  settings.start = {{20e3, 20e3, 20e3}, {-20, 20, -5}};
  settings.times = {n * 8 * 3600};
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  ASSERT_EQ(result.points.size(), 1U);
  ASSERT_TRUE(result.points[0].has_answer()) << result.points[0].failure;
  const TransferAnswer& linear = result.points[0].answers[0];
  const Eigen::Vector3d first(29.35751148832, -66.75115105877, 13.02971971421);
  const Eigen::Vector3d second(25.82081590444, 0.47235105877, 24.49302413033);
  EXPECT_LT((linear.start_change_m_s - first).norm(), 1e-9);
  EXPECT_LT((linear.end_change_m_s - second).norm(), 1e-9);
  EXPECT_NEAR(linear.total_change_m_s(), 109.66945, 1e-5);
}

// Order k misses by a constant times separation^(k+1).
TEST(Transfer, MissFallsAsAPowerOfTheSeparation) {
  const int order = 6;
  std::vector<std::vector<double>> misses;
  std::vector<double> separations;
  for (double separation = 64e4; separation > 5e3; separation /= 2)
    separations.push_back(separation);
  double floor = 0;
  for (const double separation : separations) {
    Scene scene = paper_chief(order);
    scene.transfer = short_hop(separation, {4.0});
    const TransferResult result = study_transfer(scene);
    floor = test::larger(floor, result.flight_floor_m);
    misses.emplace_back();
    for (const TransferAnswer& answer : result.points[0].answers) {
      ASSERT_TRUE(answer.failure.empty()) << answer.failure;
      misses.back().push_back(answer.miss_m);
    }
  }
  EXPECT_LT(floor, 1e-5);
  for (int k = 1; k <= order; ++k) {
    const auto miss = [&](std::size_t i) { return misses[i][static_cast<std::size_t>(k - 1)]; };
    // The smallest two separations that stay well above the rounding of the flights.
    std::size_t i = separations.size() - 2;
    while (i > 0 && miss(i + 1) < 100 * floor) --i;
    ASSERT_GT(miss(i + 1), 100 * floor) << k;
    EXPECT_NEAR(std::log2(miss(i) / miss(i + 1)), k + 1, 0.3) << k;
  }
}

TEST(Transfer, TenKilometresOnThePapersOrbit) {
  Scene scene = paper_chief(4);
  scene.transfer = short_hop(10e3, equal_times(2 * paper_period, 40));
  scene.transfer->singular_margin = 0.05 * paper_period;
  const TransferResult result = study_transfer(scene);
  int far = 0;
  double largest = 0;
  double largest_linear = 0;
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.singular_distance.has_value());
    if (point.is_near_singular) continue;
    ASSERT_TRUE(point.has_answer()) << point.failure;
    ++far;
    largest = test::larger(largest, point.answers[3].miss_m);
    largest_linear = std::max(largest_linear, point.answers[0].miss_m);
    EXPECT_LT(*point.hamilton_jacobi_residual, 1e-8);
  }
  EXPECT_GE(far, 20);
  EXPECT_LT(largest, 1);
  EXPECT_GT(largest_linear, 100);
}

// At most times order 2 misses by more than the tolerance; the least is that of all answers
// refined.
TEST(Transfer, TheLeastIsOverAnswersBeyondTheToleranceToo) {
  Scene scene = paper_chief(2);
  scene.transfer = short_hop(100e3, equal_times(paper_period, 20));
  scene.transfer->singular_margin = 0.01 * paper_period;
  const TransferResult result = study_transfer(scene);
  scene.transfer->refine = true;
  const TransferResult refined = study_transfer(scene);
  ASSERT_TRUE(result.best_point() && refined.best_point());
  EXPECT_EQ(*result.best_point(), *refined.best_point());
  const TransferPoint& best = result.points[*result.best_point()];
  EXPECT_TRUE(best.is_beyond_tolerance);
  EXPECT_TRUE(best.is_refined());
  EXPECT_LE(best.best().miss_m, scene.transfer->refined_miss_m);
  EXPECT_EQ(best.best().total_change_m_s(),
            refined.points[*refined.best_point()].best().total_change_m_s());
}

// Against a list sixteen times as fine.
TEST(Transfer, TheLeastBetweenTheListedTimesIsThatOfAFinerList) {
  Scene scene = paper_chief(3);
  scene.transfer = short_hop(5e3, equal_times(2 * paper_period, 16));
  scene.transfer->singular_margin = 0.01 * paper_period;
  const TransferResult coarse = study_transfer(scene);
  scene.transfer->times = equal_times(2 * paper_period, 256);
  const TransferResult fine = study_transfer(scene);
  ASSERT_TRUE(coarse.best_point() && coarse.least_between && fine.best_point());
  const double listed = coarse.points[*coarse.best_point()].best().total_change_m_s();
  const double between = coarse.least_between->best().total_change_m_s();
  const double finer = fine.points[*fine.best_point()].best().total_change_m_s();
  EXPECT_LT(between, 0.99 * listed);
  // The minimum is minimised, and answers differ by what order 3 leaves out at 5 km.
  EXPECT_LT(between, finer * (1 + 1e-7));
  EXPECT_FALSE(coarse.least_between->is_near_singular);
  EXPECT_LT(coarse.least_between->best().miss_m, scene.transfer->tolerance_m);
}

// Half a revolution of a circle takes two radial impulses of n x / 4 along the orbit (Fehse,
// Automated Rendezvous and Docking of Spacecraft, 2003, section 3.3), and the way is half an
// ellipse of 2 by 1 whose ends are x apart along the orbit, so that it is x / 4 above or below at
// the middle.
TEST(Transfer, MarksWhatTheSceneDoesNotAllow) {
  Scene scene = half_revolution_along_the_track();
  const double impulse = 2000 / (4 * scene.units.time_s);
  const auto point = [&] { return study_transfer(scene).points[0]; };
  EXPECT_NEAR(point().best().start_change_m_s.norm(), impulse, 0.02 * impulse);
  EXPECT_FALSE(point().keep_out_ratio.has_value());
  scene.transfer->largest_impulse_m_s = 1.03 * impulse;
  EXPECT_TRUE(point().is_candidate());
  scene.transfer->largest_impulse_m_s = 0.97 * impulse;
  EXPECT_TRUE(point().exceeds_impulse);
  EXPECT_TRUE(point().is_proved());
  EXPECT_FALSE(study_transfer(scene).best_point().has_value());
  EXPECT_EQ(exit_code(study_transfer(scene)), 1);
  scene.transfer->largest_impulse_m_s.reset();
  EXPECT_EQ(exit_code(study_transfer(scene)), 0);
  // At its middle the way is some 500 m from the chief, radially.
  scene.transfer->keep_out_m = Eigen::Vector3d(250, 900, 10);
  // At its start, or a little after it, for it does not leave radially.
  EXPECT_LE(*point().keep_out_ratio, 1000.0 / 900);
  EXPECT_GT(*point().keep_out_ratio, 0.9999 * 1000.0 / 900);
  EXPECT_TRUE(point().is_candidate());
  scene.transfer->keep_out_m = Eigen::Vector3d(600, 900, 10);
  EXPECT_TRUE(point().enters_keep_out());
  EXPECT_NEAR(*point().keep_out_ratio, 500.0 / 600, 0.02);
  EXPECT_FALSE(point().is_candidate());
}

// Against answers at times beside the windows' ends, each of a study of its own.
TEST(Transfer, FindsTheWindowsOfABudget) {
  Scene scene = paper_chief(3);
  scene.transfer = short_hop(5e3, equal_times(2 * paper_period, 24));
  scene.transfer->singular_margin = 0.01 * paper_period;
  const TransferResult listed = study_transfer(scene);
  ASSERT_TRUE(listed.best_point() && listed.budget_windows.empty());
  const double budget = 1.3 * listed.points[*listed.best_point()].change_m_s();
  scene.transfer->budget_m_s = budget;
  const TransferResult result = study_transfer(scene);
  ASSERT_FALSE(result.budget_windows.empty());
  const double spacing = scene.transfer->times[0];
  const auto suffices = [&](double time) {
    Scene alone = scene;
    alone.transfer->times = {time};
    const TransferPoint point = study_transfer(alone).points[0];
    return point.is_candidate() && point.change_m_s() <= budget;
  };
  for (const BudgetWindow& window : result.budget_windows) {
    EXPECT_LE(window.first, window.last);
    EXPECT_TRUE(suffices(window.first));
    EXPECT_TRUE(suffices(window.last));
    EXPECT_TRUE(window.begins_before || !suffices(window.first - spacing / 2000));
    EXPECT_TRUE(window.ends_after || !suffices(window.last + spacing / 2000));
  }
  // Every listed time that suffices is in one.
  for (const TransferPoint& point : result.points) {
    const bool is_within = point.is_candidate() && point.change_m_s() <= budget;
    EXPECT_EQ(is_within, std::any_of(result.budget_windows.begin(), result.budget_windows.end(),
                                     [&](const BudgetWindow& window) {
                                       return window.first <= point.time &&
                                              point.time <= window.last;
                                     }));
  }
}

// Right to 1e-8 by flying: what the equation leaves for these boundary values is rounding, though
// the largest coefficients of high degrees, which add nothing there, are off by 1e-3.
TEST(Transfer, TheHamiltonJacobiResidualIsThatOfTheTransfer) {
  Scene scene = kepler_chief(0.74, 26600 * 0.26, 0, 5);
  scene.units.time_s = std::sqrt(std::pow(scene.units.length_km, 3) / 398600.4415);
  const double period = 2 * std::numbers::pi * std::pow(0.26, -1.5);
  scene.transfer = short_hop(1e3, equal_times(0.9 * period, 4));
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.hamilton_jacobi_floor.has_value());
  double largest = 0;
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.hamilton_jacobi_residual.has_value());
    largest = test::larger(largest, *point.hamilton_jacobi_residual);
  }
  EXPECT_LT(largest, 1e-9);
  EXPECT_LT(largest, 100 * *result.hamilton_jacobi_floor);
}

TEST(Transfer, EveryKindGivesTheSameTransfer) {
  // 100 m: what order 4 leaves out is below the rounding of the flights.
  std::optional<TransferAnswer> first;
  for (const char* kind : {"F1", "F2", "F3", "F4", "qpq-qqp", "pqp-qpq", "auto"}) {
    Scene scene = paper_chief(4);
    scene.transfer = short_hop(100, {4.0});
    scene.transfer->kind = kind;
    const TransferResult result = study_transfer(scene);
    ASSERT_TRUE(result.points[0].has_answer()) << kind << result.points[0].failure;
    const TransferAnswer& answer = result.points[0].answers.back();
    if (!first) first = answer;
    EXPECT_LT((answer.start_change_m_s - first->start_change_m_s).norm(), 1e-10) << kind;
    EXPECT_LT((answer.end_change_m_s - first->end_change_m_s).norm(), 1e-10) << kind;
    EXPECT_LT(answer.miss_m, 1e-5) << kind;
  }
}

TEST(Transfer, RefinementReachesTheStatedMiss) {
  Scene scene = paper_chief(3);
  scene.transfer = short_hop(200e3, {4.0, 9.0});
  scene.transfer->refine = true;
  scene.transfer->refined_miss_m = 1e-4;
  for (const TransferPoint& point : study_transfer(scene).points) {
    ASSERT_TRUE(point.refined.has_value());
    ASSERT_TRUE(point.refined->failure.empty()) << point.refined->failure;
    EXPECT_GT(point.answers.back().miss_m, 1);
    EXPECT_LE(point.refined->miss_m, 1e-4);
    EXPECT_LT((point.refined->start_change_m_s - point.answers.back().start_change_m_s).norm(),
              0.1);
  }
}

TEST(Transfer, AnInaccurateIntegratorDoesNotProveItself) {
  Scene scene = paper_chief(2);
  scene.transfer = short_hop(1e3, {4.0});
  scene.transfer->refine = true;
  const TransferPoint right = study_transfer(scene).points[0];
  scene.integrators[0].stages = 1;
  scene.integrators[0].tolerance.reset();
  scene.integrators[0].step_canonical = 0.1;
  const TransferResult result = study_transfer(scene);
  EXPECT_GT(result.chief_error_m, 1e4);
  EXPECT_LT(result.flight_floor_m, 1e-5);
  EXPECT_GT(result.points[0].answers[1].miss_m, 1);
  EXPECT_TRUE(result.points[0].is_beyond_tolerance);
  // Refined by flying, the answer is that of the accurate integrator.
  ASSERT_TRUE(result.points[0].is_refined() && right.is_refined());
  EXPECT_LT((result.points[0].refined->start_change_m_s - right.refined->start_change_m_s).norm(),
            1e-5);
}

TEST(Transfer, AFailedRefinementLeavesTheAnswerOfTheHighestOrder) {
  Scene scene = paper_chief(3);
  scene.transfer = short_hop(1e3, {4.0});
  scene.transfer->refine = true;
  scene.transfer->refined_miss_m = 1e-15;  // below the rounding of the flights
  const TransferResult result = study_transfer(scene);
  const TransferPoint& point = result.points[0];
  ASSERT_TRUE(point.refined.has_value());
  EXPECT_FALSE(point.refined->failure.empty());
  EXPECT_EQ(point.best().order, 3);
  EXPECT_GT(point.best().total_change_m_s(), 0);
  EXPECT_EQ(result.best_point(), std::optional<std::size_t>(0));
  EXPECT_EQ(exit_code(result), 0);
  scene.transfer->strict = true;
  EXPECT_EQ(exit_code(study_transfer(scene)), 1);
}

TEST(Transfer, TheFlownTrajectoryJoinsTheTwoEnds) {
  Scene scene = paper_chief(4);
  scene.transfer = short_hop(1e3, {3.0});
  scene.transfer->start.velocity_m_s = {1, 2, 3};
  const TransferResult result = study_transfer(scene);
  const RelativeTrajectory flown = fly_relative(result, 0, equal_times_from_0(3, 10));
  ASSERT_EQ(flown.states.size(), 11U);
  EXPECT_LT((flown.states.front().position_m - scene.transfer->start.position_m).norm(), 1e-9);
  EXPECT_LT((flown.states.back().position_m - scene.transfer->end.position_m).norm(), 1e-3);
  // The second impulse brings the deputy to the wanted velocity, at rest in the rotating frame.
  const Eigen::Vector3d arrived =
      flown.states.back().velocity_m_s + result.points[0].best().end_change_m_s;
  EXPECT_LT(arrived.norm(), 1e-6);
}

TEST(Transfer, TheFlownTrajectoryIsAlongRtnWhateverTheFrame) {
  Scene scene = paper_chief(2);
  scene.transfer = short_hop(1e3, {3.0});
  scene.transfer->frame = RelativeFrame::inertial;
  const RelativeTrajectory flown = fly_relative(study_transfer(scene), 0, equal_times_from_0(3, 4));
  EXPECT_EQ(flown.frame, RelativeFrame::rtn_rotating);
  // At the start R is the x axis, and the orbit's plane goes through it.
  const Eigen::Vector3d start = scene.transfer->start.position_m;
  EXPECT_NEAR(flown.states[0].position_m[0], start[0], 1e-9);
  EXPECT_NEAR(flown.states[0].position_m[1], start[1] * 0.5 + start[2] * std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(flown.states[4].position_m.norm(), 1e3, 0.1);
}

TEST(Transfer, MarksWhatIsNearSingularAndWhatHasNoKind) {
  // Half a revolution of a circular orbit: the normal direction cannot be commanded.
  Scene scene = kepler_chief(0, 7000, 1000, 2);
  scene.transfer = short_hop(1e3, {2.0, std::numbers::pi, std::numbers::pi + 0.02});
  scene.transfer->kind = "F1";
  scene.transfer->singular_margin = 0.05;
  scene.transfer->strict = true;
  const TransferResult result = study_transfer(scene);
  EXPECT_FALSE(result.points[0].is_near_singular);
  EXPECT_TRUE(result.points[0].has_answer());
  EXPECT_TRUE(result.points[1].is_near_singular);
  EXPECT_FALSE(result.points[1].has_answer());
  EXPECT_NE(result.points[1].failure.find("qqq-qqq"), std::string::npos)
      << result.points[1].failure;
  EXPECT_TRUE(result.points[2].is_near_singular);
  EXPECT_TRUE(result.points[2].has_answer());
  EXPECT_EQ(result.best_point(), std::optional<std::size_t>(0));
  ASSERT_EQ(result.position_singularities().size(), 1U);
  EXPECT_EQ(exit_code(result), 0);
  // The answer away from it beyond its tolerance.
  scene.transfer->tolerance_m = 1e-9;
  EXPECT_EQ(exit_code(study_transfer(scene)), 1);
  // No time with an answer.
  scene.transfer->times = {std::numbers::pi};
  EXPECT_EQ(exit_code(study_transfer(scene)), 4);
}

TEST(Transfer, AnEarlierJetGivesTheSameAnswer) {
  Scene scene = paper_chief(4);
  scene.transfer = short_hop(10e3, {4.0});
  scene.transfer->kind = "F1";
  const TransferResult computed = study_transfer(scene);
  const DynamicalSystem system = make_system(scene);
  const FlowProblem<double> flow{system,        SeriesSpace::create(6, 3), {0, 1, 2, 3, 4, 5},
                                 scene.nominal, ClockTime::epoch(),        4.0};
  GaussSettings settings;
  settings.tolerance = 1e-14;
  IntegrationStatistics statistics;
  EarlierJet earlier{"earlier", 4.0, integrate_gauss<double>(flow, settings, statistics)};
  scene.transfer->times = {1.0, 2.0};
  const TransferResult reused = study_transfer(scene, {}, &earlier);
  ASSERT_EQ(reused.points.size(), 1U);
  ASSERT_EQ(reused.points[0].answers.size(), 3U);
  EXPECT_EQ(reused.integrator, "earlier");
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d difference = reused.points[0].answers[k].start_change_m_s -
                                       computed.points[0].answers[k].start_change_m_s;
    EXPECT_LT(difference.norm(), 1e-9);
  }
  // A jet of another planet.
  scene.system.J[2] = 0;
  EXPECT_THROW(study_transfer(scene, {}, &earlier), Error);
}

TEST(Transfer, NeedsASymplecticIntegratorAndAnOrbit) {
  Scene scene = kepler_chief(0, 7000, 1000, 2);
  EXPECT_THROW(study_transfer(scene), Error);
  scene.transfer = short_hop(1e3, {2.0});
  scene.integrators[0].method = IntegrationMethod::fehlberg78;
  EXPECT_THROW(study_transfer(scene), Error);
}

}  // namespace
}  // namespace hamjet
