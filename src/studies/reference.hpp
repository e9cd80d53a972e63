#pragma once

#include <functional>
#include <string_view>

#include "hamjet/studies/propagation.hpp"

namespace hamjet {

inline constexpr int reference_stages = 16;
/// The run that is compared has another order and a looser tolerance, so that the two share neither
/// steps nor stages even where one step spans the whole duration.
inline constexpr int compared_stages = 12;
inline constexpr double looser_tolerance = 1e4;  ///< times the reference's tolerance

/// References of runs in double precision are made of double-double numbers, in the lanes of
/// vectors, ten times as fast as those of 113 bits, where the tolerance is not below this: their
/// rounding, 1e-31, has 6 digits to grow by before it shows in the uncertainty.
inline constexpr double least_double_double_tolerance = 1e-25;

/// The numbers that a reference is made of.
struct ReferenceArithmetic {
  std::string_view name;  ///< as `reference.precision` in results
  int bits;
};

/// The arithmetic of a reference with this tolerance; `judged` is that of the runs that it judges.
constexpr ReferenceArithmetic reference_arithmetic(Precision judged, double tolerance) {
  const bool is_extended =
      judged == Precision::extended || tolerance < least_double_double_tolerance;
  return is_extended ? ReferenceArithmetic{"extended", 113}
                     : ReferenceArithmetic{"double-double", 106};
}

/// Runs the extended-precision reference of a problem: Gauss with 16 stages at the scene's
/// tolerance, and again with 12 stages at 1e4 times that; the difference, by degree, is the stated
/// uncertainty. What rounding leaves shows in it too. The two run side by side in threads of their
/// own. `keep_going` is called after every step of the finer run, with the fraction that is done;
/// it may throw.
ReferenceResult compute_reference(const ComputedProblem& problem, double duration,
                                  const ReferenceSettings& settings, Precision judged,
                                  const std::function<void(double)>& keep_going);

/// The reference of a lower order, which is the first coefficients of another.
ReferenceResult truncated_reference(const ReferenceResult& reference, const SpacePointer& space);

}  // namespace hamjet
