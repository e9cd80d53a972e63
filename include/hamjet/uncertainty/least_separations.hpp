#pragma once

#include <vector>

#include "hamjet/uncertainty/collision_probability.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// The distribution of the least distance of two spacecraft in the window, from plain samples of
/// the polynomials.
struct LeastSeparations {
  std::vector<double> shares;  ///< the fractions of the samples for which quantiles were asked
  /// The quantiles: this fraction of the samples comes nearer than this.
  std::vector<double> separations;
  /// The error of each quantile apart from sampling: the largest error of the cubics between the
  /// nodes of the paths, plus the largest difference from flights that can move the quantile.
  std::vector<double> errors;
  /// The interval of each quantile, of the settings' confidence, for any distribution. The number
  /// of samples below the true quantile of a fraction p is that of successes in n trials of
  /// probability p, so that two order statistics enclose the quantile; here they are moved apart by
  /// the error. Source: H. A. David and H. N. Nagaraja, Order Statistics (2003), section 7.1. The
  /// lower end is not below 0; where the upper end would lie above the largest sample, it is
  /// infinite.
  std::vector<double> lower;
  std::vector<double> upper;
  long samples = 0;
  long nearer = 0;  ///< number of samples that come nearer than the problem's radius
  /// Interval of that probability, after Clopper and Pearson. Its ends are computed with the radius
  /// reduced and enlarged by the same error.
  double lower_nearer = 0;
  double upper_nearer = 0;
  /// The largest error of the cubics between the nodes of the paths.
  double interpolation_error = 0;
  /// Number of samples that were flown with the full equations (the first ones, and those nearest
  /// to the first quantile), and the largest difference of their least separations from those of
  /// the polynomials.
  long flights = 0;
  double flight_difference = 0;

  /// Converts all lengths; `unit` is the present unit of length in the new one.
  void scale(double unit);
};

/// The least separations of as many samples as the settings say, with their seed, confidence and
/// threads. `flights` of the first samples and as many of those nearest to the first quantile are
/// flown. Throws as collision_probability, and Error(usage) unless the shares lie between 0 and 1.
LeastSeparations least_separations(const EncounterProblem& problem,
                                   const CollisionSettings& settings,
                                   const std::vector<double>& shares, long flights = 0);

}  // namespace hamjet
