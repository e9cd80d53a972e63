#pragma once

#include <functional>
#include <vector>

#include "nodal_flight.hpp"

namespace hamjet {

/// The orbits that keep company with a chief of a zonal field: those whose mean nodal period and
/// mean drift of the node are the chief's, to the order of the polynomials.
///
/// With T_k(u) and Omega_k(u) the time and the advance of the node from the chief's section to the
/// section that it crosses at the k-th of K + 1 equal times of a window, as flow-box polynomials in
/// the section's variables u = (u_0, q, H, p), the mean rates are the slopes of the straight lines
/// of least squares,
///
///   T(u) = sum_k c_k T_k(u) ,   Omega(u) = sum_k c_k Omega_k(u) ,   c_k = (k - K/2) / (m S) ,
///   S = sum_k (k - K/2)^2 ,
///
/// m revolutions lying between two of the times: means over the increments with weights that fall
/// to zero at the window's ends. Over many turns of the pericentre they are those of the whole
/// motion; where these take longer than the window (a Molniya orbit's take decades), means over
/// them would let the two drift apart for as long. The equations
///
///   T(u) = T(0) ,   Omega(u) = Omega(0)
///
/// are solved for (u_0, H) as polynomials of (q, p): a family of the amplitude and the phase of the
/// difference of the pericentres' pairs. Where on the orbit a member is, and where its node, are
/// free besides, for the field contains neither.
///
/// Sources: Y. He, R. Armellin and M. Xu, "Bounded relative orbits in the zonal problem via
/// high-order Poincaré maps", J. Guidance, Control, and Dynamics 42 (2019) 91; N. Baresi and D. J.
/// Scheeres, Celest. Mech. Dyn. Astron. 127 (2017) 527.
class BoundedFamily {
 public:
  /// Told the part of the window that is done, from 0 to 1.
  using Progress = std::function<void(double)>;

  /// The window has at least so many revolutions, 1 or more. Throws Error(numerical) for a chief
  /// without a nodal section, for a field in which all orbits of an energy stay together (no J2),
  /// and as integrate_gauss.
  BoundedFamily(const ZonalGravity& field, const SixNumbers<double>& chief, int order,
                int revolutions, const GaussSettings& gauss, const Progress& progress = {});

  const FlowSection<double>& section() const { return section_; }
  /// The times of the window, equal multiples of the chief's nodal period at its start; the first
  /// is 0.
  const std::vector<double>& times() const { return times_; }
  double nodal_period() const { return period_; }
  int order() const { return of_pair_.front().order(); }

  /// A member of the family.
  struct Member {
    SixNumbers<double> state;  ///< on the chief's section, with its node
    double energy = 0;         ///< u_0
    double momentum = 0;       ///< H less the chief's
  };
  /// The member whose pair (q, p) differs from the chief's by so much, by the terms up to a degree.
  /// Throws Error(numerical) if there is no such orbit.
  Member member(double q, double p, int degree) const;
  /// The state on the chief's section, with its node, of differences of the pair, of u_0 and of H.
  /// Throws Error(numerical) if there is none.
  SixNumbers<double> state_of(double q, double p, double energy, double momentum) const;

  /// T and Omega, of the pair alone: (u_0, q, H, p) of (T - T(0), q, Omega - Omega(0), p).
  const std::vector<Series<double>>& members() const { return of_pair_; }
  /// T and Omega as polynomials of u.
  const Series<double>& mean_period() const { return mean_period_; }
  const Series<double>& mean_node() const { return mean_node_; }

 private:
  FlowSection<double> section_;
  double period_ = 0;
  std::vector<double> times_;
  Series<double> mean_period_;
  Series<double> mean_node_;
  std::vector<Series<double>> of_pair_;
};

}  // namespace hamjet
