#include "studies/formation/charts/coordinate_deviations.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/transfer.hpp"
#include "hamjet/studies/validity.hpp"
#include "../periodic/independent_halo.hpp"
#include "support/errors.hpp"

// Transfers and reach along the coordinates of systems without an orbit.

namespace hamjet {
namespace {

/// Hill's equations of the motion about a circular orbit at the rate 1/2, in metres and seconds,
/// about their equilibrium at the origin.
std::string hills_scene(const std::string& hamiltonian, const std::string& more) {
  return R"(schema = 1
title = "Hill's equations"
[system]
model = "own"
coordinates = ["x", "y", "z"]
momenta = ["px", "py", "pz"]
parameters = { n = 0.5, m = 1 }
hamiltonian = ")" +
         hamiltonian + R"("
[nominal]
coordinates = [0, 0, 0]
momenta = [0, 0, 0]
[jet]
order = 2
duration_canonical = 4
)" + more;
}

const std::string clohessy_wiltshire =
    "(px^2 + py^2 + pz^2)/(2*m) + n*(y*px - x*py) + m*n^2*(y^2 + z^2)/2 - m*n^2*x^2";
const std::string transfer =
    "[transfer]\ntimes_s = [1, 3]\n"
    "start = { position_m = [1, -2, 0.5], velocity_m_s = [0.1, 0.2, -0.3] }\n"
    "end = { position_m = [0.2, 0.3, -0.1] }\n";

// The solution of Clohessy and Wiltshire, position by position and velocity.
struct ClohessyWiltshire {
  Eigen::Matrix3d rr, rv, vr, vv;

  ClohessyWiltshire(double n, double t) {
    const double c = std::cos(n * t), s = std::sin(n * t);
    rr << 4 - 3 * c, 0, 0, 6 * (s - n * t), 1, 0, 0, 0, c;
    rv << s, 2 * (1 - c), 0, -2 * (1 - c), 4 * s - 3 * n * t, 0, 0, 0, s;
    rv /= n;
    vr << 3 * n * s, 0, 0, -6 * n * (1 - c), 0, 0, 0, 0, -n * s;
    vv << c, 2 * s, 0, -2 * s, 4 * c - 3, 0, 0, 0, c;
  }
};

void expect_changes(const TransferResult& result, double n) {
  const Eigen::Vector3d r0(1, -2, 0.5), v0(0.1, 0.2, -0.3), r1(0.2, 0.3, -0.1);
  ASSERT_EQ(result.points.size(), 2U);
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer());
    const ClohessyWiltshire flow(n, point.time);
    const Eigen::Vector3d v = flow.rv.partialPivLu().solve(Eigen::Vector3d(r1 - flow.rr * r0));
    const Eigen::Vector3d start = v - v0;
    const Eigen::Vector3d end = -(flow.vr * r0 + flow.vv * v);
    EXPECT_LT((point.best().start_change_m_s - start).norm(), 1e-12 * start.norm());
    EXPECT_LT((point.best().end_change_m_s - end).norm(), 1e-12 * end.norm());
    EXPECT_LT(point.best().miss_m, 1e-12);
    EXPECT_FALSE(point.drift);
  }
}

// Two impulses from rates to rest, by the closed solution; with another mass the momenta differ and
// the velocities do not.
TEST(CoordinateDeviations, TransfersOfHillsEquationsAreThoseOfClohessyAndWiltshire) {
  for (const char* mass : {"1", "2.5"}) {
    const Scene scene = io::parse_scene(hills_scene(clohessy_wiltshire, transfer), "x",
                                        {{"system.parameters.m", mass}});
    ASSERT_EQ(scene.transfer->frame, RelativeFrame::coordinates);
    const TransferResult result = study_transfer(scene);
    expect_changes(result, 0.5);
    // The nominal rests at the origin, where positions, momenta and energy have no size.
    for (const SelfCheck& check : result.checks) {
      EXPECT_NE(check.state, SelfCheckState::failed) << check.text;
    }
  }
}

// The same in kilometres and minutes: changes are told in metres a second.
TEST(CoordinateDeviations, UnitsOfTheSceneConvertVelocities) {
  const std::string scene =
      hills_scene(clohessy_wiltshire, "[units]\nlength_km = 7\ntime_s = 60\n" + transfer);
  TransferResult result = study_transfer(io::parse_scene(scene, "x"));
  for (TransferPoint& point : result.points) point.time *= 60;
  expect_changes(result, 0.5 / 60);
}

