#pragma once

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
};

}  // namespace hamjet
