#pragma once

#include <string>
#include <vector>

#include "../../studies/uncertainty/uncertainty.hpp"

namespace hamjet::io {

/// The six components of states in the frame of the results: name, unit, and how its column begins.
struct StateComponent {
  std::string name;  ///< R, ..., vN
  std::string unit;  ///< m or m/s
};
std::vector<StateComponent> state_components(const UncertaintyResult& result);

/// One family of distributions of a state: in which coordinates the polynomials are, and in which
/// the distribution is told.
struct MomentsFamily {
  std::string polynomials;  ///< "cartesian", "flow-box", ...
  std::string told_in;      ///< "RTN", "inertial", or the coordinates' name
  const std::vector<Cumulants>* by_order;
  const Cumulants* linear;  ///< the linear theory's Gaussian distribution, told alike
  std::vector<StateComponent> components;
  bool is_compared =
      false;  ///< whether `uncertainty.coordinates` asks for them, beside the scene's own
};
/// All that were computed, Cartesian ones first; at the last time those that are compared, too.
std::vector<MomentsFamily> moments_families(const UncertaintyResult& result,
                                            const UncertaintyAt& at, const UncertainState& state);

/// The linear theory's distribution and the best known one, or all orders' of the polynomials about
/// the mean where there are no domains.
std::vector<Cumulants> judged_orders(const UncertainState& state);

/// How far from Gaussian a state at the last time is, each in its own coordinates, by name and the
/// nearest first; with whatever the orbit has not, and why.
struct GaussianityInCoordinates {
  std::string coordinates;
  double negentropy = 0;       ///< negentropy of the highest order
  bool is_sure = true;         ///< see is_negentropy_sure
  double error_of_linear = 0;  ///< largest error of a probability by the linear theory
  std::string refusal;         ///< if not empty, the reason why the orbit lacks them
};
std::vector<GaussianityInCoordinates> gaussianity_in_coordinates(const UncertaintyResult& result,
                                                                 const UncertainState& state);

/// Whether the negentropy of the order n + 1 is more than its leading terms, and the order beside
/// it says nearly the same: polynomials that have not converged keep no volumes.
bool is_negentropy_sure(const std::vector<Cumulants>& by_order, std::size_t n);

/// A negentropy in a table, after a tilde where it is not sure and so large that it says little.
std::string negentropy_text(double negentropy, bool is_sure);

/// The time of a point, for people.
std::string time_text(const UncertaintyResult& result, const UncertaintyAt& at);

/// The state that a verdict is about: the last one of a time.
const UncertainState& judged_state(const UncertaintyAt& at);

/// By how much a probability by the linear covariance may be wrong, of any event, whatever
/// combination of components it is about.
double linear_error_of_probability(const std::vector<Cumulants>& by_order);
/// The same error for events about one component alone: the largest of the six.
double linear_error_of_component(const std::vector<Cumulants>& by_order);

/// The first that a reader sees: how well the position is known in the end.
std::string uncertainty_answer(const UncertaintyResult& result);
/// Whether the linear covariance misleads, and in which coordinates the distribution stays
/// Gaussian.
std::string uncertainty_judgement(const UncertaintyResult& result);
/// Answer and judgement, one after the other.
std::string uncertainty_verdict(const UncertaintyResult& result);

/// What a user must know beside the numbers, a sentence each: a covariance that was mended, noise
/// that is linear, coordinates in which nodes have no place.
std::vector<std::string> uncertainty_notes(const UncertaintyResult& result);

}  // namespace hamjet::io
