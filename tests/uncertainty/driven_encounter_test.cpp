#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hamjet/algebra/composition.hpp"
#include "hamjet/relative_motion/chief_frame.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/keep_out_margin.hpp"
#include "support/driven_kepler.hpp"
#include "support/errors.hpp"
#include "uncertainty/encounter_trajectories.hpp"
#include "uncertainty/flown_separations.hpp"

// Encounters under forces that depend on the time. Expected: flights by Boost.odeint from the epoch
// of both states, which is not the clock's, into a window that begins later.

namespace hamjet {
namespace {

using test::apart;
using test::driven_flight;

constexpr double epoch = 1.9;

EncounterProblem two_driven() {
  EncounterProblem problem{test::driven_kepler(), {}, ClockTime(epoch)};
  problem.spacecraft[0].state = {1, 0, 0, 0, 0.95, 0.4};
  problem.spacecraft[1].state = {1.001, -2e-3, 1e-3, 1e-3, 0.95, 0.401};
  for (UncertainSpacecraft& craft : problem.spacecraft) {
    craft.factor.topLeftCorner<3, 3>() = 1e-4 * Eigen::Matrix3d::Identity();
    craft.factor.bottomRightCorner<3, 3>() = 1e-4 * Eigen::Matrix3d::Identity();
  }
  problem.from = 1.5;
  problem.to = 4;
  problem.radius = 1e-4;
  problem.order = 2;
  problem.settings.tolerance = 1e-13;
  return problem;
}

std::vector<double> deviated(const EncounterProblem& problem, std::size_t craft,
                             const EncounterDeviation& xi) {
  const auto state =
      problem.spacecraft[craft].deviated(xi.segment<6>(static_cast<Eigen::Index>(6 * craft)));
  return {state.begin(), state.end()};
}

EncounterDeviation some_deviation(double size) {
  EncounterDeviation xi;
  for (Eigen::Index i = 0; i < 12; ++i) xi[i] = size * std::sin(1.7 * static_cast<double>(i + 1));
  return xi;
}

TEST(DrivenEncounter, JetsInTheWindow) {
  const EncounterProblem problem = two_driven();
  const EncounterTrajectories trajectories(problem);
  for (const double time : {1.5, 2.1, 4.0}) {
    for (std::size_t craft = 0; craft < 2; ++craft) {
      const std::vector<double>& from = problem.spacecraft[craft].state;
      const FlowJet<double> jet = trajectories.jet(craft, time);
      constexpr double step = 1e-4;
      for (std::size_t k = 0; k < 6; ++k) {
        std::vector<double> up = from, down = from;
        up[k] += step;
        down[k] -= step;
        const auto far = driven_flight(up, epoch, time), near = driven_flight(down, epoch, time);
        for (std::size_t i = 0; i < 6; ++i) {
          EXPECT_NEAR(jet[i][1 + k], (far[i] - near[i]) / (2 * step), 1e-6);
        }
      }
      const auto end = driven_flight(from, epoch, time);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(jet[i][0], end[i], 1e-10);
    }
  }
}

TEST(DrivenEncounter, FlownSeparations) {
  const EncounterProblem problem = two_driven();
  const std::vector<EncounterDeviation> deviations = {EncounterDeviation::Zero(), some_deviation(1),
                                                      some_deviation(-2)};
  const std::vector<double> found = flown_separations(problem, deviations);
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    std::vector<double> one = driven_flight(deviated(problem, 0, deviations[k]), epoch, 1.5);
    std::vector<double> other = driven_flight(deviated(problem, 1, deviations[k]), epoch, 1.5);
    double least = std::numeric_limits<double>::infinity();
    constexpr int places = 2500;
    for (int i = 0; i <= places; ++i) {
      least = std::min(least, std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]));
      const double now = epoch + 1.5 + 2.5 * i / places;
      one = driven_flight(one, now, 2.5 / places);
      other = driven_flight(other, now, 2.5 / places);
    }
    // Between the places the distance changes by less.
    EXPECT_NEAR(found[k], least, 1e-8) << k;
  }
}

TEST(DrivenEncounter, KeepOutMarginIsFlown) {
  const EncounterProblem problem = two_driven();
  const Eigen::Vector3d axes(4e-4, 8e-4, 4e-4);
  const KeepOutMargin margin = keep_out_margin(problem, axes);
  ASSERT_TRUE(margin.deviations.has_value());
  std::array<std::vector<double>, 3> states = {
      driven_flight(deviated(problem, 0, margin.deviation), epoch, 1.5),
      driven_flight(deviated(problem, 1, margin.deviation), epoch, 1.5),
      driven_flight(problem.spacecraft[0].state, epoch, 1.5)};
  double least = std::numeric_limits<double>::infinity();
  constexpr int places = 2500;
  for (int i = 0; i <= places; ++i) {
    const ChiefFrame frame(std::span<const double>(states[2]), {}, RelativeFrame::rtn_inertial);
    const Eigen::Vector3d relative(states[1][0] - states[0][0], states[1][1] - states[0][1],
                                   states[1][2] - states[0][2]);
    least = std::min(least, frame.along_axes(relative).cwiseQuotient(axes).norm());
    for (std::vector<double>& state : states) {
      state = driven_flight(state, epoch + 1.5 + 2.5 * i / places, 2.5 / places);
    }
  }
  EXPECT_NEAR(margin.flown_ratio, least, 1e-5);
  EXPECT_TRUE(margin.is_confirmed());
}

TEST(DrivenEncounter, TimesOfClosestApproachAreRefused) {
  test::expect_error([] { closest_approaches(two_driven()); }, ErrorKind::usage,
                     {"depends on the time"}, "closest approaches");
}

}  // namespace
}  // namespace hamjet
