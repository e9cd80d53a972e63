#pragma once

#include <functional>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

inline constexpr int reference_stages = 16;
/// The run that is compared has another order and a looser tolerance, so that the two share neither
/// steps nor stages even where one step spans the whole duration.
inline constexpr int compared_stages = 12;
inline constexpr double looser_tolerance = 1e4;  ///< times the reference's tolerance

/// Runs the extended-precision reference of a problem: Gauss with 16 stages at the scene's
/// tolerance, and again with 12 stages at 1e4 times that; the difference, by degree, is the stated
/// uncertainty. The two run side by side in threads of their own. `keep_going` is called
/// after every step of the finer run, with the fraction that is done; it may throw.
ReferenceResult compute_reference(const ComputedProblem& problem, double duration,
                                  const ReferenceSettings& settings,
                                  const std::function<void(double)>& keep_going);

/// The reference of a lower order, which is the first coefficients of another.
ReferenceResult truncated_reference(const ReferenceResult& reference, const SpacePointer& space);

}  // namespace hamjet
