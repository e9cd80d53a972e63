#pragma once

#include "hamjet/charts/deputy_flow.hpp"

namespace hamjet::cli {

/// By how much rounding alone moves the final position of a deputy that a flow predicts about a
/// chief that starts at `start`: the ways into the polynomials' coordinates and out of them, the
/// chief's own coordinates, from which deviations are counted, and what the polynomials make of all
/// that. Canonical, a root mean square.
///
/// It is measured, so that every chart has it, with its own condition at the chief: a deviation and
/// its negative come to opposite ends, but for rounding and for what is quadratic, which is below
/// rounding where the deviation is some hundred units in the last place. Infinite where a
/// prediction is not finite.
double rounding_of_predictions(const DeputyFlow& flow, const SixNumbers<double>& start);

}  // namespace hamjet::cli
