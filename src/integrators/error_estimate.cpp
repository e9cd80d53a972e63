#include "hamjet/integrators/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "../algebra/instantiated_real.hpp"
#include "hamjet/error.hpp"
#include "hamjet/integrators/jet_trajectory.hpp"
#include "jet_directions.hpp"
#include "line_errors.hpp"
#include "momentum_unit.hpp"
#include "runs_along_lines.hpp"

namespace hamjet {
namespace {

/// A known line is used only if no degree is larger or smaller along it by more than this factor.
constexpr double largest_distortion = 30;
/// If known lines show more than this many times the error of a separate run, either they are not
/// finer than the jet, or the run has missed the error.
constexpr double largest_disagreement = 10;
/// They raise the error of the run by no more than this: their own error is not known as well.
constexpr double largest_raise = 2;

/// The directions of known lines, in the estimate's unit of momentum. The list is empty unless the
/// degrees of the jet are about as large along each line as their largest coefficients.
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
      entries[v] *= Real(std::ldexp(1.0, -exponent_of_variable(problem.variables[v], n, exponent)));
      logarithms += std::log(std::abs(static_cast<double>(entries[v])));
    }
    const double length = std::exp(logarithms / static_cast<double>(entries.size()));
    result.push_back(direction_of(std::move(entries), length, jet, line, largest));
    if (!(result.back().distortion <= std::log(largest_distortion))) return {};
  }
  return result;
}

/// What is below rounding confirms nothing and contradicts nothing.
template <class Real>
bool is_confirmed(const std::vector<double>& own, const std::vector<double>& known) {
  return std::equal(own.begin(), own.end(), known.begin(), [](double of_own, double of_known) {
    return of_known <= largest_disagreement * std::max(of_own, rounding_unit<Real>());
  });
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

}  // namespace

template <class Real>
std::vector<double> estimate_error(const FlowProblem<Real>& problem, const FlowJet<Real>& delivered,
                                   const ErrorEstimateSettings& settings,
                                   const std::vector<JetAlongLine<Real>>& known) {
  validate(problem);
  require_jet_of(problem, delivered);
  validate_lines(problem, known);
  const auto degrees = static_cast<std::size_t>(problem.space->order()) + 1;
  if (problem.duration == 0) return std::vector<double>(degrees, 0);
  const int exponent = settings.momentum_exponent;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const FlowJet<Real> jet = compared_components(delivered, problem.variables,
                                                problem.system->degrees_of_freedom, exponent);
  const std::vector<double> largest = largest_by_degree(jet);
  const Directions<Real> drawn = choose_directions(jet, line, largest, directions_of_runs[0]);
  // Steps that were chosen along the known lines are also judged along other lines.
  const auto first = run_along<Real>(problem, drawn, 0, settings);
  std::vector<double> result = mean_line_differences<Real>(drawn, first, largest);
  const auto taken = known_directions(problem, known, exponent, jet, line, largest);
  std::vector<double> shown(degrees, 0);
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const FlowJet<Real> run = compared_components(known[k].jet, variable_of_line,
                                                  problem.system->degrees_of_freedom, exponent);
    include_known(shown, taken[k], run, largest);
  }
  if (!taken.empty() && is_confirmed<Real>(result, shown)) {
    for (std::size_t d = 0; d < degrees; ++d) {
      // One nominal stands for all lines of the run, whose difference may be small by chance.
      raise_to(result[d], d == 0 ? shown[d] : std::min(shown[d], largest_raise * result[d]));
    }
  } else {
    const auto directions = directions_of_run<Real>(drawn, 1);
    const auto second = run_along<Real>(problem, directions, 1, settings);
    take_own_part<Real>(result, directions, first, second);
  }
  raise_to_rounding(result, first, largest);
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
    require_jet_of(problem, jet);
    jets.push_back(
        compared_components(jet, problem.variables, problem.system->degrees_of_freedom, exponent));
    largest.push_back(largest_by_degree(jets.back()));
  }
  const Directions<Real> drawn =
      choose_directions(jets.back(), line, largest.back(), directions_of_runs[0]);
  std::vector<std::vector<FlowJet<Real>>> first;  // lines of the first run at each time
  for (std::size_t number = 0; number < stages_of_runs.size(); ++number) {
    const auto directions = directions_of_run<Real>(drawn, number);
    const JetTrajectory<Real> along(problem_along<Real>(problem, directions, exponent),
                                    settings_of_run<Real>(number, settings), 256e6,
                                    observer_of_run<Real>(problem.duration, number, settings));
    for (std::size_t i = 0; i < times.size(); ++i) {
      auto lines =
          lines_of_run<Real>(along.at(times[i]), problem.system->degrees_of_freedom, settings);
      Directions<Real> at_time;
      for (const Direction<Real>& direction : directions) {
        at_time.push_back({direction.entries, restrict_to_line(jets[i], direction.entries, line),
                           sizes_along(jets[i], direction.entries, line)});
      }
      if (number == 0) {
        result[i] = mean_line_differences<Real>(at_time, lines, largest[i]);
        first.push_back(std::move(lines));
      } else {
        take_own_part<Real>(result[i], at_time, first[i], lines);
        raise_to_rounding(result[i], first[i], largest[i]);
      }
    }
  }
  return result;
}

template std::vector<std::vector<double>> estimate_errors(
    const FlowProblem<InstantiatedReal>&, const std::vector<InstantiatedReal>&,
    const std::vector<FlowJet<InstantiatedReal>>&, const ErrorEstimateSettings&);
template std::vector<double> estimate_error(const FlowProblem<InstantiatedReal>&,
                                            const FlowJet<InstantiatedReal>&,
                                            const ErrorEstimateSettings&,
                                            const std::vector<JetAlongLine<InstantiatedReal>>&);

}  // namespace hamjet
