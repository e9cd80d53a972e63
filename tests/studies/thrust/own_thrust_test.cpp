#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/transfer.hpp"
#include "support/errors.hpp"

// Thrust that lasts along the coordinates of a Hamiltonian that a scene writes.

namespace hamjet {
namespace {

std::string own_scene(const std::string& system, const std::string& nominal, double time,
                      const std::string& more) {
  return "schema = 1\n[system]\nmodel = \"own\"\n" + system + "[nominal]\n" + nominal +
         "[jet]\norder = 2\nduration_canonical = " + std::to_string(time) + "\n" + more;
}

std::string line_scene(const std::string& hamiltonian, const std::string& more) {
  return own_scene(
      "coordinates = [\"q\"]\nmomenta = [\"p\"]\nhamiltonian = \"" + hamiltonian + "\"\n",
      "coordinates = [0]\nmomenta = [0]\n", 4, more);
}

const std::string along_line =
    "times_s = [4]\nstart = { position_m = [3], velocity_m_s = [0] }\n"
    "end = { position_m = [0] }\n";

// A mass point on a line, from rest to rest over the distance d = 3 in T = 4: the least integral
// of u^2 / 2 is 6 d^2 / T^3, with u = 6 d / T^2 (1 - 2 t / T).
TEST(OwnThrust, LeastEnergyOfADoubleIntegratorIsTheClosedForm) {
  const TransferResult result = study_transfer(io::parse_scene(
      line_scene("p^2/2", "[transfer]\nthrust = \"energy-optimal\"\n" + along_line), "x"));
  ASSERT_TRUE(result.thrust && result.thrust->least);
  const EnergyOptimalTransfer& least = result.thrust->transfers[*result.thrust->least];
  EXPECT_NEAR(least.energy_m2_s3, 6 * 9.0 / 64, 1e-12);
  EXPECT_NEAR(least.largest_m_s2, 18.0 / 16, 1e-2);
  EXPECT_LT((least.start_thrust_m_s2 - Eigen::Vector3d(-18.0 / 16, 0, 0)).norm(), 1e-12);
  EXPECT_LT((least.end_thrust_m_s2 - Eigen::Vector3d(18.0 / 16, 0, 0)).norm(), 1e-12);
  for (const EnergyOptimalAnswer& answer : least.answers) {
    EXPECT_NEAR(answer.energy_m2_s3, 6 * 9.0 / 64, 1e-12) << answer.order;
  }
}

// The same with full thrust or none at a = 2: it is on for t at each end, with a t (T - t) = d.
TEST(OwnThrust, LeastFuelOfADoubleIntegratorIsTheClosedForm) {
  const TransferResult result = study_transfer(
      io::parse_scene(line_scene("p^2/2", "[transfer]\nthrust = \"fuel-optimal\"\n" + along_line +
                                              "[thruster]\nacceleration_m_s2 = 2\n"),
                      "x"));
  ASSERT_TRUE(result.fuel && result.fuel->least);
  const FuelOptimalTransfer& least = result.fuel->transfers[*result.fuel->least];
  const double on = 2 - std::sqrt(4 - 3.0 / 2);
  ASSERT_EQ(least.burns.size(), 2U);
  EXPECT_NEAR(least.burns[0].length(), on, 1e-9);
  EXPECT_NEAR(least.burns[1].length(), on, 1e-9);
  EXPECT_NEAR(least.change_m_s, 4 * on, 1e-9);
  EXPECT_FALSE(least.impulses_m_s);
  EXPECT_EQ(exit_code(result), 0);
}

// Hill's equations without attraction are those of Clohessy and Wiltshire: the least energy is
// d^T W^-1 d / 2 with the Gramian W of their closed solution, here by quadrature; what the scene
// calls a metre and a second is 7 km and a minute.
TEST(OwnThrust, LeastEnergyOfHillsEquationsIsThatOfTheGramian) {
  const double n = 0.5, time = 3;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const auto flow = [n](double t) {
    const double c = std::cos(n * t), s = std::sin(n * t);
    Matrix6 phi;
    phi << 4 - 3 * c, 0, 0, s / n, 2 * (1 - c) / n, 0,                  //
        6 * (s - n * t), 1, 0, -2 * (1 - c) / n, 4 * s / n - 3 * t, 0,  //
        0, 0, c, 0, 0, s / n,                                           //
        3 * n * s, 0, 0, c, 2 * s, 0,                                   //
        -6 * n * (1 - c), 0, 0, -2 * s, 4 * c - 3, 0,                   //
        0, 0, -n * s, 0, 0, c;
    return phi;
  };
  const TransferResult result = study_transfer(io::parse_scene(
      own_scene("coordinates = [\"x\", \"y\", \"z\"]\nmomenta = [\"px\", \"py\", \"pz\"]\n"
                "parameters = { n = 0.5 }\nhamiltonian = \"(px^2 + py^2 + pz^2)/2 + n*(y*px - "
                "x*py) - n^2*x^2 + n^2*(y^2 + z^2)/2\"\n",
                "coordinates = [0, 0, 0]\nmomenta = [0, 0, 0]\n", 4,
                "[units]\nlength_km = 7\ntime_s = 60\n"
                "[transfer]\ntimes_s = [180]\nthrust = \"energy-optimal\"\n"
                "start = { position_m = [1000, -2000, 500], velocity_m_s = [0.1, 0.2, -0.3] }\n"
                "end = { position_m = [200, 300, -100] }\n"),
      "x"));
  ASSERT_TRUE(result.thrust && result.thrust->least);
  using Rule = boost::math::quadrature::gauss<double, 30>;
  Matrix6 gramian = Matrix6::Zero();
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    for (const double sign : {-1.0, 1.0}) {
      const double at = time / 2 * (1 + sign * Rule::abscissa()[k]);
      const Eigen::Matrix<double, 6, 3> thrust = flow(time - at).rightCols<3>();
      gramian += Rule::weights()[k] * time / 2 * thrust * thrust.transpose();
    }
  }
  Vector6 start, end;
  start << 1000, -2000, 500, 0.1 * 60, 0.2 * 60, -0.3 * 60;
  end << 200, 300, -100, 0, 0, 0;
  const Vector6 distance = end - flow(time) * start;
  const double least = distance.dot(gramian.ldlt().solve(distance)) / 2 / (60 * 60 * 60);
  const EnergyOptimalTransfer& found = result.thrust->transfers[*result.thrust->least];
  EXPECT_NEAR(found.energy_m2_s3, least, 1e-10 * least);
  // A linear system has no terms of higher degrees.
  for (const EnergyOptimalAnswer& answer : found.answers) {
    EXPECT_NEAR(answer.energy_m2_s3, least, 1e-10 * least) << answer.order;
    EXPECT_LT(answer.miss_m, 1e-8);
  }
}

using Numbers = std::array<long double, 13>;

/// The restricted three-body problem with its costates, in the coordinates and momenta of the
/// shipped scene, and the integral of |u|^2 / 2.
void restricted_rate(const Numbers& z, Numbers& d, long double) {
  const long double mu = 1 / 82.30059L;
  const long double from_earth[3] = {z[0] + mu, z[1], z[2]};
  const long double from_moon[3] = {z[0] - 1 + mu, z[1], z[2]};
  d.fill(0);
  d[0] = z[3] + z[1];
  d[1] = z[4] - z[0];
  d[2] = z[5];
  d[3] = z[4];
  d[4] = -z[3];
  // lambda' = -(df/dx)^T lambda, of the turn first.
  d[6] = z[7];
  d[7] = -z[6];
  d[9] = -z[6] + z[10];
  d[10] = -z[7] - z[9];
  d[11] = -z[8];
  for (const auto& [r, mass] : {std::pair(from_earth, 1 - mu), std::pair(from_moon, mu)}) {
    const long double r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    const long double pull = mass / (r2 * std::sqrt(r2));
    const long double along = r[0] * z[9] + r[1] * z[10] + r[2] * z[11];
    for (std::size_t i = 0; i < 3; ++i) {
      d[3 + i] -= pull * r[i];
      d[6 + i] += pull * (z[9 + i] - 3 * r[i] * along / r2);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    d[3 + i] -= z[9 + i];
    d[12] += z[9 + i] * z[9 + i] / 2;
  }
}

Numbers flown(Numbers z, long double time) {
  namespace odeint = boost::numeric::odeint;
  auto stepper = odeint::make_controlled(1e-16L, 1e-16L,
                                         odeint::runge_kutta_fehlberg78<Numbers, long double>());
  odeint::integrate_adaptive(stepper, restricted_rate, z, 0.0L, time, 1e-3L);
  return z;
}

// The shipped rendezvous on the near-rectilinear halo orbit: the costates lead to the place and the
// velocity in a program of the test's own, which finds the same energy.
TEST(OwnThrust, CostatesOnTheHaloOrbitLeadToTheEndInAnotherProgram) {
  const Scene scene = io::read_scene(std::filesystem::path(HAMJET_SOURCE_DIR) /
                                     "data/scenes/own/earth-moon-nrho-lasting-thrust.toml");
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.thrust);
  const double length_m = 384400e3, time_s = 375190.26;
  for (const EnergyOptimalTransfer& transfer : result.thrust->transfers) {
    ASSERT_TRUE(transfer.is_found()) << transfer.failure;
    Numbers chief{}, deputy{};
    for (std::size_t i = 0; i < 6; ++i) chief[i] = deputy[i] = scene.nominal[i];
    const auto add = [&](Numbers& z, const Eigen::Vector3d& place, const Eigen::Vector3d& rate) {
      const Eigen::Vector3d q = place / length_m, v = rate * time_s / length_m;
      for (std::size_t i = 0; i < 3; ++i) z[i] += q[static_cast<Eigen::Index>(i)];
      z[3] += v[0] - q[1];
      z[4] += v[1] + q[0];
      z[5] += v[2];
    };
    add(deputy, scene.transfer->start.position_m, scene.transfer->start.velocity_m_s);
    for (std::size_t i = 0; i < 6; ++i) deputy[6 + i] = transfer.refined->costates[i];
    chief = flown(chief, transfer.time);
    add(chief, scene.transfer->end.position_m, scene.transfer->end.velocity_m_s);
    deputy = flown(deputy, transfer.time);
    for (std::size_t i = 0; i < 6; ++i) {
      // The thrust was corrected to a tenth of a millimetre, in velocity to what makes as much in
      // the unit of time; both flights are right to some 1e-13.
      EXPECT_LT(std::abs(static_cast<double>(deputy[i] - chief[i])) * length_m, 3e-4) << i;
    }
    const double energy =
        static_cast<double>(deputy[12]) * length_m * length_m / (time_s * time_s * time_s);
    EXPECT_NEAR(transfer.energy_m2_s3, energy, 1e-8 * energy);
  }
}

TEST(OwnThrust, WhatAThrustAsksOfAHamiltonianIsSaid) {
  const auto refused = [](const std::string& scene, const std::vector<std::string>& words) {
    test::expect_error([&] { io::parse_scene(scene, "x"); }, ErrorKind::scene, words, scene);
  };
  const std::string energy = "[transfer]\nthrust = \"energy-optimal\"\n" + along_line;
  refused(line_scene("p^2/4", energy),
          {"transfer.thrust: not available for this Hamiltonian", "must be of a unit mass"});
  refused(line_scene("p^2/2", energy + "feedback = 4\n"),
          {"transfer.feedback: a law of three coordinates, got 4"});
  refused(line_scene("p^2/2", "[transfer]\n" + along_line + "[thruster]\nacceleration_m_s2 = 2\n"),
          {"thruster: burns in place of impulses are of spacecraft in an orbit"});
}

}  // namespace
}  // namespace hamjet
