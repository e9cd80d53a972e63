#include "hamjet/uncertainty/closest_approach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../algebra/scalar_search.hpp"
#include "../charts/carried_states.hpp"
#include "../charts/time_scaled_system.hpp"
#include "encounter_trajectories.hpp"
#include "hamjet/algebra/composition.hpp"
#include "hamjet/error.hpp"
#include "relative_paths.hpp"

namespace hamjet {
namespace {

/// The highest order: longer series in twelve variables (18564 terms at order 6) take seconds to
/// multiply.
constexpr int highest_order = 6;

/// Times in the window at which the distance of the means has a minimum.
std::vector<double> minima_of(const EncounterTrajectories& means) {
  const std::vector<double> times = means.times_of_looks();
  std::vector<double> minima;
  double before = 0;  // no minimum is found at the first look
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double rate = means.approach_rate(times[k]);
    // With NaN, no change of sign would show a minimum.
    if (!std::isfinite(rate)) {
      throw Error(ErrorKind::numerical,
                  "closest approach: the distance of the means is not finite");
    }
    if (before < 0 && rate >= 0) {
      constexpr int bits = 51;
      minima.push_back(root_between(
          "closest approach", [&](double time) { return means.approach_rate(time); },
          {times[k - 1], before}, {times[k], rate}, bits));
    }
    before = rate;
  }
  return minima;
}

/// The state of a spacecraft at a time, as series in the twelve numbers.
SixNumbers<Series<double>> state_series(const EncounterProblem& problem, const FlowJet<double>& jet,
                                        std::size_t craft, const SpacePointer& space) {
  std::vector<Series<double>> deviations;
  for (Eigen::Index row = 0; row < 6; ++row) {
    Series<double> deviation(space);
    for (Eigen::Index column = 0; column < 6; ++column) {
      deviation[space->linear_index(6 * craft + static_cast<std::size_t>(column))] =
          problem.spacecraft[craft].factor(row, column);
    }
    deviations.push_back(std::move(deviation));
  }
  const std::vector<Series<double>> state = compose(jet, deviations);
  return {state[0], state[1], state[2], state[3], state[4], state[5]};
}

ClosestApproach approach_at(const EncounterProblem& problem, const EncounterTrajectories& means,
                            const EncounterTrajectories& trajectories, double time) {
  const SpacePointer space = SeriesSpace::create(encounter_variables, problem.order);
  std::array<SixNumbers<Series<double>>, 2> states = {
      state_series(problem, trajectories.jet(0, time), 0, space),
      state_series(problem, trajectories.jet(1, time), 1, space)};
  ClosestApproach approach{time, Series<double>(space), {}, Series<double>(space)};
  const auto relative = [&] {
    std::vector<Series<double>> difference;
    for (std::size_t i = 0; i < 6; ++i) difference.push_back(states[1][i] - states[0][i]);
    return difference;
  };
  const auto product = [](const std::vector<Series<double>>& z, std::size_t a, std::size_t b) {
    return z[a] * z[b] + z[a + 1] * z[b + 1] + z[a + 2] * z[b + 2];
  };
  // Newton's method with the derivative of the means, d(rho.v)/dt: each iteration makes one more
  // degree right.
  const double slope = means.approach_rate_slope(time);
  if (!(slope > 0)) {
    throw Error(ErrorKind::numerical,
                "closest approach: the distance is flat there, so that its time is no series");
  }
  const std::array<SharedSystem, 2> crossing = {time_scaled_first_order(*problem.system_of(0)),
                                                time_scaled_first_order(*problem.system_of(1))};
  for (int degree = 1; degree <= problem.order; ++degree) {
    Series<double> step = product(relative(), 0, 3) / -slope;
    step[0] = 0;
    for (std::size_t craft = 0; craft < 2; ++craft) {
      states[craft] = carried(crossing[craft], states[craft], step);
    }
    approach.delay += step;
  }
  approach.state = relative();
  approach.squared_distance = product(approach.state, 0, 0);
  return approach;
}

}  // namespace

std::vector<ClosestApproach> closest_approaches(const EncounterProblem& problem, std::size_t most) {
  validate(problem);
  if (!problem.system_of(0)->is_autonomous() || !problem.system_of(1)->is_autonomous()) {
    throw Error(ErrorKind::usage,
                "closest approach: the system depends on the time, must be one whose flow is the "
                "same at every start");
  }
  if (problem.order > highest_order) {
    throw Error(ErrorKind::too_large,
                fmt::format("closest approach: series in twelve variables of order {}, at most {} "
                            "is taken",
                            problem.order, highest_order));
  }
  EncounterProblem of_means = problem;
  of_means.order = 0;
  const EncounterTrajectories means(of_means);
  std::vector<double> times = minima_of(means);
  if (times.size() > most) {
    std::sort(times.begin(), times.end(),
              [&](double a, double b) { return means.distance(a) < means.distance(b); });
    times.resize(most);
    std::sort(times.begin(), times.end());
  }
  std::vector<ClosestApproach> result;
  if (times.empty()) return result;
  const EncounterTrajectories trajectories(problem);
  for (const double time : times) {
    result.push_back(approach_at(problem, means, trajectories, time));
  }
  return result;
}

}  // namespace hamjet
