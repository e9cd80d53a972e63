#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "algebra/state_sums.hpp"
#include "driven_scenes.hpp"
#include "hamjet/detail/studies/singular_times.hpp"
#include "studies/checks/flight_checks.hpp"
#include "studies/exact_flow.hpp"
#include "studies/flights/flight_arcs.hpp"
#include "studies/flights/relative_drift.hpp"
#include "studies/formation/extreme_separations.hpp"
#include "studies/formation/flown_trajectory.hpp"
#include "studies/formation/impulses/path_flow.hpp"
#include "studies/formation/keep_out.hpp"
#include "studies/formation/nearest_pairs.hpp"
#include "studies/formation/single_transfer.hpp"
#include "studies/formation/two_point_flight.hpp"
#include "studies/integration.hpp"
#include "studies/jets_along_time.hpp"
#include "studies/lowest_point.hpp"
#include "studies/many_flows.hpp"
#include "studies/nominal/followed_nominal.hpp"
#include "studies/reference.hpp"
#include "studies/scene_trajectory.hpp"

// Flights whose forces depend on the time, of all functions that studies fly with. Expected: the
// same flights by Boost.odeint, whose force is written by hand. A flight that starts at another
// time of the clock than its state misses them.

namespace hamjet {
namespace {

using test::apart;
using test::driven_flight;

constexpr double close = 1e-10;

void expect_jet(const FlowJet<double>& jet, const std::vector<double>& from, double start,
                double duration) {
  EXPECT_LT(apart(nominal_of(jet), driven_flight(from, start, duration)), close);
  for (std::size_t k = 0; k < 6; ++k) {
    const std::vector<double> slope = test::derivative_of_driven_flight(from, start, duration, k);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(jet[i][1 + k], slope[i], 1e-7);
  }
}

TEST(DrivenFlights, ExactFlow) {
  const Scene scene = driven_chief(1);
  for (const double duration : {3.0, -2.0}) {
    const auto end = exact_flow(driven(), scene.nominal, scene.start_time, duration);
    EXPECT_LT(apart(end, driven_flight(scene.nominal, late, duration)), close);
  }
  // From the epoch it would end elsewhere.
  EXPECT_GT(apart(driven_flight(scene.nominal, 0, 3), driven_flight(scene.nominal, late, 3)), 1e-2);
}

// Back from the end, at its time, a flight comes home.
TEST(DrivenFlights, ThereAndBack) {
  const Scene scene = driven_chief(1);
  const auto end = exact_flow(driven(), scene.nominal, scene.start_time, 3);
  EXPECT_LT(apart(exact_flow(driven(), end, scene.start_time + 3, -3), scene.nominal), close);
}

TEST(DrivenFlights, Arcs) {
  const Scene scene = driven_chief(1);
  double reached = 0;
  fly_arcs(
      driven(), {scene.nominal, driven_deputy()}, scene.start_time, 5, [&](const FlightArc& arc) {
        for (const double share : {0.4, 1.0}) {
          const double time = arc.time_at(share);
          EXPECT_LT(apart(arc.state(0, share), driven_flight(scene.nominal, late, time)), close);
          EXPECT_LT(apart(arc.state(1, share), driven_flight(driven_deputy(), late, time)), close);
        }
        reached = arc.time_at(1);
      });
  EXPECT_EQ(reached, 5);
}

TEST(DrivenFlights, TwoPointFlight) {
  const Scene scene = driven_chief(1);
  const std::vector<double> wanted = driven_flight(driven_deputy(), late, 2);
  std::vector<double> guess = driven_deputy();
  guess[3] += 1e-3;
  const TwoPointFlight flight =
      fly_between(driven(), guess, scene.start_time, position_of(wanted), 2, 1e-12);
  ASSERT_TRUE(flight.is_found()) << flight.failure;
  EXPECT_LT(apart(flight.start, driven_deputy()), 1e-9);
  EXPECT_LT(apart(flight.end, wanted), 1e-9);
  // With the flow's derivatives at the right time Newton's method is quadratic.
  EXPECT_LE(flight.flights, 5);
}

TEST(DrivenFlights, LinearFlow) {
  const Scene scene = driven_chief(1);
  const ComputedProblem problem = make_problem(scene);
  const LinearFlow flow(problem, 6, 48);
  for (const double time : {0.05, 1.7, 5.9}) {
    EXPECT_LT(apart(flow.nominal(time), driven_flight(scene.nominal, late, time)), close);
    const auto matrix = flow.at(time);
    const double unit = std::ldexp(1.0, problem.momentum_exponent);
    for (std::size_t k = 0; k < 6; ++k) {
      const std::vector<double> slope =
          test::derivative_of_driven_flight(scene.nominal, late, time, k);
      for (std::size_t i = 0; i < 6; ++i) {
        const double units = (k < 3 ? 1 : unit) / (i < 3 ? 1 : unit);
        EXPECT_NEAR(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)),
                    slope[i] * units, 1e-7);
      }
    }
  }
}