// A linear flow is its own polynomial, at every separation that is tried.
TEST(CoordinateDeviations, TheReachOfALinearSystemHasNoLimit) {
  const Scene scene =
      io::parse_scene(hills_scene(clohessy_wiltshire, "[validity]\ncount = 2\n"), "x");
  const ValidityResult result = study_validity(scene);
  ASSERT_EQ(result.points.size(), 2U);
  for (const ValidityPoint& point : result.points) {
    for (const ValidityEntry& entry : point.entries) {
      EXPECT_TRUE(entry.is_at_limit);
      EXPECT_DOUBLE_EQ(entry.proved_m, 0.5);  // half of the size of a nominal at the origin, 1 m
    }
  }
}

TEST(CoordinateDeviations, ScenesThatHaveNoVelocitiesOrFrames) {
  const auto refused = [](const std::string& scene, const std::vector<std::string>& words) {
    test::expect_error([&] { io::parse_scene(scene, "x"); }, ErrorKind::scene, words, scene);
  };
  refused(
      hills_scene("n*px^2*py^2 + pz^2 + m*x^2", transfer),
      {"transfer: not available for this Hamiltonian", "not linear in coordinates and momenta"});
  refused(hills_scene("(n*px^2 + m*py^2)/2 + z*x + pz", transfer),
          {"transfer: not available for this"});
  const std::string moved = hills_scene(clohessy_wiltshire, "");
  refused(moved + "[transfer]\nframe = \"RTN\"\ntimes_s = 1\nend = { position_m = [0, 0, 0] }\n",
          {"transfer.frame: axes of an orbit", "must be \"coordinates\""});
  refused(moved + "[validity]\ncount = 1\nderivatives = \"rotating\"\n",
          {"validity.derivatives: of RTN alone"});
  refused(hills_scene(clohessy_wiltshire, transfer + "keep_out_m = [1, 1, 1]\n"),
          {"transfer.keep_out_m: for spacecraft in an orbit"});
  refused(hills_scene(clohessy_wiltshire, transfer + "impulses = \"optimal\"\n"),
          {"transfer.impulses: for spacecraft in an orbit"});
  refused(moved +
              "[transfer]\ntimes_s = 1\nstart = { a_km = 7000 }\n"
              "end = { position_m = [0, 0, 0] }\n",
          {"transfer.start.a_km: a form of deputies in an orbit"});
  refused(hills_scene(clohessy_wiltshire, transfer + "[thruster]\nacceleration_m_s2 = 1\n"),
          {"thruster: burns in place of impulses are of spacecraft in an orbit"});
  refused(R"(schema = 1
title = "x"
[system]
model = "own"
states = ["x", "v"]
vector_field = { x = "v", v = "-x" }
[nominal]
states = [1, 0]
[jet]
order = 2
duration_canonical = 1
[validity]
count = 1
)",
          {"validity: not available for a vector field", "must be a Hamiltonian"});
}

TEST(CoordinateDeviations, TheLawOfVelocitiesIsThatOfTheField) {
  const DynamicalSystem turning = make_system("turning", 3, [](auto q, auto p) {
    using T = std::remove_cvref_t<decltype(q[0])>;
    return (p[0] * p[0] + p[1] * p[1]) / T(2) + p[2] * p[2] / T(8) +
           T(0.25) * (q[1] * p[0] - q[0] * p[1]) + cos(q[2]);
  });
  const auto law = velocity_law(turning, {1, 2, 3, 4, 5, 6});
  ASSERT_TRUE(law);
  EXPECT_TRUE(law->by_momenta.isApprox(Eigen::Vector3d(1, 1, 0.25).asDiagonal().toDenseMatrix()));
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(0, 1) = 0.25;
  turn(1, 0) = -0.25;
  EXPECT_TRUE(law->by_positions.isApprox(turn));
}

constexpr double halo_length_m = 384400e3;
constexpr double halo_time_s = 375190.26;

/// The place in metres, relative to the target, of a chaser with these rates, flown by the test's
/// own integrator.
Eigen::Vector3d flown_place(const std::vector<double>& nominal, const Eigen::Vector3d& place_m,
                            const Eigen::Vector3d& velocity_m_s, double time) {
  const test::RestrictedProblem problem(1 / 82.30059L);
  test::HaloState target = test::RestrictedProblem::start(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) target[i] = nominal[i];
  target[3] = static_cast<long double>(nominal[3]) + nominal[1];
  target[4] = static_cast<long double>(nominal[4]) - nominal[0];
  target[5] = nominal[5];
  test::HaloState chaser = target;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    chaser[i] += place_m[axis] / halo_length_m;
    chaser[3 + i] += velocity_m_s[axis] * halo_time_s / halo_length_m;
  }
  const test::HaloState there = problem.flown(target, time), met = problem.flown(chaser, time);
  Eigen::Vector3d place;
  for (std::size_t i = 0; i < 3; ++i) {
    place[static_cast<Eigen::Index>(i)] = static_cast<double>((met[i] - there[i]) * halo_length_m);
  }
  return place;
}

