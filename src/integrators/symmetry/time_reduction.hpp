#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// A rotation that has been left out already: the planes of z = (q, p) that it turns, and the plane
/// in which every start lies in the direction of the nominal's start.
struct LeftOutRotation {
  std::vector<std::array<std::size_t, 2>> planes;
  std::array<std::size_t, 2> section = {};
};

/// Leaves the shift in time phi_tau out of the integration of a flow, and puts it back. The starts
/// z0 + sum_k b_k sigma_k of the problem must be affine in the variables, with orthogonal b_k. The
/// variable j in which the nominal moves fastest at the start is left out. Every start near the
/// nominal's is
///
///   z0 + sum_k b_k sigma_k = R(-psi) phi_tau(z0 + sum_(k != j) b_k s_k) ,
///
/// where R(-psi) is present if a rotation is left out already; it brings back to the section the
/// states that the flow turns away from it. A map P that commutes with the flow and with the
/// rotation takes this start to R(-psi) phi_tau P(z0 + sum b_k s_k). So P is integrated in s alone.
/// At both ends phi_tau is a Taylor series in tau, formed degree by degree with one evaluation of
/// the vector field f,
///
///   c(a + e_tau) = f(z)(a) / (a_tau + 1) ,
///
/// by which the right-hand side above becomes a series in s and tau, at the start and at the end.
/// The inverse of the series at the start gives (s, tau) as series in sigma, with which the jet is
/// composed.
///
/// The flow itself commutes with phi_tau (V. I. Arnold, Mathematical Methods of Classical
/// Mechanics, 2nd ed., section 45); a numerical map does so only up to its error. The result is
/// then as near to the flow as before. But it is symplectic, and the jet of one numerical map, only
/// to about the error of integration.
template <class Real>
class TimeReduction {
 public:
  /// The reduction of a problem that starts at its nominal plus constants times the variables. No
  /// value if the nominal hardly moves in any variable (at an equilibrium, or on a circular
  /// equatorial orbit, which the rotation stops), or moves out of the space that the variables
  /// span.
  static std::optional<TimeReduction> of(const FlowProblem<Real>& problem,
                                         const std::optional<LeftOutRotation>& rotation);

  /// The problem in one variable less.
  const FlowProblem<Real>& problem() const { return reduced_; }

  /// The jet in all variables of the given problem, made from the jet of the reduced problem.
  FlowJet<Real> expand(const FlowJet<Real>& reduced) const;

 private:
  TimeReduction(const FlowProblem<Real>& problem, const std::optional<LeftOutRotation>& rotation,
                std::size_t left_out);

  void set_reduced_problem(const FlowProblem<Real>& problem);
  /// Whether the problem's variables span the starts that the flow and the rotation make of the
  /// reduced starts; if so, sets `inner_`.
  bool set_inner_map(const FlowProblem<Real>& problem);

  /// The jet in (s, tau) after the time tau and the rotation R(-psi), where psi is taken from the
  /// series of the start.
  FlowJet<Real> shifted(const FlowJet<Real>& without_shift) const;
  /// Applies R(-psi) to a jet.
  void turn_back(FlowJet<Real>& jet) const;

  SharedSystem system_;
  SpacePointer space_;    ///< space of the problem; its variable `left_out_` is tau
  std::size_t left_out_;  ///< index of the left-out variable
  std::optional<LeftOutRotation> rotation_;
  std::vector<std::size_t> places_;  ///< places in `space_` of the monomials of the reduced space
  FlowProblem<Real> reduced_;
  std::optional<Series<Real>> cosine_;  ///< cosine of psi, in (s, tau)
  std::optional<Series<Real>> sine_;
  std::vector<Series<Real>> inner_;  ///< (s, tau) as series in the problem's variables
};

}  // namespace hamjet
