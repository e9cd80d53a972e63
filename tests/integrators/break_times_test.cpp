#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dynamics/costate_system.hpp"
#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/integrators/cvode.hpp"
#include "hamjet/integrators/explicit_runge_kutta.hpp"
#include "hamjet/integrators/gauss_many.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "integrators/step_ends.hpp"
#include "integrators/taylor_flow.hpp"
#include "support/flow.hpp"

// A force whose derivative jumps at known times, by methods of which each ends a step there.

namespace hamjet {
namespace {

constexpr double kink = 3.3;
constexpr double last_kink = 7.1;
constexpr double slope = 2;

/// Rises from 0 at the slope 2 between two times, and stays.
class Ramp final : public TimeFunction {
 public:
  std::size_t components() const override { return 1; }
  void expand(double t, int degree, double* out) const override { expand_in(t, degree, out); }
  void expand(const Extended& t, int degree, Extended* out) const override {
    expand_in(t, degree, out);
  }

 private:
  template <class Real>
  static void expand_in(const Real& t, int degree, Real* out) {
    std::fill(out, out + degree + 1, Real(0));
    if (t < kink) return;
    const bool is_rising = t < last_kink;
    out[0] = slope * ((is_rising ? t : Real(last_kink)) - Real(kink));
    if (degree > 0 && is_rising) out[1] = slope;
  }
};

/// H = (p^2 + q^2) / 2 - q f(t).
DynamicalSystem pushed(bool has_breaks = true) {
  const auto ramp = std::make_shared<const Ramp>();
  DynamicalSystem system =
      make_system("pushed", record(
                                3,
                                [&](std::span<const Expression> z) {
                                  return std::vector<Expression>{(square(z[0]) + square(z[1])) / 2 -
                                                                 z[0] * time_values(ramp, z[2])[0]};
                                },
                                true));
  if (has_breaks) system.break_times = {kink, last_kink};
  return system;
}

/// The state at a time of the clock from (1, 0) at 0: cos t, and from each kink on the response
/// +-2 ((t - k) - sin(t - k)) to a ramp.
std::array<double, 2> exact(double t) {
  std::array<double, 2> z = {std::cos(t), -std::sin(t)};
  for (const auto& [start, sign] : {std::pair{kink, 1.0}, std::pair{last_kink, -1.0}}) {
    const double s = t - start;
    if (s < 0) continue;
    z[0] += sign * slope * (s - std::sin(s));
    z[1] += sign * slope * (1 - std::cos(s));
  }
  return z;
}

test::Flow<double> flow_from(double from, double to, bool has_breaks = true) {
  const auto [q, p] = exact(from);
  test::Flow<double> flow{pushed(has_breaks), {q, p}, to - from, 1, {}, ClockTime(from)};
  return flow;
}

void expect_state(const std::vector<double>& state, double t, double error,
                  const std::string& what) {
  const auto [q, p] = exact(t);
  EXPECT_NEAR(state[0], q, error) << what << " at " << t;
  EXPECT_NEAR(state[1], p, error) << what << " at " << t;
}

/// At 0 the momentum is 0, and a Taylor expansion has no scale for its powers. Spans with kinks
/// inside, at the start and at the end, forwards and backwards.
const std::vector<std::array<double, 2>> spans = {{0.2, 10}, {10, 0.2}, {0.2, kink},    {kink, 0.2},
                                                  {kink, 9}, {9, kink}, {last_kink, 2}, {3.2, 3.4}};

TEST(BreakTimes, StepsEndThere) {
  const DynamicalSystem system = pushed();
  const StepEnds<double> ends(system, ClockTime(1.0), 9);
  EXPECT_NEAR(ends.after(0), kink - 1, 1e-15);
  EXPECT_NEAR(ends.after(2.5), last_kink - 1, 1e-15);
  EXPECT_EQ(ends.after(8), 9);
  EXPECT_EQ(ends.after(9), 9);
  const StepEnds<double> back(system, ClockTime(last_kink), -7);
  EXPECT_NEAR(back.after(0), kink - last_kink, 1e-15);
  EXPECT_EQ(back.after(-5), -7);
  const StepEnds<double> none(system, ClockTime(kink), 1);
  EXPECT_EQ(none.after(0), 1);
}

TEST(BreakTimes, GaussEndsStepsThere) {
  for (const auto& [from, to] : spans) {
    const FlowProblem<double> problem = test::problem_of(flow_from(from, to));
    std::vector<double> ends;
    IntegrationStatistics statistics;
    const FlowJet<double> jet = integrate_gauss<double>(
        problem, test::adaptive(8, 1e-13), statistics,
        [&](const double& time, const FlowJet<double>&) { ends.push_back(from + time); });
    expect_state(test::final_state(jet), to, 1e-12, "Gauss");
    for (const double time : {kink, last_kink}) {
      if (!(time > std::min(from, to) && time < std::max(from, to))) continue;
      const auto near = std::find_if(ends.begin(), ends.end(),
                                     [&](double end) { return std::abs(end - time) < 1e-14; });
      EXPECT_NE(near, ends.end()) << from << " to " << to;
    }
    // The first trial of a flight is too long; a kink would be met by many.
    EXPECT_LE(statistics.rejected_steps, 1) << from << " to " << to;
  }
}

/// The error that steps allow is the one that they have, if none passes over a kink. Otherwise the
/// error of a collocation falls with the square of the step at best, and the estimate, which
/// squares the last mode of the slopes, takes it for that much smaller.
TEST(BreakTimes, EstimatesOfErrorsHoldWithThemAlone) {
  // The pulse of a ramp in one step has the error h^2 / 2 of a kink; 4 stages and long steps.
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const auto error_of = [&](bool has_breaks, long& steps) {
      IntegrationStatistics statistics;
      const auto end = test::final_state(
          test::run_gauss(flow_from(0, 10, has_breaks), test::adaptive(4, tolerance), &statistics));
      steps = statistics.steps + statistics.rejected_steps;
      const auto [q, p] = exact(10);
      return std::hypot(end[0] - q, end[1] - p);
    };
    long with = 0, without = 0;
    EXPECT_LT(error_of(true, with), 10 * tolerance) << tolerance;
    error_of(false, without);
    EXPECT_GT(without, with + 10) << tolerance;
  }
}

/// Gauss with s stages has order 2s on pieces that end at the kinks, and 2 over them.
TEST(BreakTimes, OrderOfEqualStepsIsLostOverAKink) {
  const auto error_of = [](double from, double to, double step) {
    const auto end =
        test::final_state(test::run_gauss(flow_from(from, to), test::fixed_step(2, step)));
    const auto [q, p] = exact(to);
    return std::hypot(end[0] - q, end[1] - p);
  };
  const double across = error_of(0, 6.7, 6.7 / 20) / error_of(0, 6.7, 6.7 / 200);
  const double before = error_of(0, kink, kink / 10) / error_of(0, kink, kink / 100);
  EXPECT_LT(across, 1e3);
  EXPECT_NEAR(before, 1e4, 1000);
}

TEST(BreakTimes, OtherMethods) {
  for (const auto& [from, to] : spans) {
    const test::Flow<double> flow = flow_from(from, to);
    const FlowProblem<double> problem = test::problem_of(flow);
    IntegrationStatistics statistics;
    ExplicitRungeKuttaSettings fehlberg;
    fehlberg.tolerance = 1e-13;
    expect_state(test::final_state(integrate_fehlberg78<double>(problem, fehlberg, statistics)), to,
                 1e-11, "Fehlberg");
    if (cvode_available()) {
      CvodeSettings cvode;
      cvode.tolerance = 1e-12;
      CvodeCounts counts;
      cvode.counts = &counts;
      expect_state(test::final_state(integrate_cvode(problem, cvode, statistics)), to, 1e-9,
                   "CVODE");
      // Counts of all pieces: at least one iteration a step.
      EXPECT_GE(counts.nonlinear_iterations, statistics.steps);
    }
    const auto many = integrate_gauss_many(problem, std::vector<std::vector<double>>(3, flow.start),
                                           test::adaptive(8, 1e-13), {});
    for (const ManyFlowsOutcome& outcome : many) {
      ASSERT_FALSE(outcome.jet.empty());
      EXPECT_FALSE(outcome.was_alone);
      EXPECT_LE(outcome.statistics.rejected_steps, 1);
      expect_state(test::final_state(outcome.jet), to, 1e-12, "lanes");
    }
    std::vector<double> state = flow.start;
    TaylorFlow(pushed()).advance(state, flow.start_time, std::vector<double>{flow.duration});
    expect_state(state, to, 1e-12, "Taylor");
  }
}

/// States with the costates of least energy have the breaks of their system. From the costates (0,
/// a) the thrust is -a cos t, whose response is (-a t sin t, -a (sin t + t cos t)) / 2.
TEST(BreakTimes, AreThoseOfCostatesToo) {
  constexpr double a = 0.4;
  test::Flow<double> flow{costate_system(pushed()), {1, 0, 0, a}, 10, 1, {}, ClockTime(0.0)};
  IntegrationStatistics statistics;
  const auto end = test::final_state(test::run_gauss(flow, test::adaptive(8, 1e-13), &statistics));
  const auto [q, p] = exact(10);
  const double c = std::cos(10.0), s = std::sin(10.0);
  EXPECT_NEAR(end[0], q - a * 10 * s / 2, 1e-12);
  EXPECT_NEAR(end[1], p - a * (s + 10 * c) / 2, 1e-12);
  EXPECT_NEAR(end[2], a * s, 1e-12);
  EXPECT_NEAR(end[3], a * c, 1e-12);
  EXPECT_LE(statistics.rejected_steps, 1);
}

TEST(BreakTimes, JetsBetweenSteps) {
  const JetTrajectory<double> jets(test::problem_of(flow_from(0, 10)), test::adaptive(8, 1e-13));
  for (const double t : {1.0, kink, 3.31, 5.0, last_kink, 8.0}) {
    expect_state(test::final_state(jets.at(t)), t, 1e-12, "between");
  }
}

TEST(BreakTimes, OtherSystemsKeepThem) {
  const DynamicalSystem forced = with_force(
      pushed(), [](std::span<const Expression> z) { return std::vector<Expression>{-0.1 * z[1]}; });
  EXPECT_EQ(forced.break_times, pushed().break_times);
  EXPECT_EQ(costate_system(pushed()).break_times, pushed().break_times);
}

}  // namespace
}  // namespace hamjet
