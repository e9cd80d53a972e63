#include "growth_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../comparison/convergence_fit.hpp"
#include "../energy_error.hpp"
#include "../integration.hpp"
#include "../largest_coefficient.hpp"
#include "../nominal/followed_nominal.hpp"
#include "hamjet/error.hpp"

namespace hamjet {
namespace {

/// The jet at one of the times that the fits use.
struct Checkpoint {
  double time = 0;
  FlowJet<double> jet;
  double largest_energy_error = 0;  ///< up to this time
};

/// The times of the fits; if none are given, 1, 1/2, 1/4, ... of the duration, the smallest first.
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
  EnergyError energy(*problem.system, problem.nominal, problem.start_time);
  std::vector<Checkpoint> reached;
  double largest = 0;
  IntegrationStatistics statistics;
  integrate<double>(flow, scene.integrators.front(), statistics,
                    [&](const double& time, const FlowJet<double>& jet) {
                      progress(time / scene.duration);
                      std::vector<Extended> state;
                      for (const auto& component : jet) state.emplace_back(component[0]);
                      largest = std::max(largest,
                                         std::abs(energy.error(state, problem.start_time + time)));
                      while (reached.size() < wanted.size() &&
                             std::abs(time) >= std::abs(wanted[reached.size()]) * (1 - 1e-12)) {
                        reached.push_back({time, jet, largest});
                      }
                    });
  return reached;
}

/// The true nominal at the checkpoints, with all components of the model.
std::vector<Extended> true_states(const Scene& scene, const ComputedProblem& problem,
                                  const std::vector<Checkpoint>& points) {
  std::vector<double> times;
  for (const Checkpoint& point : points) times.push_back(point.time);
  const std::size_t dimension = scene.nominal.size();
  std::vector<Extended> states(points.size() * dimension, Extended(0));
  follow_nominal(problem, times, 1e-24, [&](std::size_t k, const std::vector<Extended>& state) {
    for (std::size_t i = 0; i < state.size(); ++i) {
      states[k * dimension + problem.components[i]] = state[i];
    }
  });
  return states;
}

/// The problem with every nonzero component of the start moved by this number of ulps away from 0.
ComputedProblem moved_start(ComputedProblem problem, int ulps) {
  for (double& x : problem.nominal) {
    for (int i = 0; i < ulps && x != 0; ++i) x = std::nextafter(x, 2 * x);
  }
  return problem;
}

/// For each checkpoint, the largest distance of a component of the nominal from the true one,
/// relative to the largest component. The states belong to the scene's start; `moved` is another
/// start, so near that the linear part of the jet gives the difference.
std::vector<double> nominal_errors(const ComputedProblem& problem, const ComputedProblem& moved,
                                   const std::vector<Checkpoint>& points,
                                   const std::vector<Extended>& states) {
  const std::size_t dimension = states.size() / points.size();
  std::vector<double> errors;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Extended largest = 0;
    Extended error = 0;
    for (std::size_t i = 0; i < problem.components.size(); ++i) {
      Extended truth = states[k * dimension + problem.components[i]];
      for (std::size_t j = 0; j < problem.variables.size(); ++j) {
        const std::size_t variable = problem.variables[j];
        truth += Extended(points[k].jet[i][problem.space->linear_index(j)]) *
                 (Extended(moved.nominal[variable]) - Extended(problem.nominal[variable]));
      }
      largest = std::max(largest, Extended(abs(truth)));
      error = std::max(error, Extended(abs(truth - Extended(points[k].jet[i][0]))));
    }
    errors.push_back(static_cast<double>(Extended(error / largest)));
  }
  return errors;
}

/// Throws Error(usage) unless there is a checkpoint at each of the times. Steps that a tolerance
/// chooses end elsewhere, and for every start at other times.
void require_times(const std::vector<double>& times, bool are_exact,
                   const std::vector<Checkpoint>& points) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k < points.size() && (!are_exact || points[k].time == times[k])) continue;
    throw Error(ErrorKind::usage,
                fmt::format("case.growth: no step ends at t = {:g}; fixed steps that divide the "
                            "times are needed",
                            times[k]));
  }
}

void require_sizes(const GrowthExpectation& expected, const Scene& scene) {
  if (!expected.states.empty() &&
      expected.states.size() != expected.times.size() * scene.nominal.size()) {
    throw Error(ErrorKind::usage,
                fmt::format("case.growth.states: {} numbers, must be {} for each time",
                            expected.states.size(), scene.nominal.size()));
  }
  if (expected.coefficient_exponents.size() > static_cast<std::size_t>(scene.order)) {
    throw Error(ErrorKind::usage,
                fmt::format("case.growth.coefficient_exponents: {} degrees, but the order is {}",
                            expected.coefficient_exponents.size(), scene.order));
  }
}

void add_squares(std::vector<double>& sums, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i] * values[i];
}

/// Fits the exponent through the values above the least significant one.
void fit(GrowthCurve& curve, double least, double tolerance) {
  std::vector<ConvergencePoint> usable;
  for (const auto& [time, value] : curve.points) {
    if (value > least) usable.push_back({std::abs(time), value, ""});
  }
  if (!std::all_of(curve.points.begin(), curve.points.end(),
                   [](const auto& point) { return std::isfinite(point.second); })) {
    return;  // the curve is not as expected
  }
  if (usable.size() >= 3) curve.exponent = fit_logarithms(usable, 0).slope;
  if (!curve.exponent) {
    // A quantity that never rises above round-off has not grown.
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
  require_sizes(expected, scene);
  const std::vector<double> times = wanted_times(scene, expected);
  std::vector<Checkpoint> points;  // with the scene's own start
  std::vector<Extended> states = expected.states;
  std::vector<double> squared_errors(times.size(), 0);
  std::vector<double> squared_energy_errors(times.size(), 0);
  for (int sample = 0; sample < expected.samples; ++sample) {
    const ComputedProblem moved = moved_start(problem, sample);
    const auto reached = checkpoints(
        scene, moved, times, [&](double done) { progress((sample + done) / expected.samples); });
    require_times(times, !expected.times.empty(), reached);
    if (sample > 0) {
      std::vector<double> own_times;
      for (const Checkpoint& point : points) own_times.push_back(point.time);
      require_times(own_times, true, reached);
    }
    if (sample == 0) {
      points = reached;
      if (expected.error_exponent && states.empty()) states = true_states(scene, problem, points);
    }
    if (expected.error_exponent) {
      add_squares(squared_errors, nominal_errors(problem, moved, reached, states));
    }
    std::vector<double> energy_errors;
    for (const Checkpoint& point : reached) energy_errors.push_back(point.largest_energy_error);
    add_squares(squared_energy_errors, energy_errors);
  }
  std::vector<GrowthCurve> curves;
  const auto add = [&](GrowthCurve curve, double least) {
    fit(curve, least, expected.exponent_tolerance);
    curves.push_back(std::move(curve));
  };
  const auto add_error = [&](const char* quantity, const std::optional<double>& exponent,
                             const std::vector<double>& squares) {
    if (!exponent) return;
    GrowthCurve curve;
    curve.quantity = quantity;
    curve.expected = *exponent;
    for (std::size_t i = 0; i < points.size(); ++i) {
      curve.points.emplace_back(points[i].time, std::sqrt(squares[i] / expected.samples));
    }
    add(std::move(curve), round_off);
  };
  add_error("error of the nominal", expected.error_exponent, squared_errors);
  add_error("largest energy error", expected.energy_exponent, squared_energy_errors);
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
