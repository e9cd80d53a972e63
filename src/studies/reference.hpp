#pragma once

#include <functional>
#include <string_view>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

inline constexpr int reference_stages = 16;
/// The second run has another order and a looser tolerance than the reference, so that both share
/// neither steps nor stages even if one step spans the whole duration.
inline constexpr int compared_stages = 12;
inline constexpr double looser_tolerance = 1e4;  ///< factor relative to the reference's tolerance

/// References for runs in double precision use double-double numbers in the lanes of vectors, which
/// are ten times as fast as numbers of 113 bits, unless the tolerance is below this. Their
/// rounding, 1e-31, may grow by 6 digits before it shows in the uncertainty.
inline constexpr double least_double_double_tolerance = 1e-25;

/// The arithmetic of a reference.
struct ReferenceArithmetic {
  std::string_view name;  ///< value of `reference.precision` in results
  int bits;
};

/// The arithmetic of a reference with this tolerance; `judged` is the precision of the runs that it
/// judges.
constexpr ReferenceArithmetic reference_arithmetic(Precision judged, double tolerance) {
  const bool is_extended =
      judged == Precision::extended || tolerance < least_double_double_tolerance;
  return is_extended ? ReferenceArithmetic{"extended", 113}
                     : ReferenceArithmetic{"double-double", 106};
}

/// Runs the extended-precision reference of a problem: Gauss with 16 stages at the scene's
/// tolerance, and again with 12 stages at 1e4 times that tolerance. The difference, by degree, is
/// the stated uncertainty; it includes rounding. Both runs have threads of their own. `keep_going`
/// is called after every step of the finer run, with the fraction that is done; it may throw.
ReferenceResult compute_reference(const ComputedProblem& problem, double duration,
                                  const ReferenceSettings& settings, Precision judged,
                                  const std::function<void(double)>& keep_going);

/// The reference of a lower order, made of the first coefficients of another reference.
ReferenceResult truncated_reference(const ReferenceResult& reference, const SpacePointer& space);

}  // namespace hamjet
