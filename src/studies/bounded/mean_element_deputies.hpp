#pragma once

#include "hamjet/charts/canonical_chart.hpp"
#include "hamjet/dynamics/zonal_gravity.hpp"

namespace hamjet {

/// Deputies as theories of first order in J2 choose them: mean elements, after Brouwer and Lyddane
/// (see mean_elements.hpp), whose pericentre's pair (q, p) of the nodal chart differs from the
/// chief's by so much, with the chief's mean argument of latitude and node.
///
/// equal_elements: the mean semi-major axis and inclination are the chief's.
///
/// j2_invariant: to first order in the difference of eta = sqrt(1 - e^2) they differ so that mean
/// argument of latitude and node drift as the chief's,
///
///   di = -4 d eta / (eta tan i) ,   da/a = 2 D d eta ,
///   D = J2 R^2 / (4 a^2 eta^5) (4 + 3 eta) (1 + 5 cos^2 i) .
///
/// Source: H. Schaub and K. T. Alfriend, "J2 invariant relative orbits for spacecraft formations",
/// Celest. Mech. Dyn. Astron. 79 (2001) 77.
enum class MeanElementRule { equal_elements, j2_invariant };

/// The state of such a deputy. Throws Error(numerical) if there is no such orbit.
SixNumbers<double> mean_element_deputy(const ZonalGravity& field, const SixNumbers<double>& chief,
                                       MeanElementRule rule, double q, double p);

}  // namespace hamjet
