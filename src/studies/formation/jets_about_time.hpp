#pragma once

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

}  // namespace hamjet
