#include "hamjet/detail/studies/finite_burns.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "../formation_scenes.hpp"
#include "hamjet/studies/transfer.hpp"
#include "studies/formation/burns/burn_flight.hpp"

// Burns in place of impulses. Chiefs are on Kepler orbits in canonical units of 7000 km, so that a
// test's own program can fly them.

namespace hamjet::burning {
namespace {

const double canonical_s = std::sqrt(7000.0 * 7000 * 7000 / 398600.4405);
constexpr double exhaust_m_s = 2000;

/// A transfer from rest 100 m above the plane of a circular orbit to rest at the chief, in one
/// radian.
Scene out_of_plane(double acceleration_m_s2) {
  Scene scene = kepler_chief(0, 7000, canonical_s, 2);
  TransferSettings settings;
  settings.start.position_m = {0, 0, 100};
  settings.times = {1.0};
  settings.refine = true;
  settings.refined_miss_m = 1e-6;
  scene.transfer = settings;
  scene.thruster.emplace().acceleration_m_s2 = acceleration_m_s2;
  return scene;
}

/// On an ellipse, from 2 km away to 100 m behind the chief.
Scene on_an_ellipse(double acceleration_m_s2, std::vector<double> times = {2.5}) {
  Scene scene = kepler_chief(0.3, 7000, canonical_s, 3);
  scene.nominal = {1, 0, 0, 0, 0.57, 0.98};
  TransferSettings settings;
  settings.start.position_m = {1200, -1400, 800};
  settings.start.velocity_m_s = {0.2, 0.1, -0.3};
  settings.end.position_m = {0, -100, 0};
  settings.end.velocity_m_s = {0.05, 0, 0.1};
  settings.times = std::move(times);
  settings.refine = true;
  settings.refined_miss_m = 1e-4;
  scene.transfer = settings;
  scene.thruster.emplace().acceleration_m_s2 = acceleration_m_s2;
  return scene;
}

Scene with_falling_mass(Scene scene) {
  scene.thruster->mass_kg = 100;
  scene.thruster->exhaust_m_s = exhaust_m_s;
  return scene;
}

BurnPlan plan_of(const Scene& scene) {
  const TransferResult result = study_transfer(scene);
  return result.burns->plans.at(0);
}

// Out of the plane a deputy near a circular orbit oscillates with the rate n. The change of a burn
// about t, whose arc is alpha = n L, acts as an impulse at t of sin(alpha / 2) / (alpha / 2) times
// its size: along the normal the thrust stays the same, but places on both sides of the impulse's
// are worth cos(n (t' - t)) of it. The loss is alpha^2 / 24 + 7 alpha^4 / 5760 of the impulse. (The
// same holds for the energy that a thrust along a fixed inertial direction makes about the tangent;
// a thrust that turns with the orbit along T loses nothing of the energy, and as much of the
// eccentricity.)
TEST(FiniteBurns, LossOfAShortArcIsThatOfItsAngle) {
  const double n = 1 / canonical_s;
  for (const BurnAttitude attitude : {BurnAttitude::rtn, BurnAttitude::inertial}) {
    for (const double acceleration : {8e-4, 2e-3, 4e-3}) {
      Scene scene = out_of_plane(acceleration);
      scene.thruster->attitude = attitude;
      const BurnPlan plan = plan_of(scene);
      ASSERT_TRUE(plan.is_found()) << plan.failure;
      ASSERT_EQ(plan.burns.size(), 2U);
      for (const FiniteBurn& burn : plan.burns) {
        const double alpha = burn.end - burn.start;
        EXPECT_NEAR(alpha, n * burn.change_m_s / acceleration, 1e-9 * alpha);
        const double loss = burn.change_m_s / burn.impulse_m_s - 1;
        // What is not linear in 100 m over 7000 km stays below this.
        EXPECT_NEAR(loss, alpha / 2 / std::sin(alpha / 2) - 1, 1e-7);
        EXPECT_NEAR(loss, alpha * alpha / 24, alpha * alpha / 24 * alpha * alpha / 30 + 1e-7);
        EXPECT_GT(std::abs(burn.direction[2]), 0.999);
      }
    }
  }
}

// Burns of the same changes become shorter as the thrust grows; as each is symmetric about its
// impulse, or has it as the mean time of its change, what is lost falls with the square.
TEST(FiniteBurns, ConvergeToImpulsesWithTheSquareOfTheirLength) {
  for (const bool mass_falls : {false, true}) {
    std::vector<double> losses, differences;
    for (const double acceleration : {2e-2, 4e-2, 8e-2}) {
      Scene scene = on_an_ellipse(acceleration);
      if (mass_falls) {
        scene = with_falling_mass(scene);
        scene.thruster->exhaust_m_s = 20;  // so that the mass falls by a fifth
      }
      const TransferResult result = study_transfer(scene);
      const BurnPlan& plan = result.burns->plans.at(0);
      ASSERT_TRUE(plan.is_found()) << plan.failure;
      const double impulses = result.points[0].change_m_s();
      EXPECT_NEAR(plan.impulses_m_s, impulses, 1e-12 * impulses);
      losses.push_back(plan.change_m_s() - impulses);
      differences.push_back(plan.burns[0].change_m_s - plan.burns[0].impulse_m_s);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(std::log2(losses[k] / losses[k + 1]), 2, 0.1) << "mass falls: " << mass_falls;
      EXPECT_NEAR(std::log2(differences[k] / differences[k + 1]), 2, 0.1);
    }
  }
}

using Numbers = std::array<long double, 7>;  // q, v and the mass

/// A thrust in canonical units; no acceleration where it does not burn.
struct Thrust {
  long double acceleration = 0;  ///< at mass 1
  long double exhaust = 0;       ///< 0 if the mass does not fall
  bool turns = true;
  std::array<long double, 3> direction{};
};

/// Kepler's problem under a thrust, with the mass as a seventh number.
Numbers derivative(const Numbers& z, const Thrust& thrust) {
  using Vector = std::array<long double, 3>;
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto unit = [](const Vector& v) {
    const long double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return Vector{v[0] / size, v[1] / size, v[2] / size};
  };
  const Vector q{z[0], z[1], z[2]}, v{z[3], z[4], z[5]};
  std::array<Vector, 3> axes = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  if (thrust.turns) axes = {unit(q), cross(unit(cross(q, v)), unit(q)), unit(cross(q, v))};
  const long double r = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  Numbers d{};
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = v[i];
    d[3 + i] = -q[i] / (r * r * r);
    for (std::size_t k = 0; k < 3; ++k) {
      d[3 + i] += thrust.acceleration / z[6] * thrust.direction[k] * axes[k][i];
    }
  }
  if (thrust.exhaust > 0) d[6] = -thrust.acceleration / thrust.exhaust;
  return d;
}

/// The classical Runge-Kutta method in long double.
Numbers flown(Numbers z, const Thrust& thrust, long double time) {
  constexpr int steps = 4000;
  const long double h = time / steps;
  const auto moved = [](const Numbers& a, const Numbers& b, long double factor) {
    Numbers sum = a;
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * b[i];
    return sum;
  };
  for (int k = 0; k < steps; ++k) {
    const Numbers k1 = derivative(z, thrust);
    const Numbers k2 = derivative(moved(z, k1, h / 2), thrust);
    const Numbers k3 = derivative(moved(z, k2, h / 2), thrust);
    const Numbers k4 = derivative(moved(z, k3, h), thrust);
    for (std::size_t i = 0; i < z.size(); ++i) {
      z[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }
  return z;
}

std::vector<double> state_of(const Numbers& z) {
  std::vector<double> state;
  for (std::size_t i = 0; i < 6; ++i) state.push_back(static_cast<double>(z[i]));
  return state;
}

/// Flies a plan by the test's own program, and expects it to arrive.
void expect_arrival(const Scene& scene, const BurnPlan& plan) {
  const MetricUnits units{scene.units.length_km * 1000, scene.units.time_s};
  const RelativeFrame frame = scene.transfer->frame;
  Numbers chief{}, deputy{};
  chief[6] = deputy[6] = 1;
  const std::vector<double> start =
      ChiefFrame(scene.nominal, units, frame).deviation(scene.transfer->start);
  for (std::size_t i = 0; i < 6; ++i) {
    chief[i] = scene.nominal[i];
    deputy[i] = chief[i] + start[i];
  }
  long double now = 0;
  for (const FiniteBurn& burn : plan.burns) {
    deputy = flown(deputy, {}, burn.start - now);
    Thrust thrust;
    thrust.acceleration = scene.thruster->acceleration_m_s2 * units.time_s / units.velocity_m_s();
    if (scene.thruster->exhaust_m_s) {
      thrust.exhaust = *scene.thruster->exhaust_m_s / units.velocity_m_s();
    }
    thrust.turns = scene.thruster->attitude == BurnAttitude::rtn;
    for (std::size_t i = 0; i < 3; ++i) {
      thrust.direction[i] = burn.direction[static_cast<Eigen::Index>(i)];
    }
    const long double before = deputy[6];
    deputy = flown(deputy, thrust, burn.end - burn.start);
    now = burn.end;
    if (!burn.propellant_kg) continue;
    const long double kg = scene.thruster->mass_kg;
    EXPECT_NEAR(*burn.propellant_kg, static_cast<double>((before - deputy[6]) * kg), 1e-9);
    EXPECT_NEAR(*burn.mass_after_kg, static_cast<double>(deputy[6] * kg), 1e-9);
  }
  deputy = flown(deputy, {}, plan.duration - now);
  chief = flown(chief, {}, plan.duration);
  const std::vector<double> wanted = scene.transfer->end.deviation(state_of(chief), units, frame);
  Eigen::Vector3d miss, velocity_miss;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    miss[k] = static_cast<double>(deputy[i] - chief[i] - wanted[i]);
    velocity_miss[k] = static_cast<double>(deputy[3 + i] - chief[3 + i] - wanted[3 + i]);
  }
  // The burns were corrected until both misses were below refined_miss_m, in the unit of time.
  const double most_m = 1.5 * scene.transfer->refined_miss_m;
  EXPECT_LT(miss.norm() * units.length_m, most_m);
  EXPECT_LT(velocity_miss.norm() * units.length_m, most_m);
  EXPECT_LT(plan.miss_m, scene.transfer->refined_miss_m);
}

// Burns of an eighth of a revolution and more, turning with the orbit or not, of falling mass or
// not, lead to the end in another program.
TEST(FiniteBurns, LeadToTheEndInAnotherProgram) {
  for (const BurnAttitude attitude : {BurnAttitude::rtn, BurnAttitude::inertial}) {
    for (const bool mass_falls : {false, true}) {
      Scene scene = on_an_ellipse(3e-3);
      if (mass_falls) {
        scene = with_falling_mass(scene);
        scene.thruster->exhaust_m_s = 20;
      }
      scene.thruster->attitude = attitude;
      const BurnPlan plan = plan_of(scene);
      ASSERT_TRUE(plan.is_found()) << plan.failure;
      EXPECT_GT(plan.burns[0].end - plan.burns[0].start, 0.5);
      EXPECT_LT(plan.burns[0].start, 0);
      EXPECT_GT(plan.burns[1].end, plan.duration);
      expect_arrival(scene, plan);
    }
  }
}

// The optimal impulses, three or more of them, become as many burns.
TEST(FiniteBurns, ReplaceOptimalImpulses) {
  Scene scene = on_an_ellipse(2e-2, {6.0, 11.5});
  scene.transfer->impulses = TransferImpulses::optimal;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.optimal && result.optimal->is_found());
  const BurnPlan& plan = result.burns->plans.back();
  ASSERT_TRUE(plan.is_optimal);
  ASSERT_TRUE(plan.is_found()) << plan.failure;
  EXPECT_EQ(plan.burns.size(), result.optimal->plan->impulses.size());
  EXPECT_GT(plan.burns.size(), 2U);
  EXPECT_EQ(plan.impulses_m_s, result.optimal->plan->total_change_m_s());
  EXPECT_LT(plan.change_m_s(), 1.05 * plan.impulses_m_s);
  expect_arrival(scene, plan);
}

// In the geometry of the first test both burns fill the transfer, and meet, where
// asin(n v1 / 2a) + asin(n v2 / 2a) = n T; a burn of at most L needs a = n v / (2 sin(n L / 2)).
TEST(FiniteBurns, ThrusterTooWeakIsToldByHowMuch) {
  const double n = 1 / canonical_s;
  const BurnPlan strong = plan_of(out_of_plane(1));
  const double first = strong.burns[0].impulse_m_s, second = strong.burns[1].impulse_m_s;
  double low = n * std::max(first, second) / 2, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double a = std::sqrt(low * high);
    (std::asin(n * first / (2 * a)) + std::asin(n * second / (2 * a)) > 1 ? low : high) = a;
  }
  for (const double part : {0.1, 0.7, 0.97}) {
    const BurnPlan weak = plan_of(out_of_plane(part * high));
    EXPECT_FALSE(weak.is_found());
    ASSERT_TRUE(weak.least_acceleration_m_s2) << part << " " << weak.failure;
    EXPECT_NEAR(*weak.least_acceleration_m_s2, high, 0.011 * high);
  }
  EXPECT_TRUE(plan_of(out_of_plane(1.01 * high)).is_found());
  Scene scene = out_of_plane(2e-4);
  const double longest = 0.2;
  scene.thruster->longest_burn_s = longest * canonical_s;
  const TransferResult result = study_transfer(scene);
  const BurnPlan& limited = result.burns->plans[0];
  ASSERT_TRUE(limited.least_acceleration_m_s2) << limited.failure;
  const double needed = n * std::max(first, second) / (2 * std::sin(longest / 2));
  EXPECT_NEAR(*limited.least_acceleration_m_s2, needed, 0.011 * needed);
  EXPECT_FALSE(result.burns->least);
  EXPECT_EQ(result.burns->failure, limited.failure);
  EXPECT_EQ(exit_code(result), 1);
}

