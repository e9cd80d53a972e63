#pragma once

#include <cstddef>

#include "hamjet/detail/dynamics/thrust_axes.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// What a thrust that burns is like.
struct BurningThrust {
  ThrustAxes axes = ThrustAxes::rtn;
  bool mass_falls = false;

  /// The numbers with which states of the system end.
  std::size_t parameters() const { return mass_falls ? 4 : 3; }
};

/// A system of three degrees of freedom, with momenta per unit mass, under a thrust that burns. Its
/// states end with further parameters: the vector c along the axes of the thrust, which is its
/// acceleration or, if the mass falls, the direction times the speed w of the exhaust, and then the
/// time t_0 of the clock at which a burn would leave no mass. As m = (t_0 - t) |dm/dt| and the
/// force is w |dm/dt|, the acceleration is then c / (t_0 - t).
DynamicalSystem burning_system(const DynamicalSystem& system, const BurningThrust& thrust);

}  // namespace hamjet
