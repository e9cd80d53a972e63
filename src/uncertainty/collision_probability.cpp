#include "hamjet/uncertainty/collision_probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "../integrators/concurrent_tasks.hpp"
#include "binomial_interval.hpp"
#include "collision_judgement.hpp"
#include "entry_sampler.hpp"
#include "flown_separations.hpp"
#include "hamjet/error.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"
#include "weighted_hits.hpp"

namespace hamjet {
namespace {

/// The cubics between nodes are accurate to this fraction of the radius.
constexpr double path_accuracy = 1e-5;
/// The number of blocks of samples in a task.
constexpr std::size_t blocks_in_task = 64;
/// The lower order is also evaluated in one of this many blocks.
constexpr std::size_t lower_order_every = 8;
/// The sampled sphere is wider than the collision radius by at least this fraction of the radius,
/// and by at least this multiple of the largest difference seen.
constexpr double narrowest_margin = 1e-5;
constexpr double margin_factor = 1.5;
/// Draws whose weight is below this fraction of the mean weight hold no more than this fraction of
/// the probability.
constexpr double negligible_weight = 1e-4;
/// Spheres wider than this, in radii, contain too few collisions for their cost.
constexpr double widest_sphere = 20;
/// The relative standard error that fewer than a hundred draws with all of the weight would have:
/// such draws say nothing of the collisions that they have missed.
constexpr double few_draws = 0.1;
constexpr std::size_t pilot_blocks = 32;
/// The number of draws that are flown: those that come nearest to the radius.
constexpr std::size_t flown_draws = 64;
/// Plain draws reach some four standard deviations, and paths that are left out begin at nine;
/// quadratic terms grow by the square of the ratio.
constexpr double growth_to_farthest = 6;
constexpr std::size_t time_count = 200;

/// Sums over samples.
struct Sums {
  long samples = 0;
  Hits hits;
  Hits sure;          ///< hits with a radius that is smaller by the error of the paths
  Hits possible;      ///< hits with a radius that is larger by the error of the paths
  long compared = 0;  ///< number of samples evaluated with the lower order too
  double change = 0;
  double change_squared = 0;
  std::vector<double> by_time = std::vector<double>(time_count, 0.0);

  void add(const Sums& other) {
    samples += other.samples;
    hits.add(other.hits);
    sure.add(other.sure);
    possible.add(other.possible);
    compared += other.compared;
    change += other.change;
    change_squared += other.change_squared;
    for (std::size_t k = 0; k < time_count; ++k) by_time[k] += other.by_time[k];
  }
};

/// A block of samples: their deviations, as a structure of arrays, and their weights.
struct Block {
  std::vector<double> points = std::vector<double>(encounter_variables * samples_in_block);
  std::vector<double> weights = std::vector<double>(samples_in_block);
};

class Estimate {
 public:
  Estimate(const EncounterProblem& problem, const CollisionSettings& settings,
           const RelativePaths& paths)
      : problem_(&problem), settings_(&settings), paths_(&paths) {}

  /// Switches to drawing entries of a sphere. Returns false where too little is known of the
  /// sphere.
  bool sample_entries();
  CollisionProbability result();

 private:
  void draw(RandomStream& random, Block& samples) const;
  /// Adds the first `count` samples of a block to the sums.
  void judge(const Block& samples, std::size_t count, bool with_lower_order, Sums& sums) const;
  /// The largest difference between the least distances of the pilot's paths and those of their
  /// linear paths.
  double largest_difference() const;
  /// The largest difference between least distances and those of flights, as far as it can matter
  /// to the radius.
  double flight_difference() const;
  /// Draws a block of random numbers that is not part of the samples, and computes the least
  /// distances of its paths.
  void draw_pilot(RandomStream& random, Block& samples, std::vector<double>& least) const;

