#include "hamjet/studies/validity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "../../src/studies/exact_flow.hpp"
#include "../../src/studies/formation/charts/deputy_flows.hpp"
#include "../../src/studies/formation/single_transfer.hpp"
#include "../../src/studies/formation/validity/flown_deputies.hpp"
#include "../../src/studies/formation_scale.hpp"
#include "../../src/studies/jets_along_time.hpp"
#include "formation_scenes.hpp"
#include "hamjet/detail/algebra/monomial_values.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "unseen_deputies.hpp"

namespace hamjet {
namespace {

Scene scene_of(int order, double tolerance_m) {
  Scene scene = paper_chief(order);
  ValiditySettings validity;
  validity.tolerance_m = tolerance_m;
  validity.times = {3.0, 9.0};
  validity.samples = 20;
  scene.validity = validity;
  return scene;
}

TEST(Validity, ProvedSeparationMeetsTheToleranceAndGrowsWithTheOrder) {
  const ValidityResult result = study_validity(scene_of(4, 1));
  ASSERT_EQ(result.points.size(), 2U);
  EXPECT_GT(result.flights, 0);
  EXPECT_LT(result.flight_floor_m, 1e-4);
  for (const ValidityPoint& point : result.points) {
    ASSERT_EQ(point.entries.size(), 4U);
    double smaller = 0;
    for (const ValidityEntry& entry : point.entries) {
      EXPECT_LE(entry.miss_m, 1);
      EXPECT_GT(entry.miss_m, 0.5);  // known to a few percent of the separation
      EXPECT_GT(entry.proved_m, smaller);
      smaller = entry.proved_m;
    }
    // The part of degree k + 1 foretells the error of order k.
    for (const ValidityEntry& entry : point.entries) {
      EXPECT_NEAR(entry.predicted_m / entry.proved_m, 1, 0.3) << entry.order;
    }
  }
}

// Flown independently of the study: deputies drawn inside the proved separation, in the coordinates
// that `hamjet eval` and `hamjet transfer` take, all meet the tolerance, whatever the frame.
TEST(Validity, EveryDeputyInsideTheProvedSeparationMeetsTheTolerance) {
  for (const RelativeFrame kind : {RelativeFrame::rtn_rotating, RelativeFrame::rtn_inertial}) {
    Scene scene = scene_of(3, 1);
    scene.nominal = {1, 0, 0, 0, 0.6, std::sqrt(1.7 - 0.36)};  // e = 0.7, from perigee
    scene.validity->times = {6.0};
    scene.validity->frame = kind;
    const ValidityResult result = study_validity(scene);
    const ComputedProblem problem = make_problem(scene);
    FlowJet<double> jet;
    const double time = 6.0;
    visit_jets(problem, scene.integrators[0], std::span(&time, 1),
               [&](std::size_t, const FlowJet<double>& reached) { jet = reached; });
    MonomialValues values(problem.space);
    const double semi_major_axis = 1 / 0.3;
    test::UnseenDeputies deputies(scene, problem, kind, std::pow(semi_major_axis, -1.5), 7);
    const auto share = [&](int k) {
      return k % 4 == 0 ? 1 : std::uniform_real_distribution(0.5, 1.0)(deputies.generator());
    };
    const auto predict = [&](const std::vector<double>& start, int order) {
      values.set_point(start);
      return std::array{values.value(jet[0], order), values.value(jet[1], order),
                        values.value(jet[2], order)};
    };
    for (const ValidityEntry& entry : result.points[0].entries) {
      const int beyond = deputies.beyond_a_metre(entry, time, 200, share, predict);
      EXPECT_EQ(beyond, 0) << "order " << entry.order;
    }
  }
}

// The miss of order k goes as separation^(k+1).
TEST(Validity, SeparationGoesAsARootOfTheTolerance) {
  const ValidityResult fine = study_validity(scene_of(3, 0.1));
  const ValidityResult coarse = study_validity(scene_of(3, 10));
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = coarse.points[0].entries[k].proved_m / fine.points[0].entries[k].proved_m;
    EXPECT_NEAR(std::log(100) / std::log(ratio), static_cast<double>(k) + 2, 0.2);
  }
}

// Independent of the number of random deputies: the worst ones are looked for.
TEST(Validity, MoreSamplesFindNothingMuchWorse) {
  Scene few = scene_of(4, 1);
  Scene many = few;
  few.validity->samples = 10;
  many.validity->samples = 2000;
  const ValidityResult a = study_validity(few);
  const ValidityResult b = study_validity(many);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(a.points[i].entries[k].proved_m / b.points[i].entries[k].proved_m, 1, 0.1)
          << i << ' ' << k + 1;
    }
  }
}

