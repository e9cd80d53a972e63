#include "hamjet/maps/flow_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "support/errors.hpp"
#include "support/map.hpp"

namespace hamjet {
namespace {

using Map = FlowMap<double>;

Series<double> deviation(const SpacePointer& space, std::size_t i, double constant = 0) {
  return Series<double>::variable(space, i, constant);
}

/// The flow of H = (p^2 + q^2)/2 over a time, about the nominal that ends at (0.5, -0.25).
Map oscillator(double time, int order = 3) {
  const auto space = SeriesSpace::create(2, order);
  const auto q = deviation(space, 0);
  const auto p = deviation(space, 1);
  return Map({q * std::cos(time) + p * std::sin(time) + 0.5,
              p * std::cos(time) - q * std::sin(time) - 0.25});
}
/// The flow of H = -a q^3/3 over a unit of time, p + a q^2 about q = 0 and p = 7.
Map kick(double a, int order = 4) {
  const auto space = SeriesSpace::create(2, order);
  const auto q = deviation(space, 0);
  return Map({q, deviation(space, 1, 7) + square(q) * a});
}
/// The flow of H = p^2/2 over a time, about q = 3 and p = 0.
Map drift(double time, int order = 4) {
  const auto space = SeriesSpace::create(2, order);
  return Map({deviation(space, 0, 3) + deviation(space, 1) * time, deviation(space, 1)});
}

double largest_difference(const Map& a, const Map& b) {
  double largest = 0;
  EXPECT_EQ(*a.space(), *b.space());
  EXPECT_EQ(a.components(), b.components());
  for (std::size_t i = 0; i < a.components(); ++i) {
    for (std::size_t k = 0; k < a.space()->size(); ++k) {
      largest = test::larger(largest, std::abs(a.jet()[i][k] - b.jet()[i][k]));
    }
  }
  return largest;
}

// Expected: the group property of a flow, phi_s o phi_t = phi_(s+t).
TEST(FlowMap, OscillatorFlowsComposeToTheFlowOfTheSumOfTimes) {
  for (const double s : {0.25, -2.0, 10.0}) {
    EXPECT_LE(largest_difference(oscillator(0.75).followed_by(oscillator(s)), oscillator(0.75 + s)),
              4e-15);
  }
}

// Expected: kick and drift in closed form, whose integer coefficients are exact. The order of the
// two matters, and the nominal's end is that of the map that comes second.
TEST(FlowMap, TheOneThatFollowsActsSecond) {
  const auto space = SeriesSpace::create(2, 4);
  const auto q = deviation(space, 0);
  const auto p = deviation(space, 1);
  const auto kicked = p + square(q) * 2.0;
  EXPECT_EQ(
      largest_difference(kick(2).followed_by(drift(5)), Map({q + kicked * 5.0 + 3.0, kicked})), 0);
  const auto moved = q + p * 5.0;
  EXPECT_EQ(largest_difference(drift(5).followed_by(kick(2)),
                               Map({moved, p + square(moved) * 2.0 + 7.0})),
            0);
}

TEST(FlowMap, ComposesAtTheLowerOfTheTwoOrders) {
  const Map expected = kick(2, 2).followed_by(drift(5, 2));
  EXPECT_EQ(largest_difference(kick(2, 4).followed_by(drift(5, 2)), expected), 0);
  EXPECT_EQ(largest_difference(kick(2, 2).followed_by(drift(5, 4)), expected), 0);
}

// Expected: the identity, and for a kick the closed inverse p - a q^2.
TEST(FlowMap, InverseComposesToTheIdentity) {
  const auto space = SeriesSpace::create(2, 4);
  const std::vector<double> start = {0.125, -6};
  const Map there = oscillator(0.75, 4).followed_by(kick(0.3)).followed_by(oscillator(1.25, 4));
  const Map back = there.inverse(start);
  const Map identity({deviation(space, 0, start[0]), deviation(space, 1, start[1])});
  EXPECT_LE(largest_difference(there.followed_by(back), identity), 1e-15);
  const Map other_way({deviation(space, 0, 0.5), deviation(space, 1, -0.25)});
  EXPECT_LE(largest_difference(back.followed_by(there), other_way), 1e-15);
  const auto q = deviation(space, 0);
  EXPECT_EQ(
      largest_difference(kick(2).inverse({0, 0}), Map({q, deviation(space, 1) - square(q) * 2.0})),
      0);
}

// Expected: the same identity for the flow of an orbit, to the rounding of extended precision times
// the terms that cancel, some 1e6; in double precision it would be 1e-10.
TEST(FlowMap, InverseOfAnOrbit) {
  auto flow = test::flow_of<Extended>(test::paper_orbit(), 3);
  flow.duration = test::quarter_period;
  const FlowMap<Extended> there(test::run_gauss(flow, test::fixed_step(4, 0.5)));
  const FlowMap<Extended> round_trip = there.followed_by(there.inverse(flow.start));
  double error = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(round_trip.jet()[i][0], flow.start[i]);
    for (std::size_t k = 1; k < round_trip.space()->size(); ++k) {
      const Extended expected = k == 1 + i ? 1 : 0;
      error = test::larger(
          error, std::abs(static_cast<double>(Extended(round_trip.jet()[i][k] - expected))));
    }
  }
  EXPECT_LE(error, 1e-26);
}

TEST(FlowMap, OutlivesAllThatItWasMadeFrom) {
  auto space = SeriesSpace::create(2, 3);
  const std::weak_ptr<const SeriesSpace> watched = space;
  std::vector<Series<double>> jet = {deviation(space, 0, 3), deviation(space, 1)};
  std::optional<Map> map(Map{jet});
  jet.clear();
  space.reset();
  ASSERT_FALSE(watched.expired());
  EXPECT_EQ(map->order(), 3);
  EXPECT_EQ(map->jet()[0][0], 3);
  // A jet that is taken from a temporary remains valid.
  const std::vector<Series<double>>& taken = Map(*map).jet();
  map.reset();
  EXPECT_EQ(taken[0][0], 3);
  EXPECT_FALSE(watched.expired());
}

TEST(FlowMap, IsAValue) {
  Map a = kick(2);
  Map b = a;
  a = drift(5);
  EXPECT_EQ(largest_difference(b, kick(2)), 0);
  const Map c = std::move(b);
  EXPECT_EQ(largest_difference(c, kick(2)), 0);
  b = a;  // an object that has been moved from takes a new value
  EXPECT_EQ(largest_difference(b, drift(5)), 0);
  EXPECT_EQ(largest_difference(Map(Map(c).jet()), kick(2)), 0);
}

// Expected: the closed form p + a q^2, without the nominal.
TEST(FlowMap, EvaluatesTheFinalDeviation) {
  EXPECT_EQ(kick(2).evaluate(std::vector<double>{0.5, 0.25}), (std::vector<double>{0.5, 0.75}));
  const FlowMap<Extended> extended(convert_map<Extended>(kick(2).jet()));
  EXPECT_EQ(extended.evaluate(std::vector<double>{0.5, 0.25}), (std::vector<double>{0.5, 0.75}));
  std::vector<double> values(4);
  const std::vector<double> points = {0.5, 3, 0.25, 1};  // two, component by component
  kick(2).evaluator(1).evaluate(points, {.values = values, .last = {}, .last_but_one = {}});
  EXPECT_EQ(values, points);
}

// Expected: the rotation by the time.
TEST(FlowMap, LinearPartIsTheStateTransitionMatrix) {
  const Matrix<double> phi = oscillator(0.75).linear_part();
  ASSERT_EQ(phi.rows(), 2);
  ASSERT_EQ(phi.cols(), 2);
  EXPECT_DOUBLE_EQ(phi(0, 0), std::cos(0.75));
  EXPECT_DOUBLE_EQ(phi(0, 1), std::sin(0.75));
  EXPECT_DOUBLE_EQ(phi(1, 0), -std::sin(0.75));
  EXPECT_DOUBLE_EQ(phi(1, 1), std::cos(0.75));
}

TEST(FlowMap, TellsItsSymplecticityByDegree) {
  const auto defects = oscillator(0.75, 4).followed_by(kick(0.3)).symplecticity();
  ASSERT_EQ(defects.size(), 4U);
  for (const auto& defect : defects) EXPECT_LE(defect.scaled, 1e-15) << defect.degree;
  // {q + e q p, p} - 1 = e p, of degree 1 alone.
  const auto space = SeriesSpace::create(2, 3);
  const auto q = deviation(space, 0);
  const auto p = deviation(space, 1);
  const auto seen = Map({q + q * p * 0.125, p}).symplecticity();
  EXPECT_EQ(seen[0].absolute, 0);
  EXPECT_EQ(seen[1].absolute, 0.125);
  EXPECT_EQ(seen[2].absolute, 0);
}

// Expected: F1 = ((q^2 + q0^2) cos t - 2 q q0) / (2 sin t).
TEST(FlowMap, GeneratingFunctionOfTheOscillator) {
  const double t = 0.75;
  const auto f1 = oscillator(t).generating_function(parse_kind("F1", 1));
  const SeriesSpace& space = f1.space();
  EXPECT_EQ(space.order(), 4);
  const double half_cotangent = 0.5 / std::tan(t);
  for (std::size_t k = 0; k < space.size(); ++k) {
    const double expected = space.degree(k) != 2         ? 0
                            : space.exponents(k)[0] == 1 ? -1 / std::sin(t)
                                                         : half_cotangent;
    EXPECT_NEAR(f1[k], expected, 1e-15) << k;
  }
}

TEST(FlowMap, Truncates) {
  EXPECT_EQ(largest_difference(kick(2, 4).truncated(2), kick(2, 2)), 0);
  EXPECT_EQ(largest_difference(kick(2, 4).truncated(4), kick(2, 4)), 0);
  EXPECT_EQ(kick(2, 4).truncated(0).jet()[1][0], 7);
}

TEST(FlowMap, RefusesWhatDoesNotFit) {
  const auto refused = [](const char* text, const auto& make) {
    test::expect_error(ErrorKind::usage, text, make);
  };
  const auto space = SeriesSpace::create(2, 3);
  const auto q = deviation(space, 0);
  refused("no components", [] { Map({}); });
  refused("", [&] { Map({q, deviation(SeriesSpace::create(2, 4), 1)}); });
  const Map position({q});  // one component in two variables
  refused("as many components", [&] { position.followed_by(kick(2)); });
  refused("composition: ", [&] { position.inverse({0}); });
  refused("number for each component", [] { kick(2).inverse({0}); });
  refused("not that order", [] { kick(2).truncated(5); });
  refused("", [] { kick(2).truncated(-1); });
  refused("", [] { kick(2).evaluator(5); });
  refused("", [] { kick(2).evaluate(std::vector<double>{1}); });
  refused("", [&] { position.symplecticity(); });
  test::expect_error(ErrorKind::numerical, "", [&] { Map({q, q}).inverse({0, 0}); });
}

}  // namespace
}  // namespace hamjet
