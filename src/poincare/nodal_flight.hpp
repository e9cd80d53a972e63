#pragma once

#include "hamjet/charts/flow_box.hpp"

namespace hamjet {

/// The places of a nodal section's variables: of the energy, the pericentre's pair
/// (q, p) = sqrt(2 (L - G)) (-sin g, cos g), and the momentum H about the axis.
enum NodalVariable : std::size_t { energy_variable, q_variable, momentum_variable, p_variable };
inline constexpr std::size_t nodal_variables = 4;

/// The places of the pericentre's pair and of H among the coordinates of the nodal chart.
inline constexpr std::size_t node_place = 1, q_place = 2, momentum_place = 4, p_place = 5;

/// A flight from one nodal section to another, its steady motion put back, as series in the first
/// one's variables. H and the energy are the same at both.
template <class Real>
struct NodalFlight {
  Series<Real> time;
  Series<Real> q;  ///< at the end
  Series<Real> p;
  Series<Real> node;  ///< by how much the node advances, the chief's less whole turns
};

/// Throws Error(usage) unless the map is between nodal sections.
template <class Real>
NodalFlight<Real> nodal_flight(const FlowBoxMap<Real>& map);

/// A chief's return to its section, the states of its mean argument of latitude l + g.
template <class Real>
struct ReturnMap {
  FlowBoxMap<Real> map;
  NodalFlight<Real> flight;
};

/// The return of a chief that goes round a zonal field to its own section that is nearest to a
/// time, to an order; (q, p) -> (q', p') of one energy and H preserves the area. Throws
/// Error(numerical) for a chief that is no ellipse or too near to the equatorial plane, where no
/// node is defined, if Newton's method does not bring it to its section, and as integrate_gauss.
template <class Real>
ReturnMap<Real> return_near(const ZonalGravity& field, const SixNumbers<Real>& chief,
                            const Real& time, int order, const GaussSettings& gauss);

/// The first return, which the field moves by far less than half a turn from Kepler's period.
template <class Real>
ReturnMap<Real> first_return(const ZonalGravity& field, const SixNumbers<Real>& chief, int order,
                             const GaussSettings& gauss);

/// Kepler's period of an energy.
template <class Real>
Real kepler_period(const Real& energy, const Real& mu);

}  // namespace hamjet
