#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/detail/formats/epoch.hpp"

// Orbit messages of the Consultative Committee for Space Data Systems, versions 2.0 and 3.0, on
// reading also 1.0, in keyword = value notation (KVN), and on reading, in builds with XML, in that
// notation too (CCSDS 505.0-B-3 (2023)). Source: CCSDS 502.0-B-3, Orbit Data Messages (2023),
// sections 3 (OPM), 5 (OEM) and 7 (syntax), CCSDS 502.0-B-2 (2009), and CCSDS 502.0-B-1 (2004),
// whose messages are those of version 2.0 without accelerations, covariances and REF_FRAME_EPOCH.

namespace hamjet::io {

/// Largest message that is read, in bytes: some 400 000 states.
inline constexpr std::size_t largest_orbit_message_bytes = std::size_t{64} << 20;

/// A state of one moment, along axes that do not rotate.
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
  std::optional<Epoch> reference_frame_epoch = {};  ///< REF_FRAME_EPOCH, of a frame "of epoch"
  std::size_t center_name_line = 0;                 ///< of CENTER_NAME, where it was read
};

/// A covariance of position and velocity, as a message gives it.
struct OrbitCovariance {
  Epoch epoch;
  std::string reference_frame;  ///< COV_REF_FRAME, in capitals, or the states' where there is none
  std::array<std::array<double, 6>, 6> matrix = {};  ///< both halves: km^2, km^2/s, km^2/s^2
  std::size_t line = 0;                              ///< of its first number
};

/// Osculating elements that an OPM gives beside its state.
struct OrbitElements {
  double semi_major_axis_km = 0;
  double eccentricity = 0;
  double inclination_deg = 0;
  double ascending_node_deg = 0;
  double argument_of_perigee_deg = 0;
  double anomaly_deg = 0;
  bool is_mean_anomaly = false;  ///< or the true one
  std::size_t line = 0;          ///< of SEMI_MAJOR_AXIS
};

/// One block of metadata with the states that follow it.
struct EphemerisSegment {
  OrbitMetadata metadata;
  std::vector<std::string> comments;  ///< before the states; written, not read
  std::vector<OrbitState> states;     ///< in order of time, at least one
  /// USEABLE_START_TIME and USEABLE_STOP_TIME: states outside only help to interpolate.
  std::optional<Epoch> useable_start;
  std::optional<Epoch> useable_stop;
  bool has_acceleration = false;                  ///< it stood behind the states; not kept
  bool has_covariance = false;                    ///< a covariance block followed
  std::vector<OrbitCovariance> covariances = {};  ///< of that block
  std::size_t line = 0;                           ///< of META_START

  bool is_useable(const Epoch& epoch) const {
    return !(useable_start && epoch < *useable_start) && !(useable_stop && *useable_stop < epoch);
  }
};

/// An Orbit Ephemeris Message (OEM): states of one object along time. What it cannot hold: Taylor
/// coefficients, generating functions, checks.
struct OrbitEphemerisMessage {
  std::string version = "2.0";        ///< or "3.0"; on reading also "1.0"
  std::vector<std::string> comments;  ///< of the header; written, not read
  Epoch creation_date;                ///< UTC
  std::string originator;
  std::vector<EphemerisSegment> segments;
};

/// An Orbit Parameter Message (OPM): the state of one object at one moment.
struct OrbitParameterMessage {
  std::string version;
  std::vector<std::string> comments;  ///< of the header; written, not read
  Epoch creation_date;                ///< UTC
  std::string originator;
  OrbitMetadata metadata;
  std::vector<std::string> state_comments;  ///< before the state; written, not read
  OrbitState state;
  std::optional<double> gm_km3_s2;  ///< GM, which stands with the Keplerian elements
  std::size_t gm_line = 0;          ///< of GM
  std::optional<OrbitElements> elements = {};
  std::optional<OrbitCovariance> covariance = {};
  /// What else the message holds, and is not used for the state: "Keplerian elements", "spacecraft
  /// parameters", "covariance", "user-defined parameters".
  std::vector<std::string> unused;
  /// What is wrong with numbers that are not used, as `name:line: keyword: what`.
  std::vector<std::string> doubts = {};
};

/// Reads an OEM. `name` is the file's, printable, for messages. Accelerations are
/// checked and left out. Throws Error(input_output), one line `name:line: keyword: what is wrong,
/// got, must be`, for whatever is not such a message, among others: other versions, a missing
/// or doubled keyword, a keyword that the standard does not have, blocks that do not end, epochs
/// out of order or outside of the span, what is no finite number, a frame that rotates with its
/// body or is not known, a time system in which a second is not a second of the model.
OrbitEphemerisMessage read_oem(const std::string& name, std::string_view text);

/// Reads an OPM; otherwise as read_oem. Units, where they are written, must be those of the
/// standard; of numbers that are not used (elements, spacecraft parameters) what is wrong is among
/// `doubts`. META_START and META_STOP, which some programs write as in an OEM, are passed over.
/// Throws too for a manoeuvre, which the state says nothing about.
OrbitParameterMessage read_opm(const std::string& name, std::string_view text);

/// An OEM as text. Numbers have 16 digits, as many as the standard allows (7.5.6, 7.5.7): what is
/// read back and written again is the same text, and differs from the numbers given by at most
/// 7e-16 of each. Texts must be printable ASCII.
std::string oem_text(const OrbitEphemerisMessage& message);

/// An OPM of the state alone as text; otherwise as oem_text.
std::string opm_text(const OrbitParameterMessage& message);

/// Whether a reference frame is one whose axes do not rotate, as far as it is known here.
bool is_inertial_frame(std::string_view reference_frame);

/// The name of the same axes by which frames are compared: J2000 is EME2000, TEME is TEMEOFDATE;
/// any other name is its own.
std::string_view name_of_axes(std::string_view reference_frame);

/// Why a frame that is not inertial is refused, and what would be right: for messages.
std::string frame_problem(std::string_view reference_frame);

}  // namespace hamjet::io
