#pragma once

#include "affine_symplectic_map.hpp"
#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// The sequence f_k = f composed k times with itself: f_0 is the identity, and a rotation by theta
/// gives rotations by k theta. The powers are formed in extended precision, so that each is good to
/// the rounding of double; where f grows (it has eigenvalues off the unit circle, or is a shear) so
/// does the round-off of what is computed in its coordinates, see AffineSymplecticMap::condition.
class SymplecticPowers {
 public:
  explicit SymplecticPowers(const AffineSymplecticMap<Extended>& map);

  /// The power f_k. Any k >= 0 may follow any other; a smaller one is counted up from 0, a larger
  /// one from the last. Throws Error(usage) for k < 0, Error(numerical) if the power overflows
  /// double precision.
  AffineSymplecticMap<double> operator()(long k);

 private:
  AffineSymplecticMap<Extended> map_;
  AffineSymplecticMap<Extended> power_;
  long exponent_ = 0;
};

}  // namespace hamjet