// Here the error of order 3 has two pairs of maxima, and the largest of random deputies lie below
// the lower pair. The deputy was found by an independent search over flights in extended precision;
// it misses by 3.5 % more than the tolerance where the lower pair alone is flown.
TEST(Validity, AllMaximaOfTheErrorAreFlown) {
  const Scene scene = io::parse_scene(R"(
[system]
model = "zonal-gravity"
mu_km3_s2 = 398600.4415
radius_km = 6378.1363
J2 = 0.00108262668355315
J3 = -2.53265648533224e-06
J4 = -1.619621591367e-06
J5 = -2.27296082868698e-07
J6 = 5.40681239107085e-07
[nominal]
a_km = 6862.247585
e = 0.0217531715
i_deg = 72.8107042
raan_deg = -170.190019
argp_deg = 147.445145
ea_deg = -37.6222792
[jet]
order = 4
duration_s = -2832.896797406844
coordinates = "nodal"
[validity]
tolerance_m = 1.98928757
frame = "RTN"
derivatives = "inertial"
count = 1
samples = 43
)",
                                      "maxima.toml");
  Vector6 deputy;  // metres and m/s along R, T and N
  deputy << -6931.44956, -12165.9881, 30198.3197, 16.1536565, 12.279156, -30.9029384;
  deputy.head<3>().normalize();
  deputy.tail<3>().normalize();
  const ValidityEntry entry = study_validity(scene).points.at(0).entries.at(2);
  const ComputedProblem problem = make_problem(scene);
  const Matrix6 axes = ellipsoid_axes(problem.nominal, scene.validity->frame,
                                      scene.validity->semi_axes, momentum_per_length(scene));
  DeputyFlowPropagation propagation(scene, problem, scene.integrators[0],
                                    {JetCoordinates::nodal, JetCoordinates::nodal});
  const std::unique_ptr<DeputyFlow> flow = propagation.advance_to(scene.duration);
  FlownDeputies deputies(problem, axes, scene.duration, *flow, nullptr, [] {});
  const double metres = metric_units(scene).length_m;
  EXPECT_LE(deputies.miss(entry.proved_m / metres * deputy, 3) * metres,
            scene.validity->tolerance_m);
}

// The differences are of the misses of whole flights.
TEST(Validity, GradientsOfMissesAreTheirDifferences) {
  Scene scene = scene_of(2, 1);
  const double time = 9;
  const ComputedProblem problem = make_problem(scene);
  const Matrix6 axes = ellipsoid_axes(problem.nominal, scene.validity->frame,
                                      scene.validity->semi_axes, momentum_per_length(scene));
  Vector6 direction;
  direction << 0.36, 0.6, -0.72, 0.6, 0.3, -0.75;
  const Vector6 deputy = 5e-4 * direction;
  const double step = 5e-7;
  for (const JetCoordinates kind : {JetCoordinates::cartesian, JetCoordinates::nodal}) {
    DeputyFlowPropagation propagation(scene, problem, scene.integrators[0], {kind, kind});
    const std::unique_ptr<DeputyFlow> flow = propagation.advance_to(time);
    FlownDeputies deputies(problem, axes, time, *flow, nullptr, [] {});
    for (const int order : {1, 2}) {
      Vector6 differences;
      for (Eigen::Index i = 0; i < 6; ++i) {
        const Vector6 change = step * Vector6::Unit(i);
        differences[i] =
            (deputies.miss(deputy + change, order) - deputies.miss(deputy - change, order)) /
            (2 * step);
      }
      const Vector6 gradient = deputies.gradient(deputy, order, step);
      EXPECT_LT((gradient - differences).norm(), 1e-4 * differences.norm())
          << static_cast<int>(kind) << ' ' << order << '\n'
          << gradient.transpose() << '\n'
          << differences.transpose();
    }
  }
}

TEST(Validity, AFlatEllipsoidReachesAtLeastAsFarAsTheBall) {
  Scene scene = scene_of(2, 1);
  const ValidityResult ball = study_validity(scene);
  scene.validity->semi_axes = {0.1, 0.1, 1};  // mostly normal to the plane
  const ValidityResult flat = study_validity(scene);
  EXPECT_GT(flat.points[1].entries[1].proved_m, ball.points[1].entries[1].proved_m);
}

