#pragma once

#include <array>
#include <cstddef>

#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// The places of a commanded system's numbers: the state that its controller believes and the
/// costates of that, the spacecraft's true state, and a matrix by rows.
struct CommandedPlaces {
  static constexpr std::array<std::size_t, 6> believed = {0, 1, 2, 3, 4, 5};
  static constexpr std::array<std::size_t, 6> costates = {9, 10, 11, 12, 13, 14};
  static constexpr std::array<std::size_t, 6> spacecraft = {6, 7, 8, 15, 16, 17};
  static constexpr std::size_t matrix = 18;  ///< the first of nine
  static constexpr std::size_t count = 27;
};

/// A spacecraft of a system of three degrees of freedom whose controller flies states and costates
/// of its own (costate_system) and commands the thrust u = -lambda_p of these. The spacecraft
/// carries out M u with a matrix M of errors, nine parameters. Throws Error(usage) for a system
/// with parameters.
DynamicalSystem commanded_system(const DynamicalSystem& system);

}  // namespace hamjet
