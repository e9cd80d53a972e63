#pragma once

#include <hamjet/dynamics/osculating_elements.hpp>
#include <hamjet/studies/scene.hpp>

#include "scene_table.hpp"

namespace hamjet::io {

/// The start of an orbit from an orbit message, and what the message says of it.
struct NominalFromFile {
  CartesianState state;
  NominalFile file;
};

/// The keys `oem_file` or `opm_file`, `epoch` and `object` of the table `[nominal]`. The file's
/// path is relative to the scene's. Throws Error(scene) about the keys; Error(input_output) if the
/// file cannot be read or is no such message (see read_oem and read_opm), Error(too_large) if it is
/// larger than any that is read.
NominalFromFile read_nominal_file(const TableReader& nominal);

}  // namespace hamjet::io
