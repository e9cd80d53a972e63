#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "hamjet/algebra/calculus.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/keep_out_margin.hpp"
#include "support/driven_kepler.hpp"
#include "support/errors.hpp"
#include "uncertainty/encounter_trajectories.hpp"
#include "uncertainty/flown_separations.hpp"

// Encounters of two spacecraft with equations of motion of their own: a turning force acts on the
// first alone. Expected: flights by Boost.odeint, each with the forces of its spacecraft.

namespace hamjet::unlike_encounter_tests {
namespace {

constexpr double epoch = 1.9;
constexpr double from = 1.5;
constexpr double to = 3;

std::vector<double> kepler_flight(const std::vector<double>& start, double duration) {
  namespace odeint = boost::numeric::odeint;
  test::OdeintState z;
  std::copy_n(start.begin(), 6, z.begin());
  const auto rates = [](const test::OdeintState& x, test::OdeintState& dx, double) {
    const double r = std::hypot(x[0], x[1], x[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      dx[i] = x[i + 3];
      dx[i + 3] = -x[i] / (r * r * r);
    }
  };
  odeint::integrate_adaptive(
      odeint::make_controlled(1e-14, 1e-14, odeint::runge_kutta_fehlberg78<test::OdeintState>()),
      rates, z, 0.0, duration, duration / 100);
  return {z.begin(), z.end()};
}

std::vector<double> flight(std::size_t craft, const std::vector<double>& start, double begin,
                           double duration) {
  return craft == 0 ? test::driven_flight(start, begin, duration) : kepler_flight(start, duration);
}

EncounterProblem two_unlike() {
  EncounterProblem problem{test::driven_kepler(), {}, ClockTime(epoch)};
  problem.spacecraft[0].state = {1, 0, 0, 0, 0.95, 0.4};
  std::vector<double> passing = test::driven_flight(problem.spacecraft[0].state, epoch, 2.2);
  const std::vector<double> apart_then = {5e-4, -3e-4, 6e-4, 2e-3, 3e-3, -1e-3};
  for (std::size_t i = 0; i < 6; ++i) passing[i] += apart_then[i];
  problem.spacecraft[1].state = kepler_flight(passing, -2.2);
  problem.spacecraft[1].own_system = kepler();
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
  }
  problem.from = from;
  problem.to = to;
  problem.radius = 1e-4;
  problem.order = 2;
  problem.settings.tolerance = 1e-13;
  return problem;
}

EncounterDeviation some_deviation() {
  EncounterDeviation xi;
  for (Eigen::Index i = 0; i < 12; ++i) xi[i] = std::sin(1.7 * static_cast<double>(i + 1));
  return xi;
}

std::vector<double> deviated(const EncounterProblem& problem, std::size_t craft,
                             const EncounterDeviation& xi) {
  const auto state =
      problem.spacecraft[craft].deviated(xi.segment<6>(static_cast<Eigen::Index>(6 * craft)));
  return {state.begin(), state.end()};
}

TEST(UnlikeEncounter, EachHasJetsOfItsOwnForces) {
  const EncounterProblem problem = two_unlike();
  const EncounterTrajectories trajectories(problem);
  for (std::size_t craft = 0; craft < 2; ++craft) {
    const std::vector<double>& start = problem.spacecraft[craft].state;
    const FlowJet<double> jet = trajectories.jet(craft, 2.6);
    const auto end = flight(craft, start, epoch, 2.6);
    const auto of_other = flight(1 - craft, start, epoch, 2.6);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(jet[i][0], end[i], 1e-10);
    EXPECT_GT(test::apart(end, of_other), 1e-3);
  }
}

TEST(UnlikeEncounter, SeparationsAndMarginsAreFlown) {
  const EncounterProblem problem = two_unlike();
  const Eigen::Vector3d axes(4e-4, 8e-4, 4e-4);
  const KeepOutMargin margin = keep_out_margin(problem, axes);
  ASSERT_TRUE(margin.deviations.has_value());
  const std::vector<EncounterDeviation> deviations = {some_deviation(), margin.deviation};
  const std::vector<double> found = flown_separations(problem, deviations);
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    // The last is the mean of the first, along whose axes the ellipsoid lies.
    constexpr std::array<std::size_t, 3> craft_of = {0, 1, 0};
    std::array<std::vector<double>, 3> states = {deviated(problem, 0, deviations[k]),
                                                 deviated(problem, 1, deviations[k]),
                                                 problem.spacecraft[0].state};
    for (std::size_t i = 0; i < 3; ++i) states[i] = flight(craft_of[i], states[i], epoch, from);
    double least = std::numeric_limits<double>::infinity();
    double least_ratio = least;
    constexpr int places = 1500;
    for (int place = 0; place <= places; ++place) {
      const ChiefFrame frame(std::span<const double>(states[2]), {}, RelativeFrame::rtn_inertial);
      const Eigen::Vector3d relative(states[1][0] - states[0][0], states[1][1] - states[0][1],
                                     states[1][2] - states[0][2]);
      least = std::min(least, relative.norm());
      least_ratio = std::min(least_ratio, frame.along_axes(relative).cwiseQuotient(axes).norm());
      constexpr double step = (to - from) / places;
      for (std::size_t i = 0; i < 3; ++i) {
        states[i] = flight(craft_of[i], states[i], epoch + from + step * place, step);
      }
    }
    // Near its minimum the distance changes by less between the places.
    EXPECT_NEAR(found[k], least, 1e-7) << k;
    if (k == 1) {
      EXPECT_NEAR(margin.flown_ratio, least_ratio, 1e-4);
    }
  }
  EXPECT_TRUE(margin.is_confirmed());
}

// The first in the field of a point, the second in that of an oblate Earth; a revolution after they
// were beside each other they are so again.
TEST(UnlikeEncounter, ClosestApproachesAreThoseOfFlights) {
  EncounterProblem problem{kepler(), {}, ClockTime::epoch()};
  problem.spacecraft[0].state = {1, 0, 0, 0, 1, 0.1};
  problem.spacecraft[1].state = {1.0002, 0, 0, 0, 0.9217, 0.4};
  problem.spacecraft[1].own_system = zonal_gravity({1, 0.9, {{2, 1.0826e-3}}});
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor = 1e-5 * Eigen::Matrix<double, 6, 6>::Identity();
  }
  problem.from = 5.5;
  problem.to = 7.2;
  problem.radius = 1e-6;
  problem.order = 3;
  problem.settings.tolerance = 1e-13;
  const std::vector<EncounterDeviation> deviations = {EncounterDeviation::Zero(), some_deviation()};
  const std::vector<double> flown = flown_separations(problem, deviations);
  const std::vector<ClosestApproach> approaches = closest_approaches(problem);
  ASSERT_GE(approaches.size(), 1U);
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    const std::vector<double> xi(deviations[k].data(), deviations[k].data() + 12);
    double least = std::numeric_limits<double>::infinity();
    for (const ClosestApproach& approach : approaches) {
      const double square = evaluate(approach.squared_distance, std::span<const double>(xi));
      least = std::min(least, std::sqrt(square));
    }
    EXPECT_NEAR(least, flown[k], 1e-7 * (1 + flown[k]));
  }
  // A field that were the other one's would move the second by some J2 of its distance.
  EncounterProblem alike = problem;
  alike.spacecraft[1].own_system = {};
  EXPECT_GT(std::abs(flown_separation_of_means(alike) - flown[0]), 1e-3);
}

TEST(UnlikeEncounter, SystemsThatAreNoOrbitsAreRefused) {
  EncounterProblem problem = two_unlike();
  problem.spacecraft[1].own_system =
      make_system("plane", 2, []<class T>(std::span<const T> q, std::span<const T> p) {
        return p[0] * p[1] + q[0] * q[1];
      });
  test::expect_error([&] { validate(problem); }, ErrorKind::usage, {"one of an orbit"}, "plane");
}

}  // namespace
}  // namespace hamjet::unlike_encounter_tests
