#include "hamjet/integrators/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/raise_to.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "jet_directions.hpp"
#include "line_restriction.hpp"
#include "lines_side_by_side.hpp"
#include "momentum_unit.hpp"

namespace hamjet {
namespace {

constexpr std::size_t rounding_samples = 16;  ///< along each direction
/// Stages of the runs along directions; other stages make other steps.
constexpr std::array<int, 2> stages_of_runs = {16, 15};
/// Directions of each run. An error of a high degree d is about (g.x)^d, with g what the steps
/// resolve worst: it is seen along few directions, and two of many steps' errors, none of few.
constexpr std::array<std::size_t, 2> directions_of_runs = {8, 2};
/// A known line is of use if no degree is larger or smaller along it by more than this factor.
constexpr double largest_distortion = 30;
/// Known lines that show more than this many times the error of a run of their own are not finer
/// than the jet, or the run has missed the error.
constexpr double largest_disagreement = 10;

/// A line's variable has no unit of momentum.
constexpr std::array<std::size_t, 1> variable_of_line = {0};

template <class Real>
using Directions = std::vector<Direction<Real>>;

template <class Real>
constexpr double rounding() {
  return static_cast<double>(std::numeric_limits<Real>::epsilon());
}

/// The directions of known lines, in the estimate's unit of momentum; none unless the degrees of
/// the jet are about as large along each as their largest coefficients.
template <class Real>
std::vector<Direction<Real>> known_directions(const FlowProblem<Real>& problem,
                                              const std::vector<JetAlongLine<Real>>& known,
                                              int exponent, const FlowJet<Real>& jet,
                                              const SpacePointer& line,
                                              const std::vector<double>& largest) {
  const std::size_t n = problem.system->degrees_of_freedom;
  std::vector<Direction<Real>> result;
  for (const JetAlongLine<Real>& one : known) {
    std::vector<Real> entries = one.direction;
    double logarithms = 0;
    for (std::size_t v = 0; v < entries.size(); ++v) {
      if (problem.variables[v] >= n) entries[v] *= Real(std::ldexp(1.0, -exponent));
      logarithms += std::log(std::abs(static_cast<double>(entries[v])));
    }
    const double length = std::exp(logarithms / static_cast<double>(entries.size()));
    result.push_back(direction_of(std::move(entries), length, jet, line, largest));
    if (!(result.back().distortion <= std::log(largest_distortion))) return {};
  }
  return result;
}

/// By degree, the largest difference of two univariate jets.
template <class Real>
std::vector<double> differences(const FlowJet<Real>& a, const FlowJet<Real>& b) {
  std::vector<double> result(a[0].size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t d = 0; d < result.size(); ++d) {
      const double difference = std::abs(static_cast<double>(Real(a[i][d] - b[i][d])));
      raise_to(result[d], difference);
    }
  }
  return result;
}

/// By degree, how far two runs along a direction differ, relative to what the jet's coefficients
/// are.
template <class Real>
std::vector<double> relative_differences(const FlowJet<Real>& a, const FlowJet<Real>& run,
                                         bool is_known, const std::vector<double>& largest) {
  std::vector<double> result = differences(a, run);
  const std::vector<double> along = largest_by_degree(run);
  for (std::size_t d = 0; d < result.size(); ++d) {
    double scale = along[d] > 0 ? std::min(along[d], largest[d]) : largest[d];
    // The coefficients may add up along a known line, and their errors with them.
    if (is_known && along[d] > 0) scale = along[d];
    if (scale == 0) scale = std::max(along[d], largest[d]);
    result[d] = scale == 0 ? 0 : result[d] / scale;
  }
  return result;
}

/// By degree, the larger of `result` and the error that a run along a direction shows.
template <class Real>
void include_run(std::vector<double>& result, const Direction<Real>& direction,
                 const FlowJet<Real>& run, bool is_known, const std::vector<double>& largest) {
  const std::vector<double> shown = relative_differences(direction.jet, run, is_known, largest);
  const std::vector<double> along = largest_by_degree(run);
  for (std::size_t d = 0; d < result.size(); ++d) {
    if (along[d] == 0 && largest[d] == 0) continue;
    double estimate = error_estimate_safety * shown[d];
    if (estimate < rounding<Real>()) estimate = rounding<Real>();
    raise_to(result[d], estimate);
  }
}

/// All runs have the same nominal, so that its difference between two of them is error too.
template <class Real>
void include_nominals(std::vector<double>& result, const FlowJet<Real>& a, const FlowJet<Real>& b,
                      double largest) {
  if (largest == 0) return;
  raise_to(result[0], error_estimate_safety * differences(a, b)[0] / largest);
}

bool is_confirmed(const std::vector<double>& own, const std::vector<double>& known) {
  return std::equal(own.begin(), own.end(), known.begin(), [](double of_own, double of_known) {
    return of_known <= largest_disagreement * of_own;
  });
}

template <class Real>
void validate_jet(const FlowProblem<Real>& problem, const FlowJet<Real>& jet) {
  if (jet.size() != problem.system->dimension()) {
    throw Error(ErrorKind::usage, "error estimate: the jet has another number of components");
  }
  for (const Series<Real>& component : jet) require_same_space(component.space(), *problem.space);
}

template <class Real>
void validate_lines(const FlowProblem<Real>& problem,
                    const std::vector<JetAlongLine<Real>>& known) {
  const auto order = static_cast<std::size_t>(problem.space->order());
  for (const JetAlongLine<Real>& line : known) {
    bool fits = line.direction.size() == problem.variables.size() &&
                line.jet.size() == problem.system->dimension();
    for (const Series<Real>& component : line.jet) fits = fits && component.size() == order + 1;
    if (!fits) throw Error(ErrorKind::usage, "error estimate: a known line is of another problem");
  }
}

/// The problem along a direction, which is in the estimate's unit of momentum.
template <class Real>
FlowProblem<Real> problem_along(const FlowProblem<Real>& problem,
                                const std::vector<Real>& direction, int exponent) {
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const std::size_t n = problem.system->degrees_of_freedom;
  std::vector<Real> entries = direction;
  for (std::size_t v = 0; v < entries.size(); ++v) {
    if (problem.variables[v] >= n) entries[v] *= Real(std::ldexp(1.0, exponent));
  }
  return {problem.system,
          line,
          {0},
          problem.initial_state,
          problem.duration,
          restrict_to_line(starting_jet(problem), entries, line)};
}

/// The problem along several directions, side by side.
template <class Real>
FlowProblem<Real> problem_along(const FlowProblem<Real>& problem,
                                std::span<const Direction<Real>> directions, int exponent) {
  std::vector<FlowJet<Real>> starts;
  FlowProblem<Real> all;
  for (const Direction<Real>& direction : directions) {
    all = problem_along(problem, direction.entries, exponent);
    starts.push_back(*all.initial_jet);
  }
  all.initial_jet = side_by_side(starts);
  all.space = (*all.initial_jet)[0].space_pointer();
  all.variables.assign(directions.size(), 0);
  return all;
}

/// Moves the coefficients of a start by up to half a unit in the last place of the largest
/// position, or momentum, of their degree.
template <class Real>
void move_by_half_units(FlowProblem<Real>& along, std::mt19937_64& generator) {
  FlowJet<Real>& start = *along.initial_jet;
  const std::size_t n = start.size() / 2;
  for (std::size_t d = 0; d < start[0].size(); ++d) {
    for (const std::size_t first : {std::size_t{0}, n}) {
      double largest = 0;
      for (std::size_t i = first; i < first + n; ++i) {
        raise_to(largest, std::abs(static_cast<double>(start[i][d])));
      }
      for (std::size_t i = first; i < first + n; ++i) {
        const double fraction = static_cast<double>(generator() >> 11) * 0x1p-52 - 1;  // in [-1, 1)
        start[i][d] += Real(fraction * largest * rounding<Real>() / 2);
      }
    }
  }
  for (std::size_t i = 0; i < start.size(); ++i) along.initial_state[i] = start[i][0];
}

/// How the run along a direction is integrated.
template <class Real>
GaussSettings settings_of_run(std::size_t number, const ErrorEstimateSettings& settings) {
  GaussSettings gauss;
  gauss.stages = stages_of_runs[number];
  gauss.tolerance = settings.tolerance.value_or(4 * rounding<Real>());
  gauss.controls_all_degrees = true;
  return gauss;
}

/// Counts the steps of the run along a direction.
template <class Real>
StepObserver<Real> observer_of_run(const Real& duration, std::size_t number,
                                   const ErrorEstimateSettings& settings) {
  return [&settings, duration, number, steps = 0L](const Real& time, const FlowJet<Real>&) mutable {
    if (++steps > settings.most_steps) {
      throw Error(ErrorKind::too_large,
                  fmt::format("error estimate: the independent run would take more than {} "
                              "steps",
                              settings.most_steps));
    }
    if (!settings.progress) return;
    const double done = static_cast<double>(Real(time / duration));
    settings.progress((static_cast<double>(number) + done) /
                      static_cast<double>(stages_of_runs.size()));
  };
}

/// The jets along the directions that such a run has come to, in the estimate's unit of momentum.
template <class Real>
std::vector<FlowJet<Real>> lines_of_run(const FlowJet<Real>& run,
                                        const ErrorEstimateSettings& settings) {
  std::vector<FlowJet<Real>> lines = line_by_line(run);
  for (FlowJet<Real>& line : lines) {
    line = in_momentum_unit(std::move(line), variable_of_line, settings.momentum_exponent);
  }
  return lines;
}

template <class Real>
std::vector<FlowJet<Real>> run_along(const FlowProblem<Real>& problem,
                                     std::span<const Direction<Real>> directions,
                                     std::size_t number, const ErrorEstimateSettings& settings) {
  IntegrationStatistics statistics;
  return lines_of_run<Real>(
      integrate_gauss<Real>(problem_along(problem, directions, settings.momentum_exponent),
                            settings_of_run<Real>(number, settings), statistics,
                            observer_of_run<Real>(problem.duration, number, settings)),
      settings);
}

/// The directions of a run, of those that were drawn.
template <class Real>
std::span<const Direction<Real>> directions_of_run(const Directions<Real>& drawn,
                                                   std::size_t number) {
  return std::span(drawn).first(directions_of_runs[number]);
}

/// By degree, the largest of `result` and the errors that a run shows along its directions.
template <class Real>
void include_lines(std::vector<double>& result, std::span<const Direction<Real>> directions,
                   const std::vector<FlowJet<Real>>& lines, const std::vector<double>& largest) {
  for (std::size_t j = 0; j < directions.size(); ++j) {
    include_run(result, directions[j], lines[j], false, largest);
  }
}

}  // namespace

