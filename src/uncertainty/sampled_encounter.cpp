#include "sampled_encounter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision_judgement.hpp"
#include "flown_separations.hpp"

namespace hamjet {
namespace {

/// The cubics between nodes are accurate to this fraction of the radius.
constexpr double path_accuracy = 1e-5;
/// The lower order is also evaluated in one of this many blocks.
constexpr std::size_t lower_order_every = 8;
/// The sampled sphere is wider than the collision radius by at least this fraction of the radius,
/// and by at least this multiple of the largest difference seen.
constexpr double narrowest_margin = 1e-5;
constexpr double margin_factor = 1.5;
/// Draws whose weight is below this fraction of the mean weight hold no more than this fraction of
/// the probability.
constexpr double negligible_weight = 1e-4;
/// Plain draws reach some four standard deviations, and paths that are left out begin at nine;
/// quadratic terms grow by the square of the ratio.
constexpr double growth_to_farthest = 6;

RelativePaths paths_of(const EncounterPart& part) {
  const double radius = part.problem.radius;
  if (part.trajectories) {
    return {part.problem, path_accuracy * radius, farthest_told * radius, *part.trajectories,
            *part.low};
  }
  return {part.problem, path_accuracy * radius, farthest_told * radius};
}

}  // namespace

void SampleSums::add(const SampleSums& other) {
  samples += other.samples;
  hits.add(other.hits);
  sure.add(other.sure);
  possible.add(other.possible);
  compared += other.compared;
  change += other.change;
  change_squared += other.change_squared;
  for (std::size_t k = 0; k < time_count; ++k) by_time[k] += other.by_time[k];
}

SampledEncounter::SampledEncounter(EncounterPart part, const CollisionSettings& settings,
                                   const SamplingEffort& effort, std::uint64_t number)
    : part_(std::move(part)),
      settings_(&settings),
      effort_(effort),
      number_(number),
      paths_(paths_of(part_)) {
  // The paths have what they need of the jets.
  part_.trajectories.reset();
  part_.low.reset();
}

void SampledEncounter::draw(RandomStream& random, Block& samples) const {
  SampledPath path(paths_.times().size());
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    EncounterDeviation deviation;
    samples.weights[j] = 1;
    if (sampler_) {
      deviation = sampler_->draw(random);
      take_linear_path(paths_, deviation, path);
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

void SampledEncounter::judge(const Block& samples, std::size_t count, bool with_lower_order,
                             SampleSums& sums) const {
  std::vector<double> states(6 * paths_.times().size() * samples_in_block);
  std::vector<double> lower;
  paths_.evaluate(samples.points, part_.problem.order, states);
  if (with_lower_order) {
    lower.resize(states.size());
    paths_.evaluate(samples.points, part_.problem.order - 1, lower);
  }
  SampledPath path(paths_.times().size());
  const double scale = static_cast<double>(time_count) / (part_.problem.to - part_.problem.from);
  for (std::size_t j = 0; j < count; ++j) {
    take_path(states, samples_in_block, j, path);
    const double weight = samples.weights[j];
    ++sums.samples;
    const Judgement judged =
        judge_path(paths_, path, part_.problem.radius, error_, settings_->event);
    const std::optional<double>& entry = judged.first;
    if (judged.is_sure && weight > 0) sums.sure.add(weight);
    if (judged.is_possible && weight > 0) sums.possible.add(weight);
    if (entry && weight > 0) {
      sums.hits.add(weight);
      const auto place =
          static_cast<std::size_t>(std::max(0.0, (*entry - part_.problem.from) * scale));
      sums.by_time[std::min(place, time_count - 1)] += weight;
    }
    if (with_lower_order) {
      take_path(lower, samples_in_block, j, path);
      const bool hit = has_event(paths_, path, part_.problem.radius, settings_->event);
      const double change = (hit ? weight : 0) - (entry ? weight : 0);
      ++sums.compared;
      sums.change += change;
      sums.change_squared += change * change;
    }
  }
}

void SampledEncounter::draw_pilot(RandomStream& random, Block& samples,
                                  std::vector<double>& least) const {
  SampledPath path(paths_.times().size());
  std::vector<double> states(6 * path.size() * samples_in_block);
  draw(random, samples);
  paths_.evaluate(samples.points, part_.problem.order, states);
  least.clear();
  for (std::size_t j = 0; j < samples_in_block; ++j) {
    take_path(states, samples_in_block, j, path);
    least.push_back(least_distance(paths_, path));
  }
}

double SampledEncounter::largest_difference() const {
  RandomStream random(settings_->seed, ~(2 * number_));
  Block samples;
  SampledPath path(paths_.times().size());
  std::vector<double> least;
  std::vector<std::pair<double, double>> differences;  // largest differences, and weights
  double sum = 0;
  for (std::size_t k = 0; k < effort_.pilot_blocks; ++k) {
    draw_pilot(random, samples, least);
    for (std::size_t j = 0; j < samples_in_block; ++j) {
      take_linear_path(paths_, deviation_of(samples.points, j), path);
      differences.emplace_back(std::abs(least[j] - least_distance(paths_, path)),
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

double SampledEncounter::flight_difference() const {
  struct Candidate {
    double least;
    double weight;
    EncounterDeviation deviation;
  };
  RandomStream random(settings_->seed, ~(2 * number_ + 1));
  Block samples;
  std::vector<double> least;
  std::vector<Candidate> candidates;
  double sum = 0;
  for (std::size_t k = 0; k < effort_.pilot_blocks; ++k) {
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
  const double radius = part_.problem.radius;
  const std::vector<std::size_t> nearest = nearest_to(radius, separations, effort_.flown_draws);
  std::vector<EncounterDeviation> deviations;
  for (const std::size_t place : nearest) deviations.push_back(candidates[place].deviation);
  const std::vector<double> flown = flown_separations(part_.problem, deviations);
  double largest = 0;
  for (std::size_t k = 0; k < flown.size(); ++k) {
    largest = std::max(largest, difference_near(radius, separations[nearest[k]], flown[k]));
  }
  return largest;
}

bool SampledEncounter::sample_entries() {
  // Collisions whose linear path stays outside the sphere are lost. The sphere is therefore widened
  // until the differences of its own paths are smaller than the margin. Where no linear path enters
  // the sphere, plain samples show how far true paths are from linear ones.
  const bool is_of_entries = settings_->event == CollisionEvent::entry;
  const double difference_of_plain =
      paths_.arcs().empty() ? 0 : growth_to_farthest * largest_difference();
  double margin = narrowest_margin * part_.problem.radius;
  if (effort_.begins_wide) {
    margin = std::max(margin, margin_factor * difference_of_plain / growth_to_farthest);
  }
  while (margin <= (widest_sphere - 1) * part_.problem.radius) {
    sampler_.emplace(paths_, part_.problem.radius + margin, is_of_entries, effort_.boxes);
    if (sampler_->is_empty()) {
      if (difference_of_plain <= margin) return true;
      margin = std::max(2 * margin, difference_of_plain);
      continue;
    }
    difference_ = largest_difference();
    double needed = margin_factor * difference_;
    if (needed <= margin) {
      error_ = paths_.interpolation_error() + flight_difference();
      needed += error_;
      if (needed <= margin) return true;
    }
    margin = std::max(2 * margin, needed);
  }
  sampler_.reset();
  return false;
}

void SampledEncounter::sample_plainly() {
  sampler_.reset();
  difference_ = 0;
  error_ = paths_.arcs().empty() ? 0 : paths_.interpolation_error() + flight_difference();
}

SampleSums SampledEncounter::sample(std::uint64_t stream, std::size_t count) const {
  RandomStream random(settings_->seed, stream);
  SampleSums sums;
  Block samples;
  for (std::size_t k = 0; k * samples_in_block < count; ++k) {
    draw(random, samples);
    judge(samples, in_block(count, k * samples_in_block),
          part_.problem.order > 1 && k % lower_order_every == 0, sums);
  }
  return sums;
}

}  // namespace hamjet
