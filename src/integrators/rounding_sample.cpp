#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/raise_to.hpp"
#include "../algebra/signed_fraction.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "line_errors.hpp"
#include "runs_along_lines.hpp"

namespace hamjet {
namespace {

constexpr std::size_t rounding_samples = 4;

/// Moves the coefficients of a start by up to half a unit in the last place of the largest
/// position, or momentum, of their degree. Parameters are kept by a flow, and are not rounded.
template <class Real>
void move_by_half_units(FlowProblem<Real>& along, std::mt19937_64& generator) {
  FlowJet<Real>& start = *along.initial_jet;
  const std::size_t n = along.system->degrees_of_freedom;
  for (std::size_t d = 0; d < start[0].size(); ++d) {
    for (const std::size_t first : {std::size_t{0}, n}) {
      double largest = 0;
      for (std::size_t i = first; i < first + n; ++i) {
        raise_to(largest, std::abs(static_cast<double>(start[i][d])));
      }
      for (std::size_t i = first; i < first + n; ++i) {
        start[i][d] += Real(signed_fraction(generator) * largest * rounding_unit<Real>() / 2);
      }
    }
  }
  for (std::size_t i = 0; i < start.size(); ++i) along.initial_state[i] = start[i][0];
}

}  // namespace

template <class Real>
std::vector<double> sample_rounding(
    const FlowProblem<Real>& problem, const FlowJet<Real>& delivered,
    const std::function<FlowJet<Real>(const FlowProblem<Real>&)>& integrate,
    const ErrorEstimateSettings& settings) {
  validate(problem);
  require_jet_of(problem, delivered);
  const int exponent = settings.momentum_exponent;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const FlowJet<Real> jet = compared_components(delivered, problem.variables,
                                                problem.system->degrees_of_freedom, exponent);
  const std::vector<double> largest = largest_by_degree(jet);
  Directions<Real> unmoved = choose_directions(jet, line, largest, directions_of_runs[0]);
  std::vector<std::vector<FlowJet<Real>>> moved(rounding_samples);
  std::mt19937_64 generator(1);
  const auto runs = static_cast<double>(unmoved.size() * (rounding_samples + 1));
  double done = 0;
  for (Direction<Real>& direction : unmoved) {
    const FlowProblem<Real> along = problem_along(problem, direction.entries, exponent);
    const auto run = [&](const FlowProblem<Real>& start) {
      if (settings.progress) settings.progress(done++ / runs);
      return compared_components(integrate(start), variable_of_line,
                                 problem.system->degrees_of_freedom, exponent);
    };
    direction.jet = run(along);
    for (std::vector<FlowJet<Real>>& sample : moved) {
      FlowProblem<Real> start = along;
      move_by_half_units(start, generator);
      sample.push_back(run(start));
    }
  }
  std::vector<double> result(largest.size(), 0);
  for (const std::vector<FlowJet<Real>>& sample : moved) {
    const std::vector<double> change = mean_line_differences<Real>(unmoved, sample, largest);
    for (std::size_t d = 0; d < result.size(); ++d) raise_to(result[d], change[d]);
  }
  return result;
}

template std::vector<double> sample_rounding(
    const FlowProblem<InstantiatedReal>&, const FlowJet<InstantiatedReal>&,
    const std::function<FlowJet<InstantiatedReal>(const FlowProblem<InstantiatedReal>&)>&,
    const ErrorEstimateSettings&);

}  // namespace hamjet
