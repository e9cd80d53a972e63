#pragma once

#include <vector>

#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/studies/propagation.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet {

/// By degree of the Poisson brackets, the size of the defect that rounding of the equations of
/// motion makes where terms of them cancel, as those of sqrt((x + 1)^2) do in all degrees above the
/// first.
///
/// What cancels leaves in degree k of the equations a rounding f_k, which is measured: the largest
/// difference of their series in double from those in extended precision, at points of the nominal.
/// Where it is far more than a rounding of what is left, degree k of the jet has a rounding of up
/// to
///
///   8 u / u_double |T| f_k G^(k+1) ,
///
/// with T the duration, u of the run's precision, and G the largest row of the linear part, or 1.
/// A degree that is no larger is rounding alone; of others no more than 1e-6 of their size counts.
/// The products of these roundings with other degrees are the result, in the unit of momentum of
/// comparable_jet.
std::vector<double> defects_of_rounding(const Scene& scene, const DynamicalSystem& system,
                                        const RunResult& run);

}  // namespace hamjet
