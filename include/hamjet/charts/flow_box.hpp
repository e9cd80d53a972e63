#pragma once

#include <memory>
#include <vector>

#include "hamjet/charts/flow_section.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/maps/flow_map.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet {

/// The steady part of a flight from section to section, in closed form: the time that it takes, and
/// how far pericentre and node turn on the way.
template <class T>
struct SteadyMotion {
  T time;
  T pericentre;
  T node;
};

/// The flow from a section through the chief's start to one through its end, as polynomials in the
/// variables u of the first. A state at the time tau from the first section is, after the duration,
/// at the time tau + duration - T_s(u) from the second one, with the same energy and the
/// coordinates psi(u): no polynomial contains tau, however large it is, nor the node in the nodal
/// chart.
///
/// The polynomials are those of what is left once the steady motion (see secular_motion.hpp; of
/// Kepler's ellipses alone in spherical coordinates) is taken out, which is put back in closed
/// form: the time that it takes to the chief's advance of the angle, and the turn of the
/// pericentre's pair of coordinates and of the node.
template <class Real>
struct FlowBoxMap {
  std::shared_ptr<const FlowSection<Real>> start;
  std::shared_ptr<const FlowSection<Real>> end;
  Real duration = 0;    ///< of the chief's flight
  Real advance = 0;     ///< of the chief's steady motion, of the angle; of elements alone
  Real oblateness = 0;  ///< J2 R^2, of the steady motion
  Real mu = 1;
  /// T_s less the time of the steady motion.
  Series<Real> time;
  /// The coordinates in the places of the end's section, turned back by the steady motion, the
  /// chief's in their constant terms; and behind them, where the charts have an ignored one, by how
  /// much it advances more than the steady motion.
  std::vector<Series<Real>> coordinates;

  /// The steady motion from a state of the start's section.
  SteadyMotion<Real> steady(const Real& energy, const SixNumbers<Real>& coordinates) const;
  /// The same as series in u.
  SteadyMotion<Series<Real>> steady() const;

  /// Defects of the degrees 0..N-1 from symplecticity, in the canonical coordinates (tau, E) and
  /// those of the sections: the largest coefficients of
  ///
  ///   {psi_i, psi_j} - J_ij   and   d psi_i / dE - {T_s, psi_i} ,
  ///
  /// brackets in the section's pairs; what they say is said at symplecticity_by_degree. They are at
  /// the error of the integration, not at rounding: the energy scales its steps.
  std::vector<SymplecticityDefect> symplecticity() const;
};

/// The map between two sections of a field whose polynomials are known, as FlowBoxMap has them: the
/// steady motion's constants follow from the rest.
template <class Real>
FlowBoxMap<Real> flow_box_map(const ZonalGravity& field,
                              std::shared_ptr<const FlowSection<Real>> start,
                              std::shared_ptr<const FlowSection<Real>> end, const Real& duration,
                              Series<Real> time, std::vector<Series<Real>> coordinates);

/// Makes the flow-box maps of one chief from its start to several times.
///
/// The states of the start's section are integrated by a Gauss method at a pace of each orbit's
/// own, in units of its period, so that they stay side by side however they shear along the orbit
/// in time; at the end they are carried to the section through the chief's state, which is near.
template <class Real>
class FlowBoxPropagation {
 public:
  /// Throws as FlowSection, and Error(usage) for a field that is not one of an orbit.
  FlowBoxPropagation(const ZonalGravity& field, ChartName chart, const SixNumbers<Real>& chief,
                     int order, const GaussSettings& settings);

  /// The map to a time further on than the last one. Throws as integrate_gauss and FlowSection.
  FlowBoxMap<Real> advance_to(const Real& time);

  /// Summed over the integrations.
  const IntegrationStatistics& statistics() const { return total_; }

 private:
  ZonalGravity field_;
  SharedSystem crossing_;
  GaussSettings settings_;
  ChartName chart_;
  std::shared_ptr<const FlowSection<Real>> start_;
  FlowProblem<Real> flow_;
  Series<Real> periods_;
  Real reached_ = 0;
  IntegrationStatistics total_;
};

/// The map of a jet in positions and momenta, by composition to the jet's order, without another
/// integration: the states of the start's section go through the jet, all for the duration, and
/// from there to the section through the chief's end. The inverse of flow_box_jet. Beside the map
/// that FlowBoxPropagation integrates it has the jet's errors, which shear along the orbit
/// magnifies: the pace of each orbit is not taken out before they are made. Throws Error(usage)
/// unless the jet has six components in six variables, and as FlowSection.
template <class Real>
FlowBoxMap<Real> flow_box_map_of_jet(const ZonalGravity& field, ChartName chart,
                                     const SixNumbers<Real>& chief, const Real& duration,
                                     const FlowMap<Real>& jet);

/// The chart of the sections that suits an orbit: nodal, or Poincaré's near the equatorial plane,
/// or spherical for an orbit that is no ellipse.
template <class Real>
ChartName section_chart(const SixNumbers<Real>& chief, const Real& mu);

}  // namespace hamjet
