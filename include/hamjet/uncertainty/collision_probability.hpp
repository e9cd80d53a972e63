#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hamjet/uncertainty/collision_choices.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

struct CollisionSettings {
  CollisionEvent event = CollisionEvent::nearer;
  CollisionSampling sampling = CollisionSampling::automatic;
  long samples = 1'000'000;
  std::uint64_t seed = 1;
  double confidence = 0.95;  ///< of the interval
  std::size_t threads = 1;   ///< on which the result does not depend
  /// Called now and then from the calling thread with the fraction that is done; may throw to stop.
  std::function<void(double fraction)> progress = {};
};

/// The probability that two spacecraft come nearer than a radius in a window, as samples of the
/// polynomials have it, and how far it can be trusted.
struct CollisionProbability {
  CollisionSampling sampling = CollisionSampling::plain;  ///< that was done
  double probability = 0;
  /// Interval of the settings' confidence: of the sampling, for a radius that is smaller by the
  /// error of the paths below, and larger by it above.
  double lower = 0;
  double upper = 0;
  /// By how much distances along a path may be wrong: by the cubics between its nodes, and by how
  /// far the least distances of 64 flights are from those of their polynomials, which are of the
  /// draws that come nearest to the radius.
  double path_error = 0;
  double standard_error = 0;
  long samples = 0;
  long hits = 0;  ///< samples that come nearer
  /// So many plain samples would have the same standard error.
  double equivalent_samples = 0;
  /// Of the polynomials of one order less, less the probability, on an eighth of the samples; and
  /// its standard error. What the order leaves out is of this size or below.
  double change_from_lower_order = 0;
  double standard_error_of_change = 0;
  /// The radius of the sphere whose entries are drawn, and the largest difference seen between the
  /// least distances of a linear path and of the polynomials': collisions for which it exceeds the
  /// difference of the radii are lost.
  std::optional<double> sampled_radius;
  std::optional<double> largest_difference;
  /// The probability that they have come nearer by a time: at equal times of the window.
  std::vector<double> times;
  std::vector<double> by_time;
};

/// By random samples of the polynomials, in the window, each path judged between the times too.
/// Plain samples have the interval of Clopper and Pearson, weighted ones that of the normal
/// distribution. Throws as validate, integrate_gauss, Error(numerical) where a flight ends in the
/// centre, and Error(usage) for less than 1000 samples or a confidence below 0.5 or not below 1,
/// and where entries are asked for that cannot be drawn: where EntrySampler has none, or linear
/// paths say too little of true ones.
CollisionProbability collision_probability(const EncounterProblem& problem,
                                           const CollisionSettings& settings);

}  // namespace hamjet
