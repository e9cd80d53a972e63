#include "hamjet/uncertainty/collision_probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <memory>

#include "../integrators/concurrent_tasks.hpp"
#include "binomial_interval.hpp"
#include "encounter_parts.hpp"
#include "hamjet/error.hpp"
#include "sampled_encounter.hpp"

namespace hamjet {
namespace {

/// The relative standard error of a mean in which a hundred draws have all of the weight. Fewer
/// draws say nothing of the collisions that they have missed.
constexpr double few_draws = 0.1;
/// What comes before the samples of one of so many parts. With too few boxes a few draws have all
/// of the weight.
SamplingEffort effort_of_part(std::size_t parts) {
  return {4, std::clamp<std::size_t>(200'000 / parts, 1000, 10'000), 16, true};
}
/// By how many radii orbits bend within a part. Parts of which linear paths say too little are
/// themselves taken in parts of the next width.
constexpr std::array<double, 2> bends_of_parts = {0.4, 0.1};
/// Parts with less than this share of all entries are left out.
constexpr double negligible_share = 1e-7;

using SampledParts = std::vector<std::unique_ptr<SampledEncounter>>;

/// Chooses the samples of each part: entries, or plain ones where entries say too little. Parts are
/// numbered from `first`.
SampledParts sampled_parts(std::vector<EncounterPart> parts, std::size_t first,
                           const CollisionSettings& settings) {
  SampledParts result(parts.size());
  const SamplingEffort effort = effort_of_part(parts.size());
  run_concurrently(
      parts.size(), settings.threads,
      [&](std::size_t k, TaskControl& control) {
        result[k] =
            std::make_unique<SampledEncounter>(std::move(parts[k]), settings, effort, first + k);
        bool has_entries = false;
        try {
          has_entries =
              settings.sampling != CollisionSampling::plain && result[k]->sample_entries();
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::numerical) throw;
        }
        if (!has_entries) result[k]->sample_plainly();
        control.advance();
      },
      [&](long) {
        if (settings.progress) settings.progress(0);
      });
  return result;
}

/// The parts of a distribution of which linear paths say enough; empty if it is best left whole.
SampledParts narrow_parts(const EncounterProblem& problem, const CollisionSettings& settings) {
  SampledParts all;
  std::vector<EncounterPart> wide = {{1, problem}};
  for (const double bend : bends_of_parts) {
    std::vector<EncounterPart> parts;
    for (const EncounterPart& one : wide) {
      for (EncounterPart& part :
           encounter_parts(one.problem, bend * problem.radius, settings.threads)) {
        part.weight *= one.weight;
        parts.push_back(std::move(part));
      }
    }
    // Nothing has been taken in parts.
    if (all.empty() && !parts[0].trajectories) return all;
    wide.clear();
    for (auto& part : sampled_parts(std::move(parts), all.size(), settings)) {
      const bool is_wide = settings.sampling != CollisionSampling::plain && !part->sampler() &&
                           !part->is_empty() && bend != bends_of_parts.back();
      if (is_wide) {
        wide.push_back({part->weight(), part->problem()});
      } else {
        all.push_back(std::move(part));
      }
    }
    if (wide.empty()) break;
  }
  return all;
}

/// The numbers of samples of parts, by the entries that each has; 0 for parts that are left out.
std::vector<std::size_t> shares_of_samples(const SampledParts& parts, std::size_t wanted) {
  std::vector<std::size_t> counts(parts.size(), 0);
  std::vector<double> masses;
  double sum = 0;
  for (const auto& part : parts) {
    masses.push_back(part->is_empty()  ? 0
                     : part->sampler() ? part->weight() * std::exp(part->sampler()->log_mass())
                                       : part->weight());
    sum += masses.back();
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (!(masses[k] > negligible_share * sum)) continue;
    counts[k] = std::max(samples_in_block,
                         static_cast<std::size_t>(static_cast<double>(wanted) * (masses[k] / sum)));
  }
  return counts;
}

/// The sums over the samples of each part.
std::vector<SampleSums> sampled(const SampledParts& parts, const std::vector<std::size_t>& counts,
                                const CollisionSettings& settings) {
  struct Task {
    std::size_t part;
    std::size_t count;
  };
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (std::size_t first = 0; first < counts[k]; first += samples_in_task) {
      tasks.push_back({k, std::min(samples_in_task, counts[k] - first)});
    }
  }
  std::vector<SampleSums> of_tasks(tasks.size());
  run_concurrently(
      tasks.size(), settings.threads,
      [&](std::size_t k, TaskControl& control) {
        of_tasks[k] = parts[tasks[k].part]->sample(k, tasks[k].count);
        control.advance();
      },
      [&](long done) {
        if (settings.progress) {
          settings.progress(static_cast<double>(done) / static_cast<double>(tasks.size()));
        }
      });
  std::vector<SampleSums> sums(parts.size());
  for (std::size_t k = 0; k < tasks.size(); ++k) sums[tasks[k].part].add(of_tasks[k]);
  return sums;
}