// The chaser of the shipped scene, a day and half a period on its way, with the polynomials' own
// velocity changes.
TEST(HaloRendezvous, ADayAndHalfAPeriodLeadWithinAMetreOfThePlace) {
  const std::filesystem::path file =
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own/earth-moon-nrho-rendezvous.toml";
  Scene scene = io::read_scene(file);
  scene.validity.reset();
  const TransferResult result = study_transfer(scene);
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_NEAR(result.points[1].time, 1.5111111111111111 / 2, 1e-8);
  const Eigen::Vector3d start = scene.transfer->start.position_m;
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer());
    const TransferAnswer& last = point.answers.back();
    const Eigen::Vector3d met =
        flown_place(scene.nominal, start, last.start_change_m_s, point.time);
    EXPECT_LT((met - scene.transfer->end.position_m).norm(), 1) << point.time;
    EXPECT_LT(last.miss_m, 1);
    // The linear theory misses by more.
    EXPECT_GT(point.answers.front().miss_m, 10 * last.miss_m);
    const Eigen::Vector3d drifted =
        flown_place(scene.nominal, start, Eigen::Vector3d::Zero(), point.time);
    EXPECT_GT((drifted - scene.transfer->end.position_m).norm(), 1e4);
  }
}

/// The place to which a jet in extended precision takes a deviation (dq, dp), by its terms up to an
/// order, in canonical units.
Eigen::Vector3d place_by_jet(const FlowJet<Extended>& jet, const Eigen::Matrix<double, 6, 1>& d,
                             int order) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  const SeriesSpace& space = jet[0].space();
  for (std::size_t k = 1; k < space.first(order + 1); ++k) {
    double monomial = 1;
    Eigen::Index variable = 0;
    for (const auto exponent : space.exponents(k)) {
      for (int e = 0; e < exponent; ++e) monomial *= d[variable];
      ++variable;
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      place[i] += static_cast<double>(jet[static_cast<std::size_t>(i)][k]) * monomial;
    }
  }
  return place;
}

// Random chasers at the reach that `validity` proves, flown by the test's own integrator, are where
// the polynomials of that order say to the tolerance; further away some are not.
TEST(HaloRendezvous, TheReachIsThatOfFlownNeighbours) {
  const std::filesystem::path file =
      std::filesystem::path(HAMJET_SOURCE_DIR) / "data/scenes/own/earth-moon-nrho-rendezvous.toml";
  Scene scene = io::read_scene(file, {{"jet.order", "3"}});
  scene.validity->samples = 10;
  const ValidityResult result = study_validity(scene);
  ASSERT_EQ(result.points.size(), 2U);
  std::mt19937_64 generator(7);
  for (const ValidityPoint& point : result.points) {
    Scene flown = scene;
    flown.duration = point.time;
    flown.validity.reset();
    flown.transfer.reset();
    const PropagationResult run = propagate(flown);
    ASSERT_EQ(run.runs.at(0).failure, "");
    double before = 0;
    for (const ValidityEntry& entry : point.entries) {
      EXPECT_GT(entry.proved_m, before) << point.time << ", order " << entry.order;
      before = entry.proved_m;
      double at_reach = 0, beyond = 0;
      for (int k = 0; k < 12; ++k) {
        Eigen::Vector3d place, rate;
        for (Eigen::Vector3d* vector : {&place, &rate}) {
          for (double& x : *vector) x = std::normal_distribution<double>()(generator);
          vector->normalize();
        }
        for (const double separation : {entry.proved_m, 4 * entry.proved_m}) {
          const Eigen::Vector3d q = separation / halo_length_m * place;
          const Eigen::Vector3d v = separation / halo_length_m * rate;
          Eigen::Matrix<double, 6, 1> d;
          d << q, v[0] - q[1], v[1] + q[0], v[2];
          const Eigen::Vector3d by_jet =
              halo_length_m * place_by_jet(run.runs[0].jet, d, entry.order);
          const Eigen::Vector3d met = flown_place(scene.nominal, halo_length_m * q,
                                                  v * halo_length_m / halo_time_s, point.time);
          double& largest = separation > entry.proved_m ? beyond : at_reach;
          largest = std::max(largest, (by_jet - met).norm());
        }
      }
      EXPECT_LE(at_reach, 1.05 * scene.validity->tolerance_m) << entry.order;
      EXPECT_GT(beyond, scene.validity->tolerance_m) << entry.order;
    }
  }
}

}  // namespace
}  // namespace hamjet
