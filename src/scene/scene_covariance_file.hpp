#pragma once

#include <optional>
#include <string_view>

#include "../formats/orbit_messages/message_agreement.hpp"
#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

/// The spacecraft whose covariance is wanted.
struct CovarianceOwner {
  std::string_view who;  ///< "chief" or "deputy"
  std::string_view
      object_of_cdm;  ///< object of a CDM that is taken where the table does not name one
  KnownState state;   ///< state at the chief's moment
  /// C_D A / m and C_R A / m of the scene, whose covariances are wanted too; none without the
  /// force.
  std::optional<double> drag_m2_kg = {};
  std::optional<double> radiation_m2_kg = {};
};

/// The covariance in the message that the key `file` of a table names. It must be at the chief's
/// moment, along the message's inertial axes, which must be the chief's, or along R, T, N of the
/// object. The message is an OEM, an OPM or a CDM, in which the key `object` selects the object.
/// Throws Error(scene) also where the message is not about the owner: if its centre differs, if its
/// state differs by more than six standard deviations plus the rounding (see difference_of_states),
/// or if its object differs and the key `object` does not name it. Throws Error(input_output) for a
/// file that is not a message.
StateUncertainty read_covariance_file(const TableReader& table, const Nominal& nominal,
                                      const CovarianceOwner& owner);

}  // namespace hamjet::io