template <class Real>
std::vector<double> estimate_error(const FlowProblem<Real>& problem, const FlowJet<Real>& delivered,
                                   const ErrorEstimateSettings& settings,
                                   const std::vector<JetAlongLine<Real>>& known) {
  validate(problem);
  validate_jet(problem, delivered);
  validate_lines(problem, known);
  const auto degrees = static_cast<std::size_t>(problem.space->order()) + 1;
  std::vector<double> result(degrees, 0);
  if (problem.duration == 0) return result;
  const int exponent = settings.momentum_exponent;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const FlowJet<Real> jet = in_momentum_unit(delivered, problem.variables, exponent);
  const std::vector<double> largest = largest_by_degree(jet);
  const Directions<Real> drawn = choose_directions(jet, line, largest, directions_of_runs[0]);
  // Steps that were chosen along the known lines are judged along others too.
  const auto first = run_along<Real>(problem, drawn, 0, settings);
  include_lines<Real>(result, drawn, first, largest);
  const auto taken = known_directions(problem, known, exponent, jet, line, largest);
  if (!taken.empty()) {
    std::vector<double> shown(degrees, 0);
    for (std::size_t k = 0; k < taken.size(); ++k) {
      const FlowJet<Real> run = in_momentum_unit(known[k].jet, variable_of_line, exponent);
      include_run(shown, taken[k], run, true, largest);
      include_nominals(shown, first[0], run, largest[0]);
    }
    if (is_confirmed(result, shown)) {
      for (std::size_t d = 0; d < degrees; ++d) result[d] = std::max(result[d], shown[d]);
      return result;
    }
  }
  const auto directions = directions_of_run<Real>(drawn, 1);
  const auto second = run_along<Real>(problem, directions, 1, settings);
  include_lines<Real>(result, directions, second, largest);
  include_nominals(result, first[0], second[0], largest[0]);
  return result;
}

