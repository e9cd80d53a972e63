#pragma once

#include "../../studies/bounded/frozen_orbit_study.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

// Of a frozen orbit, and of what turns about it. None of these charts is fitted.

/// The circles of the normal form in the pericentre's pair, each divided by its amplitude, and
/// where flown orbits are.
Chart invariant_curve_chart(const FrozenOrbitStudy& study);

/// The two multipliers and the unit circle.
Chart multiplier_chart(const FrozenOrbitStudy& study);

/// By how much the rotation number differs from that of small amplitudes, against the amplitude.
Chart frequency_chart(const FrozenOrbitStudy& study);

/// How far flown orbits are from the normal form, against the amplitude.
Chart reach_chart(const FrozenOrbitStudy& study);

}  // namespace hamjet::io
