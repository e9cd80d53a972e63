#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "hamjet/detail/dynamics/local_field.hpp"
#include "hamjet/detail/dynamics/time_function.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "hamjet/dynamics/spacecraft_forces.hpp"

namespace hamjet {

/// A body that disturbs an orbit about another one: the Sun or the Moon.
struct DisturbingBody {
  double mu = 0;                                ///< gravitational parameter
  std::shared_ptr<const LocalField> potential;  ///< mu/r about its own centre
  /// The position of its centre from the central body's.
  std::shared_ptr<const TimeFunction> position;
};

/// The pressure of the Sun's radiation on a sphere (cannonball): an acceleration
///
///   C light(t) k (q - s) / |q - s|^3
///
/// away from the Sun, with C = C_R A / m and the k of `potential`, the pressure at unit distance.
/// The light that a spacecraft has is a function of the time along a nominal, without derivatives.
/// Source: Montenbruck and Gill, Satellite Orbits, section 3.4.
struct RadiationPressure {
  std::shared_ptr<const LocalField> potential;  ///< k/r about the Sun
  std::shared_ptr<const TimeFunction> sun;      ///< the Sun's position s
  std::shared_ptr<const TimeFunction> light;    ///< from 0 to 1; null without shadows
  SpacecraftCoefficient coefficient;            ///< C
};

/// A field that a parameter c adds to the body's, (c - nominal) times its potential: the body's
/// field is linear in each of its coefficients.
struct FieldVariation {
  std::shared_ptr<const LocalField> potential;  ///< in axes that are fixed to the body
  SpacecraftCoefficient coefficient;            ///< c; its `value` is that of the nominal
};

/// The gravity that acts on a satellite of a body that turns. All units are the caller's, times
/// are counted from the caller's epoch.
struct GravityOfTurningBody {
  std::shared_ptr<const LocalField> potential;  ///< U, in axes that are fixed to the body
  std::shared_ptr<const TimeFunction> axes;     ///< R, row after row: from inertial to fixed axes
  std::vector<DisturbingBody> others;
  std::optional<RadiationPressure> radiation = {};
  std::vector<FieldVariation> variations = {};  ///< the variations of the body's field
  /// What U and its variations are multiplied by, in a unit of its own: mu may be a parameter.
  SpacecraftCoefficient scale = {1};
  Extended unit_of_scale = 1;
  /// The number of parameters of the system, which the coefficients may name.
  std::size_t parameters = 0;
};

/// The system in z = (x, y, z, p_x, p_y, p_z), inertial axes about the body's centre, momenta per
/// unit mass, with
///
///   H = |p|^2/2 - U(R(t) q) - sum over the others of mu [1/|q - s(t)| - q . s(t) / |s(t)|^3] ,
///
/// where variations by parameters are added to U, and with C light(t) k / |q - s(t)| for the
/// radiation. The term q . s(t) is the acceleration of the central body, with which the axes move.
/// All potentials are evaluated along the fixed axes, so that their local polynomials are summed
/// before they are composed with a series. Source: Montenbruck and Gill, Satellite Orbits,
/// chapter 3. Throws Error(usage) for a missing part or one of another size.
DynamicalSystem earth_gravity(const GravityOfTurningBody& gravity);

}  // namespace hamjet
