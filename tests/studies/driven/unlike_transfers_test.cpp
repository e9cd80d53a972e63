#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "algebra/state_sums.hpp"
#include "hamjet/scene/scene_reader.hpp"
#include "hamjet/studies/assignment.hpp"
#include "hamjet/studies/transfer.hpp"
#include "low_orbit_text.hpp"
#include "studies/earth_system.hpp"
#include "studies/exact_flow.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/formation/two_point_flight.hpp"
#include "support/errors.hpp"

// Transfers of deputies with another C_D A / m, or C_R A / m, than their chief. Expected: flights
// of each spacecraft in a scene of its own, whose chief it is, and closed forms.

namespace hamjet {
namespace {

constexpr double chief_drag = 0.01;
constexpr double deputy_drag = 0.02;

/// 514 km above the equator in layers of air that are the same all around, without harmonics: a
/// circle, but for the drag.
Scene circle(double chief, double deputy, const std::string& more) {
  Scene scene = io::parse_scene(
      low_pair_text("atmosphere = \"exponential\"", chief, deputy, 0.1, "0, -300, 0") + more,
      "unlike.toml");
  scene.system.earth->degree = 0;
  scene.system.earth->order = 0;
  return scene;
}

/// The end of [transfer], 100 m behind the chief.
const std::string behind = "[transfer]\nend = { position_m = [0, -100, 0] }\n";

double period_s(const Scene& scene) {
  return 2 * std::numbers::pi * scene.units.time_s *
         std::pow(position_of(scene.nominal).norm(), 1.5);
}

/// Flights of a spacecraft with the coefficients of the scene's chief, which know of no other one.
class FlightOfUnlike {
 public:
  explicit FlightOfUnlike(Scene scene) : scene_(std::move(scene)) {
    scene_.deputy.reset();
    system_ = SharedSystem(make_system(scene_));
  }
  std::vector<double> end(const std::vector<double>& state, double from, double to) const {
    return exact_flow(system_, state, scene_.start_time + from, to - from);
  }

