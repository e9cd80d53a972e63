#pragma once

#include "hamjet/dynamics/clock_time.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The list at one time of the clock; itself if it does not contain the time.
inline OperationList frozen_at(const OperationList& list, const ClockTime& time) {
  return list.has_time() ? at_time(list, time.in<Extended>()) : list;
}

/// The system whose forces are always those of one time of the clock: itself if they do not depend
/// on the time. It serves what is asked about one moment, and no flight.
inline SharedSystem frozen_at(const SharedSystem& system, const ClockTime& time) {
  if (system->is_autonomous()) return system;
  DynamicalSystem frozen = *system;
  frozen.hamiltonian = frozen_at(frozen.hamiltonian, time);
  frozen.vector_field = frozen_at(frozen.vector_field, time);
  if (frozen.second_order) {
    frozen.second_order->force = frozen_at(frozen.second_order->force, time);
  }
  frozen.uniform_rotation.reset();
  frozen.break_times.clear();
  return frozen;
}

}  // namespace hamjet
