#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/studies/scene.hpp"

// Whether two messages, or a message and a scene, speak of the same object at the same moment.

namespace hamjet::io {

/// The state of an object at a moment, and what is known of the object and of the axes.
struct KnownState {
  std::vector<std::string> names;  ///< of the object: name and identifiers; none: not known
  std::string center_name;
  std::string reference_frame;
  std::string reference_frame_epoch = {};  ///< ISO 8601; empty: none, or that of the moment
  Eigen::Vector3d position_km = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_km_s = Eigen::Vector3d::Zero();
  /// Of the place and the speed, where they are not exact.
  double position_error_km = 0;
  double velocity_error_km_s = 0;
};

/// Names of an object that say something, each once: neither empty, nor those that stand for none.
std::vector<std::string> known_names(std::vector<std::string> names);

/// Whether both know the object and no name of one is a name of the other, in capitals or not.
bool are_other_objects(const std::vector<std::string>& one, const std::vector<std::string>& other);

/// Whether two names are of one centre: a body by any of its names, or the same name.
bool is_same_centre(const std::string& one, const std::string& other);

/// The axes of a frame as messages say them: "TOD of 2020-03-01T12:00:00.000000000000".
std::string axes_text(const std::string& reference_frame, const std::string& epoch);

/// Whether two frames have the same axes at a moment: names of the same axes, and of frames of date
/// the epoch is that moment where they give none.
bool is_same_axes(const EphemerisSettings& one, const EphemerisSettings& other);

/// What is between the states of a message and of a scene, km and km/s, and what may be: so many
/// standard deviations, the rounding of the numbers, and between other axes their angle.
struct StateDifference {
  double position_km = 0;
  double velocity_km_s = 0;
  double most_position_km = 0;
  double most_velocity_km_s = 0;

  bool is_contradiction() const {
    return !(position_km <= most_position_km && velocity_km_s <= most_velocity_km_s);
  }
};

/// Standard deviations that two states of one object may lie apart.
inline constexpr double most_standard_deviations = 6;
/// States agree to this, relative to distance and speed: five digits.
inline constexpr double rounding_of_states = 1e-5;

/// Compares the states of two messages, with the standard deviations of the place and the velocity
/// as lengths of vectors. In the same axes the states themselves are compared. GCRF, ICRF and
/// EME2000 are within 1.2e-7 rad of each other (IERS Conventions (2010), section 5.3.2, the frame
/// bias), other inertial ones within 0.03 rad, the precession of a century. Axes that rotate with
/// the Earth (ITRF) are turned about their pole, from the position or, near the pole, the velocity,
/// and between these distance and speed are compared as in the same axes.
StateDifference difference_of_states(const KnownState& message, const KnownState& scene,
                                     double position_deviation_km, double velocity_deviation_km_s);

/// The state at an epoch between two of the states, by Hermite's cubic, with its error by the
/// central force of `mu_km3_s2`, into the four last members; false if the epoch is beyond them.
/// Source: the remainders (h^4/384) x'''' of the cubic and (h^3/72 sqrt(3)) x'''' of its
/// derivative, with x'''' about (mu/r^3)^2 r, ten times that for eccentric orbits.
bool interpolate_state(std::span<const OrbitState> states, const Epoch& epoch, double mu_km3_s2,
                       KnownState& result);

}  // namespace hamjet::io
