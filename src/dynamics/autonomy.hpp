#pragma once

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

}  // namespace hamjet
