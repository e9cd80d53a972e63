#pragma once

#include <string_view>

#include "../formats/orbit_messages/message_agreement.hpp"
#include "hamjet/detail/studies/uncertainty_settings.hpp"
#include "scene_sections.hpp"

namespace hamjet::io {

/// The spacecraft whose covariance is wanted.
struct CovarianceOwner {
  std::string_view who;            ///< "chief" or "deputy"
  std::string_view object_of_cdm;  ///< of a CDM, where the table does not name one
  KnownState state;                ///< at the chief's moment
};

/// The covariance in the message that the key `file` of a table names: of the chief's moment, along
/// the message's inertial axes, which must be the chief's, or along R, T, N of the object. An OEM,
/// an OPM, or a CDM, of which the key `object` names the object. Throws Error(scene) too where the
/// message is not about the owner: its centre, its state (see difference_of_states: more than six
/// standard deviations and the rounding away) or, unless the key `object` names it, the object is
/// another; and Error(input_output) for what is no message.
StateUncertainty read_covariance_file(const TableReader& table, const Nominal& nominal,
                                      const CovarianceOwner& owner);

}  // namespace hamjet::io
