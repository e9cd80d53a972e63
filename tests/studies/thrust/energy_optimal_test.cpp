#include "hamjet/detail/studies/energy_optimal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "energy_optimal_flights.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet::thrusted {
namespace {

// A program of the test's own flies the costates from the start to the end that the scene wants,
// and finds the same energy.
TEST(EnergyOptimal, CostatesLeadToTheEndInAnotherProgram) {
  const Scene scene = thrust_scene(10e3, {2.0, 5.0});
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust);
  ASSERT_EQ(result.thrust->transfers.size(), 2U);
  const MetricUnits units = units_of(scene);
  for (const EnergyOptimalTransfer& transfer : result.thrust->transfers) {
    ASSERT_TRUE(transfer.is_found()) << transfer.failure;
    const Numbers deputy =
        flown(start_of(scene, scene.transfer->start, transfer.refined->costates), transfer.time);
    const Numbers wanted = wanted_end(scene, transfer.time);
    double miss_m = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      miss_m = std::hypot(miss_m, static_cast<double>(deputy[i] - wanted[i]));
    }
    // Both flights are right to some 1e-7 m, and the thrust was corrected to 1e-4 m.
    EXPECT_LT(miss_m * units.length_m, 2e-4);
    const double energy = static_cast<double>(deputy[12]) * energy_unit(scene);
    EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-9 * energy);
    // Schwarz's inequality: (integral of |u|)^2 <= 2 T integral of |u|^2 / 2.
    EXPECT_LT(transfer.change_m_s * transfer.change_m_s,
              2 * transfer.time * units.time_s * transfer.energy_m2_s3);
    EXPECT_GT(transfer.change_m_s, 0);
  }
}

// At e = 0.9 the thrust changes within a hundredth of the revolution about the perigee.
TEST(EnergyOptimal, EnergyOfAnEccentricOrbitIsThatOfAnotherProgram) {
  Scene scene = thrust_scene(1e3, {0.7 * 2 * std::numbers::pi * std::pow(10.0, 1.5)});
  scene.nominal = {1, 0, 0, 0, std::sqrt(1.9) * 0.6, std::sqrt(1.9) * 0.8};
  scene.duration = scene.transfer->times[0];
  const TransferResult result = study_transfer(scene);
  const EnergyOptimalTransfer& transfer = result.thrust->transfers.at(0);
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  const Numbers deputy =
      flown(start_of(scene, scene.transfer->start, transfer.refined->costates), transfer.time);
  const double energy = static_cast<double>(deputy[12]) * energy_unit(scene);
  EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-9 * energy);
}

// Order k misses by a constant times separation^(k+1), and its energy, which is stationary, is
// wrong by separation^(k+2).
TEST(EnergyOptimal, MissesAndEnergiesFallByOrderAndSeparation) {
  std::vector<EnergyOptimalTransfer> transfers;
  for (const double separation : {200e3, 100e3}) {
    Scene scene = thrust_scene(separation, {4.0});
    // The end too shrinks with the separation.
    scene.transfer->end.position_m = {0, separation / 100, 0};
    transfers.push_back(study_transfer(scene).thrust->transfers.front());
    ASSERT_TRUE(transfers.back().is_found()) << transfers.back().failure;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto miss = [&](std::size_t i) { return transfers[i].answers[k].miss_m; };
    const auto wrong = [&](std::size_t i) {
      return std::abs(transfers[i].answers[k].energy_m2_s3 / transfers[i].energy_m2_s3 - 1);
    };
    const double order = static_cast<double>(k) + 1;
    EXPECT_NEAR(std::log2(miss(0) / miss(1)), order + 1, 0.35) << "order " << order;
    EXPECT_NEAR(std::log2(wrong(0) / wrong(1)), order, 0.6) << "order " << order;
  }
}

