#include "studies/paper/optimal_control_study.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/errors.hpp"

// The study as a whole: closed forms of the double integrator and of the Heisenberg problem.

namespace hamjet::test {
namespace {

OptimalControlStudy loop(Discretization form) {
  OptimalControlStudy study;
  study.model = ControlModel::heisenberg;
  study.discretization = form;
  study.steps = 32;
  study.refinements = {32, 64, 128};
  study.start = {0, 0, 0};
  study.end = {0, 0, 1};
  study.shooting_intervals = 4;
  return study;
}

OptimalControlStudy transfer(Discretization form) {
  OptimalControlStudy study;
  study.model = ControlModel::double_integrator;
  study.discretization = form;
  study.steps = 32;
  study.refinements = {400, 800, 100, 200};
  study.start = {0, 0};
  study.end = {1, 0};
  return study;
}

// Expected, from the study's own guess: the cost, half of the integral of |u|^2, is n tan(pi/n) |a|
// / T, with an error of order 2.
TEST(OptimalControlStudy, SolvesTheLoop) {
  for (const Discretization form : {Discretization::stormer, Discretization::midpoint}) {
    const OptimalControlResult result = run_study(loop(form), {});
    EXPECT_NEAR(result.cost, 32 * std::tan(std::numbers::pi / 32), 1e-13);
    EXPECT_NEAR(result.squared_control, 2 * result.cost, 1e-13);
    EXPECT_EQ(result.solution.unknowns - result.solution.rank, 1);
    EXPECT_EQ(result.end_point_rank, 2);
    EXPECT_LT(result.symplecticity_defect, 1e-15);
    ASSERT_TRUE(result.routes);
    EXPECT_LT(result.routes->largest(), 2e-14);
    ASSERT_TRUE(result.fit);
    EXPECT_NEAR(result.fit->order, 2, 0.01);
    EXPECT_EQ(result.fit->steps, (std::vector<std::size_t>{128, 64, 32}));
    EXPECT_EQ(result.exit_code(), 0);
  }
}

// An arc of the Heisenberg problem is a part of a circle; the first conjugate time is when it has
// gone once around, the next at the first positive root of tan(w/2) = w/2 of its turn w, 8.9868
// (R. Montgomery, A Tour of Subriemannian Geometries (2002), section 1.8). Two loops turn by 4 pi,
// once around at T/2, and cost twice as much as the one that is least.
TEST(OptimalControlStudy, TwoLoopsAreNoLocalLeast) {
  constexpr double pi = std::numbers::pi;
  OptimalControlStudy study = loop(Discretization::stormer);
  study.steps = 64;
  study.refinements.clear();
  study.costate_guess = {-3, 0, -6.3};
  const OptimalControlResult two = run_study(study, {});
  EXPECT_NEAR(two.cost, 64 * std::tan(2 * pi / 64), 1e-12);
  ASSERT_TRUE(two.conjugate.is_resolved);
  ASSERT_EQ(two.conjugate.passed_after.size(), 2U);
  EXPECT_NEAR(static_cast<double>(two.conjugate.passed_after[0]) / 64, 0.5, 1.01 / 64);
  EXPECT_NEAR(static_cast<double>(two.conjugate.passed_after[1]) / 64, 8.9868 / (4 * pi),
              1.01 / 64);
  EXPECT_EQ(two.is_local_least(), std::optional(false));
  for (const Discretization form : {Discretization::stormer, Discretization::midpoint}) {
    study.discretization = form;
    study.costate_guess.clear();
    // Once around, the end is conjugate itself: the solutions form a family of one cost.
    study.end = {0, 0, 1};
    const OptimalControlResult one = run_study(study, {});
    EXPECT_TRUE(one.conjugate.is_resolved);
    EXPECT_TRUE(one.conjugate.passed_after.empty());
    EXPECT_EQ(one.is_local_least(), std::nullopt);
    // The arc is less than a full circle.
    study.end = {0.5, 0, 0.25};
    EXPECT_EQ(run_study(study, {}).is_local_least(), std::optional(true));
  }
}

// A quadratic cost under linear dynamics is convex.
TEST(OptimalControlStudy, ThatOfTheDoubleIntegratorIsALeast) {
  OptimalControlStudy study = transfer(Discretization::stormer);
  study.refinements.clear();
  EXPECT_EQ(run_study(study, {}).is_local_least(), std::optional(true));
  study.end[1].reset();
  EXPECT_EQ(run_study(study, {}).is_local_least(), std::nullopt);
}

// From rest to rest over d the cost is 6 d^2 / T^3 in continuous time. The order is that of the
// form.
TEST(OptimalControlStudy, OrderIsThatOfTheForm) {
  for (const Discretization form : {Discretization::stormer, Discretization::midpoint}) {
    const OptimalControlResult result = run_study(transfer(form), {});
    ASSERT_TRUE(result.closed_form);
    EXPECT_NEAR(result.closed_form->continuous, 6, 1e-14);
    EXPECT_LT(*result.discrete_error, 1e-13);
    ASSERT_TRUE(result.fit);
    // Rest to rest is symmetric in time, which makes Stormer's first-order term vanish.
    EXPECT_NEAR(result.fit->order, 2, 0.01);
    OptimalControlStudy free = transfer(form);
    free.end[1].reset();
    const OptimalControlResult open = run_study(free, {});
    EXPECT_NEAR(open.closed_form->continuous, 1.5, 1e-14);
    ASSERT_TRUE(open.fit);
    EXPECT_NEAR(open.fit->order, form == Discretization::stormer ? 1 : 2, 0.02);
    EXPECT_EQ(open.fit->steps.front(), 800U);
  }
}

TEST(OptimalControlStudy, ChecksFailWhereTheyMust) {
  OptimalControlStudy study = loop(Discretization::stormer);
  study.refinements.clear();
  study.require_cost_error = 1e-12;
  study.require_equivalence = 1e-12;
  EXPECT_EQ(run_study(study, {}).exit_code(), 0);
  // However the run is rounded: errors can be 0, but not below.
  study.require_cost_error = -1e-30;
  study.require_equivalence = -1e-30;
  const OptimalControlResult result = run_study(study, {});
  EXPECT_EQ(result.exit_code(), 1);
  EXPECT_EQ(result.failed_checks.size(), 2U);
}

TEST(OptimalControlStudy, RefusesTooMuchWorkAndStopsWhenAsked) {
  OptimalControlStudy study = loop(Discretization::stormer);
  study.refinements = {50'000, 50'000};
  expect_error(ErrorKind::too_large, "too many steps, got at least 100032",
               [&] { run_study(study, {}); });
  study.refinements = {};
  study.shooting_intervals = 101;
  study.steps = 200;
  expect_error(ErrorKind::too_large, "too many shooting intervals, got 101",
               [&] { run_study(study, {}); });
  study = loop(Discretization::stormer);
  int calls = 0;
  expect_error(ErrorKind::check_failed, "stop", [&] {
    run_study(study, [&](const std::string&, double fraction) {
      EXPECT_GE(fraction, 0);
      EXPECT_LE(fraction, 1);
      if (++calls == 5) throw Error(ErrorKind::check_failed, "stop");
    });
  });
  EXPECT_EQ(calls, 5);
}

// A failure of a refinement is recorded, and the other results remain.
TEST(OptimalControlStudy, FailureOfARefinementIsRecorded) {
  OptimalControlStudy study = loop(Discretization::stormer);
  study.refinements = {1, 64};  // one step cannot enclose an area
  const OptimalControlResult result = run_study(study, {});
  EXPECT_NE(result.convergence[0].failure, "");
  EXPECT_FALSE(result.convergence[0].discrete_error);
  EXPECT_LT(*result.convergence[1].discrete_error, 1e-13);
  EXPECT_EQ(result.exit_code(), 4);
}

}  // namespace
}  // namespace hamjet::test