// Of several times the thruster is too weak for the short ones.
TEST(FiniteBurns, LongerTransfersAreFoundWhereShortOnesAreNot) {
  const TransferResult result = study_transfer(on_an_ellipse(1.2e-3, {0.4, 0.8, 2.5}));
  ASSERT_TRUE(result.burns);
  ASSERT_EQ(result.burns->plans.size(), 3U);
  EXPECT_FALSE(result.burns->plans[0].is_found());
  ASSERT_TRUE(result.burns->least);
  EXPECT_EQ(*result.burns->least, 2U);
}

// The rocket equation: m (1 - exp(-v / w)) of propellant for all changes v.
TEST(FiniteBurns, PropellantIsThatOfTheRocketEquation) {
  Scene scene = with_falling_mass(on_an_ellipse(2e-2));
  const BurnPlan plan = plan_of(scene);
  ASSERT_TRUE(plan.is_found()) << plan.failure;
  const double taken = 100 * (1 - std::exp(-plan.change_m_s() / exhaust_m_s));
  EXPECT_NEAR(plan.propellant_kg().value(), taken, 1e-12 * 100);
  EXPECT_NEAR(*plan.burns.back().mass_after_kg, 100 - taken, 1e-10);
  scene.thruster->propellant_kg = 1.001 * taken;
  EXPECT_TRUE(plan_of(scene).is_found());
  scene.thruster->propellant_kg = 0.999 * taken;
  const BurnPlan dry = plan_of(scene);
  EXPECT_NE(dry.failure.find("above propellant_kg"), std::string::npos) << dry.failure;
  EXPECT_FALSE(dry.least_acceleration_m_s2);  // no thrust makes them take so much less
}

