#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hamjet/charts/flow_section.hpp"
#include "hamjet/integrators/gauss_collocation.hpp"
#include "hamjet/maps/flow_map.hpp"
#include "hamjet/maps/symplecticity.hpp"

namespace hamjet {

/// The steady part of a flight from section to section, in closed form: its duration, and how far
/// pericentre and node turn meanwhile.
template <class T>
struct SteadyMotion {
  T time;
  T pericentre;
  T node;
};

/// The flow from a section through the chief's start to one through its end, as polynomials in the
/// variables u of the first. A state at the time tau from the first section is, after the duration,
/// at the time tau + duration - T_s(u) from the second one, with the same energy and the
/// coordinates psi(u): no polynomial contains tau, however large tau is, nor, in the nodal chart,
/// the node.
///
/// The polynomials describe the difference from the steady motion (see secular_motion.hpp; in
/// spherical coordinates it is Kepler's motion alone). The steady motion is put back in closed
/// form: its time to advance by the same angle as the chief, and the turn of the pericentre's pair
/// of coordinates and of the node.
template <class Real>
struct FlowBoxMap {
  std::shared_ptr<const FlowSection<Real>> start;
  std::shared_ptr<const FlowSection<Real>> end;
  Real duration = 0;  ///< duration of the chief's flight
  Real advance = 0;   ///< the angle by which the chief's steady motion advances; for elements only
  Real oblateness = 0;  ///< J2 R^2 of the steady motion
  Real mu = 1;
  /// T_s minus the time of the steady motion.
  Series<Real> time;
  /// The coordinates in the places of the end's section, with the turn of the steady motion taken
  /// back, and the chief's coordinates in the constant terms. Where the charts have an ignored
  /// coordinate, it follows as the last series: by how much it advances more than in the steady
  /// motion.
  std::vector<Series<Real>> coordinates;

  /// The steady motion of a state on the start's section.
  SteadyMotion<Real> steady(const Real& energy, const SixNumbers<Real>& coordinates) const;
  /// The steady motion as series in u.
  SteadyMotion<Series<Real>> steady() const;

  /// Defects of the degrees 0..N-1 from symplecticity, in the canonical coordinates (tau, E) and
  /// those of the sections: the largest coefficients of
  ///
  ///   {psi_i, psi_j} - J_ij   and   d psi_i / dE - {T_s, psi_i} ,
  ///
  /// with Poisson brackets in the section's pairs; symplecticity_by_degree explains their meaning.
  /// The defects are as large as the error of the integration, not of rounding, because the energy
  /// scales the steps.
  std::vector<SymplecticityDefect> symplecticity() const;
};

/// The map between two sections of a field whose polynomials are known, in the form that FlowBoxMap
/// has. The constants of the steady motion follow from the arguments.
template <class Real>
FlowBoxMap<Real> flow_box_map(const ZonalGravity& field,
                              std::shared_ptr<const FlowSection<Real>> start,
                              std::shared_ptr<const FlowSection<Real>> end, const Real& duration,
                              Series<Real> time, std::vector<Series<Real>> coordinates);

/// Makes the flow-box maps of one chief from its start to several times.
///
/// The states on the start's section are integrated by a Gauss method, each orbit in units of its
/// own period. So neighbouring orbits stay side by side, although at equal times they drift apart
/// along the orbit. At the end they are carried to the section through the chief's state, which is
/// near. The steps' tolerance is chosen for the first part of the orbit, and again for one that is
/// longer.
template <class Real>
class FlowBoxPropagation {
 public:
  /// Throws as FlowSection, and Error(usage) for a field in which no orbit exists.
  FlowBoxPropagation(const ZonalGravity& field, ChartName chart, const SixNumbers<Real>& chief,
                     int order, const GaussSettings& settings);

  /// The map to a time later than that of the last call. Throws as integrate_gauss and FlowSection.
  FlowBoxMap<Real> advance_to(const Real& time);

  /// Statistics summed over all integrations.
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
  std::optional<double> step_tolerance_;  ///< the tolerance that was chosen for a part
  double tried_ = 0;                      ///< length of this part
  IntegrationStatistics total_;
};

/// The map of a jet in positions and momenta, by composition to the jet's order, without another
/// integration: the states of the start's section go through the jet, all for the duration, and
/// from there to the section through the chief's end. This is the inverse of flow_box_jet. The map
/// has the errors of the jet, which the shear along the orbit magnifies; FlowBoxPropagation avoids
/// this, because it takes out the pace of each orbit first. Throws Error(usage) unless the jet has
/// six components in six variables, and as FlowSection.
template <class Real>
FlowBoxMap<Real> flow_box_map_of_jet(const ZonalGravity& field, ChartName chart,
                                     const SixNumbers<Real>& chief, const Real& duration,
                                     const FlowMap<Real>& jet);

/// The chart of the sections that suits an orbit: nodal; Poincaré's near the equatorial plane;
/// spherical for an orbit that is not an ellipse.
template <class Real>
ChartName section_chart(const SixNumbers<Real>& chief, const Real& mu);

}  // namespace hamjet
