#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "energy_optimal_flights.hpp"
#include "support/yamanaka_ankersen.hpp"

// Thrust of least energy beside what shares nothing with it: a closed form with quadrature, other
// controls, and shooting.

namespace hamjet::thrusted {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// To first order the least energy is d^T W^-1 d / 2 with the Gramian W = integral of
// Phi(T, s) B B^T Phi(T, s)^T, by quadrature, with Yamanaka and Ankersen's Phi, and d the distance
// of the end from where the start drifts to.
TEST(EnergyOptimalProofs, FirstOrderIsYamanakaAndAnkersenWithQuadrature) {
  constexpr double e = 0.4;
  const test::UnitEllipse ellipse(e);
  for (const double anomaly : {1.5, 4.5, 8.9}) {
    Scene scene = kepler_chief(e, 7000, 1000, 1);
    TransferSettings settings;
    settings.start = {{100, -250, 80}, {0.1, 0.2, -0.15}};
    settings.end = RelativeState{{-30, 60, 40}, {0.05, -0.02, 0.03}};
    settings.times = {ellipse.time_at(anomaly)};
    settings.thrust = TransferThrust::energy_optimal;
    settings.thrust_order = 1;
    scene.transfer = settings;
    const TransferResult result = study_transfer(scene);
    const EnergyOptimalTransfer& transfer = result.thrust->transfers.at(0);
    ASSERT_FALSE(transfer.answers.empty()) << transfer.failure;
    Matrix6 gramian = Matrix6::Zero();
    using Rule = boost::math::quadrature::gauss<double, 30>;
    constexpr int panels = 4;
    const double half = anomaly / panels / 2;
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
        for (const double sign : {-1.0, 1.0}) {
          const double at = half * (2 * panel + 1 + sign * Rule::abscissa()[k]);
          const Eigen::Matrix<double, 6, 3> thrust = ellipse.transition(at, anomaly).rightCols<3>();
          gramian += Rule::weights()[k] * half * ellipse.slowness(at) * thrust * thrust.transpose();
        }
      }
    }
    const MetricUnits units = units_of(scene);
    const auto canonical = [&](const RelativeState& state) {
      Vector6 x;
      x << state.position_m / units.length_m, state.velocity_m_s / units.velocity_m_s();
      return x;
    };
    const Vector6 distance =
        canonical(settings.end) - ellipse.transition(0, anomaly) * canonical(settings.start);
    const double least = distance.dot(gramian.ldlt().solve(distance)) / 2 * energy_unit(scene);
    EXPECT_NEAR(transfer.answers[0].energy_m2_s3, least, 1e-9 * least) << anomaly;
  }
}

/// A control u(t) that differs from the least by waves and by two constants and slopes, which
/// correct the end.
struct OtherControl {
  std::vector<Eigen::Vector3d> waves;
  Vector6 mend = Vector6::Zero();

  Eigen::Vector3d difference(double share) const {
    Eigen::Vector3d u = mend.head<3>() + share * mend.tail<3>();
    for (std::size_t j = 0; j < waves.size(); ++j) {
      u += waves[j] * std::cos(std::numbers::pi * static_cast<double>(j + 1) * share);
    }
    return u;
  }
};

/// Flown by the test's own program: the end under the other control, the energy of the least one
/// and of the other, and the integral of half the square of their difference.
struct OtherFlight {
  Vector6 end;
  double least = 0;
  double energy = 0;
  double difference = 0;
};

OtherFlight flown_by(const Numbers& start, const OtherControl& control, double time) {
  using Both = std::array<long double, 21>;  // states and costates; another state; three integrals
  const auto rate = [&](const Both& z, Both& d, long double t) {
    Numbers least{};
    std::copy_n(z.begin(), 12, least.begin());
    const Numbers own = derivative(least);
    std::copy_n(own.begin(), 12, d.begin());
    const long double r = std::sqrt(z[12] * z[12] + z[13] * z[13] + z[14] * z[14]);
    const Eigen::Vector3d more = control.difference(static_cast<double>(t / time));
    d[18] = own[12];
    d[19] = d[20] = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const long double u = more[static_cast<Eigen::Index>(i)] - z[9 + i];
      d[12 + i] = z[15 + i];
      d[15 + i] = -z[12 + i] / (r * r * r) + u;
      d[19] += u * u / 2;
      d[20] += static_cast<long double>(more.squaredNorm()) / 6;
    }
  };
  Both z{};
  std::copy_n(start.begin(), 12, z.begin());
  std::copy_n(start.begin(), 6, z.begin() + 12);
  fly(rate, z, time);
  OtherFlight flight;
  for (std::size_t i = 0; i < 6; ++i) {
    flight.end[static_cast<Eigen::Index>(i)] = static_cast<double>(z[12 + i] - z[i]);
  }
  flight.least = static_cast<double>(z[18]);
  flight.energy = static_cast<double>(z[19]);
  flight.difference = static_cast<double>(z[20]);
  return flight;
}

