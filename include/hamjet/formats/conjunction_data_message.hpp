#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/astronomy/epoch.hpp"

// Conjunction Data Messages of the Consultative Committee for Space Data Systems, version 1.0, in
// keyword = value notation (KVN). Builds with XML also read the XML notation. Source: CCSDS
// 508.0-B-1, Conjunction Data Message (2013), sections 3 (contents, table 3-4 the covariance), 4
// (XML) and 6 (syntax).

namespace hamjet::io {

/// What a message says of how air and light act on an object.
struct ConjunctionSpacecraft {
  std::optional<double> visible_area_m2;    ///< AREA_PC
  std::optional<double> drag_area_m2;       ///< AREA_DRG
  std::optional<double> radiation_area_m2;  ///< AREA_SRP
  std::optional<double> mass_kg;            ///< MASS
  std::optional<double> drag_m2_kg;         ///< CD_AREA_OVER_MASS, C_D A / m
  std::optional<double> radiation_m2_kg;    ///< CR_AREA_OVER_MASS, C_R A / m
  /// Covariances of C_D A / m (CDRG_*) with R, T, N and their velocities, then its variance:
  /// m^3/kg, m^3/(kg s), m^4/kg^2.
  std::optional<std::array<double, 7>> drag_covariance;
  /// Those of C_R A / m (CSRP_*), before the variance that with C_D A / m.
  std::optional<std::array<double, 8>> radiation_covariance;
};

/// One of the two objects: its state at the time of closest approach, and the covariance of this
/// state.
struct ConjunctionObject {
  std::string object_designator;         ///< OBJECT_DESIGNATOR
  std::string catalog_name;              ///< CATALOG_NAME
  std::string object_name;               ///< OBJECT_NAME
  std::string international_designator;  ///< INTERNATIONAL_DESIGNATOR
  std::string ephemeris_name = "NONE";   ///< EPHEMERIS_NAME
  std::string covariance_method = "CALCULATED";
  std::string maneuverable = "N/A";
  std::string orbit_center = "EARTH";
  /// REF_FRAME, in capitals: GCRF, EME2000 (J2000 is read as EME2000) or ITRF.
  std::string reference_frame;
  std::array<double, 3> position_km = {};
  std::array<double, 3> velocity_km_s = {};
  /// Covariance of position and velocity along the object's own R, T, N, with inertial velocities;
  /// both halves of the matrix, in m^2, m^2/s, m^2/s^2.
  std::array<std::array<double, 6>, 6> covariance = {};
  ConjunctionSpacecraft spacecraft = {};  ///< as far as the message tells it
  std::vector<std::string> comments;      ///< comments before the state; written, not read
  std::size_t covariance_line = 0;        ///< line of CR_R, if the message was read
};

/// A message about two objects that come near each other.
struct ConjunctionDataMessage {
  std::vector<std::string> comments;  ///< comments of the header; written, not read
  Epoch creation_date;                ///< in UTC
  std::string originator;
  std::string message_id;
  Epoch tca;  ///< time of closest approach, in UTC
  double miss_distance_m = 0;
  std::optional<double> relative_speed_m_s;
  /// Position of the second object relative to the first, along the first one's R, T, N.
  std::optional<std::array<double, 3>> relative_position_m;
  std::optional<std::array<double, 3>> relative_velocity_m_s;
  std::optional<double> collision_probability;
  std::string collision_probability_method;  ///< stands with the probability
  std::array<ConjunctionObject, 2> objects;  ///< OBJECT1 and OBJECT2
  /// Faults of optional numbers that are not used and left out, as `name:line: keyword: what`.
  std::vector<std::string> doubts = {};
};

/// Whether a text has the keyword with which a CDM begins.
bool is_cdm(std::string_view text);

/// Reads a CDM. Other contents of the standard (orbit determination, thrust, operators) are checked
/// by their keywords and left out; an empty optional value counts as absent. Throws
/// Error(input_output), with one line as read_oem, for a text that is not such a message.
ConjunctionDataMessage read_cdm(const std::string& name, std::string_view text);

/// Writes a CDM as text, with numbers of 16 digits. Texts must be printable ASCII.
std::string cdm_text(const ConjunctionDataMessage& message);

}  // namespace hamjet::io
