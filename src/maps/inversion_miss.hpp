#pragma once

#include <span>

#include "hamjet/maps/generating_function.hpp"

namespace hamjet {

/// How far a partial inversion is from inverting its jet, found along one line w = s u through the
/// nominal, u a fixed direction without special relation to the axes, s a variable.
///
/// The inversion gives the initial deviations along the line as polynomials in s; the jet, composed
/// with them, must give back the chosen final variables, s u_i, and the remaining final ones as the
/// inversion has them, in every degree up to the order. A wrong coefficient of any degree shows,
/// except for directions u of measure zero. The check costs one composition with series in one
/// variable, which is far less than the inversion.
///
/// Returns the largest difference of a coefficient of s^d, divided by the largest sum of the
/// absolute values of the terms of a coefficient of s^1..s^d of the same component: for a right
/// inversion a small multiple of T's rounding.
template <class T>
double inversion_miss(const std::vector<Series<T>>& jet, const PartialInversion<T>& inversion);

}  // namespace hamjet
