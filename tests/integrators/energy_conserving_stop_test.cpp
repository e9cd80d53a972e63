#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "energy_conserving_runs.hpp"

// Places at which the step equation has no root: the predicted place is compared with the observed
// one.

namespace hamjet {
namespace {

using test::kepler_period;
using test::kepler_state;
using test::run_energy_conserving;
using Cause = EnergyConservingStopCause;
using Method = EnergyConservingMethod;

void expect_message(const EnergyConservingStop& stop, const std::vector<std::string>& words) {
  const std::string head = "step " + std::to_string(stop.step) + " at t = ";
  EXPECT_NE(stop.message.find(head), std::string::npos) << stop.message;
  for (const std::string& word : words) {
    EXPECT_NE(stop.message.find(word), std::string::npos) << stop.message;
  }
  EXPECT_EQ(stop.message.find('\n'), std::string::npos);
}

// Expected: G of Kepler's problem changes sign at r = x a, 2 x^2 - 3 x + 3 (1 - e^2) = 0, real for
// e^2 >= 5/8. The stop is at the first such place, from 1 last step before it to 1/2 behind (the
// cubic 4 x^3 - 3 x - 1 of the step equation), so that the places converge with the step size.
TEST(EnergyConservingStops, MidpointWhereGChangesSign) {
  const DynamicalSystem system = kepler();
  for (const double e : {0.8, 0.85, 0.9}) {
    const double predicted = (3 - std::sqrt(24 * e * e - 15)) / 4 / (1 - e);
    double distance_before = 1;
    for (const double step : {0.01, 0.001, 0.0001}) {
      const auto run = run_energy_conserving<double>(
          {system, Method::midpoint, kepler_state(e, 0), step, kepler_period(e)});
      ASSERT_TRUE(run.result.stop);
      const EnergyConservingStop& stop = *run.result.stop;
      EXPECT_EQ(stop.cause, Cause::no_root);
      EXPECT_EQ(stop.step, run.result.steps);
      EXPECT_EQ(stop.time, run.result.time);
      ASSERT_TRUE(stop.steps_to_sign_change);
      EXPECT_GT(*stop.steps_to_sign_change, -0.6) << e << " " << step;
      EXPECT_LT(*stop.steps_to_sign_change, 1.1) << e << " " << step;
      expect_message(stop,
                     {"energy-conserving midpoint", "H(z_m) - E comes no nearer to 0", "G = "});
      // The first place: G is positive at the start of every step except perhaps the last steps.
      for (std::size_t k = 0; k + 1 < run.steps.size(); ++k) EXPECT_GT(run.steps[k].condition, 0);
      const auto& z = run.result.state;
      const double distance = std::abs(std::hypot(z[0], z[1]) - predicted);
      const double velocity = std::hypot(z[3], z[4]);
      EXPECT_LT(distance, 1.1 * velocity * run.result.last_step) << e << " " << step;
      EXPECT_LT(distance, distance_before);
      distance_before = distance;
    }
  }
}

// Expected: sqrt(5/8) = 0.7906 separates the eccentricities.
TEST(EnergyConservingStops, MidpointRunsBelowTheLimitingEccentricity) {
  const DynamicalSystem system = kepler();
  for (const double e : {0.3, 0.6, 0.75, 0.785}) {
    EXPECT_FALSE(integrate_energy_conserving<double>(
                     {system, Method::midpoint, kepler_state(e, 0), 0.01, 3 * kepler_period(e)})
                     .stop)
        << e;
  }
  EXPECT_TRUE(integrate_energy_conserving<double>(
                  {system, Method::midpoint, kepler_state(0.796, 0), 0.01, kepler_period(0.796)})
                  .stop);
}

// Expected: G > 0 all along the paper's orbit (e = 0.3, below the limit, oblateness of order 1e-3),
// so that the midpoint method completes its 10 pi. The errata's statement on "parts of the paper's
// own orbit" is about Störmer's method.
TEST(EnergyConservingStops, MidpointCompletesTheOrbitOfThePaper) {
  const auto& orbit = test::paper_orbit();
  const DynamicalSystem system = zonal_gravity(orbit.field);
  const auto run =
      run_energy_conserving<double>({system, Method::midpoint, orbit.start, 0.01, orbit.duration});
  EXPECT_FALSE(run.result.stop);
  for (const auto& step : run.steps) EXPECT_GT(step.condition, 0);
  const auto stormer =
      run_energy_conserving<double>({system, Method::stormer, orbit.start, 0.01, orbit.duration});
  ASSERT_TRUE(stormer.result.stop);
  EXPECT_EQ(stormer.result.stop->step, 1);  // the orbit starts at perigee, a minimum of V
  EXPECT_EQ(stormer.result.stop->cause, Cause::reversed_root);
}

// Expected: G = (6 q^2 - 1) p^2 + (2 q^3 - q)^2, zero on the way over the barrier of the double
// well where p^2 = q^2 - q^4 + 2 H. A start where G < 0 defines an energy with which the method
// runs there, and stops where G turns positive: a sign of its own is no obstacle, only its change
// is.
TEST(EnergyConservingStops, MidpointInTheDoubleWell) {
  const DynamicalSystem system = double_well();
  const auto G = [](double q, double p) {
    return (6 * q * q - 1) * p * p + std::pow(2 * q * q * q - q, 2);
  };
  for (const bool is_outside : {true, false}) {
    const std::vector<double> start =
        is_outside ? std::vector<double>{1, 0.05} : std::vector<double>{0.1, 0.2};
    ASSERT_EQ(G(start[0], start[1]) > 0, is_outside);
    const auto run = run_energy_conserving<double>({system, Method::midpoint, start, 0.001, 50});
    ASSERT_TRUE(run.result.stop);
    EXPECT_EQ(run.result.stop->cause, Cause::no_root);
    EXPECT_GT(run.result.steps, 500);
    EXPECT_NEAR(run.result.stop->condition, G(run.result.state[0], run.result.state[1]), 1e-15);
    EXPECT_GT(*run.result.stop->steps_to_sign_change, -0.6);
    EXPECT_LT(*run.result.stop->steps_to_sign_change, 1.1);
    for (std::size_t k = 0; k + 1 < run.steps.size(); ++k) {
      EXPECT_EQ(run.steps[k].condition > 0, is_outside);
    }
  }
  // Below the barrier the oscillation goes on.
  EXPECT_FALSE(
      integrate_energy_conserving<double>({system, Method::midpoint, {0.99, 0}, 0.01, 50}).stop);
}

// Expected: the inequality (p.g)^2 < 2 g^2 (V(q_k) - V(q_(k-1))), evaluated here from the states,
// holds at the stop and nowhere before; to leading order that is (1 -+ sqrt e)/e last steps before
// apogee.
TEST(EnergyConservingStops, StormerBeforeApogee) {
  const DynamicalSystem system = kepler();
  for (const double e : {0.3, 0.6}) {
    const auto run = run_energy_conserving<double>(
        {system, Method::stormer, kepler_state(e, 0.5), 0.0002, kepler_period(e)});
    ASSERT_TRUE(run.result.stop);
    const EnergyConservingStop& stop = *run.result.stop;
    EXPECT_EQ(stop.cause, Cause::no_root);
    const auto discriminant = [](const std::vector<double>& z, const std::vector<double>& before) {
      const double r = std::hypot(z[0], z[1]);
      const double pg = (z[0] * z[3] + z[1] * z[4]) / (r * r * r);
      return pg * pg - 2 / std::pow(r, 4) * (1 / std::hypot(before[0], before[1]) - 1 / r);
    };
    for (std::size_t k = 1; k < run.steps.size(); ++k) {
      EXPECT_GT(discriminant(run.steps[k].start, run.steps[k - 1].start), 0);
    }
    EXPECT_LT(discriminant(run.result.state, run.steps.back().start), 0);
    EXPECT_GT(*stop.steps_to_sign_change, 0.95 * (1 - std::sqrt(e)) / e);
    EXPECT_LT(*stop.steps_to_sign_change, 1.05 * (1 + std::sqrt(e)) / e);
    expect_message(stop, {"(p.M^-1 g)^2 = ", " < 2 (g.M^-1 g) (V(q_k) - V(q_(k-1))) = "});
    const double period = kepler_period(e);
    const double perigee_to_start = 2 * std::atan(std::sqrt((1 - e) / (1 + e)) * std::tan(0.25));
    const double apogee =
        period / 2 - period / (2 * M_PI) * (perigee_to_start - e * std::sin(perigee_to_start));
    EXPECT_NEAR(stop.time, apogee, 10 * run.result.last_step);
  }
}

// Expected: past a minimum of V the wanted root is negative; the other root, which is positive and
// within a factor of two, is not taken.
TEST(EnergyConservingStops, StormerAtPerigee) {
  const DynamicalSystem system = kepler();
  const auto run =
      run_energy_conserving<double>({system, Method::stormer, kepler_state(1.5, -0.5), 0.001, 10});
  ASSERT_TRUE(run.result.stop);
  EXPECT_EQ(run.result.stop->cause, Cause::reversed_root);
  EXPECT_GT(run.result.stop->condition, 0);
  for (const auto& step : run.steps) EXPECT_LT(step.condition, 0);
  expect_message(*run.result.stop, {"against the direction of time", "belongs to no consistent"});
}

// Expected: from the top of the double well, q_0 = 0, the second root is half the first to leading
// order (V is even: h (b - a)/(2 b) with a = 0), and a little less because of the first step's own
// kick. The other causes are expected by their definitions.
TEST(EnergyConservingStops, OtherCauses) {
  const DynamicalSystem well = double_well();
  const DynamicalSystem orbit = kepler();
  const auto cause_of = [](const EnergyConservingProblem<double>& problem) {
    const auto result = integrate_energy_conserving<double>(problem);
    EXPECT_TRUE(result.stop);
    if (!result.stop) return Cause::no_root;
    expect_message(*result.stop, {});
    return result.stop->cause;
  };
  EXPECT_EQ(cause_of({well, Method::stormer, {0, 0.01}, 0.02, 1}), Cause::step_change);
  EXPECT_EQ(cause_of({well, Method::midpoint, {0.95, 0.1}, 1e-7, 1}), Cause::undetermined_step);
  EXPECT_EQ(cause_of({orbit, Method::midpoint, kepler_state(0.3, 0), 100, 1000}),
            Cause::no_midpoint);
  EXPECT_EQ(cause_of({orbit, Method::stormer, {0, 0, 0, 0, 1, 0}, 0.1, 1}), Cause::not_finite);
  // The energy of a particle at rest in equilibrium does not determine the step size.
  EXPECT_EQ(cause_of({well, Method::stormer, {0, 0}, 0.1, 1}), Cause::undetermined_step);
  EXPECT_EQ(cause_of({well, Method::midpoint, {0, 0}, 0.1, 1}), Cause::undetermined_step);
}

}  // namespace
}  // namespace hamjet