// No other control between the same ends is cheaper: twenty random ones of three sizes, corrected
// by Newton's method until they end where the least one does. As the least energy is stationary,
// they cost more by half the square of their difference, but for what is not linear in 10 km.
TEST(EnergyOptimalProofs, NoOtherControlIsCheaper) {
  const Scene scene = thrust_scene(10e3, {4.0});
  const TransferResult result = study_transfer(scene);
  const EnergyOptimalTransfer& transfer = result.thrust->transfers.at(0);
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  const Numbers start = start_of(scene, scene.transfer->start, transfer.refined->costates);
  const double size = std::sqrt(2 * transfer.energy_m2_s3 / energy_unit(scene) / transfer.time);
  std::mt19937_64 random(20261127);
  std::normal_distribution<double> normal;
  Matrix6 ends = Matrix6::Zero();
  for (Eigen::Index j = 0; j < 6; ++j) {
    OtherControl control;
    control.mend[j] = 1e-3 * size;
    ends.col(j) = flown_by(start, control, transfer.time).end / (1e-3 * size);
  }
  for (int k = 0; k < 20; ++k) {
    OtherControl control;
    const double part = std::array{1.0, 0.1, 0.01}[static_cast<std::size_t>(k % 3)];
    for (int j = 0; j < 4; ++j) {
      control.waves.push_back(part * size *
                              Eigen::Vector3d(normal(random), normal(random), normal(random)));
    }
    OtherFlight other = flown_by(start, control, transfer.time);
    for (int round = 0; round < 8 && other.end.norm() > 1e-15; ++round) {
      control.mend -= ends.partialPivLu().solve(other.end);
      other = flown_by(start, control, transfer.time);
    }
    ASSERT_LT(other.end.norm(), 1e-14);
    EXPECT_GT(other.energy, other.least);
    EXPECT_NEAR((other.energy - other.least) / other.difference, 1, 0.02) << part;
  }
}

/// The costates from one state to another by Newton's method from none, with central differences
/// and steps that are halved until they come nearer.
struct Shot {
  Numbers start{};
  Numbers end{};
  Vector6 missing;
};

Shot flown_shot(const Numbers& start, const Numbers& wanted, double time) {
  Shot shot{start, flown(start, time), {}};
  for (std::size_t i = 0; i < 6; ++i) {
    shot.missing[static_cast<Eigen::Index>(i)] = static_cast<double>(wanted[i] - shot.end[i]);
  }
  return shot;
}

Shot shot(Numbers start, const Numbers& wanted, double time) {
  constexpr long double step = 1e-10L;
  std::fill(start.begin() + 6, start.end(), 0.0L);
  Shot best = flown_shot(start, wanted, time);
  for (int round = 0; round < 20 && best.missing.norm() > 1e-15; ++round) {
    Matrix6 rates;
    for (std::size_t j = 0; j < 6; ++j) {
      Numbers more = best.start, less = best.start;
      more[6 + j] += step;
      less[6 + j] -= step;
      rates.col(static_cast<Eigen::Index>(j)) =
          (flown_shot(less, wanted, time).missing - flown_shot(more, wanted, time).missing) /
          static_cast<double>(2 * step);
    }
    const Vector6 change = rates.partialPivLu().solve(best.missing);
    bool is_nearer = false;
    for (double share = 1; share > 1e-3 && !is_nearer; share /= 2) {
      Numbers next = best.start;
      for (std::size_t j = 0; j < 6; ++j) {
        next[6 + j] += share * change[static_cast<Eigen::Index>(j)];
      }
      const Shot nearer = flown_shot(next, wanted, time);
      is_nearer = nearer.missing.norm() < best.missing.norm();
      if (is_nearer) best = nearer;
    }
    if (!is_nearer) break;
  }
  return best;
}

struct Orbit {
  std::string name;
  double e;
  double perigee_km;
};

double period_of(const Orbit& orbit) { return 2 * std::numbers::pi * std::pow(1 - orbit.e, -1.5); }

Scene shooting_scene(const Orbit& orbit, double separation_m,
                     const std::vector<double>& revolutions, int order) {
  const double unit_s = std::sqrt(std::pow(orbit.perigee_km, 3) / 398600.4415);
  Scene scene = kepler_chief(orbit.e, orbit.perigee_km, unit_s, 1);
  TransferSettings settings;
  settings.start.position_m = Eigen::Vector3d(0.5, -0.8, 0.3).normalized() * separation_m;
  settings.end.position_m = {0, separation_m / 50, 0};
  for (const double share : revolutions) settings.times.push_back(share * period_of(orbit));
  settings.thrust = TransferThrust::energy_optimal;
  settings.thrust_order = order;
  settings.refined_miss_m = 1e-7 * separation_m;
  scene.transfer = settings;
  scene.duration = settings.times.back();
  return scene;
}

