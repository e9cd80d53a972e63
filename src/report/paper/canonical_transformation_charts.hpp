#pragma once

#include <vector>

#include "../../studies/paper/canonical_transformation.hpp"
#include "../drawing/chart.hpp"

namespace hamjet::io {

/// The paper's figures ex1_1 and ex1_2: the trajectory in the plane (q, p) and in that of (Q, P),
/// the energy error along time in both coordinates, and the difference of the two. Of a model with
/// more degrees of freedom the first is shown.
std::vector<Chart> canonical_transformation_charts(const CanonicalTransformationResult& result);

}  // namespace hamjet::io