// The linear flow along a path with impulses, from each of which it goes on.
TEST(DrivenFlights, PathWithImpulses) {
  const Scene scene = driven_chief(1);
  const ComputedProblem problem = make_problem(scene);
  const double unit = std::ldexp(1.0, problem.momentum_exponent);
  TimedImpulses impulses;
  impulses.times = {1.0, 2.2};
  impulses.changes = {{0.05, -0.02, 0.03}, {-0.04, 0.06, 0.01}};
  const PathFlow flow(problem, driven_deputy(), impulses, unit, 5);
  const auto flown = [&](std::vector<double> state, double time) {
    double now = 0;
    for (std::size_t k = 0; k < 2 && impulses.times[k] < time; ++k) {
      state = driven_flight(state, late + now, impulses.times[k] - now);
      now = impulses.times[k];
      for (std::size_t i = 0; i < 3; ++i) {
        state[3 + i] += impulses.changes[k][static_cast<Eigen::Index>(i)] * unit;
      }
    }
    return driven_flight(state, late + now, time - now);
  };
  constexpr double step = 5e-4;
  for (const double time : {0.7, 1.9, 4.5}) {
    const auto matrix = flow.at(time);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto changed = [&](double change) {
        std::vector<double> start = driven_deputy();
        start[k] += change;
        return flown(start, time);
      };
      const auto up = changed(step), down = changed(-step), far_up = changed(2 * step),
                 far_down = changed(-2 * step);
      for (std::size_t i = 0; i < 6; ++i) {
        const double slope = (8 * (up[i] - down[i]) - (far_up[i] - far_down[i])) / (12 * step);
        const double units = (k < 3 ? 1 : unit) / (i < 3 ? 1 : unit);
        EXPECT_NEAR(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)),
                    slope * units, 1e-7);
      }
    }
  }
}

TEST(DrivenFlights, JetsAlongTime) {
  const Scene scene = driven_chief(2);
  const ComputedProblem problem = make_problem(scene);
  const IntegratorSettings gauss = precise_gauss();
  JetPropagation jets(problem, gauss);
  for (const double time : {1.0, 2.5, 6.0}) {
    expect_jet(jets.advance_to(time), scene.nominal, late, time);
  }
}

// A problem about a later state of the same chief starts at that state's time.
TEST(DrivenFlights, JetsFromALaterState) {
  const Scene scene = driven_chief(2);
  ComputedProblem problem = make_problem(scene);
  problem.nominal = driven_flight(scene.nominal, late, 2);
  problem.start_time = scene.start_time + 2;
  const IntegratorSettings gauss = precise_gauss();
  JetPropagation jets(problem, gauss);
  expect_jet(jets.advance_to(3), problem.nominal, late + 2, 3);
}

TEST(DrivenFlights, Trajectory) {
  const Scene scene = driven_chief(2);
  const SceneTrajectory trajectory(scene, "", {});
  for (const double time : {0.0, 0.3, 2.2, scene.duration}) {
    expect_jet(convert_map<double>(trajectory.at(time)), scene.nominal, late, time);
  }
}

TEST(DrivenFlights, FollowedNominal) {
  const Scene scene = driven_chief(1);
  const std::vector<double> times = {1, 2.5, 4};
  follow_nominal(make_problem(scene), times, 1e-20,
                 [&](std::size_t k, const std::vector<Extended>& state) {
                   std::vector<double> rounded;
                   for (const Extended& x : state) rounded.push_back(static_cast<double>(x));
                   EXPECT_LT(apart(rounded, driven_flight(scene.nominal, late, times[k])), close);
                 });
}

TEST(DrivenFlights, Reference) {
  const Scene scene = driven_chief(1);
  const ReferenceResult reference = compute_reference(make_problem(scene), 3, ReferenceSettings{},
                                                      Precision::double_precision, [](double) {});
  expect_jet(convert_map<double>(reference.jet), scene.nominal, late, 3);
}

TEST(DrivenFlights, ManyFlows) {
  const Scene scene = driven_chief(1);
  const ManyFlows flows =
      study_many_flows(scene, "", {scene.nominal, driven_deputy()}, false, 1, {});
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_FALSE(flows.outcomes[k].failure.has_value());
    expect_jet(flows.outcomes[k].jet, flows.states[k], late, scene.duration);
  }
}

