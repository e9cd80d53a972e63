#pragma once

#include <optional>

#include "../tables/scene_table.hpp"
#include "hamjet/astronomy/epoch.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/formats/orbit_message.hpp"
#include "hamjet/studies/scene.hpp"

namespace hamjet::io {

/// The start of an orbit from an orbit message, and the metadata of the message.
struct NominalFromFile {
  CartesianState state;
  NominalFile file;
};

/// The centre of attraction that a scene has.
struct SceneCentre {
  SystemSettings system;
  std::optional<std::string> stated_name;  ///< value of `ephemeris.center_name`
};

/// A message's GM and the scene's mu must agree to this relative difference. The published values
/// of one body do (398600 to 398600.8 km^3/s^2 for the Earth, 2e-6).
inline constexpr double gm_tolerance = 1e-5;

/// The keys `oem_file` or `opm_file`, `epoch` and `object` of the table `[nominal]`. The file's
/// path is relative to the scene's. Throws Error(scene) for faulty keys, Error(input_output) if the
/// file cannot be read or is not such a message (see read_oem and read_opm), and Error(too_large)
/// if it exceeds the largest size that is read. It also refuses a message whose centre is not that
/// of the scene: a CENTER_NAME with another mu (see body_mu_tolerance); an unknown CENTER_NAME, if
/// the scene's mu is that of a known body and the scene does not state the same name; a GM other
/// than the scene's mu; and zonal coefficients about a body other than the Earth, whose axis all
/// frames that are read have. It warns of an OPM whose Keplerian elements do not belong to its
/// state, and of faults in other numbers that are not used.
NominalFromFile read_nominal_file(const TableReader& nominal, const SceneCentre& centre);

/// The metadata that the message of a table gives for its state; no value for a table without a
/// file. Throws as read_nominal_file, except for the centre and the frame.
std::optional<EphemerisSettings> settings_of_orbit_file(const TableReader& table);

/// What the OPM of a table says of its spacecraft; no value for a table without one. Throws as
/// settings_of_orbit_file.
std::optional<OpmSpacecraft> spacecraft_of_orbit_file(const TableReader& table);

/// The OPM of a table, which must have one. Throws as settings_of_orbit_file.
OrbitParameterMessage parameters_of_orbit_file(const TableReader& table);

/// The frames in which a scene's messages may be: the model `earth` knows how the Earth's axes
/// turn.
AcceptedFrames frames_of(const SystemSettings& system);

/// The epoch of the state that read_nominal_file takes; no value for a table without a file. Throws
/// as read_nominal_file, except for the centre.
std::optional<Epoch> epoch_of_nominal_file(const TableReader& nominal);

}  // namespace hamjet::io
