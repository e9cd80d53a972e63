#pragma once

#include <vector>

#include "hamjet/uncertainty/collision_probability.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// How near two spacecraft come in the window, by plain samples of the polynomials.
struct LeastSeparations {
  std::vector<double> shares;       ///< of all samples, as asked for
  std::vector<double> separations;  ///< below which the share has its least separation
  /// The interval of each, of the settings' confidence, whatever the distribution: so many samples
  /// lie below the true quantile of a share p as successes come in n trials of probability p, so
  /// that two order statistics enclose it. Source: H. A. David and H. N. Nagaraja, Order Statistics
  /// (2003), section 7.1. Below 0 there is no separation; above the largest sample nothing is
  /// known: infinity.
  std::vector<double> lower;
  std::vector<double> upper;
  long samples = 0;
  long nearer = 0;          ///< samples that come nearer than the problem's radius
  double lower_nearer = 0;  ///< interval of the probability of that, after Clopper and Pearson
  double upper_nearer = 0;
  /// The first samples, flown with the full equations: by how much their least separations differ,
  /// at most.
  long flights = 0;
  double flight_difference = 0;

  /// Tells all lengths in a unit of which this is the present one.
  void scale(double unit);
};

/// Of so many samples as the settings have, which say seed, confidence and threads too; `flights`
/// of them are flown. Throws as collision_probability, and Error(usage) unless the shares lie
/// between 0 and 1.
LeastSeparations least_separations(const EncounterProblem& problem,
                                   const CollisionSettings& settings,
                                   const std::vector<double>& shares, long flights = 0);

}  // namespace hamjet