TEST(DrivenFlights, FlownTrajectory) {
  const Scene scene = driven_chief(1);
  const std::vector<double> deviation = state_difference(driven_deputy(), scene.nominal);
  const std::vector<double> times = equal_times_from_0(6, 6);
  const RelativeTrajectory flown =
      flown_trajectory(scene, deviation, RelativeFrame::rtn_rotating, times, 3);
  ASSERT_EQ(flown.times.size(), 7U);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_LT(apart(flown.chief[k], driven_flight(scene.nominal, late, times[k])), close);
    EXPECT_LT(apart(flown.deputy[k], driven_flight(driven_deputy(), late, times[k])), close);
  }
}

/// The least distance of two flights, or of one from the centre, at 4000 places.
template <class Distance>
std::pair<double, double> least_of(double from, double to, const Distance& distance) {
  double least = std::numeric_limits<double>::infinity();
  double at = from;
  constexpr int places = 400;
  const auto look = [&](double a, double b) {
    for (int k = 0; k <= places; ++k) {
      const double time = a + (b - a) * k / places;
      const double found = distance(time);
      if (found < least) {
        least = found;
        at = time;
      }
    }
  };
  look(from, to);
  const double step = (to - from) / places;
  look(std::max(from, at - step), std::min(to, at + step));
  return {least, at};
}

TEST(DrivenFlights, LowestPointOfAFlight) {
  const Scene scene = driven_chief(1);
  const std::vector<double> from = driven_flight(scene.nominal, late, 2);
  const auto distance = [&](double time) {
    return position_of(driven_flight(from, late + 2, time)).norm();
  };
  const auto [least, at] = least_of(0, 9, distance);
  const LowestPoint lowest = lowest_point(driven(), from, scene.start_time + 2, 9);
  EXPECT_NEAR(lowest.distance, least, 1e-7);
  EXPECT_NEAR(lowest.time, at, 1e-2);
}

// Steps of a tenth of a revolution, between which the search flies itself.
TEST(DrivenFlights, LowestPointBetweenSteps) {
  const Scene scene = descending_chief(1);
  const ComputedProblem problem = make_problem(scene);
  const double start = late + descending_after;
  LowestPointSearch search(problem);
  for (int k = 0; k <= 7; ++k) search.record(k, driven_flight(scene.nominal, start, k));
  const auto distance = [&](double time) {
    return position_of(driven_flight(scene.nominal, start, time)).norm();
  };
  const auto [least, at] = least_of(0, 7, distance);
  const LowestPoint lowest = search.take();
  EXPECT_NEAR(lowest.distance, least, 1e-7);
  EXPECT_NEAR(lowest.time, at, 1e-2);
  EXPECT_GT(std::abs(at - std::round(at)), 0.02);
}

// The deputy passes its chief three units of time after both stand at a later time than the
// scene's.
TEST(DrivenFlights, KeepOutRatio) {
  Scene scene = driven_chief(1);
  TransferSettings settings;
  const double metres = metric_units(scene).length_m;
  settings.keep_out_m = Eigen::Vector3d(1e-3, 2e-3, 1e-3) * metres;
  scene.transfer = settings;
  const std::vector<double> chief = driven_flight(scene.nominal, late, 2);
  std::vector<double> passing = driven_flight(scene.nominal, late, 5);
  const std::vector<double> apart_then = {5e-4, -3e-4, 2e-4, 2e-3, 3e-3, -1e-3};
  for (std::size_t i = 0; i < 6; ++i) passing[i] += apart_then[i];
  const std::vector<double> deputy = driven_flight(passing, late + 5, -3);
  const auto ratio = [&](double time) {
    const std::vector<double> c = driven_flight(chief, late + 2, time);
    const RelativeState relative =
        ChiefFrame(c, {}, RelativeFrame::rtn_rotating)
            .relative(state_difference(driven_flight(deputy, late + 2, time), c));
    return relative.position_m.cwiseQuotient(*settings.keep_out_m / metres).norm();
  };
  const double found = keep_out_ratio(FlownTogether(scene), chief, state_difference(deputy, chief),
                                      scene.start_time + 2, 5);
  const auto [least, at] = least_of(0, 5, ratio);
  EXPECT_GT(at, 1);
  EXPECT_LT(at, 4);
  EXPECT_NEAR(found, least, 1e-5);
}

