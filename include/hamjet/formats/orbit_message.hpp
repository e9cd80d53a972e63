#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/epoch.hpp"

// Orbit messages of the Consultative Committee for Space Data Systems in keyword = value notation
// (KVN). Versions 2.0 and 3.0 are read and written, version 1.0 is only read; builds with XML also
// read the XML notation (CCSDS 505.0-B-3 (2023)). Source: CCSDS 502.0-B-3, Orbit Data Messages
// (2023), sections 3 (OPM), 5 (OEM) and 7 (syntax), CCSDS 502.0-B-2 (2009), and CCSDS 502.0-B-1
// (2004), whose messages are those of version 2.0 without accelerations, covariances and
// REF_FRAME_EPOCH.

namespace hamjet::io {

/// Largest message that is read, in bytes: some 400 000 states.
inline constexpr std::size_t largest_orbit_message_bytes = std::size_t{64} << 20;

/// A state at one moment.
struct OrbitState {
  Epoch epoch;
  std::array<double, 3> position_km = {};
  std::array<double, 3> velocity_km_s = {};
};

/// The object of the states, and the centre, frame and time system in which they are given.
struct OrbitMetadata {
  std::string object_name;      ///< OBJECT_NAME
  std::string object_id;        ///< OBJECT_ID
  std::string center_name;      ///< CENTER_NAME
  std::string reference_frame;  ///< REF_FRAME, in capitals
  TimeSystem time_system = TimeSystem::utc;
  std::optional<Epoch> reference_frame_epoch = {};  ///< REF_FRAME_EPOCH, for a frame "of epoch"
  std::size_t center_name_line = 0;  ///< line of CENTER_NAME, if the message was read
};

/// A covariance of position and velocity, as a message gives it.
struct OrbitCovariance {
  Epoch epoch;
  std::string
      reference_frame;  ///< COV_REF_FRAME, in capitals, or the frame of the states if it is absent
  std::array<std::array<double, 6>, 6> matrix =
      {};                ///< both halves of the matrix, in km^2, km^2/s, km^2/s^2
  std::size_t line = 0;  ///< line of its first number
};

/// Osculating elements that an OPM gives beside its state.
struct OrbitElements {
  double semi_major_axis_km = 0;
  double eccentricity = 0;
  double inclination_deg = 0;
  double ascending_node_deg = 0;
  double argument_of_perigee_deg = 0;
  double anomaly_deg = 0;
  bool is_mean_anomaly = false;  ///< otherwise it is the true anomaly
  std::size_t line = 0;          ///< line of SEMI_MAJOR_AXIS
};

/// One block of metadata with the states that follow it.
struct EphemerisSegment {
  OrbitMetadata metadata;
  std::vector<std::string> comments;  ///< comments before the states; written, not read
  std::vector<OrbitState> states;     ///< in order of time, at least one
  /// USEABLE_START_TIME and USEABLE_STOP_TIME: states outside serve for interpolation only.
  std::optional<Epoch> useable_start;
  std::optional<Epoch> useable_stop;
  bool has_acceleration = false;  ///< the states had accelerations, which are not kept
  bool has_covariance = false;    ///< a covariance block followed
  std::vector<OrbitCovariance> covariances = {};  ///< covariances of that block
  std::size_t line = 0;                           ///< line of META_START

