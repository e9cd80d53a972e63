#pragma once

#include "affine_symplectic_map.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// The sequence f_k = f composed k times with itself: f_0 is the identity, and a rotation by theta
/// gives rotations by k theta. The powers are formed in extended precision, so that each is right
/// to the rounding of double. Where the powers of f grow (f has eigenvalues off the unit circle, or
/// is a shear), the round-off of computations in the coordinates of f_k grows as well, see
/// AffineSymplecticMap::condition.
class SymplecticPowers {
 public:
  explicit SymplecticPowers(const AffineSymplecticMap<Extended>& map);

  /// The power f_k. The calls may have any k >= 0 in any order: a smaller k than the last one is
  /// reached from f_0, a larger one from the last power. Throws Error(usage) for k < 0,
  /// Error(numerical) if the power overflows double precision.
  AffineSymplecticMap<double> operator()(long k);

 private:
  AffineSymplecticMap<Extended> map_;
  AffineSymplecticMap<Extended> power_;
  long exponent_ = 0;
};

}  // namespace hamjet
