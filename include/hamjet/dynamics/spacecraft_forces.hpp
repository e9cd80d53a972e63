#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "hamjet/detail/dynamics/expression.hpp"
#include "hamjet/detail/dynamics/local_field.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"

namespace hamjet {

/// A quantity in which spacecraft differ, such as C_D A / m: a number of the system, or one of the
/// parameters at the end of its state.
struct SpacecraftCoefficient {
  double value = 0;
  std::optional<std::size_t> parameter = {};  ///< index among the system's parameters

  /// The coefficient in a system whose inputs are (q, p, c, t), with n degrees of freedom.
  Expression in(std::span<const Expression> inputs, std::size_t degrees_of_freedom) const;
};

/// An atmosphere that turns with its body, and bulges where the afternoon is (Harris-Priester):
///
///   rho = factor [rho_0(x) + (rho_1(x) - rho_0(x)) cos^n(psi / 2)] ,
///
/// where psi is the angle between the position and the apex of the bulge, the direction of the Sun
/// turned by `lag` about the axis. Source: Montenbruck and Gill, Satellite Orbits, section 3.5.
struct TurningAtmosphere {
  std::shared_ptr<const LocalField> least;     ///< rho_0, in axes that are fixed to the body
  std::shared_ptr<const LocalField> greatest;  ///< rho_1; null for an atmosphere without a bulge
  std::shared_ptr<const TimeFunction> sun;     ///< the Sun's position, for the bulge
  double lag = 0;                              ///< radians
  int exponent = 4;                            ///< n, even and positive
  double rate = 0;                             ///< angular velocity about the third fixed axis
  SpacecraftCoefficient factor = {1};          ///< a factor of all densities
};

/// The system with the drag
///
///   F = -B rho |v| v / 2 ,   v = p - omega x q ,
///
/// of an atmosphere on a spacecraft with B = C_D A / m. `axes` are those of earth_gravity, to which
/// the system must belong. Densities, B and lengths are in units in which B rho is one over a
/// length. Throws Error(usage) for missing parts, and an exponent that is not even and positive.
DynamicalSystem with_drag(const DynamicalSystem& system,
                          const std::shared_ptr<const TimeFunction>& axes,
                          const TurningAtmosphere& atmosphere, const SpacecraftCoefficient& B);

/// A constant acceleration along R (away from the body), T (in the plane of the motion, forward)
/// and N (of the angular momentum) of the spacecraft's own orbit.
struct OrbitThrust {
  std::array<SpacecraftCoefficient, 3> along;  ///< R, T, N
  Extended unit = 1;  ///< what a coefficient of 1 is in the system's unit of acceleration
};

/// The system with this acceleration, which comes from no potential. The system is one of three
/// degrees of freedom, with momenta per unit mass.
DynamicalSystem with_thrust(const DynamicalSystem& system, const OrbitThrust& thrust);

}  // namespace hamjet
