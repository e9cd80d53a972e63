#include "hamjet/uncertainty/least_separations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "../integrators/concurrent_tasks.hpp"
#include "binomial_interval.hpp"
#include "entry_sampler.hpp"
#include "flown_separations.hpp"
#include "hamjet/error.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"

namespace hamjet {
namespace {

/// Separations are accurate to this fraction of the radius or, where that is smaller, of the least
/// separation of the means, but at least of a hundredth of the radius.
constexpr double separation_accuracy = 1e-3;
constexpr double least_counted = 0.01;

/// The deviations of a block of samples, as a structure of arrays.
std::vector<double> deviations_of(std::uint64_t seed, std::size_t number) {
  RandomStream random(seed, number);
  std::vector<double> points(encounter_variables * samples_in_block);
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    for (std::size_t i = 0; i < encounter_variables; ++i)
      points[i * samples_in_block + j] = random.normal();
  }
  return points;
}

/// The deviations of one sample.
EncounterDeviation drawn_deviation(std::uint64_t seed, std::size_t sample) {
  return deviation_of(deviations_of(seed, sample / samples_in_block), sample % samples_in_block);
}

/// The samples that are flown: the first ones, and those nearest to the first quantile.
std::vector<std::size_t> flown_samples(const std::vector<double>& least, double told,
                                       long flights) {
  const std::vector<std::size_t> nearest =
      nearest_to(told, least, static_cast<std::size_t>(flights));
  std::set<std::size_t> samples(nearest.begin(), nearest.end());
  for (std::size_t k = 0; k < nearest.size(); ++k) samples.insert(k);
  return {samples.begin(), samples.end()};
}

/// The sample below which this fraction of the samples lies.
double quantile_of(const std::vector<double>& sorted, double share) {
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(place, sorted.size() - 1)];
}

/// The least separation of a sample by the polynomials and by a flight.
struct Flown {
  double told;
  double flown;
};

/// The largest difference between flights and polynomials that can move a quantile of this size.
double difference_at(const std::vector<Flown>& flights, double quantile) {
  double largest = 0;
  for (const Flown& flight : flights) {
    largest = std::max(largest, difference_near(quantile, flight.told, flight.flown));
  }
  return largest;
}

/// Computes quantiles of sorted samples, with intervals.
void tell_quantiles(const std::vector<double>& sorted, const std::vector<Flown>& flights,
                    double confidence, LeastSeparations& result) {
  const auto count = static_cast<double>(sorted.size());
  const double tail = (1 - confidence) / 2;
  for (const double share : result.shares) {
    const double told = quantile_of(sorted, share);
    const double error = result.interpolation_error + difference_at(flights, told);
    result.separations.push_back(told);
    result.errors.push_back(error);
    // Quantiles of the number of samples below the true quantile; Boost rounds these outwards, but
    // not below 0.
    const boost::math::binomial_distribution<double> below(count, share);
    const auto low = static_cast<std::size_t>(boost::math::quantile(below, tail));
    const auto high =
        static_cast<std::size_t>(boost::math::quantile(boost::math::complement(below, tail)));
    const bool is_enclosed = boost::math::cdf(below, static_cast<double>(low)) <= tail;
    result.lower.push_back(is_enclosed ? std::max(0.0, sorted[low] - error) : 0.0);
    result.upper.push_back(high < sorted.size() ? sorted[high] + error
                                                : std::numeric_limits<double>::infinity());
  }
}

}  // namespace

void LeastSeparations::scale(double unit) {
  for (auto* lengths : {&separations, &errors, &lower, &upper}) {
    for (double& length : *lengths) length *= unit;
  }
  interpolation_error *= unit;
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
  const double size = std::clamp(flown_separation_of_means(problem), least_counted * problem.radius,
                                 problem.radius);
  const RelativePaths paths(problem, separation_accuracy * size,
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
  result.interpolation_error = paths.interpolation_error();
  std::vector<double> sorted = least;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Flown> all_flown;
  if (flights > 0 && !shares.empty()) {
    const std::vector<std::size_t> samples =
        flown_samples(least, quantile_of(sorted, shares.front()), flights);
    std::vector<EncounterDeviation> deviations;
    for (const std::size_t k : samples) deviations.push_back(drawn_deviation(settings.seed, k));
    const std::vector<double> flown = flown_separations(problem, deviations);
    for (std::size_t k = 0; k < flown.size(); ++k) {
      all_flown.push_back({least[samples[k]], flown[k]});
      result.flight_difference =
          std::max(result.flight_difference, std::abs(flown[k] - least[samples[k]]));
    }
    result.flights = static_cast<long>(samples.size());
  }
  const double error = result.interpolation_error + difference_at(all_flown, problem.radius);
  const auto nearer_than = [&](double radius) {
    return std::lower_bound(sorted.begin(), sorted.end(), radius) - sorted.begin();
  };
  const auto interval_of = [&](long hits) {
    return binomial_interval(result.samples, hits, settings.confidence);
  };
  result.nearer = nearer_than(problem.radius);
  result.lower_nearer = interval_of(nearer_than(problem.radius - error)).first;
  result.upper_nearer = interval_of(nearer_than(problem.radius + error)).second;
  tell_quantiles(sorted, all_flown, settings.confidence, result);
  return result;
}

}  // namespace hamjet