// Changes of some metres a second behind an exhaust of 0.1 m/s leave exp(-20) of the mass and less,
// whose flight does not end.
TEST(FiniteBurns, SpacecraftThatWouldBeSpentAreSaid) {
  Scene scene = with_falling_mass(on_an_ellipse(2e-2));
  scene.thruster->exhaust_m_s = 0.1;
  const BurnPlan plan = plan_of(scene);
  EXPECT_NE(
      plan.failure.find("would leave less than 0.001 of the mass behind an exhaust of 0.1 m/s"),
      std::string::npos)
      << plan.failure;
}

TEST(FiniteBurns, BurnsThatAreTooShortAreSaid) {
  Scene scene = on_an_ellipse(2e-2);
  scene.thruster->shortest_burn_s = 1e3;
  const BurnPlan plan = plan_of(scene);
  EXPECT_NE(plan.failure.find("below shortest_burn_s"), std::string::npos) << plan.failure;
}

// A miss below the rounding of a position, a nanometre, is not reached, and this is said.
TEST(FiniteBurns, BurnsThatAreNotCorrectedAreSaid) {
  Scene scene = on_an_ellipse(2e-2);
  scene.transfer->refine = false;
  scene.transfer->refined_miss_m = 1e-12;
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.burns);
  EXPECT_FALSE(result.burns->least);
  EXPECT_NE(result.burns->failure.find("no burns were found"), std::string::npos)
      << result.burns->failure;
}

