#include "hamjet/integrators/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "hamjet/error.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "line_restriction.hpp"
#include "momentum_unit.hpp"

namespace hamjet {
namespace {

constexpr std::size_t candidates = 16;
/// Stages of the run along each direction; other stages make other steps.
constexpr std::array<int, 2> stages_of_runs = {16, 15};

template <class Real>
constexpr double rounding() {
  return static_cast<double>(std::numeric_limits<Real>::epsilon());
}

/// The largest magnitudes of the coefficients of each degree.
template <class Real>
std::vector<double> largest_by_degree(const FlowJet<Real>& jet) {
  const SeriesSpace& space = jet[0].space();
  std::vector<double> largest(static_cast<std::size_t>(space.order()) + 1, 0);
  for (const Series<Real>& component : jet) {
    for (std::size_t k = 0; k < space.size(); ++k) {
      double& of = largest[static_cast<std::size_t>(space.degree(k))];
      of = std::max(of, std::abs(static_cast<double>(component[k])));
    }
  }
  return largest;
}

/// A direction with the jet along it.
template <class Real>
struct Direction {
  std::vector<Real> entries;
  FlowJet<Real> jet;
  double distortion = 0;  ///< logarithm of the most that a degree is larger or smaller here
};

template <class Real>
Direction<Real> draw_direction(std::mt19937_64& generator, const FlowJet<Real>& jet,
                               const SpacePointer& line, const std::vector<double>& largest) {
  Direction<Real> direction;
  for (std::size_t v = 0; v < jet[0].space().variables(); ++v) {
    const std::uint64_t bits = generator();
    const double fraction = static_cast<double>(bits >> 12) * 0x1p-52;  // in [0, 1)
    const double size = std::sqrt(0.5) * (1 + fraction);
    direction.entries.emplace_back((bits & 1) == 0 ? size : -size);
  }
  direction.jet = restrict_to_line(jet, direction.entries, line);
  const std::vector<double> along = largest_by_degree(direction.jet);
  for (std::size_t d = 1; d < along.size(); ++d) {
    if (largest[d] == 0) continue;
    const double distortion = std::abs(std::log(along[d] / largest[d]));
    direction.distortion = std::max(direction.distortion, distortion);
  }
  return direction;
}

/// The directions along which the jet is judged.
template <class Real>
std::vector<Direction<Real>> choose_directions(const FlowJet<Real>& jet, const SpacePointer& line,
                                               const std::vector<double>& largest) {
  std::mt19937_64 generator(20040693);
  std::vector<Direction<Real>> drawn;
  for (std::size_t k = 0; k < candidates; ++k) {
    drawn.push_back(draw_direction(generator, jet, line, largest));
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const auto& a, const auto& b) { return a.distortion < b.distortion; });
  drawn.resize(stages_of_runs.size());
  return drawn;
}

/// By degree, the largest difference of two univariate jets.
template <class Real>
std::vector<double> differences(const FlowJet<Real>& a, const FlowJet<Real>& b) {
  std::vector<double> result(a[0].size(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t d = 0; d < result.size(); ++d) {
      const double difference = std::abs(static_cast<double>(Real(a[i][d] - b[i][d])));
      if (!(difference <= result[d])) result[d] = difference;
    }
  }
  return result;
}

template <class Real>
void validate_jet(const FlowProblem<Real>& problem, const FlowJet<Real>& jet) {
  if (jet.size() != problem.system->dimension()) {
    throw Error(ErrorKind::usage, "error estimate: the jet has another number of components");
  }
  for (const Series<Real>& component : jet) require_same_space(component.space(), *problem.space);
}

template <class Real>
FlowJet<Real> run_along(const FlowProblem<Real>& problem, const std::vector<Real>& direction,
                        std::size_t number, const ErrorEstimateSettings& settings) {
  GaussSettings gauss;
  gauss.stages = stages_of_runs[number];
  gauss.tolerance = settings.tolerance.value_or(4 * rounding<Real>());
  gauss.controls_all_degrees = true;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const std::size_t n = problem.system->degrees_of_freedom;
  std::vector<Real> entries = direction;
  for (std::size_t v = 0; v < entries.size(); ++v) {
    if (problem.variables[v] >= n) entries[v] *= Real(std::ldexp(1.0, settings.momentum_exponent));
  }
  const FlowJet<Real> start = restrict_to_line(starting_jet(problem), entries, line);
  const FlowProblem<Real> along{problem.system,   line,  {0}, problem.initial_state,
                                problem.duration, &start};
  IntegrationStatistics statistics;
  long steps = 0;
  FlowJet<Real> end =
      integrate_gauss<Real>(along, gauss, statistics, [&](const Real& time, const FlowJet<Real>&) {
        if (++steps > settings.most_steps) {
          throw Error(ErrorKind::too_large,
                      fmt::format("error estimate: the independent run would take more than {} "
                                  "steps",
                                  settings.most_steps));
        }
        if (!settings.progress) return;
        const double done = static_cast<double>(Real(time / problem.duration));
        settings.progress((static_cast<double>(number) + done) /
                          static_cast<double>(stages_of_runs.size()));
      });
  constexpr std::size_t position[] = {0};  // the line's variable has no unit of momentum
  return in_momentum_unit(std::move(end), position, settings.momentum_exponent);
}

}  // namespace

template <class Real>
std::vector<double> estimate_error(const FlowProblem<Real>& problem, const FlowJet<Real>& delivered,
                                   const ErrorEstimateSettings& settings) {
  validate(problem);
  validate_jet(problem, delivered);
  const auto degrees = static_cast<std::size_t>(problem.space->order()) + 1;
  std::vector<double> result(degrees, 0);
  if (problem.duration == 0) return result;
  const SpacePointer line = SeriesSpace::create(1, problem.space->order());
  const FlowJet<Real> jet =
      in_momentum_unit(delivered, problem.variables, settings.momentum_exponent);
  const std::vector<double> largest = largest_by_degree(jet);
  const auto directions = choose_directions(jet, line, largest);
  std::vector<FlowJet<Real>> runs;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    runs.push_back(run_along(problem, directions[k].entries, k, settings));
    const std::vector<double> differing = differences(directions[k].jet, runs[k]);
    const std::vector<double> along = largest_by_degree(runs[k]);
    for (std::size_t d = 0; d < degrees; ++d) {
      double scale = along[d] > 0 ? std::min(along[d], largest[d]) : largest[d];
      if (scale == 0) scale = std::max(along[d], largest[d]);
      if (scale == 0) continue;
      double estimate = error_estimate_safety * differing[d] / scale;
      if (estimate < rounding<Real>()) estimate = rounding<Real>();
      if (!(estimate <= result[d])) result[d] = estimate;
    }
  }
  // Both runs have the same nominal, so that its difference between them is error too.
  if (largest[0] > 0) {
    result[0] =
        std::max(result[0], error_estimate_safety * differences(runs[0], runs[1])[0] / largest[0]);
  }
  return result;
}

template std::vector<double> estimate_error(const FlowProblem<double>&, const FlowJet<double>&,
                                            const ErrorEstimateSettings&);
template std::vector<double> estimate_error(const FlowProblem<Extended>&, const FlowJet<Extended>&,
                                            const ErrorEstimateSettings&);

}  // namespace hamjet
