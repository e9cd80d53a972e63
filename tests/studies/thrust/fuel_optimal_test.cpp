#include "hamjet/detail/studies/fuel_optimal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "energy_optimal_flights.hpp"
#include "hamjet/studies/transfer.hpp"

namespace hamjet::thrusted {
namespace {

Scene fuel_scene(std::vector<double> times, double acceleration_m_s2) {
  Scene scene = thrust_scene(10e3, std::move(times));
  scene.transfer->thrust = TransferThrust::fuel_optimal;
  scene.thruster.emplace().acceleration_m_s2 = acceleration_m_s2;
  return scene;
}

long double primer(const Numbers& z) { return std::hypot(z[9], z[10], z[11]); }

/// Flies the burns of a transfer by the test's own program: full thrust along the primer vector,
/// which is carried along, between the times that the transfer tells; the last of the numbers is
/// the integral of |u|. `at_switch` sees the states at these times.
template <class AtSwitch>
Numbers flown_burns(const Scene& scene, const FuelOptimalTransfer& transfer,
                    const AtSwitch& at_switch) {
  const MetricUnits units = units_of(scene);
  const long double most = scene.thruster->acceleration_m_s2 * units.time_s / units.velocity_m_s();
  Numbers z = start_of(scene, scene.transfer->start, transfer.costates);
  long double now = 0;
  const auto fly_to = [&](double time, long double size) {
    fly(
        [size](const Numbers& x, Numbers& d, long double) {
          d = derivative(x);
          for (std::size_t i = 0; i < 3; ++i) {
            d[3 + i] += x[9 + i] - (size > 0 ? size * x[9 + i] / primer(x) : 0);
          }
          d[12] = size;
        },
        z, time - now);
    now = time;
  };
  for (const ThrustBurn& burn : transfer.burns) {
    if (burn.start > 0) {
      fly_to(burn.start, 0);
      at_switch(z);
    }
    fly_to(burn.end, most);
    if (burn.end < transfer.time) at_switch(z);
  }
  if (now < transfer.time) fly_to(transfer.time, 0);
  return z;
}

void expect_arrival(const Scene& scene, const FuelOptimalTransfer& transfer) {
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  const MetricUnits units = units_of(scene);
  std::size_t switches = 0;
  const Numbers end = flown_burns(scene, transfer, [&](const Numbers& z) {
    EXPECT_NEAR(static_cast<double>(primer(z)), 1, 1e-9);
    ++switches;
  });
  EXPECT_GT(switches, 0U);
  const Numbers wanted = wanted_end(scene, transfer.time);
  double miss_m = 0, velocity_miss_m_s = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    miss_m = std::hypot(miss_m, static_cast<double>(end[i] - wanted[i]) * units.length_m);
    velocity_miss_m_s = std::hypot(
        velocity_miss_m_s, static_cast<double>(end[3 + i] - wanted[3 + i]) * units.velocity_m_s());
  }
  // Both are right to some 1e-7 m, and the burns were corrected to rounding.
  EXPECT_LT(miss_m, 1e-5);
  EXPECT_LT(velocity_miss_m_s, 1e-8);
  EXPECT_LT(transfer.miss_m, 1e-5);
  const double change = static_cast<double>(end[12]) * units.velocity_m_s();
  EXPECT_NEAR(transfer.change_m_s, change, 1e-11 * change);
  // The conditions of the maximum principle, as the study tells them.
  EXPECT_LT(transfer.primer_at_switches, 1e-12);
  EXPECT_LE(transfer.primer_in_coasts, 1 + 1e-12);
  EXPECT_GE(transfer.primer_in_burns, 1 - 1e-12);
  ASSERT_TRUE(transfer.hamiltonian_change);
  EXPECT_LT(*transfer.hamiltonian_change, 1e-11);
}

// Burns at the times and along the directions that are told lead to the end in another program,
// cost no less than impulses and no more than the thrust of least energy, which is allowed too.
TEST(FuelOptimal, BurnsLeadToTheEndInAnotherProgram) {
  const Scene scene = fuel_scene({2.0, 5.0, 9.0}, 0.08);
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.fuel);
  ASSERT_EQ(result.fuel->transfers.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const FuelOptimalTransfer& transfer = result.fuel->transfers[i];
    SCOPED_TRACE(transfer.time);
    expect_arrival(scene, transfer);
    ASSERT_LT(result.thrust->transfers[i].largest_m_s2, 0.08);
    EXPECT_LT(transfer.change_m_s, transfer.energy_optimal_m_s);
    ASSERT_TRUE(transfer.impulses_m_s);
    EXPECT_GT(transfer.change_m_s, *transfer.impulses_m_s * (1 - 1e-6));
  }
  EXPECT_EQ(exit_code(result), 0);
}

