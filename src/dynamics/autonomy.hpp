#pragma once

#include <utility>

#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// Whether a system's Hamiltonian does not contain the time. Its flow over a duration is then the
/// same at every start, and its energy is kept; what rests on either must ask here.
template <class System>
bool is_autonomous(const System& system) {
  if constexpr (requires { system.is_autonomous(); }) {
    return system.is_autonomous();
  } else {
    return true;
  }
}

/// The list at one time of the clock; itself if it does not contain the time.
template <class List>
List frozen_at(const List& list, const ClockTime& time) {
  if constexpr (requires { list.has_time(); }) {
    if (list.has_time()) return at_time(list, time.in<Extended>());
  }
  return list;
}

/// The system whose forces are always those of one time of the clock: itself if they do not depend
/// on the time. It serves what is asked about one moment, and no flight.
inline SharedSystem frozen_at(const SharedSystem& system, const ClockTime& time) {
  if (is_autonomous(*system)) return system;
  DynamicalSystem frozen = *system;
  frozen.hamiltonian = frozen_at(frozen.hamiltonian, time);
  frozen.vector_field = frozen_at(frozen.vector_field, time);
  if (frozen.second_order) {
    frozen.second_order->force = frozen_at(frozen.second_order->force, time);
  }
  return frozen;
}

}  // namespace hamjet
