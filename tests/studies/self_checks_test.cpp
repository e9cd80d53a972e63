#include "hamjet/detail/studies/self_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "formation_scenes.hpp"
#include "hamjet/studies/propagation.hpp"

// Every self-check once on a good run, where it passes, and once on a run that is wrong in the way
// that it looks for.

namespace hamjet {
namespace {

IntegratorSettings with_step(IntegrationMethod method, double step, int stages = 1) {
  IntegratorSettings settings;
  settings.label = "fixed";
  settings.method = method;
  settings.stages = stages;
  settings.step_canonical = step;
  return settings;
}

IntegratorSettings with_tolerance(IntegrationMethod method, double tolerance) {
  IntegratorSettings settings;
  settings.label = "adaptive";
  settings.method = method;
  settings.tolerance = tolerance;
  return settings;
}

RunResult run(Scene scene, const IntegratorSettings& settings) {
  scene.integrators = {settings};
  RunResult result = propagate(scene).runs[0];
  EXPECT_EQ(result.failure, "");
  return result;
}

SelfCheck check(const Scene& scene, const RunResult& run, SelfCheckName name) {
  const auto all = self_checks(scene, run);
  EXPECT_EQ(all.size(), self_check_names().size());
  return all[static_cast<std::size_t>(name)];
}

void expect_state(const SelfCheck& check, SelfCheckState state, const std::string& text = "") {
  EXPECT_EQ(name_of(check.state), name_of(state)) << check.text;
  EXPECT_NE(check.text.find(text), std::string::npos) << check.text;
  EXPECT_GE(check.seconds, 0);
  if (state == SelfCheckState::passed || state == SelfCheckState::failed) return;
  EXPECT_FALSE(check.value);
  EXPECT_FALSE(check.limit);
}

Scene good_scene() {
  Scene scene = paper_chief(3);
  scene.system.radius_km = 6378.137;
  scene.duration = 12;  // a revolution and some
  scene.kinds = {"F1", "F2"};
  return scene;
}

const RunResult& good_run() {
  static const RunResult result = run(good_scene(), precise_gauss());
  return result;
}

TEST(SelfChecks, AllPassOnAGoodRun) {
  EXPECT_TRUE(good_run().failed_checks.empty());
  ASSERT_EQ(good_run().checks.size(), self_check_count);
  for (const SelfCheck& entry : good_run().checks) {
    expect_state(entry, SelfCheckState::passed);
    ASSERT_TRUE(entry.value);
    EXPECT_TRUE(std::isfinite(*entry.value));
  }
}

TEST(SelfChecks, ThatAreOffDoNothing) {
  Scene scene = good_scene();
  for (std::size_t i = 0; i < self_check_count; ++i) {
    scene.checks[static_cast<SelfCheckName>(i)].is_on = false;
  }
  const RunResult result = run(scene, with_step(IntegrationMethod::gauss, 0.05, 4));
  for (const SelfCheck& entry : result.checks) {
    expect_state(entry, SelfCheckState::off, "turned off in the scene");
    EXPECT_EQ(entry.seconds, 0);
  }
  EXPECT_FALSE(result.lowest_point);
  EXPECT_FALSE(result.inversion);
  EXPECT_FALSE(result.error_estimate.by_degree);
  EXPECT_FALSE(result.statistics.largest_step_error);
}

TEST(SelfChecks, FiniteFindsEveryKindOfNumber) {
  const Scene scene = good_scene();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_found = [&](const std::string& place, const auto& spoil) {
    RunResult wrong = good_run();
    spoil(wrong);
    const SelfCheck found = check(scene, wrong, SelfCheckName::finite);
    expect_state(found, SelfCheckState::failed, "the first in " + place);
    EXPECT_EQ(found.value, 1);
  };
  expect_found("the jet", [&](RunResult& r) { r.jet[4][7] = Extended(nan); });
  // Finite in extended precision, but not in the double precision in which it is stored.
  expect_found("the jet", [&](RunResult& r) { r.jet[4][7] = Extended("1e400"); });
  expect_found("the nominal", [&](RunResult& r) { r.nominal_final[2] = -1 / 0.0; });
  expect_found("the nominal", [&](RunResult& r) { r.nominal[3].state[1] = nan; });
  expect_found("the energy", [&](RunResult& r) { r.energy_error = nan; });
  expect_found("the exactness of F2",
               [&](RunResult& r) { r.kinds[1].by_degree[2].residual.scaled = nan; });
  expect_found("the symplecticity", [&](RunResult& r) { r.symplecticity[1].absolute = nan; });
  expect_found("the generating function F1",
               [&](RunResult& r) { (*r.kinds[0].generating_function)[5] = Extended(nan); });
  Scene extended = scene;
  extended.precision = Precision::extended;
  RunResult large = good_run();
  large.jet[4][7] = Extended("1e400");
  expect_state(check(extended, large, SelfCheckName::finite), SelfCheckState::passed);
}

TEST(SelfChecks, ConvergenceCountsIterations) {
  Scene scene = good_scene();
  const SelfCheck passed = check(scene, good_run(), SelfCheckName::convergence);
  EXPECT_EQ(passed.value, 0);  // of Newton's method, for fixed-point iteration contracts
  expect_state(passed, SelfCheckState::passed, "fixed-point");
  // The midpoint rule's stage is q = 2.26, where an iteration has the factor
  // tau^2 (6 q^2 - 1) / 4 = 1.2.
  Scene stiff = scene;
  stiff.system = {};
  stiff.system.model = SystemModel::double_well;
  stiff.nominal = {3, 0};
  stiff.variables = {0, 1};
  stiff.kinds.reset();
  stiff.duration = 0.4;
  const RunResult newton = run(stiff, with_step(IntegrationMethod::gauss, 0.4));
  const SelfCheck counted = check(stiff, newton, SelfCheckName::convergence);
  EXPECT_GE(*counted.value, 1);
  EXPECT_LE(*counted.value, 40);  // the most that the method allows
  scene.checks[SelfCheckName::convergence].limit = 0.5;
  expect_state(check(scene, newton, SelfCheckName::convergence), SelfCheckState::failed,
               "iterations in a step");
  scene.kinds.reset();
  scene.duration = 1;
  const RunResult newmark = run(scene, with_step(IntegrationMethod::newmark, 0.01));
  EXPECT_GE(check(good_scene(), newmark, SelfCheckName::convergence).value, 1);
  for (const auto method : {IntegrationMethod::stormer, IntegrationMethod::velocity_verlet,
                            IntegrationMethod::fehlberg78}) {
    expect_state(check(scene, run(scene, with_step(method, 0.01)), SelfCheckName::convergence),
                 SelfCheckState::not_applicable, "explicit");
  }
}

TEST(SelfChecks, StepErrorOfAdaptiveSteps) {
  Scene scene = good_scene();
  scene.kinds.reset();
  for (const auto method : {IntegrationMethod::gauss, IntegrationMethod::fehlberg78}) {
    for (const double tolerance : {1e-4, 1e-10}) {
      const RunResult result = run(scene, with_tolerance(method, tolerance));
      const SelfCheck passed = check(scene, result, SelfCheckName::step_error);
      expect_state(passed, SelfCheckState::passed, "of the tolerance");
      // Steps are chosen to use the tolerance, not a thousandth of it.
      EXPECT_GE(*passed.value, 1e-3 * tolerance);
      EXPECT_LE(*passed.value, *passed.limit);
      RunResult wrong = result;
      wrong.statistics.largest_step_error = 11 * tolerance;
      expect_state(check(scene, wrong, SelfCheckName::step_error), SelfCheckState::failed);
    }
  }
}

TEST(SelfChecks, StepErrorOfFixedSteps) {
  Scene scene = good_scene();
  scene.kinds.reset();
  // Coarse and sensible; a fifth of a revolution, which resolves nothing.
  const RunResult coarse = run(scene, with_step(IntegrationMethod::gauss, 0.05));
  expect_state(check(scene, coarse, SelfCheckName::step_error), SelfCheckState::passed);
  const RunResult wrong = run(scene, with_step(IntegrationMethod::gauss, 0.6));
  expect_state(check(scene, wrong, SelfCheckName::step_error), SelfCheckState::failed,
               "too large to resolve the motion");
  const RunResult verlet = run(scene, with_step(IntegrationMethod::velocity_verlet, 0.01));
  expect_state(check(scene, verlet, SelfCheckName::step_error), SelfCheckState::not_applicable,
               "estimates no local error");
}

TEST(SelfChecks, FastModeThatTheStepDoesNotResolve) {
  // omega = 1000 and a step of 1: midpoint stays stable and bounded, and shows nothing of it.
  Scene scene;
  scene.system.model = SystemModel::harmonic_oscillator;
  scene.system.stiffness_N_per_m = 1e6;
  scene.nominal = {1, 0};
  scene.duration = 100;
  scene.order = 1;
  scene.variables = {0, 1};
  const RunResult stiff = run(scene, with_step(IntegrationMethod::gauss, 1));
  expect_state(check(scene, stiff, SelfCheckName::step_error), SelfCheckState::failed);
  expect_state(check(scene, stiff, SelfCheckName::energy), SelfCheckState::passed);
  expect_state(check(scene, stiff, SelfCheckName::symplecticity), SelfCheckState::passed);
}

TEST(SelfChecks, EnergyOfADetachedRoot) {
  // Kepler, e = 0.9, one midpoint step of 0.15: Newton's iteration from the start converges to a
  // root with E = +0.5519 instead of -0.5 (midpoint_wrong_root of reference_cases.json). The map is
  // symplectic all the same.
  Scene scene = kepler_chief(0.9, 1, 1, 1);
  RunResult wrong;
  wrong.settings = with_step(IntegrationMethod::gauss, 0.15);
  wrong.statistics.steps = 1;
  wrong.energy.initial = -0.5;
  wrong.energy.largest_change = 0.5519 + 0.5;
  wrong.energy.initial_terms = 0.5 + 10 + 19;  // |H| + 1/r + p^2
  wrong.energy.largest_terms = wrong.energy.initial_terms;
  wrong.symplecticity = {{0, 1e-16, 1e-16}};
  const SelfCheck energy = check(scene, wrong, SelfCheckName::energy);
  expect_state(energy, SelfCheckState::failed, "changed by 1.05 from -0.5");
  EXPECT_NEAR(*energy.value, 1.0519 / 0.5, 1e-12);
  expect_state(check(scene, wrong, SelfCheckName::symplecticity), SelfCheckState::passed);
  // The connected root of a step of 0.01 has E = -0.5275: coarse, and passed.
  wrong.energy.largest_change = 0.0275;
  expect_state(check(scene, wrong, SelfCheckName::energy), SelfCheckState::passed);
  wrong.energy.largest_change = std::numeric_limits<double>::infinity();
  const SelfCheck infinite = check(scene, wrong, SelfCheckName::energy);
  expect_state(infinite, SelfCheckState::failed);
  EXPECT_FALSE(infinite.value);
}

TEST(SelfChecks, EnergyOfAnUnstableExplicitMethod) {
  // At perigee of e = 0.9 the orbit turns with omega = sqrt(19) / 0.1 = 44, and Verlet is stable
  // for omega tau < 2. (On a linear system such steps are refused.)
  Scene scene = good_scene();
  scene.system = {};
  scene.system.model = SystemModel::kepler;
  scene.nominal = {0.1, 0, 0, 0, std::sqrt(19.0), 0};
  scene.order = 1;
  scene.kinds.reset();
  const auto verlet = [&](double step) {
    return check(scene, run(scene, with_step(IntegrationMethod::velocity_verlet, step)),
                 SelfCheckName::energy);
  };
  expect_state(verlet(0.001), SelfCheckState::passed);
  expect_state(verlet(0.1), SelfCheckState::failed, "steps that are too large");
}

TEST(SelfChecks, EnergyLimitFollowsTheTolerance) {
  Scene scene = good_scene();
  scene.kinds.reset();
  for (const double tolerance : {1e-6, 1e-12}) {
    const RunResult result = run(scene, with_tolerance(IntegrationMethod::fehlberg78, tolerance));
    const SelfCheck passed = check(scene, result, SelfCheckName::energy);
    expect_state(passed, SelfCheckState::passed);
    EXPECT_LE(*passed.limit, 1e5 * tolerance);
    RunResult wrong = result;
    wrong.energy.largest_change = 2e5 * tolerance;
    expect_state(check(scene, wrong, SelfCheckName::energy), SelfCheckState::failed);
  }
}

TEST(SelfChecks, EnergyOfAParabola) {
  // H = 0 up to rounding: the change is judged by the terms that cancel in it.
  Scene scene = kepler_chief(1, 1, 1, 1);
  scene.duration = 5;
  const RunResult result = run(scene, precise_gauss());
  EXPECT_LE(std::abs(result.energy.initial), 1e-15);
  EXPECT_NEAR(result.energy.initial_terms, 1 + 2, 1e-12);  // 1/r + p^2
  expect_state(check(scene, result, SelfCheckName::energy), SelfCheckState::passed);
}

TEST(SelfChecks, Symplecticity) {
  const Scene scene = good_scene();
  RunResult wrong = good_run();
  wrong.jet[0][1] *= 1 + Extended(1e-9);
  wrong.symplecticity = symplecticity_by_degree<Extended>(wrong.jet);
  const SelfCheck failed = check(scene, wrong, SelfCheckName::symplecticity);
  expect_state(failed, SelfCheckState::failed, "more than rounding explains");
  // Beyond a millionth a map is of no use, whatever made it so.
  RunResult useless = good_run();
  useless.jet[0][1] *= 1 + Extended(1e-3);
  useless.statistics.steps = 1000000000000000;
  useless.symplecticity = symplecticity_by_degree<Extended>(useless.jet);
  expect_state(check(scene, useless, SelfCheckName::symplecticity), SelfCheckState::failed,
               "which rounding may explain");
  // A coefficient of degree 3 alone, as a composition of arcs that lost its digits leaves them:
  // the linear part stays symplectic, the brackets of degree 2 do not.
  RunResult high = good_run();
  high.jet[0][SeriesSpace::create(6, 2)->size()] *= 1 + Extended(1e-6);
  high.symplecticity = symplecticity_by_degree<Extended>(high.jet);
  EXPECT_LE(high.symplecticity[0].scaled, 1e-13);
  expect_state(check(scene, high, SelfCheckName::symplecticity), SelfCheckState::failed,
               "brackets of degree 2");
  Scene short_scene = scene;
  short_scene.kinds.reset();
  short_scene.duration = 1;
  expect_state(check(scene, run(short_scene, with_step(IntegrationMethod::newmark, 0.01)),
                     SelfCheckName::symplecticity),
               SelfCheckState::not_applicable, "other variables");
  expect_state(check(scene, run(short_scene, with_tolerance(IntegrationMethod::fehlberg78, 1e-9)),
                     SelfCheckName::symplecticity),
               SelfCheckState::not_applicable, "fehlberg78 is not symplectic");
  short_scene.variables = {0, 1};
  expect_state(check(scene, run(short_scene, precise_gauss()), SelfCheckName::symplecticity),
               SelfCheckState::not_applicable, "not expanded in all variables");
}

TEST(SelfChecks, InversionThatIsNone) {
  const Scene scene = good_scene();
  RunResult wrong = good_run();
  ASSERT_TRUE(wrong.inversion);
  EXPECT_EQ(wrong.inversion->kinds, 2);
  EXPECT_LE(wrong.inversion->miss, 1e-26);
  wrong.inversion->miss = 1e-14;
  const SelfCheck failed = check(scene, wrong, SelfCheckName::inversion);
  expect_state(failed, SelfCheckState::failed, "misses the identity by 1e-14");
  EXPECT_EQ(failed.value, 1e-14);
  EXPECT_EQ(failed.limit, std::numeric_limits<double>::epsilon());
  wrong.inversion->miss = std::numeric_limits<double>::infinity();
  expect_state(check(scene, wrong, SelfCheckName::inversion), SelfCheckState::failed);
  Scene none = scene;
  none.kinds.reset();
  expect_state(check(none, wrong, SelfCheckName::inversion), SelfCheckState::not_applicable,
               "no generating function");
}

TEST(SelfChecks, InversionThatIsIllConditioned) {
  // Near t = pi the oscillator's F1 has dq/dp0 = sin t, here 1e-13: refused only from 1e-14 on.
  Scene scene;
  scene.system.model = SystemModel::harmonic_oscillator;
  scene.nominal = {1, 0};
  scene.order = 2;
  scene.variables = {0, 1};
  scene.kinds = {"F2", "F1"};
  scene.duration = 3.14159265358979 - 1e-12;
  const RunResult near = run(scene, precise_gauss());
  const SelfCheck failed = check(scene, near, SelfCheckName::inversion);
  expect_state(failed, SelfCheckState::failed, "F1 is ill-conditioned");
  EXPECT_GE(near.inversion->amplification, 1e12);
  scene.duration = 3.1;
  expect_state(check(scene, run(scene, precise_gauss()), SelfCheckName::inversion),
               SelfCheckState::passed);
}

TEST(SelfChecks, SurfaceBetweenSteps) {
  // Kepler with e = 0.3 from apogee: r = 1.3 there and a (1 - e) = 0.7 at perigee, half a period
  // pi later (a = 1). Few, long steps have no point near it.
  Scene scene = paper_chief(1);
  scene.system.J[2] = 0;
  scene.system.J[3] = 0;
  scene.units = {1000, 1000};
  scene.nominal = {1.3, 0, 0, 0, std::sqrt(0.7 / 1.3), 0};
  scene.duration = 6;
  scene.system.radius_km = 800;
  const RunResult result = run(scene, with_step(IntegrationMethod::gauss, 1.2, 8));
  ASSERT_TRUE(result.lowest_point);
  EXPECT_NEAR(result.lowest_point->distance, 0.7, 1e-8);
  EXPECT_NEAR(result.lowest_point->time, std::numbers::pi, 1e-5);
  for (const NominalPoint& point : result.nominal) {
    EXPECT_GT(std::hypot(point.state[0], point.state[1]), 0.75);  // between points indeed
  }
  const SelfCheck failed = check(scene, result, SelfCheckName::surface);
  expect_state(failed, SelfCheckState::failed, "100 km below the surface at t = 3141.5");
  EXPECT_NEAR(*failed.value, 700, 1e-5);
  EXPECT_EQ(failed.limit, 800);
  scene.checks[SelfCheckName::surface].limit = 690;
  expect_state(check(scene, result, SelfCheckName::surface), SelfCheckState::passed,
               "10 km above the distance of 690 km");
  // Backwards in time, from apogee the same.
  scene.duration = -6;
  const RunResult back = run(scene, with_step(IntegrationMethod::gauss, 1.2, 8));
  EXPECT_NEAR(back.lowest_point->distance, 0.7, 1e-8);
  EXPECT_NEAR(back.lowest_point->time, -std::numbers::pi, 1e-5);
  // Turning back before the perigee, the end is the lowest point.
  scene.duration = 2;
  const RunResult half = run(scene, precise_gauss());
  EXPECT_EQ(half.lowest_point->time, 2);
  scene.system.radius_km = 0;
  expect_state(check(scene, half, SelfCheckName::surface), SelfCheckState::not_applicable,
               "no radius");
}

TEST(SelfChecks, SurfaceWhereTheNominalCannotBeFollowed) {
  // A step of the fall from rest that jumps over the centre: r.v changes sign, and in between lies
  // a collision.
  const Scene scene = good_scene();
  RunResult wrong = good_run();
  wrong.lowest_point->failure = "a collision";
  wrong.lowest_point->failure_time = 1;
  expect_state(check(scene, wrong, SelfCheckName::surface), SelfCheckState::failed,
               "cannot be followed down: a collision");
}

}  // namespace
}  // namespace hamjet
