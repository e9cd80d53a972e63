#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hamjet/detail/algebra/eigen.hpp"
#include "hamjet/formats/conjunction_data_message.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/studies/scene.hpp"

// Whether two messages, or a message and a scene, describe the same object at the same moment.

namespace hamjet::io {

/// The state of an object at a moment, and what is known about the object and the axes.
struct KnownState {
  std::vector<std::string> names;  ///< names and identifiers of the object; empty if not known
  std::string center_name;
  std::string reference_frame;
  std::string reference_frame_epoch =
      {};  ///< in ISO 8601; if empty, there is none, or it is the moment of the state
  Eigen::Vector3d position_km = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_km_s = Eigen::Vector3d::Zero();
  /// Errors of position and speed, if the state is not exact.
  double position_error_km = 0;
  double velocity_error_km_s = 0;
};

/// The distinct names of an object that are neither empty nor placeholders.
std::vector<std::string> known_names(std::vector<std::string> names);
std::vector<std::string> known_names_of(const ConjunctionObject& object);

/// Whether both lists have names and share none, regardless of case.
bool are_other_objects(const std::vector<std::string>& one, const std::vector<std::string>& other);

/// Whether two names mean the same centre: the same body by any of its names, or equal names.
bool is_same_centre(const std::string& one, const std::string& other);

/// The axes of a frame in the words of messages: "TOD of 2020-03-01T12:00:00.000000000000".
std::string axes_text(const std::string& reference_frame, const std::string& epoch);

/// Whether two frames have the same axes at a moment: their names mean the same axes, and for
/// frames of date the epochs are equal, where a missing epoch means that moment.
bool is_same_axes(const EphemerisSettings& one, const EphemerisSettings& other);

/// The difference between the states of a message and of a scene, in km and km/s, and the tolerance
/// for it: a number of standard deviations, the rounding of the numbers and, between different
/// axes, their angle.
struct StateDifference {
  double position_km = 0;
  double velocity_km_s = 0;
  double most_position_km = 0;
  double most_velocity_km_s = 0;

  bool is_contradiction() const {
    return !(position_km <= most_position_km && velocity_km_s <= most_velocity_km_s);
  }
};

/// The number of standard deviations by which two states of one object may differ.
inline constexpr double most_standard_deviations = 6;
/// States may differ by this relative to distance and speed: rounding to five digits.
inline constexpr double rounding_of_states = 1e-5;

/// Compares the states of two messages; the standard deviations of position and velocity are given
/// as lengths of vectors. In the same axes the states themselves are compared. The axes of GCRF,
/// ICRF and EME2000 are within 1.2e-7 rad of each other (IERS Conventions (2010), section 5.3.2,
/// the frame bias), and those of other inertial frames within 0.03 rad, the precession of a
/// century. A state in axes that rotate with the Earth (ITRF) is turned about their pole until its
/// position or, near the pole, its velocity agrees with the other one; distance and speed are then
/// compared as in the same axes.
StateDifference difference_of_states(const KnownState& message, const KnownState& scene,
                                     double position_deviation_km, double velocity_deviation_km_s);

/// Interpolates the state at an epoch between two of the states by Hermite's cubic, and estimates
/// its error from the central force of `mu_km3_s2`; the results are the last four parameters.
/// Returns false if the epoch is outside the states. Source: the remainders (h^4/384) x'''' of the
/// cubic and (h^3/72 sqrt(3)) x'''' of its derivative, with x'''' about (mu/r^3)^2 r, taken ten
/// times as large for eccentric orbits.
bool interpolate_state(std::span<const OrbitState> states, const Epoch& epoch, double mu_km3_s2,
                       KnownState& result);

}  // namespace hamjet::io