// The least energy is a function of the start whose gradient the costates are.
TEST(EnergyOptimal, CostatesAreTheGradientOfTheEnergy) {
  const Scene scene = thrust_scene(10e3, {3.0});
  const EnergyOptimalTransfer middle = study_transfer(scene).thrust->transfers.front();
  ASSERT_TRUE(middle.is_found()) << middle.failure;
  const MetricUnits units = units_of(scene);
  const double unit = energy_unit(scene);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -1).normalized();
  std::vector<double> energies;
  constexpr double step_m = 100;
  for (const double sign : {1.0, -1.0}) {
    Scene moved = scene;
    moved.transfer->start.position_m += sign * step_m * direction;
    const EnergyOptimalTransfer one = study_transfer(moved).thrust->transfers.front();
    ASSERT_TRUE(one.is_found()) << one.failure;
    energies.push_back(one.energy_m2_s3);
  }
  // A displacement in the turning frame moves the velocity too.
  const ChiefFrame frame(scene.nominal, units, scene.transfer->frame);
  const std::vector<double> displacement =
      frame.deviation({direction * step_m, Eigen::Vector3d::Zero()});
  double expected = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    expected += displacement[i] * middle.refined->costates[i] * unit;
  }
  // The energy is nearly quadratic, for which a central difference is exact; its cubic part is that
  // of a separation of 10 km in 7000.
  EXPECT_NEAR((energies[0] - energies[1]) / 2, expected, 1e-4 * std::abs(expected));
}

// The thrust along the way begins and ends as it is told to, is that of the costates that the test
// flies in between, and its integral by Simpson's rule is the change.
TEST(EnergyOptimal, ProfileIsThatOfTheCostates) {
  const Scene scene = thrust_scene(10e3, {2.0, 5.0});
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust && result.thrust->least);
  const EnergyOptimalTransfer& least = result.thrust->transfers[*result.thrust->least];
  const std::vector<ThrustSample>& profile = result.thrust->profile;
  ASSERT_GE(profile.size(), 49U);
  ASSERT_EQ(profile.size() % 2, 1U);
  EXPECT_EQ(profile.front().time, 0);
  EXPECT_EQ(profile.back().time, least.time);
  const double size = least.largest_m_s2;
  EXPECT_LT((profile.front().thrust_m_s2 - least.start_thrust_m_s2).norm(), 1e-12 * size);
  EXPECT_LT((profile.back().thrust_m_s2 - least.end_thrust_m_s2).norm(), 1e-9 * size);
  const MetricUnits units = units_of(scene);
  const std::size_t middle = profile.size() / 2;
  const Numbers deputy =
      flown(start_of(scene, scene.transfer->start, least.refined->costates), profile[middle].time);
  const Numbers chief =
      flown(start_of(scene, RelativeState(), std::vector<double>(6)), profile[middle].time);
  const Eigen::Vector3d thrust(static_cast<double>(-deputy[9]), static_cast<double>(-deputy[10]),
                               static_cast<double>(-deputy[11]));
  const ChiefFrame frame(state_of(chief), units, scene.transfer->frame);
  const Eigen::Vector3d along = frame.along_axes(thrust) * (units.velocity_m_s() / units.time_s);
  EXPECT_LT((profile[middle].thrust_m_s2 - along).norm(), 1e-8 * size);
  double change = 0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const bool is_end = k == 0 || k + 1 == profile.size();
    change += profile[k].thrust_m_s2.norm() * (is_end ? 1 : k % 2 == 1 ? 4 : 2);
  }
  change *= least.time * units.time_s / static_cast<double>(profile.size() - 1) / 3;
  EXPECT_NEAR(change, least.change_m_s, 1e-4 * change);
}

// Where a thruster is too weak, the study tells by how much.
TEST(EnergyOptimal, ThrusterTooWeakIsTold) {
  Scene scene = thrust_scene(10e3, {2.0, 5.0});
  scene.transfer->largest_thrust_m_s2 = 1e-6;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust);
  EXPECT_FALSE(result.thrust->least);
  EXPECT_TRUE(result.thrust->transfers[0].exceeds_thrust);
  EXPECT_NE(result.thrust->failure.find("largest_thrust_m_s2"), std::string::npos)
      << result.thrust->failure;
  EXPECT_EQ(exit_code(result), 1);
}

// No flight misses by less than the rounding of a position, a nanometre.
TEST(EnergyOptimal, AThrustThatIsNotCorrectedIsSaid) {
  Scene scene = thrust_scene(10e3, {2.0});
  scene.transfer->refined_miss_m = 1e-12;  // below the rounding of a position
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust);
  EXPECT_FALSE(result.thrust->least);
  EXPECT_NE(result.thrust->failure.find("was not corrected to 1e-12 m"), std::string::npos)
      << result.thrust->failure;
  EXPECT_EQ(result.thrust->failure, result.thrust->transfers[0].failure);
  EXPECT_NE(exit_code(result), 0);
}

}  // namespace
}  // namespace hamjet::thrusted
