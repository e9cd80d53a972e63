#pragma once

#include "hamjet/algebra/extended.hpp"

namespace hamjet {

/// A time of a system's clock: the t of H(q, p, t), in the system's own unit of time, counted from
/// the epoch. A state says nothing about the forces on it without the time at which it stands, so
/// that whatever flies a state takes both. The type has no default, and no number converts to it,
/// so that a flight cannot leave the time out or take a duration for it.
class ClockTime {
 public:
  template <class Real>
  explicit ClockTime(const Real& time) : time_(convert<Extended>(time)) {}

  /// The time at which a scene's states stand, from which the clock counts.
  static ClockTime epoch() { return ClockTime(0.0); }

  /// The time in the numbers of an integration.
  template <class Real>
  Real in() const {
    return convert<Real>(time_);
  }

  /// The time after a duration, which is negative for backwards.
  template <class Real>
  friend ClockTime operator+(const ClockTime& time, const Real& duration) {
    return ClockTime(Extended(time.time_ + convert<Extended>(duration)));
  }
  friend bool operator==(const ClockTime&, const ClockTime&) = default;

 private:
  Extended time_;
};

}  // namespace hamjet