/// A weighted sum of probabilities, and the variance of its sampling error.
struct WeightedSum {
  double probability = 0;
  double variance = 0;

  void add(double weight, const Hits& hits, long samples) {
    const auto count = static_cast<double>(samples);
    probability += weight * hits.probability(count);
    variance += weight * weight * hits.variance(count) / count;
  }
};

/// Adds up what parts say.
void add_up(const SampledParts& parts, const std::vector<SampleSums>& sums,
            const CollisionSettings& settings, CollisionProbability& result) {
  WeightedSum all, sure, possible;
  double lower = 0, upper = 0;  // the interval that plain samples give
  double variance_of_change = 0;
  std::vector<double> by_time(time_count, 0.0);
  result.parts = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const SampledEncounter& part = *parts[k];
    const SampleSums& own = sums[k];
    if (own.samples == 0) continue;
    const double weight = part.weight();
    ++result.parts;
    result.samples += own.samples;
    result.hits += own.hits.count;
    result.path_error = std::max(result.path_error, part.path_error());
    all.add(weight, own.hits, own.samples);
    if (part.sampler()) {
      sure.add(weight, own.sure, own.samples);
      possible.add(weight, own.possible, own.samples);
    } else {
      lower += weight * binomial_interval(own.samples, own.sure.count, settings.confidence).first;
      upper +=
          weight * binomial_interval(own.samples, own.possible.count, settings.confidence).second;
    }
    if (own.compared > 0) {
      const auto compared = static_cast<double>(own.compared);
      const double change = own.change / compared;
      result.change_from_lower_order += weight * change;
      variance_of_change += weight * weight *
                            std::max(0.0, own.change_squared / compared - change * change) /
                            compared;
    }
    for (std::size_t t = 0; t < time_count; ++t) {
      by_time[t] += weight * own.by_time[t] / static_cast<double>(own.samples);
    }
  }
  result.probability = std::min(1.0, all.probability);
  result.standard_error = std::sqrt(all.variance);
  const double tail = (1 - settings.confidence) / 2;
  const double quantile = boost::math::quantile(
      boost::math::complement(boost::math::normal_distribution<double>(), tail));
  result.lower = std::max(0.0, sure.probability - quantile * std::sqrt(sure.variance) + lower);
  result.upper =
      std::min(1.0, possible.probability + quantile * std::sqrt(possible.variance) + upper);
  if (all.variance > 0) {
    result.equivalent_samples = result.probability * (1 - result.probability) / all.variance;
  }
  result.standard_error_of_change = std::sqrt(variance_of_change);
  double sum = 0;
  for (std::size_t t = 0; t < time_count; ++t) {
    sum += by_time[t];
    result.by_time[t + 1] = std::min(1.0, sum);
  }
}