// Derivatives by the changes of three burns, with their times and masses, against central
// differences of flights.
TEST(FiniteBurns, DerivativesAreThoseOfFlights) {
  for (const bool mass_falls : {false, true}) {
    Scene scene = on_an_ellipse(1e-2);
    if (mass_falls) {
      scene = with_falling_mass(scene);
      scene.thruster->exhaust_m_s = 10;
    }
    const ComputedProblem problem = make_problem(scene);
    const SharedSystem burning = burning_system(*problem.system, {ThrustAxes::rtn, mass_falls});
    const BurnFlight flight(scene, problem, burning, 2.5);
    const CanonicalThruster thruster(*scene.thruster, flight.units());
    const std::vector<Impulse> at = {{0, {}}, {1, {}}, {2.5, {}}};
    const BurnFlight::Changes changes = {
        {2e-4, -1e-4, 3e-4}, {1e-4, 2e-4, -1e-4}, {-2e-4, 1e-4, 1e-4}};
    const auto rates = flight.derivatives(thruster, at, changes);
    ASSERT_EQ(rates.cols(), 9);
    constexpr double step = 1e-7;
    for (Eigen::Index j = 0; j < 9; ++j) {
      BurnFlight::Changes more = changes, less = changes;
      more[static_cast<std::size_t>(j / 3)][j % 3] += step;
      less[static_cast<std::size_t>(j / 3)][j % 3] -= step;
      const BurnFlight::Vector6 difference =
          (flight.missing(thruster, at, less) - flight.missing(thruster, at, more)) / (2 * step);
      EXPECT_LT((rates.col(j) - difference).norm(), 1e-6 * difference.norm() + 1e-7) << j;
    }
  }
}

}  // namespace
}  // namespace hamjet::burning
