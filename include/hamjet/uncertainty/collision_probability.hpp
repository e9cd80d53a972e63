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
  double confidence = 0.95;  ///< confidence of the interval
  std::size_t threads = 1;   ///< number of threads, on which the result does not depend
  /// Called now and then from the calling thread with the fraction of the work that is done; it may
  /// throw to stop.
  std::function<void(double fraction)> progress = {};
};

/// The probability that two spacecraft come nearer than a radius in a window, from samples of the
/// polynomials, with measures of its reliability.
struct CollisionProbability {
  CollisionSampling sampling = CollisionSampling::plain;  ///< the kind of sampling that was used
  double probability = 0;
  /// Interval of the settings' confidence for the sampling error. Its lower end is computed with
  /// the radius reduced by the error of the paths, its upper end with the radius enlarged by that
  /// error.
  double lower = 0;
  double upper = 0;
  /// Error of the distances along a path: that of the cubics between the nodes, plus the largest
  /// difference between flights and polynomials in the least distance, over the 64 draws that come
  /// nearest to the radius.
  double path_error = 0;
  double standard_error = 0;
  /// Number of pairs of parts of both distributions that were sampled; 1 for whole ones.
  std::size_t parts = 1;
  long samples = 0;
  long hits = 0;  ///< number of samples that come nearer than the radius
  /// The number of plain samples that would have the same standard error.
  double equivalent_samples = 0;
  /// The probability by polynomials of one order less, minus the probability itself, on an eighth
  /// of the samples, and the standard error of this difference. The truncation error is of this
  /// size or smaller.
  double change_from_lower_order = 0;
  double standard_error_of_change = 0;
  /// The radius of the sphere whose entries are drawn, and the largest difference seen between the
  /// least distances of a linear path and of the polynomials. Collisions for which that difference
  /// exceeds the difference of the radii are lost.
  std::optional<double> sampled_radius;
  std::optional<double> largest_difference;
  /// The probability that the spacecraft have come nearer than the radius by a time, at equally
  /// spaced times of the window.
  std::vector<double> times;
  std::vector<double> by_time;
};

/// Estimates the probability in the window by random samples of the polynomials; each path is also
/// judged between the nodes in time. The interval is that of Clopper and Pearson for plain samples,
/// and that of the normal distribution for weighted ones. Throws as validate, integrate_gauss,
/// Error(numerical) where a flight ends in the centre, and Error(usage) for less than 1000 samples
/// or a confidence outside [0.5, 1). Where the settings ask for entries, it also throws
/// Error(usage) if entries cannot be drawn: if EntrySampler finds none, or if linear paths differ
/// too much from the true ones.
CollisionProbability collision_probability(const EncounterProblem& problem,
                                           const CollisionSettings& settings);

}  // namespace hamjet
