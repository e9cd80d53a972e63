#pragma once

namespace hamjet {

/// The axes along which the direction of a thrust stays the same.
enum class ThrustAxes {
  inertial,
  rtn,  ///< R along the radius, N along the angular momentum, T = N x R, of the own orbit
  tnw,  ///< T along the velocity, W along the angular momentum, N = W x T, of the own orbit
};

}  // namespace hamjet
