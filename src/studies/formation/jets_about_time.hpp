#pragma once

#include <span>
#include <vector>

#include "../jets_along_time.hpp"

namespace hamjet {

/// The jet of a flow at times t about a time, as a polynomial in t: element k of the result is the
/// coefficient of t^k, for k from 0 to `order`. `jet` is the jet at that time itself, of an orbit
/// about a center at the origin.
///
/// The jets are integrated to nodes of Chebyshev's on both sides and interpolated. The nodes span
/// a part of a revolution in which the interpolation leaves out no more than rounding; rounding
/// itself grows with the power, so that the coefficients of high powers, which short times
/// multiply, have fewer digits. Throws as the integrator.
std::vector<FlowJet<double>> jets_about_time(const JetPropagation& at_time,
                                             const FlowJet<double>& jet, int order);

/// The longest time before and after its own that jets_about_time integrates to anywhere along the
/// orbit of a state, with mu = 1; 0 for an orbit that escapes.
double longest_time_about(std::span<const double> state);

}  // namespace hamjet