  const EncounterProblem* problem_;
  const CollisionSettings* settings_;
  const RelativePaths* paths_;
  std::optional<EntrySampler> sampler_;
  double difference_ = 0;
  double error_ = 0;  ///< error of the distances of a path
};

void Estimate::draw(RandomStream& random, Block& samples) const {
  SampledPath path(paths_->times().size());
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    EncounterDeviation deviation;
    samples.weights[j] = 1;
    if (sampler_) {
      deviation = sampler_->draw(random);
      take_linear_path(*paths_, deviation, path);
      // A path that touches the sphere to within rounding may be computed as passing by. It then
      // counts for nothing; such paths have probability zero.
      const auto ratio = sampler_->log_density_ratio(path);
      samples.weights[j] = ratio ? std::exp(-*ratio) : 0;
    } else {
      for (Eigen::Index i = 0; i < deviation.size(); ++i) deviation[i] = random.normal();
    }
    for (std::size_t i = 0; i < encounter_variables; ++i) {
      samples.points[i * samples_in_block + j] = deviation[static_cast<Eigen::Index>(i)];
    }
  }
}

void Estimate::judge(const Block& samples, std::size_t count, bool with_lower_order,
                     Sums& sums) const {
  std::vector<double> states(6 * paths_->times().size() * samples_in_block);
  std::vector<double> lower;
  paths_->evaluate(samples.points, problem_->order, states);
  if (with_lower_order) {
    lower.resize(states.size());
    paths_->evaluate(samples.points, problem_->order - 1, lower);
  }
  SampledPath path(paths_->times().size());
  const double scale = static_cast<double>(time_count) / (problem_->to - problem_->from);
  for (std::size_t j = 0; j < count; ++j) {
    take_path(states, samples_in_block, j, path);
    const double weight = samples.weights[j];
    ++sums.samples;
    const Judgement judged = judge_path(*paths_, path, problem_->radius, error_, settings_->event);
    const std::optional<double>& entry = judged.first;
    if (judged.is_sure && weight > 0) sums.sure.add(weight);
    if (judged.is_possible && weight > 0) sums.possible.add(weight);
    if (entry && weight > 0) {
      sums.hits.add(weight);
      const auto place = static_cast<std::size_t>(std::max(0.0, (*entry - problem_->from) * scale));
      sums.by_time[std::min(place, time_count - 1)] += weight;
    }
    if (with_lower_order) {
      take_path(lower, samples_in_block, j, path);
      const bool hit = has_event(*paths_, path, problem_->radius, settings_->event);
      const double change = (hit ? weight : 0) - (entry ? weight : 0);
      ++sums.compared;
      sums.change += change;
      sums.change_squared += change * change;
    }
  }
}

void Estimate::draw_pilot(RandomStream& random, Block& samples, std::vector<double>& least) const {
  SampledPath path(paths_->times().size());
  std::vector<double> states(6 * path.size() * samples_in_block);
  draw(random, samples);
  paths_->evaluate(samples.points, problem_->order, states);
  least.clear();
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    take_path(states, samples_in_block, j, path);
    least.push_back(least_distance(*paths_, path));
  }
}

double Estimate::largest_difference() const {
  RandomStream random(settings_->seed, ~std::uint64_t{0});
  Block samples;
  SampledPath path(paths_->times().size());
  std::vector<double> least;
  std::vector<std::pair<double, double>> differences;  // largest differences, and weights
  double sum = 0;
  for (std::size_t k = 0; k < pilot_blocks; ++k) {
    draw_pilot(random, samples, least);
    for (std::size_t j = 0; j < samples_in_block; ++j) {
      take_linear_path(*paths_, deviation_of(samples.points, j), path);
      differences.emplace_back(std::abs(least[j] - least_distance(*paths_, path)),
                               samples.weights[j]);
      sum += samples.weights[j];
    }
  }
  // Draws of negligible weight, from corners of the boxes, say nothing of collisions.
  double largest = 0;
  for (const auto& [difference, weight] : differences) {
    if (weight > negligible_weight * sum / static_cast<double>(differences.size())) {
      largest = std::max(largest, difference);
    }
  }
  return largest;
}

double Estimate::flight_difference() const {
  struct Candidate {
    double least;
    double weight;
    EncounterDeviation deviation;
  };
  RandomStream random(settings_->seed, ~std::uint64_t{1});
  Block samples;
  std::vector<double> least;
  std::vector<Candidate> candidates;
  double sum = 0;
  for (std::size_t k = 0; k < pilot_blocks; ++k) {
    draw_pilot(random, samples, least);
    for (std::size_t j = 0; j < samples_in_block; ++j) {
      candidates.push_back({least[j], samples.weights[j], deviation_of(samples.points, j)});
      sum += samples.weights[j];
    }
  }
  const double least_weight = negligible_weight * sum / static_cast<double>(candidates.size());
  std::erase_if(candidates, [&](const Candidate& c) { return !(c.weight > least_weight); });
  std::vector<double> separations;
  for (const Candidate& one : candidates) separations.push_back(one.least);
  const double radius = problem_->radius;
  const std::vector<std::size_t> nearest = nearest_to(radius, separations, flown_draws);
  std::vector<EncounterDeviation> deviations;
  for (const std::size_t place : nearest) deviations.push_back(candidates[place].deviation);
  const std::vector<double> flown = flown_separations(*problem_, deviations);
  double largest = 0;
  for (std::size_t k = 0; k < flown.size(); ++k) {
    largest = std::max(largest, difference_near(radius, separations[nearest[k]], flown[k]));
  }
  return largest;
}

bool Estimate::sample_entries() {
  // Collisions whose linear path stays outside the sphere are lost. The sphere is therefore widened
  // until the differences of its own paths are smaller than the margin. Where no linear path enters
  // the sphere, plain samples show how far true paths are from linear ones.
  const bool is_of_entries = settings_->event == CollisionEvent::entry;
  const double difference_of_plain =
      paths_->arcs().empty() ? 0 : growth_to_farthest * largest_difference();
  double margin = narrowest_margin * problem_->radius;
  while (margin <= (widest_sphere - 1) * problem_->radius) {
    sampler_.emplace(*paths_, problem_->radius + margin, is_of_entries);
    if (sampler_->is_empty()) {
      if (difference_of_plain <= margin) return true;
      margin = std::max(2 * margin, difference_of_plain);
      continue;
    }
    difference_ = largest_difference();
    double needed = margin_factor * difference_;
    if (needed <= margin) {
      error_ = paths_->interpolation_error() + flight_difference();
      needed += error_;
      if (needed <= margin) return true;
    }
    margin = std::max(2 * margin, needed);
  }
  sampler_.reset();
  return false;
}

