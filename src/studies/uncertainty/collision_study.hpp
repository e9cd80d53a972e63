#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamjet/detail/studies/progress.hpp"
#include "hamjet/studies/scene.hpp"
#include "hamjet/uncertainty/closest_approach.hpp"
#include "hamjet/uncertainty/collision_probability.hpp"
#include "hamjet/uncertainty/least_separations.hpp"

namespace hamjet {

/// One of both spacecraft at a closest approach.
struct ApproachingSpacecraft {
  std::vector<double> state;  ///< state of the mean, in canonical units
  /// Covariance of the state at that time, to first order in the deviations, along the spacecraft's
  /// own R, T, N with inertial velocities; in metres and metres per second.
  Covariance covariance;
};

/// A minimum of the distance between the means of chief and deputy.
struct UncertainApproach {
  double time = 0;  ///< in canonical units
  double time_s = 0;
  /// Whether the time is in the window that was examined; otherwise it is in the whole of a passage
  /// that an edge of this window cuts.
  bool is_in_window = true;
  double distance_m = 0;  ///< distance of the means
  double speed_m_s = 0;
  double time_deviation_s = 0;  ///< standard deviation of its time, linear
  double distance_deviation_m =
      0;  ///< standard deviation of the distance; if the means meet, of the position
  /// Random deviations were flown to the times that the polynomials give. The two members below are
  /// the largest differences of the relative positions from the predicted ones, and of the times
  /// from the minima. The number of flights is 0 if the polynomials give times far outside the
  /// window.
  int flights = 0;
  double position_error_m = 0;
  double time_error_s = 0;
  /// Whether the polynomials are right to a tenth of the distance or the radius.
  bool holds(double radius_m) const {
    return flights > 0 && position_error_m < 0.1 * (distance_m > radius_m ? distance_m : radius_m);
  }
  /// The encounter plane of the whole passage; lengths in metres, times in seconds.
  std::optional<ShortEncounter> plane;
  std::string refusal;  ///< reason why there is no plane
  bool is_cut = false;  ///< an edge of the window that was examined cuts the passage
  std::array<ApproachingSpacecraft, 2> spacecraft;  ///< the chief and the deputy
};

/// The probability that chief and deputy come near each other, from the uncertainty of their states
/// at the start.
struct CollisionResult {
  CollisionWatch watch;
  /// The coordinates in which the starts of chief and deputy are Gaussian.
  std::array<std::string, 2> gaussian_in;
  double from_s = 0;  ///< the window that was examined
  double to_s = 0;
  /// The window is wider than the scene's start to end, in a scene without a window, because it
  /// contains the whole of a passage that these cut.
  bool is_widened = false;
  CollisionProbability probability;  ///< times in seconds, lengths in metres
  /// If an edge of the scene's window cuts a passage: the probability for the window that contains
  /// the whole passage.
  std::optional<CollisionProbability> of_whole_passage;
  double whole_from_s = 0;
  double whole_to_s = 0;
  /// A burn at the start lies inside a passage, before which the trajectory is a different one: the
  /// probabilities are of what follows, and none is that of the encounter.
  bool is_cut_by_burn = false;
  /// Reasons why a number is not reliable, or does not cover the whole passage.
  std::vector<std::string> warnings;
  std::vector<UncertainApproach> approaches;
  LeastSeparations separations;  ///< in metres
  int order = 0;
  double seconds = 0;
};

/// The probability for whole passages, which describes the encounter as such.
const CollisionProbability& probability_of_passage(const CollisionResult& result);

/// The approach at which the means are nearest; null if they have none in the window.
const UncertainApproach* nearest_approach(const CollisionResult& result);

/// Whether the probability for whole passages is known to be that of the nearest approach: not in a
/// window of the scene's own that ends within it, if it is too slow for its whole to be found.
bool has_whole_passage(const CollisionResult& result);

/// The study of table `[uncertainty.collision]`. Throws as collision_probability and
/// closest_approaches, and Error(scene) where both states are known exactly.
CollisionResult study_collision(const Scene& scene, std::size_t threads,
                                const ProgressCallback& progress = {});

}  // namespace hamjet
