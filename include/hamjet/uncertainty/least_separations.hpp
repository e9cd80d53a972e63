#pragma once

#include <vector>

#include "hamjet/uncertainty/collision_probability.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// How near two spacecraft come in the window, by plain samples of the polynomials.
struct LeastSeparations {
  std::vector<double> shares;       ///< of all samples, as asked for
  std::vector<double> separations;  ///< below which the share has its least separation
  /// By how much each may be wrong beside its sampling: the largest error of the cubics between the
  /// nodes of the paths, and the largest difference from flights that can move it.
  std::vector<double> errors;
  /// The interval of each, of the settings' confidence, whatever the distribution: so many samples
  /// lie below the true quantile of a share p as successes come in n trials of probability p, so
  /// that two order statistics enclose it, here moved apart by the error. Source: H. A.
  /// David and H. N. Nagaraja, Order Statistics (2003), section 7.1. Below 0 there is no
  /// separation; above the largest sample nothing is known: infinity.
  std::vector<double> lower;
  std::vector<double> upper;
  long samples = 0;
  long nearer = 0;  ///< samples that come nearer than the problem's radius
  /// Interval of the probability of that, after Clopper and Pearson, of a radius that is smaller
  /// and larger by the same error.
  double lower_nearer = 0;
  double upper_nearer = 0;
  /// The largest error of the cubics between the nodes of the paths.
  double interpolation_error = 0;
  /// Samples that were flown with the full equations, the first ones and those nearest to the first
  /// of the shares: by how much their least separations differ, at most.
  long flights = 0;
  double flight_difference = 0;

  /// Tells all lengths in a unit of which this is the present one.
  void scale(double unit);
};

/// Of so many samples as the settings have, which say seed, confidence and threads too; `flights`
/// of the first ones and as many of the nearest to the first share are flown. Throws as
/// collision_probability, and Error(usage) unless the shares lie between 0 and 1.
LeastSeparations least_separations(const EncounterProblem& problem,
                                   const CollisionSettings& settings,
                                   const std::vector<double>& shares, long flights = 0);

}  // namespace hamjet
