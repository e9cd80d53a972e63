#pragma once

#include <string_view>

#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

/// The covariance in the message that the key `file` of a table names: of the chief's moment, along
/// the message's inertial axes, which must be the chief's, or along R, T, N. An OEM, an OPM, or a
/// CDM, of which the key `object` names the object; `default_object` is that of a CDM without it.
StateUncertainty read_covariance_file(const TableReader& table, const Nominal& nominal,
                                      std::string_view default_object);

}  // namespace hamjet::io