CollisionProbability Estimate::result() {
  CollisionProbability result;
  result.sampling = sampler_ ? CollisionSampling::entries : CollisionSampling::plain;
  const double span = problem_->to - problem_->from;
  for (std::size_t k = 0; k <= time_count; ++k) {
    result.times.push_back(problem_->from + span * static_cast<double>(k) / time_count);
  }
  result.by_time.assign(time_count + 1, 0.0);
  if (sampler_) {
    result.sampled_radius = sampler_->radius();
    result.largest_difference = difference_;
    if (sampler_->is_empty()) return result;
  }
  if (paths_->arcs().empty()) return result;
  if (!sampler_) error_ = paths_->interpolation_error() + flight_difference();
  result.path_error = error_;
  const std::size_t in_task = samples_in_block * blocks_in_task;
  const auto wanted = static_cast<std::size_t>(settings_->samples);
  const std::size_t tasks = (wanted + in_task - 1) / in_task;
  std::vector<Sums> sums(tasks);
  run_concurrently(
      tasks, settings_->threads,
      [&](std::size_t task, TaskControl& control) {
        RandomStream random(settings_->seed, task);
        Block samples;
        for (std::size_t k = 0; k < blocks_in_task; ++k) {
          const std::size_t count = in_block(wanted, task * in_task + k * samples_in_block);
          if (count == 0) break;
          draw(random, samples);
          judge(samples, count, problem_->order > 1 && k % lower_order_every == 0, sums[task]);
        }
        control.advance();
      },
      [&](long done) {
        if (settings_->progress) {
          settings_->progress(static_cast<double>(done) / static_cast<double>(tasks));
        }
      });
  Sums all;
  for (const Sums& part : sums) all.add(part);

  const auto count = static_cast<double>(all.samples);
  result.samples = all.samples;
  result.hits = all.hits.count;
  result.probability = all.hits.probability(count);
  const double variance = all.hits.variance(count);
  result.standard_error = std::sqrt(variance / count);
  if (sampler_) {
    const double tail = (1 - settings_->confidence) / 2;
    const double quantile = boost::math::quantile(
        boost::math::complement(boost::math::normal_distribution<double>(), tail));
    const auto width = [&](const Hits& hits) {
      return quantile * std::sqrt(hits.variance(count) / count);
    };
    result.lower = std::max(0.0, all.sure.probability(count) - width(all.sure));
    result.upper = std::min(1.0, all.possible.probability(count) + width(all.possible));
  } else {
    result.lower = binomial_interval(all.samples, all.sure.count, settings_->confidence).first;
    result.upper = binomial_interval(all.samples, all.possible.count, settings_->confidence).second;
  }
  if (variance > 0) {
    result.equivalent_samples = result.probability * (1 - result.probability) /
                                (result.standard_error * result.standard_error);
  }
  if (all.compared > 0) {
    const auto compared = static_cast<double>(all.compared);
    result.change_from_lower_order = all.change / compared;
    result.standard_error_of_change = std::sqrt(
        std::max(0.0, all.change_squared / compared - std::pow(all.change / compared, 2)) /
        compared);
  }
  double sum = 0;
  for (std::size_t k = 0; k < time_count; ++k) {
    sum += all.by_time[k] / count;
    result.by_time[k + 1] = std::min(1.0, sum);
  }
  return result;
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
  const RelativePaths paths(problem, path_accuracy * problem.radius,
                            farthest_told * problem.radius);
  Estimate estimate(problem, settings, paths);
  if (settings.sampling == CollisionSampling::plain) return estimate.result();
  const bool must_enter = settings.sampling == CollisionSampling::entries;
  std::string reason;  // reason why entries are not drawn
  try {
    if (estimate.sample_entries()) {
      const CollisionProbability result = estimate.result();
      if (result.samples == 0) return result;
      // If the weights of probable collisions vary much, entries may tell less than plain samples
      // do.
      const bool is_worse = result.equivalent_samples < static_cast<double>(result.samples);
      const bool is_told_by_few = !(result.standard_error < few_draws * result.probability);
      if (!is_told_by_few && (must_enter || !is_worse)) return result;
      reason =
          "collision: a few of the drawn entries have all of the weight, so that they may have "
          "missed where collisions come from; plain sampling does not";
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
  if (must_enter) throw Error(ErrorKind::usage, reason);
  return Estimate(problem, settings, paths).result();
}

}  // namespace hamjet
