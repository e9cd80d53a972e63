#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "phase_space_scale.hpp"

namespace hamjet {

/// A flow along a few straight lines of initial deviations, z0 + s d: for each line the final
/// components as series in s alone. A Runge-Kutta or splitting method commutes with the restriction
/// to a line, so that N + 1 coefficients show what the same steps make of the full jet of order N
/// along it, truncation error by degree included, at a small part of the cost.
///
/// The entries of a direction have sizes between 1/2 and 1 in the scaled variables of
/// momentum_scale, so that every monomial takes part, and random signs, the same in every run. The
/// signs of the first are those of the gradient of H: neighbours of another energy drift away along
/// the flow, so that on this line the series is about as large as the jet's largest coefficients.
/// The signs of the second are those of the vector field: neighbours ahead or behind meet the waves
/// of the field at another phase, of which the jet's high degrees are made.
template <class Real>
class DirectionalFlow {
 public:
  /// For each line the flow's jet, of order N in one variable.
  using Lines = std::vector<FlowJet<Real>>;
  /// Integrates a problem in one variable a line.
  using Integrate = std::function<FlowJet<Real>(const FlowProblem<Real>&)>;

  /// The field may be given, for many flows of one system.
  DirectionalFlow(const FlowProblem<Real>& problem, std::size_t count,
                  std::shared_ptr<FieldAtStates<Real>> field = nullptr);

  const std::vector<Real>& direction(std::size_t line) const { return directions_[line]; }

  /// All lines, by one integration, for they have one nominal: lines(integrate(problem())).
  Lines integrate(const Integrate& integrate) const;

  /// The problem in one variable a line, whose products with each other are left out
  /// (SeriesSpace::create_uncoupled), for they do not enter the lines' series.
  FlowProblem<Real> problem() const;
  /// The lines from the jet of that problem.
  Lines lines(const FlowJet<Real>& jet) const;

  /// Restricts a jet of the problem's variables to the lines: sum over |a| = k of c_a d^a for each
  /// degree k.
  Lines restrict(const FlowJet<Real>& jet) const;

  /// For each degree the largest difference of a coefficient of any line and component, relative to
  /// the largest one of that degree in `reference`; momenta are scaled by momentum_scale at the
  /// end. 0 where both vanish; not finite where a coefficient is not.
  std::vector<double> relative_difference(const Lines& lines, const Lines& reference) const;

 private:
  FlowProblem<Real> problem_;
  std::shared_ptr<FieldAtStates<Real>> field_;
  SpacePointer line_space_;
  std::vector<std::vector<Real>> directions_;  ///< by line, one number per variable
  Lines starts_;
};

}  // namespace hamjet
