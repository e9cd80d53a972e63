#pragma once

#include <optional>

#include "hamjet/detail/formats/epoch.hpp"
#include "hamjet/dynamics/osculating_elements.hpp"
#include "hamjet/studies/scene.hpp"
#include "tables/scene_table.hpp"

namespace hamjet::io {

/// The start of an orbit from an orbit message, and what the message says of it.
struct NominalFromFile {
  CartesianState state;
  NominalFile file;
};

/// The centre of attraction as a scene has it.
struct SceneCentre {
  SystemSettings system;
  std::optional<std::string> stated_name;  ///< `ephemeris.center_name`
};

/// A message's GM and the scene's mu must agree to this, relative: the published values of one body
/// do (398600 to 398600.8 km^3/s^2 of the Earth, 2e-6).
inline constexpr double gm_tolerance = 1e-5;

/// The keys `oem_file` or `opm_file`, `epoch` and `object` of the table `[nominal]`. The file's
/// path is relative to the scene's. Throws Error(scene) about the keys; Error(input_output) if the
/// file cannot be read or is no such message (see read_oem and read_opm), Error(too_large) if it is
/// larger than any that is read.
/// Refused is also a message whose centre is not the scene's: a CENTER_NAME whose mu is another
/// (see body_mu_tolerance), or is not known where the scene's mu is a known body's and the scene
/// does not state that name itself; a GM other than the scene's mu; and zonal coefficients about
/// another body than the Earth, the axis of which all frames that are read have. Warned of is an
/// OPM whose Keplerian elements are not those of its state, and what is wrong with other numbers
/// that are not used.
NominalFromFile read_nominal_file(const TableReader& nominal, const SceneCentre& centre);

/// What the message of a table says of its state, of a table without a file none. Throws as
/// read_nominal_file, but for the centre.
std::optional<EphemerisSettings> settings_of_orbit_file(const TableReader& table);

/// The epoch of the state that read_nominal_file takes, of a table that has no such file none.
/// Throws as that, but for the centre.
std::optional<Epoch> epoch_of_nominal_file(const TableReader& nominal);

}  // namespace hamjet::io
