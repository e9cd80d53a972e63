#include "hamjet/uncertainty/least_separations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "../integrators/concurrent_tasks.hpp"
#include "../integrators/taylor_flow.hpp"
#include "binomial_interval.hpp"
#include "entry_sampler.hpp"
#include "hamjet/error.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"

namespace hamjet {
namespace {

/// Separations are told to a part of the radius.
constexpr double separation_accuracy = 0.01;

/// The deviations of a block, a structure of arrays.
std::vector<double> deviations_of(std::uint64_t seed, std::size_t number) {
  RandomStream random(seed, number);
  std::vector<double> points(encounter_variables * samples_in_block);
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    for (std::size_t i = 0; i < encounter_variables; ++i)
      points[i * samples_in_block + j] = random.normal();
  }
  return points;
}

/// Least separations of a block's first samples, flown with the full equations through the nodes.
std::vector<double> flown_block(const EncounterProblem& problem, const RelativePaths& paths,
                                const std::vector<double>& points, std::size_t count) {
  std::vector<SampledPath> flown(count, SampledPath(paths.times().size()));
  TaylorFlow flow(problem.system);
  for (std::size_t craft = 0; craft < 2; ++craft) {
    std::vector<double> states;
    for (std::size_t j = 0; j < count; ++j) {
      Eigen::Matrix<double, 6, 1> xi;
      for (std::size_t i = 0; i < 6; ++i) {
        xi[static_cast<Eigen::Index>(i)] = points[(6 * craft + i) * samples_in_block + j];
      }
      const auto start = problem.spacecraft[craft].deviated(xi);
      states.insert(states.end(), start.begin(), start.end());
    }
    double time = 0;
    for (std::size_t node = 0; node < paths.times().size(); ++node) {
      const std::vector<double> ahead(count, paths.times()[node] - time);
      flow.advance(states, ahead);
      time = paths.times()[node];
      for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t c = 0; c < 6; ++c) {
          flown[j][node][c] += (craft == 0 ? -1 : 1) * states[6 * j + c];
        }
      }
    }
  }
  std::vector<double> least;
  for (const SampledPath& path : flown) least.push_back(least_distance(paths, path));
  return least;
}

/// Quantiles of sorted samples, with intervals.
void tell_quantiles(const std::vector<double>& sorted, double confidence,
                    LeastSeparations& result) {
  const auto count = static_cast<double>(sorted.size());
  const double tail = (1 - confidence) / 2;
  for (const double share : result.shares) {
    const auto place = static_cast<std::size_t>(share * count);
    result.separations.push_back(sorted[std::min(place, sorted.size() - 1)]);
    // Quantiles of the number of samples below; Boost rounds them away from the middle, but not
    // below 0.
    const boost::math::binomial_distribution<double> below(count, share);
    const auto low = static_cast<std::size_t>(boost::math::quantile(below, tail));
    const auto high =
        static_cast<std::size_t>(boost::math::quantile(boost::math::complement(below, tail)));
    result.lower.push_back(boost::math::cdf(below, static_cast<double>(low)) <= tail ? sorted[low]
                                                                                     : 0.0);
    result.upper.push_back(high < sorted.size() ? sorted[high]
                                                : std::numeric_limits<double>::infinity());
  }
}

}  // namespace

void LeastSeparations::scale(double unit) {
  for (auto* lengths : {&separations, &lower, &upper}) {
    for (double& length : *lengths) length *= unit;
  }
  flight_difference *= unit;
}

LeastSeparations least_separations(const EncounterProblem& problem,
                                   const CollisionSettings& settings,
                                   const std::vector<double>& shares, long flights) {
  validate(problem);
  for (const double share : shares) {
    if (!(share > 0 && share < 1)) {
      throw Error(ErrorKind::usage, "least separations: a share must be between 0 and 1");
    }
  }
  // No path is left out.
  const RelativePaths paths(problem, separation_accuracy * problem.radius,
                            std::numeric_limits<double>::infinity());
  const auto count = static_cast<std::size_t>(std::max(1L, settings.samples));
  const std::size_t tasks = (count + samples_in_block - 1) / samples_in_block;
  std::vector<double> least(count);
  run_concurrently(
      tasks, settings.threads,
      [&](std::size_t task, TaskControl& control) {
        std::vector<double> states(6 * paths.times().size() * samples_in_block);
        paths.evaluate(deviations_of(settings.seed, task), problem.order, states);
        SampledPath path(paths.times().size());
        for (std::size_t j = 0; j < in_block(count, task * samples_in_block); ++j) {
          take_path(states, samples_in_block, j, path);
          least[task * samples_in_block + j] = least_distance(paths, path);
        }
        control.advance();
      },
      [&](long done) {
        if (settings.progress) {
          settings.progress(static_cast<double>(done) / static_cast<double>(tasks));
        }
      });
  LeastSeparations result;
  result.shares = shares;
  result.samples = static_cast<long>(least.size());
  result.flights = std::min(flights, result.samples);
  const auto flown_blocks =
      (static_cast<std::size_t>(result.flights) + samples_in_block - 1) / samples_in_block;
  for (std::size_t k = 0; k < flown_blocks; ++k) {
    const std::size_t number =
        in_block(static_cast<std::size_t>(result.flights), k * samples_in_block);
    const std::vector<double> flown =
        flown_block(problem, paths, deviations_of(settings.seed, k), number);
    for (std::size_t j = 0; j < number; ++j) {
      result.flight_difference =
          std::max(result.flight_difference, std::abs(flown[j] - least[k * samples_in_block + j]));
    }
  }
  std::sort(least.begin(), least.end());
  result.nearer = std::lower_bound(least.begin(), least.end(), problem.radius) - least.begin();
  std::tie(result.lower_nearer, result.upper_nearer) =
      binomial_interval(result.samples, result.nearer, settings.confidence);
  tell_quantiles(least, settings.confidence, result);
  return result;
}

}  // namespace hamjet