CollisionProbability result_of(const EncounterProblem& problem, const CollisionSettings& settings,
                               const SampledParts& parts, const std::vector<std::size_t>& counts) {
  CollisionProbability result;
  const double span = problem.to - problem.from;
  for (std::size_t k = 0; k <= time_count; ++k) {
    result.times.push_back(problem.from + span * static_cast<double>(k) / time_count);
  }
  result.by_time.assign(time_count + 1, 0.0);
  result.sampling = CollisionSampling::entries;
  for (const auto& part : parts) {
    if (!part->sampler()) {
      result.sampling = CollisionSampling::plain;
      continue;
    }
    result.sampled_radius = std::max(result.sampled_radius.value_or(0), part->sampler()->radius());
    result.largest_difference = std::max(result.largest_difference.value_or(0), part->difference());
  }
  add_up(parts, sampled(parts, counts, settings), settings, result);
  return result;
}

/// By samples of a whole distribution; the kind of its samples has been chosen.
CollisionProbability of_whole(const EncounterProblem& problem, const CollisionSettings& settings,
                              const SampledParts& whole) {
  const std::size_t count = whole[0]->is_empty() ? 0 : static_cast<std::size_t>(settings.samples);
  return result_of(problem, settings, whole, {count});
}

}  // namespace

CollisionProbability collision_probability(const EncounterProblem& problem,
                                           const CollisionSettings& settings) {
  if (settings.samples < 1000) {
    throw Error(ErrorKind::usage, "collision: there must be at least 1000 samples");
  }
  if (!(settings.confidence >= 0.5 && settings.confidence < 1)) {
    throw Error(ErrorKind::usage, "collision: the confidence must be from 0.5 to below 1");
  }
  validate(problem);
  const bool must_enter = settings.sampling == CollisionSampling::entries;
  std::string reason;  // reason why entries are not drawn
  const auto is_believed = [&](const CollisionProbability& result) {
    if (result.samples == 0) return true;
    // If the weights of probable collisions vary much, entries may tell less than plain samples
    // do.
    const bool is_worse = result.equivalent_samples < static_cast<double>(result.samples);
    const bool is_told_by_few = !(result.standard_error < few_draws * result.probability);
    reason =
        "collision: a few of the drawn entries have all of the weight, so that they may have "
        "missed where collisions come from; plain sampling does not";
    return !is_told_by_few && (must_enter || !is_worse);
  };
  const auto of_parts = [&](const SampledParts& parts) {
    return result_of(problem, settings, parts,
                     shares_of_samples(parts, static_cast<std::size_t>(settings.samples)));
  };
  const bool is_plain = settings.sampling == CollisionSampling::plain;
  if (!is_plain || problem.tolerance) {
    const SampledParts parts = narrow_parts(problem, settings);
    if (!parts.empty()) {
      const CollisionProbability result = of_parts(parts);
      if (is_plain || is_believed(result)) return result;
      // The polynomials of the whole are wrong.
      if (problem.tolerance && !must_enter) {
        for (const auto& part : parts) {
          if (part->sampler()) part->sample_plainly();
        }
        return of_parts(parts);
      }
    }
  }
  SampledParts whole;
  whole.push_back(
      std::make_unique<SampledEncounter>(EncounterPart{1, problem}, settings, SamplingEffort{}, 0));
  if (settings.sampling != CollisionSampling::plain && reason.empty()) {
    try {
      if (whole[0]->sample_entries()) {
        const CollisionProbability result = of_whole(problem, settings, whole);
        if (is_believed(result)) return result;
      } else {
        reason = fmt::format(
            "collision: the linear motion misses by more than {} radii, so that "
            "its entries say too little; plain sampling needs none",
            widest_sphere);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numerical) throw;
      reason = error.what();
    }
  }
  if (must_enter) throw Error(ErrorKind::usage, reason);
  whole[0]->sample_plainly();
  return of_whole(problem, settings, whole);
}

}  // namespace hamjet
