#pragma once

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/maps/flow_map.hpp"

namespace hamjet {

/// A flow's jet from the coordinates of one chart to those of another: with X and Y the charts at
/// the start and at the end,
///
///   c + d  ->  Y(jet(X^-1(c + d) - z)) ,
///
/// z the chief's initial state and c its coordinates; the constant terms are the chief's final
/// coordinates. Since both charts are canonical, this map is as symplectic as the jet. It is formed
/// by Horner's scheme, to the jet's order. `jet` must have six components in all six deviations,
/// with the nominal's end in the constant terms; Error(usage) is thrown for another jet.
template <class Real>
FlowMap<Real> in_charts(const FlowMap<Real>& jet, const CanonicalChart<Real>& start,
                        const SixNumbers<Real>& start_state, const CanonicalChart<Real>& end);

/// The jet in positions and momenta that belongs to a map between charts: the inverse of in_charts.
template <class Real>
FlowMap<Real> out_of_charts(const FlowMap<Real>& map, const CanonicalChart<Real>& start,
                            const SixNumbers<Real>& start_state, const CanonicalChart<Real>& end);

}  // namespace hamjet