template <class Real>
std::vector<std::vector<double>> estimate_errors(const FlowProblem<Real>& problem,
                                                 const std::vector<Real>& times,
                                                 const std::vector<FlowJet<Real>>& delivered,
                                                 const ErrorEstimateSettings& settings) {
  validate(problem);
  if (times.size() != delivered.size()) {
    throw Error(ErrorKind::usage, "error estimate: times and jets are not of one number");
  }
  const auto degrees = static_cast<std::size_t>(problem.space->order()) + 1;
  std::vector<std::vector<double>> result(times.size(), std::vector<double>(degrees, 0));
  if (times.empty()) return result;
  const int exponent = settings.momentum_exponent;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  std::vector<FlowJet<Real>> jets;
  std::vector<std::vector<double>> largest;
  for (const FlowJet<Real>& jet : delivered) {
    validate_jet(problem, jet);
    jets.push_back(in_momentum_unit(jet, problem.variables, exponent));
    largest.push_back(largest_by_degree(jets.back()));
  }
  std::vector<FlowJet<Real>> first(times.size());  // of the first run, along its first direction
  const Directions<Real> drawn =
      choose_directions(jets.back(), line, largest.back(), directions_of_runs[0]);
  for (std::size_t number = 0; number < stages_of_runs.size(); ++number) {
    const auto directions = directions_of_run<Real>(drawn, number);
    const JetTrajectory<Real> along(problem_along<Real>(problem, directions, exponent),
                                    settings_of_run<Real>(number, settings), 256e6,
                                    observer_of_run<Real>(problem.duration, number, settings));
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto lines = lines_of_run<Real>(along.at(times[i]), settings);
      for (std::size_t j = 0; j < lines.size(); ++j) {
        const Direction<Real> direction{directions[j].entries,
                                        restrict_to_line(jets[i], directions[j].entries, line)};
        include_run(result[i], direction, lines[j], false, largest[i]);
      }
      if (number > 0) include_nominals(result[i], first[i], lines[0], largest[i][0]);
      first[i] = lines[0];
    }
  }
  return result;
}

