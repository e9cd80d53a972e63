#include "hamjet/detail/studies/energy_optimal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "formation_scenes.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet {
namespace {

using Numbers = std::array<long double, 13>;  // q, v, their costates, and the energy so far

/// The paper's orbit and a deputy that comes from `separation_m` to rest beside the chief.
Scene thrust_scene(double separation_m, std::vector<double> times) {
  Scene scene = kepler_chief(0.3, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), 2);
  scene.nominal = {1, 0, 0, 0, 0.57, 0.98};
  TransferSettings settings;
  settings.start.position_m = Eigen::Vector3d(0.6, -0.7, 0.4).normalized() * separation_m;
  settings.start.velocity_m_s = Eigen::Vector3d(0.2, 0.1, -0.3) * (separation_m / 1000);
  settings.end.position_m = {0, 50, 0};
  settings.times = std::move(times);
  settings.thrust = TransferThrust::energy_optimal;
  settings.refined_miss_m = 1e-4;
  scene.transfer = settings;
  return scene;
}

/// Kepler's problem under u = -lambda_v, by hand: with g = -q/r^3, q'' = g + u, lambda_q' =
/// -(dg/dq) lambda_v, lambda_v' = -lambda_q, where (dg/dq) a = -a/r^3 + 3 q (q.a)/r^5.
Numbers derivative(const Numbers& z) {
  Numbers d{};
  const long double r2 = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
  const long double r3 = r2 * std::sqrt(r2);
  const long double along = z[0] * z[9] + z[1] * z[10] + z[2] * z[11];
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = z[3 + i];
    d[3 + i] = -z[i] / r3 - z[9 + i];
    d[6 + i] = z[9 + i] / r3 - 3 * z[i] * along / (r2 * r3);
    d[9 + i] = -z[6 + i];
    d[12] += z[9 + i] * z[9 + i] / 2;
  }
  return d;
}

/// The classical Runge-Kutta method in long double, which is right to 1e-13 with these steps.
Numbers flown(Numbers z, long double time) {
  constexpr int steps = 20000;
  const long double h = time / steps;
  const auto moved = [](const Numbers& a, const Numbers& b, long double factor) {
    Numbers sum = a;
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * b[i];
    return sum;
  };
  for (int k = 0; k < steps; ++k) {
    const Numbers k1 = derivative(z);
    const Numbers k2 = derivative(moved(z, k1, h / 2));
    const Numbers k3 = derivative(moved(z, k2, h / 2));
    const Numbers k4 = derivative(moved(z, k3, h));
    for (std::size_t i = 0; i < z.size(); ++i) {
      z[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }
  return z;
}

Numbers start_of(const Scene& scene, const RelativeState& relative,
                 const std::vector<double>& costates) {
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  const std::vector<double> deviation =
      ChiefFrame(scene.nominal, units, scene.transfer->frame).deviation(relative);
  Numbers z{};
  for (std::size_t i = 0; i < 6; ++i) {
    z[i] = static_cast<long double>(scene.nominal[i]) + deviation[i];
    z[6 + i] = costates[i];
  }
  return z;
}

// A program of the test's own flies the costates from the start to the end that the scene wants,
// and finds the same energy.
TEST(EnergyOptimal, CostatesLeadToTheEndInAnotherProgram) {
  const Scene scene = thrust_scene(10e3, {2.0, 5.0});
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust);
  ASSERT_EQ(result.thrust->transfers.size(), 2U);
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  for (const EnergyOptimalTransfer& transfer : result.thrust->transfers) {
    ASSERT_TRUE(transfer.is_found()) << transfer.failure;
    const Numbers deputy =
        flown(start_of(scene, scene.transfer->start, transfer.refined->costates), transfer.time);
    const Numbers chief =
        flown(start_of(scene, RelativeState(), std::vector<double>(6)), transfer.time);
    std::vector<double> chief_end;
    for (std::size_t i = 0; i < 6; ++i) chief_end.push_back(static_cast<double>(chief[i]));
    const std::vector<double> wanted =
        scene.transfer->end.deviation(chief_end, units, scene.transfer->frame);
    double miss_m = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      miss_m = std::hypot(miss_m, static_cast<double>(deputy[i] - chief[i] - wanted[i]));
    }
    // Both flights are right to some 1e-7 m, and the thrust was corrected to 1e-4 m.
    EXPECT_LT(miss_m * units.length_m, 2e-4);
    const double unit = units.velocity_m_s() * units.velocity_m_s() / units.time_s;
    const double energy = static_cast<double>(deputy[12]) * unit;
    EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-9 * energy);
    // Schwarz's inequality: (integral of |u|)^2 <= 2 T integral of |u|^2 / 2.
    EXPECT_LT(transfer.change_m_s * transfer.change_m_s,
              2 * transfer.time * units.time_s * transfer.energy_m2_s3);
    EXPECT_GT(transfer.change_m_s, 0);
  }
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
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  const double unit = units.velocity_m_s() * units.velocity_m_s() / units.time_s;
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

// A thruster that is too weak is told by how much.
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
}  // namespace hamjet
