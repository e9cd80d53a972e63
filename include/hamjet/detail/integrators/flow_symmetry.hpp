#pragma once

#include <cstddef>

namespace hamjet {

/// A symmetry that an integration leaves out and puts back.
enum class FlowSymmetry {
  none,
  /// The rotation that the system declares (DynamicalSystem::rotated_planes), wherever the jet is
  /// expanded in all that it turns: the jet of one variable less is integrated, which takes from
  /// two thirds of the time at order 4 to a third at order 8. It is put together again by closed
  /// formulas, and is the jet of the same numerical map to rounding, for the methods that commute
  /// with rotations and choose their steps by the nominal: Gauss, and the explicit splittings.
  rotation,
  /// The rotation, and the shift in time along the nominal as well: one variable less again. The
  /// flow commutes with it, but a numerical map only to its error, so that the jet is neither that
  /// of one numerical map nor symplectic to rounding, but to about the error of integration.
  rotation_and_time,
  /// The shift in time alone, where rotation_and_time is asked for and no rotation is there.
  time,
};

/// Whether a shift in time is left out.
constexpr bool has_time_shift(FlowSymmetry symmetry) {
  return symmetry == FlowSymmetry::rotation_and_time || symmetry == FlowSymmetry::time;
}

/// How many variables less are integrated.
constexpr std::size_t variables_less(FlowSymmetry symmetry) {
  if (symmetry == FlowSymmetry::none) return 0;
  return symmetry == FlowSymmetry::rotation_and_time ? 2 : 1;
}

}  // namespace hamjet