template <class Real>
std::vector<double> sample_rounding(
    const FlowProblem<Real>& problem, const FlowJet<Real>& delivered,
    const std::function<FlowJet<Real>(const FlowProblem<Real>&)>& integrate,
    const ErrorEstimateSettings& settings) {
  validate(problem);
  validate_jet(problem, delivered);
  const int exponent = settings.momentum_exponent;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const FlowJet<Real> jet = in_momentum_unit(delivered, problem.variables, exponent);
  const std::vector<double> largest = largest_by_degree(jet);
  std::vector<double> result(largest.size(), 0);
  std::mt19937_64 generator(1);
  double done = 0;
  for (const Direction<Real>& direction :
       choose_directions(jet, line, largest, stages_of_runs.size())) {
    const FlowProblem<Real> along = problem_along(problem, direction.entries, exponent);
    const auto run = [&](const FlowProblem<Real>& start) {
      if (settings.progress) settings.progress(done);
      done += 1.0 / static_cast<double>(stages_of_runs.size() * (rounding_samples + 1));
      return in_momentum_unit(integrate(start), variable_of_line, exponent);
    };
    const FlowJet<Real> unmoved = run(along);
    for (std::size_t sample = 0; sample < rounding_samples; ++sample) {
      FlowProblem<Real> moved = along;
      move_by_half_units(moved, generator);
      const std::vector<double> change = relative_differences(run(moved), unmoved, false, largest);
      for (std::size_t d = 0; d < result.size(); ++d) raise_to(result[d], change[d]);
    }
  }
  return result;
}

template std::vector<double> sample_rounding(
    const FlowProblem<InstantiatedReal>&, const FlowJet<InstantiatedReal>&,
    const std::function<FlowJet<InstantiatedReal>(const FlowProblem<InstantiatedReal>&)>&,
    const ErrorEstimateSettings&);
template std::vector<std::vector<double>> estimate_errors(
    const FlowProblem<InstantiatedReal>&, const std::vector<InstantiatedReal>&,
    const std::vector<FlowJet<InstantiatedReal>>&, const ErrorEstimateSettings&);
template std::vector<double> estimate_error(const FlowProblem<InstantiatedReal>&,
                                            const FlowJet<InstantiatedReal>&,
                                            const ErrorEstimateSettings&,
                                            const std::vector<JetAlongLine<InstantiatedReal>>&);

}  // namespace hamjet
