#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "encounter_parts.hpp"
#include "entry_sampler.hpp"
#include "hamjet/uncertainty/collision_probability.hpp"
#include "relative_paths.hpp"
#include "sampled_paths.hpp"
#include "weighted_hits.hpp"

namespace hamjet {

/// Spheres wider than this, in radii, contain too few collisions for their cost.
inline constexpr double widest_sphere = 20;
/// The number of equal parts of the window in which collisions are counted.
inline constexpr std::size_t time_count = 200;
/// The number of samples in a task: its random numbers have a stream of their own.
inline constexpr std::size_t samples_in_task = 64 * samples_in_block;

/// Sums over samples.
struct SampleSums {
  long samples = 0;
  Hits hits;
  Hits sure;          ///< hits with a radius that is smaller by the error of the paths
  Hits possible;      ///< hits with a radius that is larger by the error of the paths
  long compared = 0;  ///< number of samples evaluated with the lower order too
  double change = 0;
  double change_squared = 0;
  std::vector<double> by_time = std::vector<double>(time_count, 0.0);

  void add(const SampleSums& other);
};

/// How much is spent on what comes before the samples of an encounter.
struct SamplingEffort {
  std::size_t pilot_blocks = 32;
  std::size_t boxes = EntrySampler::most_boxes;
  std::size_t flown_draws = 64;  ///< those that come nearest to the radius
  /// Begin with a sphere as wide as plain samples let expect, not with the narrowest.
  bool begins_wide = false;
};

/// An encounter whose deviations are sampled. Threads may share an object that is not changed.
class SampledEncounter {
 public:
  /// `settings` must outlive the object. Throws as RelativePaths. `number` tells its random numbers
  /// from those of other parts of one distribution.
  SampledEncounter(EncounterPart part, const CollisionSettings& settings,
                   const SamplingEffort& effort, std::uint64_t number);
  SampledEncounter(const SampledEncounter&) = delete;
  SampledEncounter& operator=(const SampledEncounter&) = delete;

  /// Switches to drawing entries of a sphere. Returns false where too little is known of the
  /// sphere. Throws as EntrySampler.
  bool sample_entries();
  /// Switches to plain samples.
  void sample_plainly();

  /// Whether no path comes near.
  bool is_empty() const { return paths_.arcs().empty() || (sampler_ && sampler_->is_empty()); }
  double weight() const { return part_.weight; }
  const EncounterProblem& problem() const { return part_.problem; }
  const std::optional<EntrySampler>& sampler() const { return sampler_; }
  /// The largest difference seen between the least distances of a linear path and of the
  /// polynomials.
  double difference() const { return difference_; }
  double path_error() const { return error_; }

  /// The sums of `count` samples, drawn with one stream of random numbers.
  SampleSums sample(std::uint64_t stream, std::size_t count) const;

 private:
  /// A block of samples: their deviations, as a structure of arrays, and their weights.
  struct Block {
    std::vector<double> points = std::vector<double>(encounter_variables * samples_in_block);
    std::vector<double> weights = std::vector<double>(samples_in_block);
  };

  void draw(RandomStream& random, Block& samples) const;
  /// Adds the first `count` samples of a block to the sums.
  void judge(const Block& samples, std::size_t count, bool with_lower_order,
             SampleSums& sums) const;
  /// The largest difference between the least distances of the pilot's paths and those of their
  /// linear paths.
  double largest_difference() const;
  /// The largest difference between least distances and those of flights, as far as it can matter
  /// to the radius.
  double flight_difference() const;
  /// Draws a block of random numbers that is not part of the samples, and computes the least
  /// distances of its paths.
  void draw_pilot(RandomStream& random, Block& samples, std::vector<double>& least) const;

  EncounterPart part_;
  const CollisionSettings* settings_;
  SamplingEffort effort_;
  std::uint64_t number_;
  RelativePaths paths_;
  std::optional<EntrySampler> sampler_;
  double difference_ = 0;
  double error_ = 0;  ///< error of the distances of a path
};

}  // namespace hamjet