TEST(DrivenFlights, ExtremeSeparations) {
  const Scene scene = driven_chief(1);
  const std::vector<double> deviation = state_difference(driven_deputy(), scene.nominal);
  const auto separation = [&](double time) {
    return (position_of(driven_flight(driven_deputy(), late, time)) -
            position_of(driven_flight(scene.nominal, late, time)))
        .norm();
  };
  const double metres = metric_units(scene).length_m;
  const ExtremeSeparations found =
      extreme_separations(scene, deviation, RelativeFrame::rtn_rotating, 6);
  EXPECT_NEAR(separation_m(found.nearest.state) / metres, least_of(0, 6, separation).first, 1e-7);
  const auto farthest = least_of(0, 6, [&](double time) { return -separation(time); });
  EXPECT_NEAR(separation_m(found.farthest.state) / metres, -farthest.first, 1e-7);
}

/// The time from the flight's passage through the chief's first half-plane to the next one.
double revolution(const std::vector<double>& chief, const std::vector<double>& state,
                  double start) {
  const Eigen::Vector3d radial = position_of(chief).normalized();
  const Eigen::Vector3d along =
      position_of(chief).cross(momentum_of(chief)).normalized().cross(radial);
  const auto passage = [&](double near) {
    double time = near;
    for (int i = 0; i < 20; ++i) {
      const auto z = driven_flight(state, start, time);
      const double x = position_of(z).dot(radial), y = position_of(z).dot(along);
      const double rate =
          (x * momentum_of(z).dot(along) - y * momentum_of(z).dot(radial)) / (x * x + y * y);
      time -= std::atan2(y, x) / rate;
    }
    return time;
  };
  const double inverse_axis = 2 / position_of(state).norm() - momentum_of(state).squaredNorm();
  return passage(2 * std::numbers::pi * std::pow(inverse_axis, -1.5)) - passage(0);
}

TEST(DrivenFlights, RelativeDriftFromALaterTime) {
  const Scene scene = driven_chief(1);
  const std::vector<double> chief = driven_flight(scene.nominal, late, 1.5);
  const std::vector<double> deputy = driven_flight(driven_deputy(), late, 1.5);
  const auto drift = relative_drift(scene, chief, state_difference(deputy, chief),
                                    scene.start_time + 1.5, RelativeFrame::inertial, false);
  ASSERT_TRUE(drift.has_value());
  const double difference =
      revolution(chief, deputy, late + 1.5) - revolution(chief, chief, late + 1.5);
  EXPECT_NEAR(drift->period_difference_s / scene.units.time_s, difference, 1e-9);
}

// The chief arrives last; the second deputy arrives first and flies on.
TEST(DrivenFlights, NearestOfPairs) {
  Scene scene = driven_chief(1);
  scene.transfer = TransferSettings{};
  scene.transfer->frame = RelativeFrame::inertial;
  scene.assignment.emplace();
  const double metres = metric_units(scene).length_m;
  const double metres_a_second = metric_units(scene).velocity_m_s();
  scene.assignment->deputies = {
      {Eigen::Vector3d(0.01, 0, 0) * metres, Eigen::Vector3d(0, 0.004, 0) * metres_a_second},
      {Eigen::Vector3d(0, 0.012, 0) * metres, Eigen::Vector3d(0.003, 0, 0.01) * metres_a_second}};
  const std::vector<double> arrivals = {4, 2};
  const Eigen::Vector3d change(0, 0.01, 0.004);
  std::vector<AssignedTransfer> transfers;
  for (std::size_t k = 0; k < 2; ++k) {
    AssignedTransfer& one = transfers.emplace_back();
    one.deputy = k;
    one.transfer.time = arrivals[k];
    one.transfer.answers.emplace_back();
    one.transfer.answers.back().end_change_m_s = change * metres_a_second;
  }
  const auto flown = [&](std::size_t k, double time) {
    const RelativeState& start = scene.assignment->deputies[k];
    std::vector<double> state = scene.nominal;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      state[i] += start.position_m[axis] / metres;
      state[3 + i] += start.velocity_m_s[axis] / metres_a_second;
    }
    if (time <= arrivals[k]) return driven_flight(state, late, time);
    state = driven_flight(state, late, arrivals[k]);
    for (std::size_t i = 0; i < 3; ++i) state[3 + i] += change[static_cast<Eigen::Index>(i)];
    return driven_flight(state, late + arrivals[k], time - arrivals[k]);
  };
  const auto separation = [&](double time) {
    return (position_of(flown(0, time)) - position_of(flown(1, time))).norm();
  };
  const auto pairs = nearest_of_pairs(scene, transfers);
  ASSERT_EQ(pairs.size(), 1U);
  const auto [least, at] = least_of(0, 4, separation);
  EXPECT_NEAR(pairs[0].separation_m / metres, least, 1e-7);
  EXPECT_NEAR(pairs[0].time, at, 1e-2);
}

}  // namespace
}  // namespace hamjet
