#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hamjet/integrators/flow_problem.hpp"

namespace hamjet {

/// A rotation that has been left out already: the planes that it turns, of z = (q, p), and that of
/// them in whose direction at the start every start lies.
struct LeftOutRotation {
  std::vector<std::array<std::size_t, 2>> planes;
  std::array<std::size_t, 2> section = {};
};

/// A flow without the shift in time phi_tau, and put together with it again. Of a problem whose
/// starts z0 + sum_k b_k sigma_k are affine in the variables, with b_k across each other, one
/// variable j is left out, that in which the nominal moves fastest at the start. Every start near
/// the nominal's is
///
///   z0 + sum_k b_k sigma_k = R(-psi) phi_tau(z0 + sum_(k != j) b_k s_k) ,
///
/// R(-psi) being the rotation, where one is left out already, that brings back to its section what
/// the flow turns away from it. A map P that commutes with the flow and with the rotation takes it
/// to R(-psi) phi_tau P(z0 + sum b_k s_k). So P is integrated in s alone. phi_tau at both ends is
/// a Taylor series in tau, formed degree by degree with one evaluation of the vector field f,
///
///   c(a + e_tau) = f(z)(a) / (a_tau + 1) ,
///
/// which makes the right hand side above, without R(-psi) at the end and with it, a series in s
/// and tau; the former's inverse is (s, tau) as series in sigma, and the jet is composed with it.
///
/// The flow itself commutes with phi_tau (V. I. Arnold, Mathematical Methods of Classical
/// Mechanics, 2nd ed., section 45); a numerical map does so to its error only. What is put together
/// is then as near to the flow as before, but not symplectic to rounding, and no longer the jet of
/// one numerical map: both to about the error of integration.
template <class Real>
class TimeReduction {
 public:
  /// The reduction of a problem that starts at its nominal plus constants times the variables; none
  /// where the nominal hardly moves in any of them (an equilibrium, or a circular equatorial orbit,
  /// which the rotation stops), or leaves what they span.
  static std::optional<TimeReduction> of(const FlowProblem<Real>& problem,
                                         const std::optional<LeftOutRotation>& rotation);

  /// The problem in one variable less.
  const FlowProblem<Real>& problem() const { return reduced_; }

  /// The jet in all variables of the problem given, from that of the reduced problem.
  FlowJet<Real> expand(const FlowJet<Real>& reduced) const;

 private:
  TimeReduction(const FlowProblem<Real>& problem, const std::optional<LeftOutRotation>& rotation,
                std::size_t left_out);

  void set_reduced_problem(const FlowProblem<Real>& problem);
  /// Whether the starts that the flow and the rotation make of the reduced ones are spanned by the
  /// problem's variables; if so, sets `inner_`.
  bool set_inner_map(const FlowProblem<Real>& problem);

  /// The jet in (s, tau) after the time tau and the rotation R(-psi), psi from the start's series.
  FlowJet<Real> shifted(const FlowJet<Real>& without_shift) const;
  /// R(-psi) of a jet.
  void turn_back(FlowJet<Real>& jet) const;

  SharedSystem system_;
  SpacePointer space_;    ///< of the problem; its variable `left_out_` is tau
  std::size_t left_out_;  ///< place among the variables
  std::optional<LeftOutRotation> rotation_;
  std::vector<std::size_t> places_;  ///< in `space_` of the monomials of the reduced space
  FlowProblem<Real> reduced_;
  std::optional<Series<Real>> cosine_;  ///< of psi, in (s, tau)
  std::optional<Series<Real>> sine_;
  std::vector<Series<Real>> inner_;  ///< (s, tau) in the problem's variables
};

}  // namespace hamjet
