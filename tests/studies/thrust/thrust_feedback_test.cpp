#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "energy_optimal_flights.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"

// The law of feedback beside the open loop, the test's own program, and a closed form.

namespace hamjet::thrusted {
namespace {

std::vector<double> six(const RelativeState& state) {
  return {state.position_m[0],   state.position_m[1],   state.position_m[2],
          state.velocity_m_s[0], state.velocity_m_s[1], state.velocity_m_s[2]};
}

Eigen::Vector3d thrust_of(const FeedbackInstant& instant, const RelativeState& state) {
  MonomialValues values(instant.thrust.front().space_pointer());
  values.set_point(six(state));
  Eigen::Vector3d thrust;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Series<double>& one = instant.thrust[static_cast<std::size_t>(i)];
    thrust[i] = values.value(one, one.order());
  }
  return thrust;
}

// Asked anew on the way, polynomials of order 3 arrive and cost as the open loop that flying
// corrected; uncorrected, the open loop of the same order misses by more.
TEST(ThrustFeedback, AFlightByTheLawArrivesAndCostsAsTheOpenLoop) {
  Scene scene = thrust_scene(30e3, {4.0});
  std::vector<double> misses;
  for (const int instants : {2, 8, 16}) {
    scene.transfer->feedback = instants;
    const TransferResult result = study_transfer(scene);
    ASSERT_TRUE(result.thrust && result.thrust->least) << result.thrust->failure;
    const EnergyOptimalTransfer& open = result.thrust->transfers.front();
    ASSERT_TRUE(result.thrust->feedback);
    const FeedbackLaw& law = *result.thrust->feedback;
    ASSERT_EQ(law.failure, "");
    ASSERT_EQ(law.instants.size(), static_cast<std::size_t>(instants));
    misses.push_back(law.miss_m);
    EXPECT_LT(law.miss_m, open.answers.back().miss_m);
    // The energy is stationary at the optimum, so that errors of the law cost their squares.
    EXPECT_NEAR(law.energy_m2_s3, open.energy_m2_s3, 1e-5 * open.energy_m2_s3);
    EXPECT_NEAR(law.change_m_s, open.change_m_s, 1e-3 * open.change_m_s);
    // At the first instant the law is the thrust of the uncorrected answer.
    const Eigen::Vector3d first = thrust_of(law.instants.front(), scene.transfer->start);
    EXPECT_LT((first - open.start_thrust_m_s2).norm(), 1e-3 * open.start_thrust_m_s2.norm());
  }
  EXPECT_LT(misses[1], 0.1 * misses[0]);
  // More instants leave what the flights round.
  EXPECT_LT(misses[2], 1e-6);
}

// On the way the law is the thrust of the optimal flight that the test's own program has there.
TEST(ThrustFeedback, OnTheOptimalWayTheLawIsItsThrust) {
  Scene scene = thrust_scene(3e3, {4.0});
  scene.transfer->feedback = 4;
  scene.transfer->refined_miss_m = 1e-5;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust->feedback);
  const EnergyOptimalTransfer& open = result.thrust->transfers.front();
  const MetricUnits units = units_of(scene);
  for (const FeedbackInstant& instant : result.thrust->feedback->instants) {
    const Numbers deputy =
        flown(start_of(scene, scene.transfer->start, open.refined->costates), instant.time);
    const Numbers chief =
        flown(start_of(scene, RelativeState(), std::vector<double>(6)), instant.time);
    const ChiefFrame frame(state_of(chief), units, scene.transfer->frame);
    std::vector<double> deviation;
    for (std::size_t i = 0; i < 6; ++i) {
      deviation.push_back(static_cast<double>(deputy[i] - chief[i]));
    }
    const Eigen::Vector3d thrust(static_cast<double>(-deputy[9]), static_cast<double>(-deputy[10]),
                                 static_cast<double>(-deputy[11]));
    const Eigen::Vector3d expected =
        frame.along_axes(thrust) * (units.velocity_m_s() / units.time_s);
    // Order 3 leaves out the fourth power of 3 km in 7000 km.
    EXPECT_LT((thrust_of(instant, frame.relative(deviation)) - expected).norm(),
              1e-7 * open.largest_m_s2);
  }
}

// Across the plane of a circle the motion is an oscillator of frequency 1, z'' = -z + u. To bring
// it to rest at 0 in time T costs least by u = -B^T e^(A^T T)... with the Gramian W of the time to
// go: u = -B^T Phi^T W^-1 Phi x, where Phi = [[c, s], [-s, c]] and W = integral of Phi B B^T Phi^T,
// [[T - s c, s^2], [s^2, T + s c]] / 2 with s = sin T, c = cos T.
TEST(ThrustFeedback, AcrossACircleTheLinearLawIsTheOscillators) {
  Scene scene = kepler_chief(0, 7000, std::sqrt(std::pow(7000, 3) / 398600.4415), 1);
  TransferSettings settings;
  settings.start.position_m = {0, -100, 50};
  settings.times = {4.0};
  settings.thrust = TransferThrust::energy_optimal;
  settings.thrust_order = 1;
  settings.feedback = 5;
  scene.transfer = settings;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust->feedback);
  const FeedbackLaw& law = *result.thrust->feedback;
  ASSERT_EQ(law.failure, "");
  const double rate = 1 / scene.units.time_s;
  for (const FeedbackInstant& instant : law.instants) {
    const double T = 4.0 - instant.time;
    const double s = std::sin(T), c = std::cos(T);
    Eigen::Matrix2d phi, gramian;
    phi << c, s, -s, c;
    gramian << (T - s * c) / 2, s * s / 2, s * s / 2, (T + s * c) / 2;
    const Eigen::RowVector2d gain = -(phi.transpose() * gramian.inverse() * phi).bottomRows<1>();
    const Series<double>& normal = instant.thrust[2];
    const SeriesSpace& space = normal.space();
    EXPECT_NEAR(normal[space.linear_index(2)], gain[0] * rate * rate,
                1e-9 * std::abs(gain[0]) * rate * rate);
    EXPECT_NEAR(normal[space.linear_index(5)], gain[1] * rate, 1e-9 * std::abs(gain[1]) * rate);
    for (const std::size_t other : {0, 1, 3, 4}) {
      EXPECT_LT(std::abs(normal[space.linear_index(other)]), 1e-12);
    }
  }
}

}  // namespace
}  // namespace hamjet::thrusted
