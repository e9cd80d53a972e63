#include <algorithm>
#include <cmath>
#include <random>

#include "../algebra/instantiated_real.hpp"
#include "../algebra/raise_to.hpp"
#include "hamjet/integrators/error_estimate.hpp"
#include "line_errors.hpp"
#include "runs_along_lines.hpp"

namespace hamjet {
namespace {

constexpr std::size_t rounding_samples = 16;  ///< along each direction

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
        start[i][d] += Real(fraction * largest * rounding_unit<Real>() / 2);
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
      const std::vector<double> change =
          relative_line_differences(run(moved), unmoved, false, largest);
      for (std::size_t d = 0; d < result.size(); ++d) raise_to(result[d], change[d]);
    }
  }
  return result;
}

template std::vector<double> sample_rounding(
    const FlowProblem<InstantiatedReal>&, const FlowJet<InstantiatedReal>&,
    const std::function<FlowJet<InstantiatedReal>(const FlowProblem<InstantiatedReal>&)>&,
    const ErrorEstimateSettings&);

}  // namespace hamjet