/// State, costates, the change that was spent and its costate.
using WithMass = std::array<long double, 14>;

// A thruster whose mass falls by a third: the test's own program carries the mass and the costate
// of the change, at which the primer vector must pass at each switch, and comes to the end. Between
// the same ends it takes less than with the first acceleration all the way, which it could be
// throttled to.
TEST(FuelOptimal, FallingMassIsFlownInAnotherProgram) {
  Scene scene = fuel_scene({5.0}, 0.08);
  const double constant_m_s = study_transfer(scene).fuel->transfers.at(0).change_m_s;
  scene.thruster->mass_kg = 500;
  // An exhaust as fast as this takes no mass, and leaves no rounding in the change.
  scene.thruster->exhaust_m_s = 1e15 * constant_m_s;
  EXPECT_NEAR(study_transfer(scene).fuel->transfers.at(0).change_m_s, constant_m_s,
              1e-9 * constant_m_s);
  scene.thruster->exhaust_m_s = 2.5 * constant_m_s;
  const TransferResult result = study_transfer(scene);
  const FuelOptimalTransfer& transfer = result.fuel->transfers.at(0);
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  EXPECT_LT(transfer.change_m_s, constant_m_s);
  ASSERT_TRUE(transfer.propellant_kg);
  EXPECT_NEAR(*transfer.propellant_kg,
              500 * (1 - std::exp(-transfer.change_m_s / constant_m_s / 2.5)), 1e-9);
  const MetricUnits units = units_of(scene);
  const long double first = 0.08L * units.time_s / units.velocity_m_s();
  const long double exhaust = *scene.thruster->exhaust_m_s / units.velocity_m_s();
  WithMass z{};
  const Numbers start = start_of(scene, scene.transfer->start, transfer.costates);
  std::copy_n(start.begin(), 12, z.begin());
  z[13] = 1;
  long double now = 0;
  const auto fly_to = [&](double time, bool burns) {
    fly(
        [&](const WithMass& x, WithMass& d, long double) {
          Numbers of_states{};
          std::copy_n(x.begin(), 12, of_states.begin());
          const Numbers rate = derivative(of_states);
          std::copy_n(rate.begin(), 12, d.begin());
          const long double length = primer(of_states);
          const long double size = burns ? first * std::exp(x[12] / exhaust) : 0;
          for (std::size_t i = 0; i < 3; ++i) d[3 + i] += x[9 + i] - size * x[9 + i] / length;
          d[12] = size;
          d[13] = size / exhaust * (length - x[13]);
        },
        z, time - now);
    now = time;
  };
  const auto expect_switch = [&] {
    const long double length = std::hypot(z[9], z[10], z[11]);
    EXPECT_NEAR(static_cast<double>(length / z[13]), 1, 1e-9);
  };
  for (const ThrustBurn& burn : transfer.burns) {
    if (burn.start > 0) {
      fly_to(burn.start, false);
      expect_switch();
    }
    fly_to(burn.end, true);
    if (burn.end < transfer.time) expect_switch();
  }
  if (now < transfer.time) fly_to(transfer.time, false);
  EXPECT_GT(z[13], 1.01);
  const Numbers wanted = wanted_end(scene, transfer.time);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(static_cast<double>(z[i] - wanted[i])) * units.length_m, 1e-5);
    EXPECT_LT(std::abs(static_cast<double>(z[3 + i] - wanted[3 + i])) * units.velocity_m_s(), 1e-8);
  }
  EXPECT_NEAR(transfer.change_m_s, static_cast<double>(z[12]) * units.velocity_m_s(),
              1e-10 * transfer.change_m_s);
  EXPECT_LT(transfer.primer_at_switches, 1e-12);
  EXPECT_LE(transfer.primer_in_coasts, 1 + 1e-12);
  EXPECT_GE(transfer.primer_in_burns, 1 - 1e-12);
  ASSERT_TRUE(transfer.hamiltonian_change);
  EXPECT_LT(*transfer.hamiltonian_change, 1e-11);
  scene.thruster->propellant_kg = 0.9 * *transfer.propellant_kg;
  const TransferResult empty = study_transfer(scene);
  EXPECT_NE(empty.fuel->failure.find("above propellant_kg"), std::string::npos)
      << empty.fuel->failure;
}