ReachLimit limit_of(Scene scene, JetCoordinates coordinates, double time, double tolerance_m) {
  scene.coordinates = coordinates;
  ValiditySettings validity;
  validity.tolerance_m = tolerance_m;
  validity.times = {time};
  validity.samples = 20;
  scene.validity = validity;
  const ValidityEntry entry = study_validity(scene).points.at(0).entries.back();
  EXPECT_TRUE(entry.limit.has_value());
  return entry.limit.value_or(ReachLimit{});
}

// From the perigee a deputy escapes first if it is farther out and faster along the chief's
// velocity: ((v + s n)^2) / 2 = 1 / (1 + s), where a flow box, exact of Kepler's bound orbits,
// ends.
TEST(Validity, AFlowBoxEndsWhereADeputyEscapes) {
  const double eccentricity = 0.74;
  Scene scene = kepler_chief(eccentricity, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), 1);
  const double mean_motion = std::pow(1 - eccentricity, 1.5);
  scene.coordinates = JetCoordinates::flow_box;
  ValiditySettings validity;
  validity.tolerance_m = 7;
  validity.times = {4 * std::numbers::pi / mean_motion};
  validity.samples = 20;
  validity.frame = RelativeFrame::rtn_inertial;
  scene.validity = validity;
  const double v = std::sqrt(1 + eccentricity);
  double escape = 0;
  for (double step = 0.1; step > 1e-6; step /= 2) {
    const double s = escape + step;
    if ((v + s * mean_motion) * (v + s * mean_motion) / 2 < 1 / (1 + s)) escape = s;
  }
  const ValidityEntry entry = study_validity(scene).points[0].entries[0];
  EXPECT_LT(entry.proved_m, escape * 7e6);
  EXPECT_GT(entry.proved_m, 0.9 * escape * 7e6);
  EXPECT_TRUE(entry.is_at_wall);
  EXPECT_FALSE(entry.limit.has_value());
}

// In Poincare's elements Kepler's flow shifts the mean longitude by t L^-3 and nothing else: what
// order k neglects is of degree k + 1 in L alone.
TEST(ReachLimit, OfKeplersFlowInElementsIsTheMeanMotion) {
  const Scene scene = kepler_chief(0.3, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), 3);
  for (int order = 1; order <= 3; ++order) {
    Scene of_order = scene;
    of_order.order = order;
    const ReachLimit limit = limit_of(of_order, JetCoordinates::poincare, paper_period, 0.1);
    EXPECT_EQ(limit.start_coordinate, "L") << order;
    EXPECT_EQ(limit.end_coordinate, "l+g+h") << order;
    // The next degree adds some (order + 4) / (order + 1) of the deviation, below 1e-3.
    EXPECT_NEAR(limit.degree, order + 1, 0.03);
    EXPECT_NEAR(limit.start_degree, order + 1, 0.03);
    EXPECT_NEAR(limit.end_share, 1, 1e-3);
  }
}

// By Clohessy and Wiltshire's solution a deputy of a circular orbit is (6 n t x + 3 t vT) behind
// after whole revolutions, and the bend of the orbit by half of that squared nearer to the centre:
// of the two degrees that order 1 neglects, 2/3 are of x and 1/3 of vT where both are as long.
TEST(ReachLimit, OfALinearFlowInPositionsIsTheBendOfTheOrbit) {
  const double revolutions = 3;
  Scene scene = kepler_chief(0, 7000, std::sqrt(7000.0 * 7000 * 7000 / 398600.4405), 1);
  scene.nominal = {0, 1, 0, 0, 0, 1};  // R, T and N are y, z and x
  const ReachLimit limit =
      limit_of(scene, JetCoordinates::cartesian, 2 * std::numbers::pi * revolutions, 0.1);
  EXPECT_EQ(limit.start_coordinate, "R");
  EXPECT_EQ(limit.end_coordinate, "R");
  EXPECT_NEAR(limit.degree, 2, 0.01);
  // T, 1 beside 6 n t = 113, and second order along the orbit, 15/8 n t beside 9/8 (n t)^2 of both,
  // are left out.
  EXPECT_NEAR(limit.start_degree, 4.0 / 3, 0.05);
  EXPECT_GT(limit.end_share, 0.95);
}

}  // namespace
}  // namespace hamjet
