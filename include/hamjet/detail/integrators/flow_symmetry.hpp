#pragma once

#include <cstddef>

namespace hamjet {

/// A symmetry that an integration may leave out and put back at the end.
enum class FlowSymmetry {
  none,
  /// The rotation that the system declares (DynamicalSystem::rotated_planes), if the jet is
  /// expanded in all coordinates that it turns. The jet in one variable less is integrated, which
  /// takes two thirds of the time at order 4 and a third at order 8. Closed formulas then give the
  /// full jet, which is the jet of the same numerical map to rounding, for methods that commute
  /// with rotations and choose their steps by the nominal: Gauss, and the explicit splittings.
  rotation,
  /// The rotation, and also the shift in time along the nominal, so that one more variable is left
  /// out. The flow commutes with this shift, but a numerical map only up to its error. The jet is
  /// then not that of one numerical map, and it is symplectic to about the error of integration
  /// instead of to rounding.
  rotation_and_time,
  /// The shift in time alone, where rotation_and_time is asked for but there is no rotation.
  time,
};

/// Whether a shift in time is left out.
constexpr bool has_time_shift(FlowSymmetry symmetry) {
  return symmetry == FlowSymmetry::rotation_and_time || symmetry == FlowSymmetry::time;
}

/// The number of variables that are left out.
constexpr std::size_t variables_less(FlowSymmetry symmetry) {
  if (symmetry == FlowSymmetry::none) return 0;
  return symmetry == FlowSymmetry::rotation_and_time ? 2 : 1;
}

}  // namespace hamjet