// A thruster below the largest acceleration of least energy, which burns most of the time.
TEST(FuelOptimal, AWeakThrusterArrivesToo) {
  const Scene strong = fuel_scene({5.0}, 1);
  const double largest = study_transfer(strong).thrust->transfers[0].largest_m_s2;
  const Scene scene = fuel_scene({5.0}, 0.8 * largest);
  const TransferResult result = study_transfer(scene);
  expect_arrival(scene, result.fuel->transfers[0]);
}

// The thrust tends to the impulses. Those at the start and at the end are where the primer vector
// has a slope, so that a burn, on one side of them alone, loses in proportion to its length.
TEST(FuelOptimal, StrongThrustTendsToImpulses) {
  std::vector<double> losses;
  for (const double acceleration : {0.5, 1.0, 2.0}) {
    const Scene scene = fuel_scene({5.0}, acceleration);
    const FuelOptimalTransfer transfer = study_transfer(scene).fuel->transfers.at(0);
    ASSERT_TRUE(transfer.is_found()) << transfer.failure;
    ASSERT_TRUE(transfer.impulses_m_s);
    losses.push_back(transfer.change_m_s / *transfer.impulses_m_s - 1);
  }
  EXPECT_LT(losses[2], losses[1]);
  EXPECT_LT(losses[1], losses[0]);
  EXPECT_GT(losses[2], 0);
  // Of the limit the part in proportion is taken away, and its square is left.
  EXPECT_NEAR(2 * losses[2] - losses[1], 0, 0.05 * losses[1]);
}

// Where the thruster is too weak the study tells by how much, and slightly more does it.
TEST(FuelOptimal, ThrusterTooWeakIsToldByHowMuch) {
  Scene scene = fuel_scene({2.0, 5.0}, 1e-5);
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.fuel);
  EXPECT_FALSE(result.fuel->least);
  EXPECT_NE(result.fuel->failure.find("too weak"), std::string::npos) << result.fuel->failure;
  EXPECT_EQ(exit_code(result), 1);
  const FuelOptimalTransfer& weak = result.fuel->transfers[1];
  ASSERT_TRUE(weak.least_acceleration_m_s2) << weak.failure;
  // The change of least energy is not far above the least, and takes the whole time at full thrust.
  EXPECT_GT(*weak.least_acceleration_m_s2 * weak.time * scene.units.time_s, *weak.impulses_m_s);
  scene = fuel_scene({5.0}, 1.02 * *weak.least_acceleration_m_s2);
  const TransferResult enough = study_transfer(scene);
  EXPECT_TRUE(enough.fuel->transfers[0].is_found()) << enough.fuel->transfers[0].failure;
  EXPECT_EQ(exit_code(enough), 0);
}

}  // namespace
}  // namespace hamjet::thrusted
