#pragma once

#include <array>
#include <optional>
#include <vector>

#include "encounter_trajectories.hpp"
#include "hamjet/uncertainty/encounter.hpp"

namespace hamjet {

/// A part of the distribution of an encounter: a narrower one, with its share of the probability.
struct EncounterPart {
  double weight = 1;
  EncounterProblem problem;
  /// The jets of its spacecraft, which parts share; absent if they are still to be integrated.
  std::optional<EncounterTrajectories> trajectories = {};
  std::optional<EncounterTrajectories> low = {};  ///< of order_of_looks
};

/// The distribution of an encounter as a sum of narrower ones, as far as its spacecraft come near.
///
/// Where a spacecraft is Gaussian in elements and its orbit bends away from the line of a Gaussian
/// in positions by more than the length `bend` within three standard deviations along the track,
/// linear paths say little of the true ones. The standard normal number s along the track is then
/// taken as the sum of two independent ones, of variances 1 - k^2 and k^2, and the integral over
/// the first as a sum by the trapezoidal rule,
///
///   N(s; 0, 1) = h sum over j of N(j h; 0, 1 - k^2) N(s; j h, k^2) (1 + e) ,
///   |e| < 2 exp(-2 pi^2 k^2 (1 - k^2) / h^2) ,
///
/// with e below 3e-6 everywhere, also far out, by Poisson's summation formula. Pairs of parts are
/// left out if a linear estimate of their contribution is a factor of 1.6e5 below the largest one.
///
/// In a problem with a tolerance the number s may be another one, along which the flow stretches
/// deviations most: that of any spacecraft of which the polynomials are not right to the tolerance,
/// by the estimate of split_domains, within three standard deviations. No more than `most_parts`
/// are made for this reason.
///
/// Without such a spacecraft there is one part, the problem itself, without jets. Throws as
/// integrate_gauss.
std::vector<EncounterPart> encounter_parts(const EncounterProblem& problem, double bend,
                                           std::size_t threads);

}  // namespace hamjet
