#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"
#include "phase_space_scale.hpp"

namespace hamjet {

/// A flow along a few straight lines of initial deviations, z0 + s d: for each line it gives the
/// final components as series in s alone. A Runge-Kutta or splitting method commutes with the
/// restriction to a line. The N + 1 coefficients therefore equal the full jet of order N along this
/// line with the same steps, including its truncation error by degree, at a small fraction of the
/// cost.
///
/// The entries of a direction have sizes between 1/2 and 1 in the scaled variables of
/// momentum_scale, so that every monomial contributes, and random signs, which are the same in
/// every run. The first direction has the signs of the gradient of H: neighbours of another energy
/// drift away along the flow, so that on this line the series is about as large as the jet's
/// largest coefficients. The second direction has the signs of the vector field: neighbours ahead
/// or behind meet the waves of the field at another phase, from which the high degrees of the jet
/// come.
template <class Real>
class DirectionalFlow {
 public:
  /// For each line, the flow's jet of order N in one variable.
  using Lines = std::vector<FlowJet<Real>>;
  /// Integrates a problem that has one variable for each line.
  using Integrate = std::function<FlowJet<Real>(const FlowProblem<Real>&)>;

  /// The field may be passed, so that many flows of one system share it.
  DirectionalFlow(const FlowProblem<Real>& problem, std::size_t count,
                  std::shared_ptr<FieldAtStates<Real>> field = nullptr);

  const std::vector<Real>& direction(std::size_t line) const { return directions_[line]; }

  /// All lines by one integration, because they share the nominal: lines(integrate(problem())).
  Lines integrate(const Integrate& integrate) const;

  /// The problem with one variable for each line. Products of different variables are left out
  /// (SeriesSpace::create_uncoupled), because they do not contribute to the series of the lines.
  FlowProblem<Real> problem() const;
  /// Extracts the lines from the jet of that problem.
  Lines lines(const FlowJet<Real>& jet) const;

  /// Restricts a jet in the problem's variables to the lines: sum over |a| = k of c_a d^a for each
  /// degree k.
  Lines restrict(const FlowJet<Real>& jet) const;

  /// For each degree, the largest difference of a coefficient over all lines and components,
  /// relative to the largest coefficient of that degree in `reference`. Momenta are scaled by
  /// momentum_scale at the end. The result is 0 where both vanish, and not finite where a
  /// coefficient is not.
  std::vector<double> relative_difference(const Lines& lines, const Lines& reference) const;

 private:
  FlowProblem<Real> problem_;
  std::shared_ptr<FieldAtStates<Real>> field_;
  SpacePointer line_space_;
  std::vector<std::vector<Real>> directions_;  ///< by line, one number per variable
  Lines starts_;
};

}  // namespace hamjet
