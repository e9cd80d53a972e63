#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace hamjet {

/// The solution for a spline's high derivatives cancels digits, and so do they in the logarithms of
/// densities: with these 70 digits extended numbers are right to the last one.
using SplineNumber = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<70>,
                                                   boost::multiprecision::et_off>;

/// The spline of degree 7 through values at increasing nodes, four at least, with s'' = s''' =
/// s'''' = 0 at both ends: it continues as a line with four continuous derivatives, and has six at
/// inner nodes.
///
/// Returns for each node the coefficients of d^0 to d^7 of the polynomial between it and the next
/// one, d counted from it; for the last node, those of the line beyond it.
std::vector<std::array<SplineNumber, 8>> septic_spline(const std::vector<SplineNumber>& nodes,
                                                       const std::vector<SplineNumber>& values);

}  // namespace hamjet