 private:
  Scene scene_;
  SharedSystem system_;
};

/// A scene whose chief is like the deputy.
Scene of_deputy(Scene scene) {
  EarthSettings& earth = *scene.system.earth;
  earth.drag_m2_kg = scene.deputy->drag_m2_kg.value_or(earth.drag_m2_kg);
  earth.radiation_m2_kg = scene.deputy->radiation_m2_kg.value_or(earth.radiation_m2_kg);
  return scene;
}

/// The state, relative to the chief, at the end of a flight with impulses.
RelativeState flown_end(const Scene& scene, const std::vector<Impulse>& impulses, double end) {
  const FlightOfUnlike chief(scene), deputy(of_deputy(scene));
  const auto frame = [&](double time) {
    return ChiefFrame(time == 0 ? scene.nominal : chief.end(scene.nominal, 0, time),
                      metric_units(scene), scene.transfer->frame);
  };
  std::vector<double> state = state_sum(scene.nominal, frame(0).deviation(scene.transfer->start));
  double now = 0;
  for (const Impulse& impulse : impulses) {
    if (impulse.time != now) state = deputy.end(state, now, impulse.time);
    now = impulse.time;
    state = state_sum(state, frame(now).deviation({Eigen::Vector3d::Zero(), impulse.change_m_s}));
  }
  if (end != now) state = deputy.end(state, now, end);
  return frame(end).relative(state_difference(state, chief.end(scene.nominal, 0, end)));
}

std::vector<Impulse> impulses_of(const TransferPoint& point) {
  return {{0, point.best().start_change_m_s}, {point.time, point.best().end_change_m_s}};
}

void expect_at_end(const Scene& scene, const std::vector<Impulse>& impulses, double end) {
  const RelativeState there = flown_end(scene, impulses, end);
  EXPECT_LT((there.position_m - scene.transfer->end.position_m).norm(), 2e-3);
  EXPECT_LT((there.velocity_m_s - scene.transfer->end.velocity_m_s).norm(), 2e-5);
}

TEST(UnlikeTransfers, EndsAreReachedAsByDeputiesThatAreAlike) {
  const std::string transfer = behind + "count = 6\n";
  const TransferResult unlike = study_transfer(circle(chief_drag, deputy_drag, transfer));
  const TransferResult alike = study_transfer(circle(chief_drag, chief_drag, transfer));
  ASSERT_EQ(unlike.points.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    const TransferPoint& point = unlike.points[k];
    ASSERT_TRUE(point.has_answer()) << point.failure;
    // Polynomials of order 3 have misses of the same size, half a millimetre beside 400 m.
    EXPECT_LT(point.answers.back().miss_m, 1e-3);
    EXPECT_LT(alike.points[k].answers.back().miss_m, 1e-3);
    expect_at_end(unlike.scene, impulses_of(point), point.time);
    EXPECT_LT((point.arrived.position_m - unlike.scene.transfer->end.position_m).norm(), 1e-3);
  }
}

// Expected, from Clohessy and Wiltshire's equations with a constant deceleration f along the
// motion: a transfer from the chief's place back to it in k + 1/2 revolutions takes the changes (-2
// f / n, f t / 2, 0) and (2 f / n, f t / 2, 0).
TEST(UnlikeTransfers, ChangesOfVelocityDifferByWhatDragDoes) {
  Scene scene = circle(chief_drag, 1.02 * chief_drag,
                       "[transfer]\nend = { position_m = [0, 0, 0] }\ncount = 1\n");
  scene.transfer->start.position_m.setZero();
  scene.transfer->start.velocity_m_s.setZero();
  const double time_s = 3.5 * period_s(scene);
  scene.transfer->times = {time_s / scene.units.time_s};
  const TransferResult result = study_transfer(scene);
  const TransferPoint& point = result.points.at(0);
  ASSERT_TRUE(point.has_answer()) << point.failure;
  // The published table: 6.967e-13 kg/m^3 at 500 km, 1.454e-13 at 600 km, exponential between.
  const double density = 6.967e-13 * std::pow(1.454 / 6.967, 0.14);
  const double radius_m = position_of(scene.nominal).norm() * scene.units.length_km * 1000;
  const double rate = 2 * std::numbers::pi / period_s(scene);
  const double speed = radius_m * (rate - 7.292115e-5);  // the speed of the air, eastwards
  const double f = 0.5 * 0.02 * chief_drag * density * speed * speed;
  const double t = time_s;
  const TransferAnswer& answer = point.best();
  // Density and radius change along the spiral, and the table is smooth between its heights.
  const double some = 0.04 * f * t;
  EXPECT_NEAR(answer.start_change_m_s[1], f * t / 2, some);
  EXPECT_NEAR(answer.end_change_m_s[1], f * t / 2, some);
  EXPECT_NEAR(answer.start_change_m_s[0], -2 * f / rate, some);
  EXPECT_NEAR(answer.end_change_m_s[0], 2 * f / rate, some);
  EXPECT_GT(f * t, 1e-6);
}

TEST(UnlikeTransfers, DriftsAfterItsArrival) {
  const Scene scene = circle(chief_drag, deputy_drag, behind + "times_s = [20000]\n");
  const TransferResult result = study_transfer(scene);
  ASSERT_TRUE(result.points.at(0).drift.has_value());
  // A revolution after its arrival the deputy is 3/2 f t^2 ahead; both spacecraft alone say it.
  const double period = period_s(scene) / scene.units.time_s;
  const double time = result.points[0].time;
  const std::vector<Impulse> impulses = impulses_of(result.points[0]);
  const double before = flown_end(scene, impulses, time).position_m[1];
  const double after = flown_end(scene, impulses, time + period).position_m[1];
  EXPECT_NEAR(before, -100, 0.01);
  EXPECT_GT(after - before, 1);
  EXPECT_NEAR(result.points[0].drift->per_revolution_m, after - before, 0.02 * (after - before));
  // Of deputies that are alike, what is left is the curvature of the orbit.
  const TransferResult alike =
      study_transfer(circle(chief_drag, chief_drag, behind + "times_s = [20000]\n"));
  EXPECT_LT(std::abs(alike.points.at(0).drift->per_revolution_m), 0.05 * (after - before));
}

TEST(UnlikeTransfers, WaysOfSeveralImpulses) {
  const TransferResult result =
      study_transfer(circle(chief_drag, deputy_drag,
                            behind + "times_s = [9000, 20000]\nimpulses = \"optimal\"\n"
                                     "longest_coast_s = 6000\nkeep_out_m = [20, 40, 20]\n"
                                     "waypoint = [{ time_s = 4000, position_m = [0, -200, 0] }]\n"
                                     "[thruster]\nacceleration_m_s2 = 1e-3\n"));
  ASSERT_TRUE(result.optimal && result.optimal->is_found()) << result.optimal->failure;
  expect_at_end(result.scene, result.optimal->plan->impulses, result.optimal->plan->duration);
  ASSERT_TRUE(result.coasting && result.coasting->plan) << result.coasting->failure;
  expect_at_end(result.scene, result.coasting->plan->impulses, result.coasting->plan->duration);
  ASSERT_TRUE(result.waypoints && result.waypoints->best_plan) << result.waypoints->failure;
  const WaypointPlan& way = result.waypoints->plans[*result.waypoints->best_plan];
  expect_at_end(result.scene, way.impulses, way.duration);
  const RelativeState there =
      flown_end(result.scene, {way.impulses[0], way.impulses[1]}, way.impulses[1].time);
  EXPECT_LT((there.position_m - Eigen::Vector3d(0, -200, 0)).norm(), 2e-3);
  // Burns of half a minute are hardly dearer than impulses, if they end where these do.
  ASSERT_TRUE(result.burns && result.burns->least) << result.burns->failure;
  for (const BurnPlan& plan : result.burns->plans) {
    if (!plan.is_found()) continue;
    EXPECT_LT(std::abs(plan.loss_m_s()), 1e-3 * plan.impulses_m_s);
  }
}

TEST(UnlikeTransfers, ThrustOfLeastEnergy) {
  const TransferResult result =
      study_transfer(circle(chief_drag, deputy_drag,
                            behind + "times_s = [9000, 20000]\n"
                                     "thrust = \"energy-optimal\"\nthrust_order = 2\n"));
  ASSERT_TRUE(result.thrust && result.thrust->least) << result.thrust->failure;
  const EnergyOptimalTransfer& least = result.thrust->transfers[*result.thrust->least];
  EXPECT_LT(least.refined->miss_m, 1e-3);
  // The frame is that of the real chief all along the way.
  EXPECT_LT((result.thrust->profile.back().thrust_m_s2 - least.end_thrust_m_s2).norm(),
            1e-9 * least.end_thrust_m_s2.norm());
}

// A path that is followed passes the same places as the flights above.
TEST(UnlikeTransfers, TrajectoriesAreTheDeputysOwn) {
  const TransferResult result =
      study_transfer(circle(chief_drag, deputy_drag, behind + "times_s = [20000]\n"));
  const RelativeTrajectory path = fly_relative(result, 0);
  EXPECT_LT((path.states.back().position_m - Eigen::Vector3d(0, -100, 0)).norm(), 2e-3);
  const RelativeState alone = flown_end(result.scene, {}, result.scene.duration);
  EXPECT_LT((path.unchanged.back().position_m - alone.position_m).norm(), 2e-3);
}

TEST(UnlikeTransfers, AssignmentsAreOfDeputiesLikeTheOne) {
  const AssignmentResult result = study_assignment(circle(chief_drag, deputy_drag, R"([transfer]
count = 4
end = { position_m = [0, 0, 0] }
[assignment]
keep_apart_m = 10
deputy = [{ position_m = [0, -300, 0] }, { position_m = [0, 200, 0] }]
slot = [{ position_m = [0, 100, 0] }, { position_m = [0, -100, 0] }]
)"));
  ASSERT_EQ(result.transfers.size(), 2U) << result.failure;
  for (const AssignedTransfer& assigned : result.transfers) {
    Scene one = result.scene;
    one.transfer->start = one.assignment->deputies[assigned.deputy];
    one.transfer->end = one.assignment->slots[assigned.slot];
    ASSERT_TRUE(assigned.transfer.has_answer());
    expect_at_end(one, impulses_of(assigned.transfer), assigned.transfer.time);
  }
  ASSERT_EQ(result.pairs.size(), 1U);
  EXPECT_GT(result.pairs[0].separation_m, 10);
}

// Geostationary satellites in the season of eclipses, of which one has 30 % more area in the light.
TEST(UnlikeTransfers, OfOtherAreaInTheLight) {
  const Scene scene = io::parse_scene(R"(schema = 1
[system]
model = "earth"
gravity_degree = 2
radiation = true
[spacecraft]
radiation_m2_kg = 0.02
[nominal]
epoch_utc = "2026-03-19T20:00:00"
a_km = 42165
e = 0
i_deg = 0.05
raan_deg = 80
u_deg = 50
[deputy]
position_m = [0, -2000, 0]
spacecraft = { radiation_m2_kg = 0.026 }
[jet]
order = 3
duration_s = 43200
[transfer]
count = 2
end = { position_m = [0, -100, 0] }
)",
                                      "light.toml");
  const TransferResult result = study_transfer(scene);
  for (const TransferPoint& point : result.points) {
    ASSERT_TRUE(point.has_answer()) << point.failure;
    EXPECT_LT(point.best().miss_m, 1e-3);
    const RelativeState there = flown_end(result.scene, impulses_of(point), point.time);
    EXPECT_LT((there.position_m - scene.transfer->end.position_m).norm(), 5e-3);
  }
}

TEST(UnlikeTransfers, EarlierJetsAreOfSpacecraftThatAreAlike) {
  const Scene scene = circle(chief_drag, deputy_drag, behind + "times_s = [20000]\n");
  EarlierJet earlier;
  const ComputedProblem problem = make_problem(scene);
  for (std::size_t i = 0; i < 6; ++i) {
    earlier.jet.push_back(Series<double>::variable(problem.space, i, scene.nominal[i]));
  }
  test::expect_error(ErrorKind::scene, "alike", [&] { study_transfer(scene, {}, &earlier); });
}

}  // namespace
}  // namespace hamjet
