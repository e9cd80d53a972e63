#pragma once

#include <vector>

#include "hamjet/detail/algebra/monomial_values.hpp"
#include "thrusted_flight.hpp"

namespace hamjet {

/// The costates of least energy to the end of a flight at equal parts of it, its instants, as
/// polynomials of the state there. One jet of states and costates about the coasting orbit is
/// propagated from the arrival back through the instants; its generating function F1 gives them.
/// Scene, problem and flight must outlive it. Throws Error(numerical) where there is no such jet or
/// function.
class FeedbackCostates {
 public:
  FeedbackCostates(const Scene& scene, const ComputedProblem& problem,
                   const ThrustedFlight& flight);

  std::size_t count() const { return costates_.size(); }
  /// The instant; the arrival for k = count().
  double time(std::size_t k) const;
  /// Chief and orbit at an instant, six numbers each, and the chief's axes.
  const std::vector<double>& chief(std::size_t k) const { return chiefs_[k]; }
  const std::vector<double>& orbit(std::size_t k) const { return orbits_[k]; }
  ChiefFrame frame(std::size_t k) const;
  /// The six costates in twelve variables, the deviations of the state and of the end.
  const std::vector<Series<double>>& polynomials(std::size_t k) const { return costates_[k]; }
  /// The state (q, p) with its costates at an instant.
  std::vector<double> with_costates(std::size_t k, const std::vector<double>& state);

 private:
  const ThrustedFlight& flight_;
  MetricUnits units_;
  RelativeFrame frame_;
  std::vector<std::vector<Series<double>>> costates_;
  std::vector<std::vector<double>> chiefs_;
  std::vector<std::vector<double>> orbits_;
  MonomialValues values_;
};

}  // namespace hamjet
