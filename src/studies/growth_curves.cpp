#include "growth_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "convergence_fit.hpp"
#include "energy_error.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "integration.hpp"

namespace hamjet {
namespace {

/// The jet at one of the times through which the fits go.
struct Checkpoint {
  double time = 0;
  FlowJet<double> jet;
  double largest_energy_error = 0;  ///< up to this time
};

/// 1, 1/2, 1/4, ... of the duration, the smallest first, where no times are given.
std::vector<double> wanted_times(const Scene& scene, const GrowthExpectation& expected) {
  if (!expected.times.empty()) return expected.times;
  std::vector<double> times;
  for (int k = expected.checkpoints - 1; k >= 0; --k)
    times.push_back(std::ldexp(scene.duration, -k));
  return times;
}

std::vector<Checkpoint> checkpoints(const Scene& scene, const ComputedProblem& problem,
                                    const std::vector<double>& wanted,
                                    const std::function<void(double)>& progress) {
  const FlowProblem<double> flow = flow_problem<double>(problem, scene.duration);
  EnergyError energy(problem.system, problem.nominal);
  std::vector<Checkpoint> reached;
  double largest = 0;
  IntegrationStatistics statistics;
  integrate<double>(flow, scene.integrators.front(), statistics,
                    [&](const double& time, const FlowJet<double>& jet) {
                      progress(time / scene.duration);
                      std::vector<Extended> state;
                      for (const auto& component : jet) state.emplace_back(component[0]);
                      largest = std::max(largest, std::abs(energy.error(state)));
                      while (reached.size() < wanted.size() &&
                             std::abs(time) >= std::abs(wanted[reached.size()]) * (1 - 1e-12)) {
                        reached.push_back({time, jet, largest});
                      }
                    });
  return reached;
}

/// The true nominal at the times, by integration in extended precision.
std::vector<Extended> true_states(const Scene& scene, const ComputedProblem& problem,
                                  const std::vector<Checkpoint>& points) {
  FlowProblem<Extended> flow = flow_problem<Extended>(problem, 0);
  flow.space = SeriesSpace::create(problem.variables.size(), 0);
  GaussSettings gauss;
  gauss.stages = 16;
  gauss.tolerance = 1e-24;
  Extended reached = 0;
  const std::size_t dimension = scene.nominal.size();
  std::vector<Extended> states(points.size() * dimension, Extended(0));
  for (std::size_t k = 0; k < points.size(); ++k) {
    flow.duration = Extended(points[k].time) - reached;
    IntegrationStatistics statistics;
    const FlowJet<Extended> nominal = integrate_gauss<Extended>(flow, gauss, statistics);
    reached = Extended(points[k].time);
    for (std::size_t i = 0; i < nominal.size(); ++i) {
      flow.initial_state[i] = nominal[i][0];
      states[k * dimension + problem.components[i]] = nominal[i][0];
    }
  }
  return states;
}

/// Largest distance of a component of the nominal from the true one, relative to the largest
/// component, at each checkpoint.
std::vector<double> nominal_errors(const ComputedProblem& problem,
                                   const std::vector<Checkpoint>& points,
                                   const std::vector<Extended>& states) {
  const std::size_t dimension = states.size() / points.size();
  std::vector<double> errors;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Extended largest = 0;
    Extended error = 0;
    for (std::size_t i = 0; i < problem.components.size(); ++i) {
      const Extended& truth = states[k * dimension + problem.components[i]];
      largest = std::max(largest, Extended(abs(truth)));
      error = std::max(error, Extended(abs(truth - Extended(points[k].jet[i][0]))));
    }
    errors.push_back(static_cast<double>(Extended(error / largest)));
  }
  return errors;
}

/// Throws Error(usage) if a checkpoint is not at the time of a given state.
void require_times(const GrowthExpectation& expected, const std::vector<Checkpoint>& points,
                   std::size_t dimension) {
  if (expected.times.empty()) return;
  for (std::size_t k = 0; k < expected.times.size(); ++k) {
    if (k < points.size() && points[k].time == expected.times[k]) continue;
    throw Error(ErrorKind::usage,
                fmt::format("case.growth.times: no step ends at {:g}", expected.times[k]));
  }
  if (!expected.states.empty() && expected.states.size() != points.size() * dimension) {
    throw Error(ErrorKind::usage,
                fmt::format("case.growth.states: {} numbers, must be {} for each time",
                            expected.states.size(), dimension));
  }
}

double largest_coefficient(const FlowJet<double>& jet, int degree) {
  double largest = 0;
  for (const auto& component : jet) {
    for (std::size_t k = component.space().first(degree); k < component.space().first(degree + 1);
         ++k) {
      largest = std::max(largest, std::abs(component[k]));
    }
  }
  return largest;
}

/// Fits the exponent through the values above the least one that means something.
void fit(GrowthCurve& curve, double least, double tolerance) {
  std::vector<ConvergencePoint> usable;
  for (const auto& [time, value] : curve.points) {
    if (value > least) usable.push_back({std::abs(time), value, ""});
  }
  if (usable.size() >= 3) curve.exponent = fit_logarithms(usable, 0).slope;
  if (!curve.exponent) {
    // What never rises above round-off has not grown.
    curve.is_as_expected = curve.is_upper_bound;
  } else if (curve.is_upper_bound) {
    curve.is_as_expected = *curve.exponent <= curve.expected;
  } else {
    curve.is_as_expected = std::abs(*curve.exponent - curve.expected) <= tolerance;
  }
}

}  // namespace

std::vector<GrowthCurve> growth_curves(const Scene& scene, const ComputedProblem& problem,
                                       const GrowthExpectation& expected,
                                       const std::function<void(double)>& progress) {
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  const auto points = checkpoints(scene, problem, wanted_times(scene, expected), progress);
  require_times(expected, points, scene.nominal.size());
  std::vector<GrowthCurve> curves;
  const auto add = [&](GrowthCurve curve, double least) {
    fit(curve, least, expected.exponent_tolerance);
    curves.push_back(std::move(curve));
  };
  if (expected.error_exponent) {
    GrowthCurve curve;
    curve.quantity = "error of the nominal";
    curve.expected = *expected.error_exponent;
    const std::vector<double> errors = nominal_errors(
        problem, points,
        expected.states.empty() ? true_states(scene, problem, points) : expected.states);
    for (std::size_t i = 0; i < points.size(); ++i) {
      curve.points.emplace_back(points[i].time, errors[i]);
    }
    add(std::move(curve), round_off);
  }
  if (expected.energy_exponent) {
    GrowthCurve curve;
    curve.quantity = "largest energy error";
    curve.expected = *expected.energy_exponent;
    for (const Checkpoint& point : points) {
      curve.points.emplace_back(point.time, point.largest_energy_error);
    }
    add(std::move(curve), round_off);
  }
  for (std::size_t d = 1; d <= expected.coefficient_exponents.size(); ++d) {
    GrowthCurve curve;
    curve.quantity = fmt::format("largest coefficient of degree {}", d);
    curve.expected = expected.coefficient_exponents[d - 1];
    curve.is_upper_bound = false;
    for (const Checkpoint& point : points) {
      curve.points.emplace_back(point.time, largest_coefficient(point.jet, static_cast<int>(d)));
    }
    add(std::move(curve), 0);
  }
  return curves;
}

}  // namespace hamjet