/// Transfers on one orbit from one separation: the flown answers are those of shooting, and the
/// energies of orders 1 to N come nearer to theirs by degree as long as they are near at all.
void expect_those_of_shooting(const Orbit& orbit, double separation_m,
                              const std::vector<double>& revolutions, int order = 3) {
  SCOPED_TRACE(orbit.name + ", " + std::to_string(separation_m) + " m");
  const Scene scene = shooting_scene(orbit, separation_m, revolutions, order);
  const TransferSettings& settings = *scene.transfer;
  const double period = period_of(orbit);
  const TransferResult result = study_transfer(scene);
  ASSERT_EQ(result.thrust->transfers.size(), revolutions.size());
  for (const EnergyOptimalTransfer& transfer : result.thrust->transfers) {
    SCOPED_TRACE(transfer.time / period);
    ASSERT_TRUE(transfer.is_found()) << transfer.failure;
    const Shot other = shot(start_of(scene, settings.start, std::vector<double>(6)),
                            wanted_end(scene, transfer.time), transfer.time);
    ASSERT_LT(other.missing.norm(), 1e-12);
    const double energy = static_cast<double>(other.end[12]) * energy_unit(scene);
    // The answer was corrected to 1e-7 of the separation.
    EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-5 * energy);
    const auto wrong = [&](std::size_t k) {
      return std::abs(transfer.answers[k].energy_m2_s3 / energy - 1);
    };
    for (std::size_t k = 0; k + 1 < transfer.answers.size(); ++k) {
      if (wrong(k) > 0.1) break;
      EXPECT_LT(wrong(k + 1), 0.5 * wrong(k) + 1e-9) << "order " << k + 2;
      EXPECT_LT(transfer.answers[k + 1].miss_m,
                0.5 * transfer.answers[k].miss_m + 1e-8 * separation_m);
    }
  }
}

const std::vector<Orbit>& orbits_for_shooting() {
  static const std::vector<Orbit> orbits = {{"low", 0.001, 6892},
                                            {"e = 0.3", 0.3, 7000},
                                            {"Molniya", 0.74, 6900},
                                            {"geostationary", 0.0002, 42164}};
  return orbits;
}

TEST(EnergyOptimalProofs, ThreeTransfersAreThoseOfShooting) {
  expect_those_of_shooting(orbits_for_shooting()[1], 3e3, {0.3, 0.7, 1.3});
}

// Where no order's answer is corrected by flying, the thrust is followed from smaller deviations.
// The test's own program flies the costates that are found to the end, with their energy.
void expect_followed(const Orbit& orbit, double separation_m, double revolutions) {
  const Scene scene = shooting_scene(orbit, separation_m, {revolutions}, 3);
  const TransferResult result = study_transfer(scene);
  const EnergyOptimalTransfer& transfer = result.thrust->transfers.front();
  ASSERT_TRUE(transfer.is_found()) << transfer.failure;
  EXPECT_GT(transfer.continuation_steps, 1);
  const Numbers end =
      flown(start_of(scene, scene.transfer->start, transfer.refined->costates), transfer.time);
  const Numbers wanted = wanted_end(scene, transfer.time);
  double miss = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    miss = std::hypot(miss, static_cast<double>(end[i] - wanted[i]));
  }
  EXPECT_LT(miss * units_of(scene).length_m, 1e-6 * separation_m);
  const double energy = static_cast<double>(end[12]) * energy_unit(scene);
  EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-9 * energy);
}

TEST(EnergyOptimalProofs, BeyondThePolynomialsReachThrustIsFollowedFromSmallerDeviations) {
  expect_followed(orbits_for_shooting()[2], 100e3, 0.7);
}

TEST(EnergyOptimalShootingAtLength, ThreeRevolutionsOfMolniyaAreFollowed) {
  expect_followed(orbits_for_shooting()[2], 3e3, 3);
}

// Thirty, of 100 m to 100 km and 0.3 to 5 revolutions, by orders 1 to 4; on the Molniya orbit not
// those that are beyond the polynomials' reach, which are followed from smaller deviations.
TEST(EnergyOptimalShootingAtLength, TransfersAreThoseOfShooting) {
  for (const Orbit& orbit : orbits_for_shooting()) {
    const bool is_far_reached = orbit.e < 0.5;
    // Shooting from no thrust does not come to a perigee after five revolutions of high e.
    expect_those_of_shooting(orbit, 100, {0.3, 1.3, is_far_reached ? 5 : 4.5}, 4);
    expect_those_of_shooting(
        orbit, 3e3, is_far_reached ? std::vector{0.3, 1.3, 3.0} : std::vector{0.3, 1.3}, 4);
    expect_those_of_shooting(orbit, 100e3,
                             is_far_reached ? std::vector{0.3, 0.7} : std::vector{0.3}, 4);
  }
}

}  // namespace
}  // namespace hamjet::thrusted