  bool is_useable(const Epoch& epoch) const {
    return !(useable_start && epoch < *useable_start) && !(useable_stop && *useable_stop < epoch);
  }
};

/// An Orbit Ephemeris Message (OEM): states of one object along time. It cannot hold Taylor
/// coefficients, generating functions and checks.
struct OrbitEphemerisMessage {
  std::string version = "2.0";        ///< or "3.0"; a message that was read may also have "1.0"
  std::vector<std::string> comments;  ///< comments of the header; written, not read
  Epoch creation_date;                ///< in UTC
  std::string originator;
  std::vector<EphemerisSegment> segments;
};

/// What an OPM says of the spacecraft itself; numbers that are faulty are absent.
struct OpmSpacecraft {
  std::optional<double> mass_kg = {};                ///< MASS
  std::optional<double> radiation_area_m2 = {};      ///< SOLAR_RAD_AREA
  std::optional<double> radiation_coefficient = {};  ///< SOLAR_RAD_COEFF
  std::optional<double> drag_area_m2 = {};           ///< DRAG_AREA
  std::optional<double> drag_coefficient = {};       ///< DRAG_COEFF
};

/// A velocity change that an OPM tells: an impulse, or a burn whose direction stays the same along
/// its axes.
struct OpmManoeuvre {
  Epoch ignition;             ///< MAN_EPOCH_IGNITION, in the time system of the message
  double duration_s = 0;      ///< MAN_DURATION; 0 for an impulse
  double mass_change_kg = 0;  ///< MAN_DELTA_MASS; 0 or negative
  /// MAN_REF_FRAME, in capitals: an inertial frame, or RTN, RSW or TNW of the object's own orbit.
  std::string reference_frame;
  std::array<double, 3> change_km_s = {};  ///< MAN_DV_1, MAN_DV_2, MAN_DV_3
  std::size_t line = 0;                    ///< line of MAN_EPOCH_IGNITION, if the message was read
};

/// An Orbit Parameter Message (OPM): the state of one object at one moment.
struct OrbitParameterMessage {
  std::string version;
  std::vector<std::string> comments;  ///< comments of the header; written, not read
  Epoch creation_date;                ///< in UTC
  std::string originator;
  OrbitMetadata metadata;
  std::vector<std::string> state_comments;  ///< comments before the state; written, not read
  OrbitState state;
  std::optional<double> gm_km3_s2;  ///< GM, which stands with the Keplerian elements
  std::size_t gm_line = 0;          ///< line of GM
  std::optional<OrbitElements> elements = {};
  std::optional<OrbitCovariance> covariance = {};
  OpmSpacecraft spacecraft = {};
  std::vector<OpmManoeuvre> manoeuvres = {};  ///< in the order of the message
  /// Other contents of the message, which are not used: "Keplerian elements", "spacecraft
  /// parameters", "covariance", "user-defined parameters".
  std::vector<std::string> unused;
  /// Faults of numbers that are not used, as `name:line: keyword: what`.
  std::vector<std::string> doubts = {};
};

/// The frames of states that are read: those whose axes do not rotate alone, or the Earth's own
/// axes too (ITRF and its realisations), with velocities relative to them.
enum class AcceptedFrames { inertial, terrestrial_too };

/// Reads an OEM. `name` is the file's, printable, for messages. Accelerations are checked and left
/// out. Throws Error(input_output), with one line `name:line: keyword: what is wrong, got, must
/// be`, for a text that is not such a message. Among the causes are other versions, a missing or
/// doubled keyword, a keyword that the standard does not have, blocks that do not end, epochs out
/// of order or outside of the span, a number that is not finite, a frame that is unknown or not
/// accepted, and a time system whose second is not the second of the model.
OrbitEphemerisMessage read_oem(const std::string& name, std::string_view text,
                               AcceptedFrames frames = AcceptedFrames::inertial);

/// Reads an OPM; otherwise as read_oem. Units, where they are written, must be those of the
/// standard. Faults of numbers that are not used (elements, spacecraft parameters) are listed in
/// `doubts`. META_START and META_STOP, which some programs write as in an OEM, are skipped. The
/// numbers of manoeuvres must be right, for the state does not contain their effect.
OrbitParameterMessage read_opm(const std::string& name, std::string_view text,
                               AcceptedFrames frames = AcceptedFrames::inertial);

/// Writes an OEM as text. Numbers have 16 digits, as many as the standard allows (7.5.6, 7.5.7).
/// They differ from the given numbers by at most 7e-16 of each, and a message that is read and
/// written again is the same text. Texts must be printable ASCII.
std::string oem_text(const OrbitEphemerisMessage& message);

/// Writes an OPM of the state, the spacecraft and its manoeuvres as text; otherwise as oem_text.
std::string opm_text(const OrbitParameterMessage& message);

/// Whether the axes of a reference frame are known not to rotate.
bool is_inertial_frame(std::string_view reference_frame);

/// The common name of equal axes, by which frames are compared: EME2000 for J2000, TEMEOFDATE for
/// TEME, and any other name itself.
std::string_view name_of_axes(std::string_view reference_frame);

/// Whether states in a reference frame are read.
bool is_accepted_frame(std::string_view reference_frame, AcceptedFrames frames);

/// The reason why a frame is refused, and which frames are accepted, for messages.
std::string frame_problem(std::string_view reference_frame,
                          AcceptedFrames frames = AcceptedFrames::inertial);

}  // namespace hamjet::io
